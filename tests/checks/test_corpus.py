"""A sound domain with one mistake at a time: each is one finding, with its place, its words and its help."""

from __future__ import annotations

import re
import shutil
from collections.abc import Set
from pathlib import Path

import pytest

from golc.diagnostics import Findings, Source, UserError
from golc.embed.printing import python_text
from golc.loading import examine
from golc.rendering import render
from golc.syntax.parse import parse_file
from tests.checks.slips import CORPUS, Mistake, mistakes, said
from tests.notation import no_python

FOUR = frozenset({"misspelt name", "wrong arity", "wrong type", "missing part"})
WORDS = frozenset({"misspelt keyword", "missing part"})
KINDS: dict[str, Set[str]] = {
    **dict.fromkeys(("const", "type", "static", "fluent", "initially", "define", "action", "exog", "proc"), FOUR),
    **dict.fromkeys(("poss", "causes", "senses", "cost", "after", "invariant", "goal", "prune", "prune after"), FOUR),
    **dict.fromkeys(("given", "run", "scenario on", "until", "expect"), FOUR),
    **dict.fromkeys(("call", "test", "if", "elif", "while", "pick", "pick in", "star", "for", "for in", "let"), FOUR),
    **dict.fromkeys(("on", "on some", "guard", "search", "wait until", "within", "say", "abort"), FOUR),
    **dict.fromkeys(("by prompt", "timeout", "set"), FOUR),
    # Their keys are counted, and their parameters named, otherwise.
    **dict.fromkeys(("static table", "sensing table"), FOUR - {"wrong arity"}),
    **dict.fromkeys(("axiom", "by call", "binding with parameters", "report", "host"), FOUR - {"wrong type"}),
    "extern": (FOUR - {"wrong arity"}) | {"wrong function"},
    "self": {"misspelt name", "wrong arity"},
    "import": {"misspelt name", "misspelt keyword", "missing part"},
    # These have nothing but their words and blocks.
    **dict.fromkeys(("domain", "otherwise", "scenario", "device"), WORDS),
    **dict.fromkeys(("choose", "together", "prefer", "interrupts"), WORDS),
    **dict.fromkeys(("skip", "wait"), frozenset({"misspelt name"})),
    "by start": {"misspelt keyword", "wrong behaviour"},
    "notation": {"other notation", "out of place", "indentation", "missing part"},
    "reserved word": {"reserved word"},
}
"""What may be wrong in every kind of declaration, line and statement."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return Path(shutil.copytree(CORPUS, tmp_path_factory.mktemp("corpus") / "depot"))


def test_the_domain_itself_has_no_finding() -> None:
    assert examine(CORPUS / "depot.gl", proofs=True).findings == ()


@pytest.mark.parametrize("mistake", [*mistakes()], ids=lambda mistake: mistake.title.replace(" ", "-"))
def test_a_mistake_is_one_finding(mistake: Mistake, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    Path("depot.gl").write_text("\n".join(mistake.text) + "\n", encoding="utf-8")
    findings = examine("depot.gl", proofs=True).findings
    assert [line for finding in findings for line in said(finding)] == mistake.said
    assert len(findings) == 1


def in_other_words() -> list[Mistake]:
    """One mistake for each sentence that is said of some, whatever it quotes."""
    sentences = {tuple(re.sub("`[^`]*`|\\d+", "…", line) for line in mistake.said): mistake for mistake in mistakes()}
    return [*sentences.values()]


def test_a_mistake_in_python_is_told_in_python(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    told: dict[str, list[str]] = {}
    codes: set[str] = set()
    for mistake in in_other_words():
        findings = Findings()
        tree = parse_file(Source("depot.gl", "\n".join(mistake.text) + "\n"), findings)
        if tree is None or findings.has_errors:
            continue  # it is about the text of a `.gl` file
        try:
            Path("depot_in_python.py").write_text(python_text(tree), encoding="utf-8")
        except UserError:
            continue  # Python itself does not read it
        for finding in examine("depot_in_python.py", proofs=True).findings:
            if finding.span.source.name == "depot_in_python.py":
                codes.add(finding.code.code)
                told[mistake.title] = told.get(mistake.title, []) + no_python(render(finding))
                assert finding.fix is None
    assert {title: pieces for title, pieces in told.items() if pieces} == {}
    assert len(codes) > 30


def test_every_kind_of_line_has_every_sort_of_mistake() -> None:
    found: dict[str, set[str]] = {}
    for mistake in mistakes():
        kind, sort = mistake.title.rstrip(" 0123456789").split(": ")
        found.setdefault(kind, set()).add(sort)
    assert {
        kind: needed - found.get(kind, set()) for kind, needed in KINDS.items() if needed - found.get(kind, set())
    } == {}
