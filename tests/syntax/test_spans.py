"""Every node knows its place to the character."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import get_args

import pytest

from golc.diagnostics import Findings, Source
from golc.syntax import tree as ast
from golc.syntax.parse import parse_expression, parse_file
from golc.syntax.text import read_source
from golc.syntax.walk import children, descendants

ROOT = Path(__file__).parents[2]
EVERYTHING = ROOT / "tests/programs/everything.gl"

CONSTANT_PARTS = (ast.EnumType, ast.Pattern, ast.Binding)
"""Where a number may have a sign, which in an expression is an operation."""

Parsed = Callable[[str], ast.File]


def every_node() -> list[ast.Node]:
    file = parse_file(read_source(EVERYTHING), Findings())
    assert file is not None
    return list(descendants(file))


def test_the_text_of_an_expression_is_that_expression() -> None:
    nodes = every_node()
    constants = {id(part) for node in nodes if isinstance(node, CONSTANT_PARTS) for part in children(node)}
    expressions = [node for node in nodes if isinstance(node, get_args(ast.Expr)) and id(node) not in constants]

    assert len(expressions) > 400
    for node in expressions:
        assert parse_expression(Source("t", node.span.text), Findings()) == node, str(node.span)


def test_a_node_stands_inside_the_node_around_it() -> None:
    for node in every_node():
        for child in children(node):
            assert node.span.start <= child.span.start <= child.span.end <= node.span.end, str(child.span)


def test_a_node_begins_and_ends_with_a_word_or_sign() -> None:
    for node in every_node():
        assert node.span.text == node.span.text.strip() != "", str(node.span)


def test_a_name_is_its_text() -> None:
    for node in every_node():
        if isinstance(node, ast.Ident):
            assert node.span.text == node.text


def test_a_declaration_is_its_text(parsed: Parsed) -> None:
    file = parsed(
        """# before
domain d   # the name

action go(s: station):   # comment
    poss at != s

    causes at := s       # the last line
    # a comment that belongs to nobody

fluent at: station = 1   # comment
"""
    )

    assert [node.span.text for node in file.declarations] == [
        "action go(s: station):   # comment\n    poss at != s\n\n    causes at := s",
        "fluent at: station = 1",
    ]


def test_a_statement_and_its_block(parsed: Parsed) -> None:
    (proc,) = parsed(
        "domain d\nproc p:\n    if f:\n        a\n        b\n    else:\n        c\n    skip\n"
    ).declarations

    assert isinstance(proc, ast.Proc)
    assert proc.body.span.text == "if f:\n        a\n        b\n    else:\n        c\n    skip"
    first = proc.body.statements[0]
    assert isinstance(first, ast.If) and first.otherwise is not None
    assert first.span.text == "if f:\n        a\n        b\n    else:\n        c"
    assert first.branches[0][1].span.text == "a\n        b"
    assert first.otherwise.span.text == "c"


@pytest.mark.parametrize(
    ("text", "spans"),
    [
        ("1 + (2 * 3)", ["1", "2 * 3"]),
        ("(1 + 2) * 3", ["1 + 2", "3"]),
        ("(a) = ((b))", ["a", "b"]),
        ("not (a or b)", ["a or b"]),
        ("f(a, (b))", ["f", "a", "b"]),
        ("x in 1..(n + 1)", ["x", "1..(n + 1)"]),
        ("(a) if (b) else (c)", ["a", "b", "c"]),
        ("exists n: t where (a). (b)", ["n: t", "a", "b"]),
    ],
)
def test_the_parts_of_an_expression(text: str, spans: list[str]) -> None:
    node = parse_expression(Source("t", text), Findings())

    assert node is not None
    assert [child.span.text for child in children(node)] == spans


def test_a_node_with_a_part_in_parentheses_spans_them() -> None:
    node = parse_expression(Source("t", "  (a) + (b)  "), Findings())

    assert node is not None
    assert node.span.text == "(a) + (b)"


def test_carriage_returns_belong_to_no_node(parsed: Parsed) -> None:
    file = parsed("domain d\r\nproc p:\r\n    skip\r\n\r\nfluent f = 1\r\n")

    assert [node.span.text for node in file.declarations] == ["proc p:\r\n    skip", "fluent f = 1"]
