"""Writes `forms.md`, the page that shows both forms of the language side by side: `python docs/forms.py`.

What it shows is the golc of `forms.toml`; the Python beside it is what `golc convert` writes. A test compares the page
with what this file makes, reads both sides of each row, and looks whether every construct has one.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent, indent
from typing import Any, Literal

from golc.diagnostics import Findings, Source
from golc.embed.printing import python_text
from golc.syntax.parse import parse_file

PAGE = Path(__file__).with_name("forms.md")


@dataclass(frozen=True)
class Row:
    """A piece of golc; ``also``: other Python that says the same."""

    golc: str
    also: tuple[str, ...] = ()


Kind = Literal["head", "declaration", "statement", "expression"]


@dataclass(frozen=True)
class Section:
    """Rows of one kind under a title."""

    title: str
    kind: Kind
    rows: tuple[Row, ...]
    text: str = ""


def _section(section: Mapping[str, Any]) -> Section:
    rows = tuple(
        Row(row["golc"].strip(), tuple(each.strip() for each in row.get("also", ()))) for row in section["row"]
    )
    return Section(section["title"], section["kind"], rows, section.get("text", ""))


DATA = tomllib.loads(Path(__file__).with_name("forms.toml").read_text(encoding="utf-8"))
CONTEXT: str = DATA["context"]
SECTIONS = tuple(map(_section, DATA["section"]))


HEAD = """# Both forms, side by side

Every construct of the language as text and [in Python](embedding.md). The Python is what
[`golc convert`](command-line.md#golc-convert) writes; below a line stands other Python that says the same. The rows
speak of a lift with these declarations: `floor`, `door` with the symbols `open` and `closed`; the fluents `at`, `gate`,
`wanted`, `lit(n)` and `stops`; the actions `go(n)`, `turn_off(n)` and `look`, the exogenous action `call(n)`; the
procedures `serve(n)` and `control`.

`domain lift` is `theory = Theory("lift")`, at the head of the file below `from golc.embed import …`."""


def golc_file(section: Section, each: Row) -> str:
    """A whole file with a row in it, its last declarations."""
    match section.kind:
        case "head" | "declaration":
            return f"{_context(section)}\n{each.golc}\n"
        case "statement":
            return f"{CONTEXT}\nproc p:\n{indent(each.golc, '    ')}\n"
        case "expression":
            return f"{CONTEXT}\ngoal g: {each.golc}\n"


def python_file(section: Section, python: str) -> str:
    """The same with the row in Python."""
    match section.kind:
        case "head" | "declaration":
            body = python
        case "statement":
            body = f"@theory.proc\ndef p():\n{indent(python, '    ')}"
        case "expression":
            body = f"@theory.goal\ndef g():\n    return {python}"
    head = "from __future__ import annotations\n\nfrom golc.embed import *\n"
    return f"{head}\n{_below_imports(_context(section))}\n\n{body}\n"


def python_of(section: Section, each: Row) -> str:
    """The Python of a row as `golc convert` writes it."""
    before, whole = _below_imports(_context(section)), _below_imports(golc_file(section, each))
    assert whole.startswith(before), whole
    python = whole[len(before) :].strip("\n")
    match section.kind:
        case "head" | "declaration":
            return python
        case "statement":
            return dedent(python.partition("def p():\n")[2])
        case "expression":
            return python.partition("    return ")[2]


def _context(section: Section) -> str:
    return CONTEXT.partition("\n")[0] + "\n" if section.kind == "head" else CONTEXT


def _below_imports(text: str) -> str:
    """The Python of a file from the line on that makes the theory."""
    file = parse_file(Source("forms.gl", text), Findings())
    assert file is not None, text
    return "theory = " + python_text(file).partition("theory = ")[2]


def page() -> str:
    """The page as Markdown."""
    parts = [HEAD, *(part for section in SECTIONS for part in _markdown(section))]
    return "\n\n".join(parts) + "\n"


def _markdown(section: Section) -> list[str]:
    parts = [f"## {section.title}", *([section.text] if section.text else [])]
    if section.kind == "expression":
        lines = [f"| {_code(each.golc)} | {_python_cell(section, each)} |" for each in section.rows]
        return [*parts, "\n".join(["| golc | Python |", "|---|---|", *lines])]
    cells = [_cells(section, each) for each in section.rows]
    return [*parts, "\n\n".join(["<table>\n<tr><th>golc</th><th>Python</th></tr>", *cells, "</table>"])]


def _python_cell(section: Section, each: Row) -> str:
    return "<br>".join(_code(python) for python in (python_of(section, each), *each.also))


def _code(text: str) -> str:
    return f"`{text.replace('|', chr(92) + '|')}`"


def _cells(section: Section, each: Row) -> str:
    blocks = "\n\n---\n\n".join(_block("python", python) for python in (python_of(section, each), *each.also))
    return f"<tr><td>\n\n{_block('golc', each.golc)}\n\n</td><td>\n\n{blocks}\n\n</td></tr>"


def _block(language: str, text: str) -> str:
    return f"```{language}\n{text}\n```"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
