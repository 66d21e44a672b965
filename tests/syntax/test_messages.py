"""Strings: escapes, and the expressions in the braces of a message."""

from __future__ import annotations

import pytest

from golc.diagnostics import Code, Findings, Source
from golc.syntax import tree as ast
from golc.syntax.parse import parse_expression, parse_file


def name(text: str) -> ast.Apply:
    return ast.Apply(ast.Ident(text))


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ('""', ()),
        ('"abc"', ("abc",)),
        ('"a {x} b"', ("a ", name("x"), " b")),
        ('"{x}{y}"', (name("x"), name("y"))),
        ('"{ x }"', (name("x"),)),
        ('"{{x}}"', ("{x}",)),
        ('"{{{x}}}"', ("{", name("x"), "}")),
        (r'"a \"b\" c"', ('a "b" c',)),
        (r'"a\\n\n\t"', ("a\\n\n\t",)),
        ('"{ {x, y} }"', (ast.SetLiteral((name("x"), name("y"))),)),
        ('"{f({x})}"', (ast.Apply(ast.Ident("f"), (ast.SetLiteral((name("x"),)),)),)),
        ('"# no comment"', ("# no comment",)),
        ('"käse 🧀 {x}"', ("käse 🧀 ", name("x"))),
    ],
)
def test_the_parts_of_a_message(text: str, parts: tuple[str | ast.Expr, ...]) -> None:
    findings = Findings()

    assert parse_expression(Source("t", text), findings) == ast.Message(parts)
    assert findings.diagnostics == []


def test_an_expression_in_a_message_has_its_place_in_the_file() -> None:
    source = Source("t", 'domain d\nproc p:\n    say "at {location + 1}, { n }"\n')
    file = parse_file(source, Findings())

    assert file is not None
    (proc,) = file.declarations
    assert isinstance(proc, ast.Proc)
    (say,) = proc.body.statements
    assert isinstance(say, ast.Say)
    inner = [part for part in say.message.parts if not isinstance(part, str)]
    assert [(part.span.line, part.span.column, part.span.text) for part in inner] == [
        (3, 14, "location + 1"),
        (3, 31, "n"),
    ]


@pytest.mark.parametrize(
    ("text", "column", "marked", "message"),
    [
        (r'"a\qb"', 3, r"\q", r"`\q` writes no character"),
        ('"a {x"', 4, "{", "the `{` in this message has no end"),
        ('"a x} b"', 5, "}", "the `}` in this message has no beginning"),
        ('"a {} b"', 4, "{}", "the braces in this message hold no expression"),
        ('"a {  } b"', 4, "{  }", "the braces in this message hold no expression"),
    ],
)
def test_a_message_that_cannot_be_read(text: str, column: int, marked: str, message: str) -> None:
    findings = Findings()
    parse_expression(Source("t", text), findings)

    (finding,) = findings.diagnostics
    assert (finding.code, finding.span.column, finding.span.text, finding.message) == (
        Code.STRING,
        column,
        marked,
        message,
    )


def test_a_mistake_inside_the_braces_is_shown_there() -> None:
    findings = Findings()
    parse_file(Source("t", 'domain d\nproc p:\n    say "at {a == b} and {c +}"\n'), findings)

    assert [(d.span.line, d.span.column, d.message) for d in findings.diagnostics] == [
        (3, 16, "equality is `=`, not `==`"),
        (3, 30, "an expression is missing after `+`"),
    ]


def test_braces_mean_themselves_in_a_path() -> None:
    file = parse_file(Source("t", r"domain d" + "\n" + r'import "a{b}\\\"c.gl"'), Findings())

    assert file is not None
    assert file.declarations == (ast.Import('a{b}\\"c.gl'),)
