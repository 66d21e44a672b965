"""How deep a tree is nested: as deep as a text may be, so that each theory can be written as text."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from golc.diagnostics import Code
from golc.embed.errors import refused
from golc.syntax import tree
from golc.syntax.layout import DEEPEST

_LEVELS = (
    tree.Binary,
    tree.Block,
    tree.CollectionType,
    tree.Comprehension,
    tree.Epistemic,
    tree.Extremum,
    tree.IfElse,
    tree.Index,
    tree.ListLiteral,
    tree.OneOf,
    tree.Quantifier,
    tree.SetLiteral,
    tree.Table,
    tree.Unary,
)
"""The nodes that are a level of nesting, as is an ``Apply`` with arguments."""


def check_depth(declaration: tree.Declaration) -> None:
    """Raise ``Refused`` for a declaration that is nested too deeply; a stack instead of recursion."""
    waiting: list[tuple[object, int]] = [(declaration, 0)]
    while waiting:
        node, depth = waiting.pop()
        if isinstance(node, tuple):
            waiting += [(part, depth) for part in node]
        elif isinstance(node, tree.Node):
            depth += isinstance(node, _LEVELS) or (isinstance(node, tree.Apply) and bool(node.args))
            if depth > DEEPEST:
                help_ = "give a part of it a name with `@theory.define`, or make a part of the program a procedure"
                raise refused(Code.NESTING, f"nesting is deeper than {DEEPEST} levels", declaration.span, help_)
            waiting += [(part, depth) for part in _parts(node)]


def _parts(node: tree.Node) -> Iterator[object]:
    for field in fields(node):
        if field.name != "span":
            yield getattr(node, field.name)
