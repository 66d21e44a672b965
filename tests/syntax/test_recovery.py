"""One wrong declaration never hides the next."""

from __future__ import annotations

import re

import pytest

from golc.diagnostics import Code, Findings, Source
from golc.syntax.parse import parse_expression, parse_file

TEN = """domain ten

type station = 1...6
const n: 3
fluent at: station := 1
fluent ok: station = 1
fluent open(d: door = true

action go(s: station)
    poss at != s

action stop:
    poss at == 1
    causes at = 2

define done := at = 1.

proc control:
    while not done
        go(1)

acton wait_here

goal home: 1 < at < 3

device rcx "ten.nqc":
    0 go by cal go
"""


def findings_of(text: str) -> list[tuple[int, int, Code, str]]:
    findings = Findings()
    parse_file(Source("t", text), findings)
    return [(d.span.line, d.span.column, d.code, d.message) for d in findings.diagnostics]


def test_ten_mistakes_are_ten_findings_in_the_order_of_the_text() -> None:
    assert findings_of(TEN) == [
        (3, 17, Code.FOREIGN, "an interval is `..`, not `...`"),
        (4, 8, Code.SYNTAX, "after the name of a `const` stands `=`"),
        (5, 20, Code.FOREIGN, "`:=` changes: the value of a `fluent` is written with `=`"),
        (7, 20, Code.MISSING, "the `)` that closes `(` is missing"),
        (9, 22, Code.MISSING, "the colon at the end of this `action` is missing"),
        (13, 13, Code.FOREIGN, "equality is `=`, not `==`"),
        (14, 15, Code.FOREIGN, "`=` tests, `:=` changes: an effect is written with `:=`"),
        (16, 22, Code.FOREIGN, "a line does not end in a full stop"),
        (19, 19, Code.MISSING, "the colon at the end of this `while` is missing"),
        (22, 1, Code.SYNTAX, "`acton` begins no declaration"),
        (24, 19, Code.SYNTAX, "`<` cannot be chained"),
        (27, 13, Code.SYNTAX, "`cal` is no word here"),
    ]


def test_what_can_be_read_is_read() -> None:
    file = parse_file(Source("t", TEN), Findings())

    assert file is not None
    assert file.domain.text == "ten"
    assert [node.span.text.split()[0] for node in file.declarations] == (
        ["type", "fluent", "fluent", "action", "action", "define", "proc", "acton", "goal", "device"]
    )
    assert [span.text for span in file.unread] == ["const n: 3\n", "fluent open(d: door = true\n\n", ".", "1 < at < 3"]


def test_the_places_of_what_was_read_are_those_of_the_file() -> None:
    file = parse_file(Source("t", TEN), Findings())

    assert file is not None
    places = [(node.span.line, node.span.text) for node in file.declarations]
    assert (6, "fluent ok: station = 1") in places
    assert (16, "define done := at = 1.") in places
    assert (18, "proc control:\n    while not done\n        go(1)") in places


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", (1, 1, "the file is empty")),
        ("\n  \n", (1, 1, "the file is empty")),
        ("# only\n   # comments", (1, 1, "the file holds nothing but comments")),
        ("fluent f = 1\nfluent g = 2\n", (1, 1, "the domain line is missing")),
        ("# c\n\nproc p:\n    skip\n", (3, 1, "the domain line is missing")),
        ("fluent f = 1\ndomain d\n", (2, 1, "the domain line is not the first")),
        ("domain d\nfluent f = 1\ndomain e\n", (3, 1, "there is a second domain line")),
    ],
)
def test_the_domain_line(text: str, expected: tuple[int, int, str]) -> None:
    assert findings_of(text) == [(*expected[:2], Code.DOMAIN, expected[2])]


def test_a_misspelt_domain_line_is_not_missing() -> None:
    assert findings_of("domian d\nfluent f = 1\n") == [(1, 1, Code.SYNTAX, "`domian` begins no declaration")]


def test_a_domain_line_without_a_name() -> None:
    assert findings_of("domain\nfluent f = 1\n") == [(1, 7, Code.MISSING, "a name is missing after `domain`")]


def test_an_indented_first_line() -> None:
    assert findings_of("  domain d\nfluent f = 1\n") == [(1, 1, Code.INDENTATION, "the first line is indented")]


def test_tabs_are_one_finding() -> None:
    assert findings_of("domain d\nproc p:\n\tskip\n\nproc q:\n    if f:\n\t\tskip\n") == [
        (3, 1, Code.INDENTATION, "this line is indented with a tab")
    ]


def test_a_tab_in_a_comment_line_or_inside_a_line_is_no_indentation() -> None:
    assert findings_of("domain d\nproc p:\n\t# comment\n    skip\t# comment\n\t\nfluent f = (1 +\n\t2)\n") == []


def test_an_unclosed_bracket_costs_one_declaration() -> None:
    assert findings_of("domain d\nfluent f = (1\nfluent g = 2\nproc p:\n    skip\n") == [
        (2, 14, Code.MISSING, "the `)` that closes `(` is missing")
    ]


def test_lines_in_brackets_may_begin_in_the_first_column() -> None:
    text = "domain d\nstatic s(k: t): t = {\na: b,\nc: d\n}\nfluent f == 1\n"
    assert [line for line, *_ in findings_of(text)] == [6]


@pytest.mark.parametrize(
    "text",
    [
        "domain d",
        "domain d\r\nproc p:\r\n    skip\r\n",
        "domain d\nproc p:\n    skip",
        "domain d\nproc p:\n    skip # comment without an end",
        "# first\n\n  # second\ndomain d # third\n",
        "domain d\nproc p:\n# left\n        # right\n    skip\n            # far right\n  # between\n    skip\n",
        "domain d\nproc p:\n    skip\n      \n\n    skip\n  ",
        "domain d\nfluent f = (1 +   # comment\n\n  2  # comment\n)\n",
    ],
)
def test_ends_and_comments_that_are_fine(text: str) -> None:
    assert findings_of(text) == []


def test_columns_of_a_file_with_carriage_returns() -> None:
    assert findings_of("domain d\r\nproc p:\r\n    if f\r\n        skip\r\n") == [
        (3, 9, Code.MISSING, "the colon at the end of this `if` is missing")
    ]


def test_an_expression_with_a_mistake() -> None:
    findings = Findings()

    assert parse_expression(Source("<goal>", " at == 1"), findings) is None
    assert [(str(d.span), d.message) for d in findings.diagnostics] == [("<goal>:1:5", "equality is `=`, not `==`")]


def test_no_expression() -> None:
    findings = Findings()

    assert parse_expression(Source("<goal>", "  # nothing"), findings) is None
    assert [d.message for d in findings.diagnostics] == ["there is no expression"]


def test_an_expression_over_several_lines_needs_brackets() -> None:
    findings = Findings()

    assert parse_expression(Source("<goal>", "(a\n  and b)\n"), findings) is not None
    assert parse_expression(Source("<goal>", "a\nand b"), findings) is None
    assert len(findings.diagnostics) == 1


def test_a_file_of_another_language_is_one_mistake() -> None:
    text = "void go() { Wait(1); }\n\ntask watch() {\n    go();\n}\n\nint n;\n"
    message = "the domain line is missing, and nothing in the file begins as a declaration does"
    assert findings_of(text) == [(1, 1, Code.DOMAIN, message)]


def test_what_is_passed_over_has_no_name_of_the_file() -> None:
    text = "domain d\nfluent unread = true\nproc p:\n    test not @\n    test unread_ or @\n"
    findings = Findings()
    file = parse_file(Source("t", text), findings)

    assert len(findings.diagnostics) == 2
    assert file is not None
    assert re.findall(r"'(unread_*)'", str(file.declarations[-1])) == ["unread__", "unread___"]


def test_nothing_is_said_of_what_stands_for_what_is_passed_over() -> None:
    assert findings_of("domain d\nscenario quiet:\n    test poss(turn and served\ndevice:\n") == [
        (3, 5, Code.SYNTAX, "`test` does not fit here")
    ]


def test_a_carriage_return_is_not_passed_over() -> None:
    file = parse_file(Source("t", "domain d\r\nscenario s:\r\n    test a\r\n    expect b\r\n"), Findings())

    assert file is not None
    assert [span.text for span in file.unread] == ["    test a"]
