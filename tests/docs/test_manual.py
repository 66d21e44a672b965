"""The manual says what is so: its domains are checked, its sessions are repeated, its links lead somewhere.

How a page is read:

- A ``golc`` block that begins with ``domain`` is a file without findings, laid out as ``golc fmt`` does it.
- If a ``text`` block that begins with a finding follows at once, the file has exactly these findings.
- Any other ``golc`` block is a part of a file, a part of a program, or expressions, and has to parse.
- A block with a name behind its language (``golc garden.gl``) is saved under that name for what stands below it, or
  appended to the file (``golc + garden.gl``), which then as a whole is a file without findings.
- A ``console`` block with a ``$ golc`` or ``$ python`` line is a session: its commands are run, and their output is
  compared (see ``Terminal``). What should not be run stands in a block of another language.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click
import pytest

from golc.cli import COMMANDS, cli
from golc.diagnostics import Code, Findings, Source
from golc.loading import examine
from golc.rendering import render
from golc.syntax.format import formatted
from golc.syntax.parse import parse_expression, parse_file
from golc.theory.declare import BUILTIN_TYPES, FUNCTIONS
from golc.theory.elaborate_actions import SOURCES

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Protocol

    class Terminal(Protocol):
        folder: Path
        perform: Callable[[str, list[str]], None]


ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")), *sorted((ROOT / "examples").glob("*/README.md"))]
FENCE = re.compile(r"^```(\S*) ?(.*)\n((?:.*\n)*?)```$", re.MULTILINE)
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


@dataclass(frozen=True)
class Block:
    """A fenced block; ``name`` is what stands behind the language, ``line`` the line of its opening fence."""

    page: Path
    line: int
    language: str
    name: str
    text: str
    findings: str = ""
    """The text block below a domain that shows what is wrong with it."""

    @property
    def is_domain(self) -> bool:
        return self.language == "golc" and re.search(r"^domain\b", self.text, re.MULTILINE) is not None

    @property
    def is_session(self) -> bool:
        return self.language == "console" and re.search(r"^\$ (golc|python)\b", self.text, re.MULTILINE) is not None

    @property
    def file(self) -> str:
        return self.name.removeprefix("+ ") or "example.gl"

    def save(self, folder: Path) -> None:
        """Write the file that the block is, or append it."""
        with (folder / self.file).open("a" if self.name.startswith("+") else "w", encoding="utf-8") as file:
            file.write(self.text)

    def __str__(self) -> str:
        return f"{_name(self.page)}:{self.line}"


def blocks(page: Path) -> list[Block]:
    text = page.read_text(encoding="utf-8")
    fences = list(FENCE.finditer(text))
    found: list[Block] = []
    for fence, below in zip(fences, [*fences, None][1:], strict=True):
        language, name, body = fence.groups()
        adjacent = below is not None and not text[fence.end() : below.start()].strip()
        findings = below[3] if below and adjacent and language == "golc" and _is_finding(below) else ""
        found.append(Block(page, text.count("\n", 0, fence.start()) + 1, language, name, body, findings))
    return found


def _is_finding(fence: re.Match[str]) -> bool:
    return fence[1] == "text" and re.match(r"(error|warning)\[GL\d+\]", fence[3]) is not None


BLOCKS = [block for page in PAGES for block in blocks(page)]


def _name(page: Path) -> str:
    return str(page.relative_to(ROOT))


def _ids(found: list[Block]) -> list[str]:
    return [str(block) for block in found]


DOMAINS = [block for block in BLOCKS if block.is_domain]
PARTS = [block for block in BLOCKS if block.language == "golc" and not block.is_domain]
LONGEST = list({(block.page, block.file): block for block in PARTS if block.name}.values())
"""The last block of each file that has several."""


@pytest.mark.parametrize("block", DOMAINS, ids=_ids(DOMAINS))
def test_domain_has_the_findings_that_the_page_shows(
    block: Block, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    save_page(block, tmp_path)
    found = examine(block.file).findings
    assert "\n\n".join(map(render, found)) == block.findings.rstrip()


def save_page(block: Block, folder: Path) -> None:
    """Write the file of a block as far as the page has come with it, and whatever other files the page shows."""
    for one in blocks(block.page):
        if one.name and (one.file != block.file or one.line < block.line):
            one.save(folder)
    block.save(folder)


@pytest.mark.parametrize("block", LONGEST, ids=_ids(LONGEST))
def test_file_in_several_blocks_has_no_findings(block: Block, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    save_page(block, tmp_path)
    assert "\n\n".join(map(render, examine(block.file).findings)) == ""


WHOLE = [*(block for block in DOMAINS if not block.findings), *LONGEST]


@pytest.mark.parametrize("block", WHOLE, ids=_ids(WHOLE))
def test_file_is_laid_out_canonically(block: Block, tmp_path: Path) -> None:
    save_page(block, tmp_path)
    text = (tmp_path / block.file).read_text(encoding="utf-8")
    assert formatted(Source(str(block), text), Findings()) == text


@pytest.mark.parametrize("block", PARTS, ids=_ids(PARTS))
def test_part_of_a_file_parses(block: Block) -> None:
    program = "".join(f"    {line}\n" for line in block.text.splitlines())
    wrapped = (f"domain d\n{block.text}", f"domain d\nproc p:\n{program}")
    assert any(map(_parses, wrapped)) or all(map(_is_expression, filter(str.strip, block.text.splitlines())))


def _parses(text: str) -> bool:
    findings = Findings()
    return parse_file(Source("part", text), findings) is not None and not findings.diagnostics


def _is_expression(text: str) -> bool:
    findings = Findings()
    return parse_expression(Source("part", text), findings) is not None and not findings.diagnostics


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_sessions_run_as_the_page_shows(page: Path, terminal: Terminal) -> None:
    for block in blocks(page):
        if block.name:
            block.save(terminal.folder)
        elif block.is_session:
            for line, command, expected in _commands(block):
                try:
                    terminal.perform(command, expected)
                except AssertionError as error:
                    pytest.fail(f"{_name(page)}:{line}: $ {command}\n{error}", pytrace=False)


def _commands(block: Block) -> Iterator[tuple[int, str, list[str]]]:
    """Each command of a session with its line in the page and the lines below it; ``\\`` at the end continues it."""
    lines = block.text.replace("\\\n", "").splitlines()
    starts = [place for place, line in enumerate(lines) if line.startswith("$ ")]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        yield block.line + 1 + start, lines[start][2:].split("  #")[0].rstrip(), lines[start + 1 : end]


@pytest.mark.parametrize(
    ("command", "shown"),
    [
        ("golc plan examples/sorter/sorter.gl sort_one", ["feed", "look", "push(right)", "1 plan"]),
        ("golc plan examples/sorter/sorter.gl sort_one", ["feed", "look", "push(left)"]),
        ("golc plan examples/sorter/sorter.gl sort_one", ["…", "push(left)", "1 plan", "2 plans"]),
        ("echo feed | cat", ["push"]),
    ],
    ids=["another line", "a line too few", "a line too many", "in a shell"],
)
def test_what_a_command_does_not_write_is_told(command: str, shown: list[str], terminal: Terminal) -> None:
    with pytest.raises(AssertionError, match="but came"):
        terminal.perform(command, shown)


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_links_lead_somewhere(page: Path) -> None:
    prose = FENCE.sub("", page.read_text(encoding="utf-8"))
    links = [link for link in LINK.findall(prose) if "://" not in link]
    assert [link for link in links if not _exists(page, link)] == []


def _exists(page: Path, link: str) -> bool:
    path, _, anchor = link.partition("#")
    target = page if not path else page.parent / path
    return target.exists() and (not anchor or anchor in _anchors(target))


def _anchors(page: Path) -> set[str]:
    """The anchors that the headings of a page get where the project is hosted."""
    prose = FENCE.sub("", page.read_text(encoding="utf-8"))
    headings = re.findall(r"^#+ (.*)$", prose, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_is_described(name: str) -> None:
    page = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
    command = cli.get_command(click.Context(cli), name)
    assert command is not None
    options = [param for param in command.params if isinstance(param, click.Option) and not param.hidden]
    missing = [option.opts[-1] for option in options if not re.search(rf"`[^`]*{option.opts[-1]}\b", page)]
    assert f"## golc {name}" in page
    assert missing == []


def test_every_code_is_listed() -> None:
    page = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\| (GL\d+) \| (.*) \|$", page, re.MULTILINE)
    assert listed == sorted((code.code, code.title) for code in Code)


def test_every_word_of_the_language_is_in_the_index() -> None:
    page = (ROOT / "docs" / "words.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\| `([a-z]+)` \|", page, re.MULTILINE)
    grammar = (ROOT / "grammar" / "golc.lark").read_text(encoding="utf-8")
    words = {*re.findall(r'"([a-z]+)"', grammar), *re.findall(r"^_[A-Z.1]+: /([a-z]+)", grammar, re.MULTILINE)}
    assert listed == sorted(listed)
    assert set(listed) == words | {*BUILTIN_TYPES, *FUNCTIONS, *SOURCES}
