"""The grammar: free of conflicts, and its words are names wherever they are not words."""

from __future__ import annotations

import importlib.resources
from collections.abc import Callable

import pytest
from lark import Lark
from lark.exceptions import GrammarError, LexError

from golc.diagnostics import Code, Findings, Source
from golc.syntax import tree as ast
from golc.syntax.layout import Layout
from golc.syntax.parse import parse_file
from golc.syntax.parser import STARTS
from golc.syntax.words import RESERVED

GRAMMAR = importlib.resources.files("golc.grammar").joinpath("golc.lark").read_text(encoding="utf-8")


def strict(grammar: str) -> Lark:
    """Builds a parser; raises if two rules or two terminals compete. Needs interegular."""
    return Lark(grammar, parser="lalr", lexer="contextual", start=list(STARTS), postlex=Layout(), strict=True)


def test_the_grammar_has_no_conflict_and_no_colliding_terminals() -> None:
    assert strict(GRAMMAR).options.strict


def test_a_rule_that_competes_with_another_would_be_noticed() -> None:
    with pytest.raises(GrammarError, match="conflict"):
        strict(GRAMMAR.replace('skip: "skip" _NL', 'skip: "skip" _NL | NAME _NL'))


def test_a_terminal_that_competes_with_another_would_be_noticed() -> None:
    with pytest.raises(LexError, match="Collision"):
        strict(GRAMMAR.replace('skip: "skip" _NL', 'skip: "skip" OTHER _NL') + "\nOTHER: /[a-z]+/\n")


def test_every_soft_word_is_a_name(soft_words: list[str], parsed: Callable[[str], ast.File]) -> None:
    for word in soft_words:
        text = f"""domain {word}
type {word} = {{{word}}}
fluent {word}({word}: {word}): {word} = {word}
action {word}({word}: {word}):
    poss {word}({word}) = {word}
    causes {word}({word}) := {word} when {word} in {word}
proc {word}:
    {word}
    while {word}:
        {word}({word})
    prefer:
        {word}
    over:
        {word}
    interrupts:
        on {word}:
            {word}
        on some {word}: {word} where {word}:
            {word}
            {word}
device {word} {word}:
    {word}({word}) by call {word}
    set {word} {word}
"""
        assert len(parsed(text).declarations) == 5, word


@pytest.mark.parametrize("word", sorted(RESERVED))
def test_a_reserved_word_as_a_name_is_one_finding(word: str) -> None:
    text = f"""domain d
fluent {word}: 1..3 = 1
action a:
    poss {word} = 1 and {word} > 2
    causes {word} := {word} + 1
"""
    findings = Findings()
    parse_file(Source("t", text), findings)

    (finding,) = findings.diagnostics
    assert (finding.code, finding.span.line, finding.span.text) == (Code.RESERVED, 2, word)
    assert finding.message == f"`{word}` is a word of the language and cannot be a name"


@pytest.mark.parametrize(
    "text",
    [
        "domain if",
        "domain d\nconst if = 1",
        "domain d\ntype if = 1..2",
        "domain d\ntype t = {a, if}",
        "domain d\nstatic if = 1",
        "domain d\nstatic s(if: t) = 1",
        'domain d\nextern if from "h.py"',
        'domain d\nextern s(if: t) from "h.py"',
        "domain d\ndefine if := true",
        "domain d\naction if",
        "domain d\nexog if",
        "domain d\naxiom f(if):\n    otherwise unchanged",
        "domain d\ninvariant if: true",
        "domain d\ngoal if: true",
        "domain d\nprune if: true",
        "domain d\nscenario if:\n    run p",
        "domain d\nproc if:\n    skip",
        "domain d\nproc p:\n    pick if: t:\n        skip",
        "domain d\nproc p:\n    for if in l:\n        skip",
        "domain d\nproc p:\n    let if = 1:\n        skip",
        "domain d\ngoal g: exists if: t. true",
        "domain d\ndevice rcx:\n    0 .. a(if: t)",
    ],
)
def test_every_place_that_declares_a_name_is_checked(text: str) -> None:
    findings = Findings()
    parse_file(Source("t", text), findings)

    assert [(d.code, d.span.text) for d in findings.diagnostics] == [(Code.RESERVED, "if")]


def test_a_word_does_not_end_where_a_name_goes_on() -> None:
    findings = Findings()
    parse_file(Source("t", "domain d\ngoal g: x andy\ngoal h: x andz y"), findings)

    assert [d.span.line for d in findings.diagnostics] == [2, 3]
