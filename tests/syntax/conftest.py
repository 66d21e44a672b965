"""Random syntax trees: strategies for every node of the language, as a fixture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

import pytest
from hypothesis import strategies as st

from golc.diagnostics import Findings, Source
from golc.syntax import tree as ast
from golc.syntax.parse import parse_file
from golc.syntax.terminals import words
from golc.syntax.words import RESERVED

SOFT = sorted({*words(), "over", "actions", "waiting"} - RESERVED)
"""The words of the language that may be names."""

NAMES = st.one_of(st.sampled_from(["x", "y2", "location", "a_1", "Z"]), st.sampled_from(SOFT)).map(ast.Ident)
TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=6)
NATURALS = st.integers(0, 2000)
CONSTANTS = st.one_of(
    NAMES,
    st.integers(-20, 20).map(ast.Number),
    st.booleans().map(ast.Truth),
    st.builds(ast.Nothing),
)


def opaque(strategy: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """The strategy without its description, which for nested trees grows to megabytes."""

    @st.composite
    def one(draw: st.DrawFn) -> Any:
        return draw(strategy)

    return one()


def some(strategy: st.SearchStrategy[Any], least: int = 0, most: int = 3) -> st.SearchStrategy[tuple[Any, ...]]:
    return st.lists(strategy, min_size=least, max_size=most).map(tuple)


def maybe(strategy: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.none() | strategy


def applications(arguments: st.SearchStrategy[Any]) -> st.SearchStrategy[ast.Apply]:
    return st.builds(ast.Apply, NAMES, some(arguments))


def intervals(bounds: st.SearchStrategy[Any]) -> st.SearchStrategy[ast.IntervalType]:
    return st.builds(ast.IntervalType, bounds, bounds)


def types(bounds: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    piece = st.one_of(
        st.builds(ast.TypeName, NAMES),
        intervals(bounds),
        st.builds(ast.EnumType, some(NAMES | st.integers(-3, 3).map(ast.Number), 1)),
    )
    union = piece | st.builds(ast.UnionType, some(piece, 2))
    kinds = st.sampled_from(["set", "list"])

    def larger(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
        inner = opaque(inner)
        collection = st.builds(ast.CollectionType, kinds, inner)
        return st.one_of(collection, st.builds(ast.OptionalType, union | collection))

    return st.recursive(union, larger, max_leaves=3)


def binders(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[tuple[ast.Binder, ...]]:
    one = st.builds(ast.Binder, NAMES, types(inner)) | st.builds(ast.Binder, NAMES, st.none(), inner)
    return some(one, 1, 2)


def messages(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[ast.Message]:
    def joined(parts: list[Any]) -> ast.Message:
        # Two texts in a row are one text, and an empty one is none.
        merged: list[Any] = []
        for part in parts:
            if isinstance(part, str) and merged and isinstance(merged[-1], str):
                merged[-1] += part
            elif part != "":
                merged.append(part)
        return ast.Message(tuple(merged))

    return st.lists(TEXTS | inner, max_size=4).map(joined)


def larger_expressions(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Expressions made of smaller ones."""
    inner = opaque(inner)
    plain = st.sampled_from(["+", "-", "*", "//", "%", "=", "!=", "<", "<=", ">", ">=", "and", "or", "implies", "iff"])
    membership = st.sampled_from(["in", "not in"])
    quantifiers = st.sampled_from(["exists", "forall", "count", "sum", "min", "max"])
    return st.one_of(
        applications(inner),
        st.builds(ast.Index, inner, inner),
        st.builds(ast.Unary, st.sampled_from(["-", "not"]), inner),
        st.builds(ast.Binary, plain, inner, inner),
        st.builds(ast.Binary, membership, inner, inner | intervals(inner)),
        st.builds(ast.IfElse, inner, inner, inner),
        st.builds(ast.Quantifier, quantifiers, binders(inner), maybe(inner), inner),
        st.builds(ast.Extremum, st.sampled_from(["min", "max"]), some(inner, 2)),
        st.builds(ast.Epistemic, st.sampled_from(["known", "knows", "possible"]), inner),
        st.builds(ast.SetLiteral, some(inner)),
        st.builds(ast.ListLiteral, some(inner)),
        st.builds(ast.Comprehension, st.sampled_from(["set", "list"]), inner, binders(inner), maybe(inner)),
    )


SMALLEST = st.one_of(
    NATURALS.map(ast.Number),
    st.decimals(0, 100, allow_nan=False, places=2).map(ast.Real),
    st.just(ast.Real(Decimal("1E+3"))),
    st.booleans().map(ast.Truth),
    st.builds(ast.Nothing),
    st.builds(ast.Apply, NAMES),
)
WORDLESS = opaque(st.recursive(SMALLEST, larger_expressions, max_leaves=5))
"""Expressions without messages, which may stand inside a message."""

MESSAGES = opaque(messages(WORDLESS))
EXPRESSIONS = opaque(st.recursive(SMALLEST | MESSAGES, larger_expressions, max_leaves=6))
CALLS = opaque(applications(WORDLESS))
BINDERS = opaque(binders(WORDLESS))
TYPES = opaque(types(WORDLESS))
VALUES = st.one_of(WORDLESS, st.builds(ast.Unknown), st.builds(ast.OneOf, WORDLESS))
PARAMETERS = some(st.builds(ast.Parameter, NAMES, TYPES), 0, 2)
PATTERNS = st.builds(ast.Pattern, NAMES, some(CONSTANTS))
TABLES = st.builds(ast.Table, some(st.builds(ast.TableEntry, some(WORDLESS, 1), WORDLESS), 1))


def larger_statements(inner: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Statements made of smaller ones."""
    inner = opaque(inner)
    block = st.builds(ast.Block, some(inner, 1))
    handler = st.builds(ast.On, BINDERS | st.just(()), WORDLESS, block)
    modes = maybe(st.sampled_from(["first", "shortest", "cheapest"]))
    return st.one_of(
        st.builds(ast.If, some(st.tuples(WORDLESS, block), 1), maybe(block)),
        st.builds(ast.While, WORDLESS, block),
        st.builds(ast.Choose, some(block, 2)),
        st.builds(ast.Pick, BINDERS, maybe(WORDLESS), block),
        st.builds(ast.Star, maybe(WORDLESS), block),
        st.builds(ast.For, BINDERS, maybe(WORDLESS), block),
        st.builds(ast.Let, NAMES, WORDLESS, block),
        st.builds(ast.Together, some(block, 2)),
        st.builds(ast.TogetherStar, block),
        st.builds(ast.Prefer, some(block, 2)),
        st.builds(ast.Interrupts, some(handler, 1)),
        st.builds(ast.Guard, WORDLESS, block),
        st.builds(ast.Search, modes, maybe(WORDLESS), maybe(WORDLESS), block),
        st.builds(ast.Within, WORDLESS, block, maybe(block)),
    )


LINES = st.one_of(
    st.builds(ast.Call, CALLS),
    st.builds(ast.Test, EXPRESSIONS),
    st.builds(ast.Skip),
    st.builds(ast.Wait),
    st.builds(ast.WaitUntil, WORDLESS),
    st.builds(ast.WaitTime, WORDLESS),
    st.builds(ast.Say, MESSAGES),
    st.builds(ast.Abort, MESSAGES),
)
STATEMENTS = opaque(st.recursive(opaque(LINES), larger_statements, max_leaves=5))

CLAUSES = st.one_of(
    st.builds(ast.Precondition, EXPRESSIONS),
    st.builds(ast.Effect, st.just(()), st.none(), CALLS, VALUES, maybe(WORDLESS)),
    st.builds(ast.Effect, BINDERS, maybe(WORDLESS), CALLS, VALUES, maybe(WORDLESS)),
    st.builds(ast.Senses, WORDLESS),
    st.builds(ast.Cost, WORDLESS),
)
SCENARIO_ITEMS = st.one_of(
    st.builds(ast.Given, WORDLESS),
    st.builds(ast.Run, CALLS),
    st.builds(ast.OnEvents, some(CALLS, 1), st.sampled_from(["after", "when"]), WORDLESS),
    st.builds(ast.OnEvents, some(CALLS, 1), st.just("waiting"), st.none()),
    st.builds(ast.Until, WORDLESS),
    st.builds(ast.ExpectCount, CALLS, st.sampled_from(["at least", "at most", "exactly"]), WORDLESS),
    st.builds(ast.ExpectActions, some(CALLS)),
    st.builds(ast.ExpectFormula, WORDLESS),
)
BEHAVIOURS = st.one_of(
    st.builds(ast.ByCall, NAMES),
    st.builds(ast.ByStart, NAMES),
    st.builds(ast.ByPrompt, MESSAGES),
)
NUMBERING = st.just((None, False)) | st.tuples(NATURALS, st.booleans())
BINDINGS = st.builds(
    lambda number, action, args, behaviour, table, timeout: ast.Binding(
        action, args, number[0], number[1], behaviour, table, timeout
    ),
    NUMBERING,
    NAMES,
    maybe(some(CONSTANTS | st.builds(ast.Parameter, NAMES, TYPES), 1)),
    maybe(BEHAVIOURS),
    maybe(TABLES),
    maybe(WORDLESS),
)
SETTINGS = st.builds(ast.Setting, NAMES, WORDLESS, st.booleans())
DECLARATIONS = st.one_of(
    st.builds(ast.Import, TEXTS),
    st.builds(ast.Const, NAMES, EXPRESSIONS),
    st.builds(ast.TypeDecl, NAMES, TYPES),
    st.builds(ast.Static, NAMES, PARAMETERS, maybe(TYPES), EXPRESSIONS | TABLES),
    st.builds(ast.Extern, NAMES, PARAMETERS, maybe(TYPES), TEXTS),
    st.builds(ast.Fluent, NAMES, PARAMETERS, maybe(TYPES), maybe(VALUES)),
    st.builds(ast.Initially, WORDLESS),
    st.builds(ast.Define, NAMES, PARAMETERS, EXPRESSIONS),
    st.builds(ast.Action, NAMES, PARAMETERS, some(CLAUSES)),
    st.builds(ast.Exog, NAMES, PARAMETERS, st.booleans(), some(NAMES), some(CLAUSES)),
    st.builds(ast.Axiom, NAMES, some(NAMES), some(st.builds(ast.After, PATTERNS, VALUES, maybe(WORDLESS)))),
    st.builds(ast.Invariant, NAMES, WORDLESS),
    st.builds(ast.Goal, NAMES, WORDLESS),
    st.builds(ast.Prune, NAMES, WORDLESS),
    st.builds(ast.PruneAfter, NAMES, PATTERNS, maybe(WORDLESS)),
    st.builds(ast.Scenario, NAMES, some(SCENARIO_ITEMS, 1, 4)),
    st.builds(ast.Proc, NAMES, PARAMETERS, st.builds(ast.Block, some(STATEMENTS, 1))),
    st.builds(ast.Device, NAMES, maybe(NAMES), maybe(TEXTS), some(BINDINGS | SETTINGS)),
)
FILES = st.builds(ast.File, NAMES, some(DECLARATIONS, 0, 4))


@dataclass(frozen=True)
class Trees:
    """The strategies that tests draw from."""

    files: st.SearchStrategy[ast.File]
    expressions: st.SearchStrategy[ast.Expr]
    statements: st.SearchStrategy[ast.Statement]


@pytest.fixture(scope="session")
def trees() -> Trees:
    return Trees(FILES, EXPRESSIONS, STATEMENTS)


@pytest.fixture(scope="session")
def soft_words() -> list[str]:
    """The words of the language that may be names."""
    return SOFT


@pytest.fixture(scope="session")
def parsed() -> Callable[[str], ast.File]:
    """Parses a text that has to be free of errors."""

    def parse(text: str) -> ast.File:
        findings = Findings()
        file = parse_file(Source("test.gl", text), findings)
        assert not findings.diagnostics, [f"{d.span} {d.message}" for d in findings.diagnostics]
        assert file is not None
        return file

    return parse
