"""Nesting deeper than 500 levels is a finding, and quickly found."""

from __future__ import annotations

import pytest

from golc.diagnostics import Code, Findings, Source, Span
from golc.syntax.failure import MOST_KEPT, Failure, read
from golc.syntax.parse import parse_expression, parse_file
from golc.syntax.recovery import mending
from golc.syntax.recovery.draft import Draft
from golc.syntax.recovery.reading import Reading

DEEP = {
    "parentheses": ("(" * 501 + "1" + ")" * 501, "(" * 500 + "1" + ")" * 500),
    "sets": ("{" * 501 + "}" * 501, "{" * 500 + "}" * 500),
    "negation": ("not " * 501 + "a", "not " * 500 + "a"),
    "minus": ("-" * 501 + "1", "-" * 500 + "1"),
    "conjunction": ("a" + " and a" * 501, "a" + " and a" * 500),
    "sum": ("a" + " + a" * 501, "a" + " + a" * 500),
    "implication": ("a implies " * 501 + "a", "a implies " * 500 + "a"),
    "condition": ("a if b else " * 501 + "a", "a if b else " * 500 + "a"),
    "index": ("a" + "[0]" * 501, "a" + "[0]" * 500),
    "calls": ("f(" * 501 + "1" + ")" * 501, "f(" * 500 + "1" + ")" * 500),
    "quantifiers": ("exists x: t. " * 501 + "a", "exists x: t. " * 500 + "a"),
}


@pytest.mark.parametrize("kind", DEEP)
def test_one_level_too_many(kind: str) -> None:
    findings = Findings()
    too_deep, deep = DEEP[kind]

    assert parse_expression(Source("t", too_deep), findings) is None
    (finding,) = findings.diagnostics
    assert (finding.code, finding.message) == (Code.NESTING, "nesting is deeper than 500 levels")
    assert parse_expression(Source("t", deep), Findings()) is not None


def blocks(levels: int) -> str:
    lines = [f"{'    ' * level}while a:\n" for level in range(1, levels)]
    return "domain d\nproc p:\n" + "".join(lines) + "    " * levels + "skip\nfluent f = 1\n"


def test_blocks() -> None:
    findings = Findings()
    file = parse_file(Source("t", blocks(501)), findings)

    assert file is not None and len(file.declarations) == 1
    assert [(d.code, d.span.line) for d in findings.diagnostics] == [(Code.NESTING, 503)]
    assert len(getattr(parse_file(Source("t", blocks(500)), Findings()), "declarations", ())) == 2


def test_the_next_declaration_is_read() -> None:
    findings = Findings()
    file = parse_file(Source("t", f"domain d\nfluent f = {DEEP['sum'][0]}\nfluent g = 1\n"), findings)

    assert file is not None and len(file.declarations) == 1
    assert [(d.code, d.span.line, d.span.column) for d in findings.diagnostics] == [(Code.NESTING, 2, 12)]


@pytest.mark.parametrize("text", ["(" * 10**6, "(" * 10**6 + "1" + ")" * 10**6])
def test_a_million_brackets(text: str) -> None:
    findings = Findings()
    parse_file(Source("t", f"domain d\nfluent f = {text}\n"), findings)

    assert [d.code for d in findings.diagnostics] == [Code.NESTING]


def test_the_parsers_stacks_of_a_long_line_are_kept_only_in_part() -> None:
    text = "fluent f = " + "true implies " * 2000 + "$\n"
    failed = read(Span(Source("t", text), 0, len(text)), "declaration", text)

    assert isinstance(failed, Failure)
    assert failed.place == text.index("$")
    assert len(failed.stack) > 2000
    assert sum(map(len, failed.stacks)) <= MOST_KEPT < sum(range(4000)) / 2
    assert len(failed.stacks) < len(failed.line)


def test_brackets_in_strings_and_comments_are_not_nested() -> None:
    findings = Findings()
    text = f'domain d # {"(" * 600}\nproc p:\n    say "{"(" * 600}"\n    say "\\"{"[" * 600}"\n'

    assert parse_file(Source("t", text), findings) is not None
    assert findings.diagnostics == []


def test_a_number_that_is_too_long() -> None:
    findings = Findings()
    assert parse_file(Source("t", f"domain d\nconst c = {'1' * 4000}\n"), findings) is not None
    assert findings.diagnostics == []

    parse_file(Source("t", f"domain d\nconst c = {'1' * 10**6}\ntype t = 1..{'2' * 5000}\n"), findings)

    assert [(d.code, d.message) for d in findings.diagnostics] == [
        (Code.SYNTAX, "a number of 1000000 digits is too long: the limit is 4000"),
        (Code.SYNTAX, "a number of 5000 digits is too long: the limit is 4000"),
    ]


def test_what_a_deep_mistake_is_passed_over_with_is_not_sought_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    depth, read_to = 400, list[int]()

    class Counted(Reading):
        def __init__(self, draft: Draft, start: str) -> None:
            super().__init__(draft, start)
            read_to.append(self.place)

    monkeypatch.setattr(mending, "Reading", Counted)
    heads = "".join(f"{' ' * (level + 1)}if true:\n" for level in range(depth))
    block = " " * (depth + 1)
    text = f"domain d\nproc p:\n{heads}{block}choose:\n{block} skip\n{block}skip\n"
    findings = Findings()
    parse_file(Source("t", text), findings)

    assert [finding.message for finding in findings.diagnostics] == ["this `choose` has one branch only"]
    assert sum(read_to) <= mending.TRIALS + 4 * len(text)
