"""How deep a tree is nested: as deep as a text may be, so that each theory can be written as text."""

from __future__ import annotations

from collections.abc import Iterator

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


def nodes(declaration: tree.Declaration) -> Iterator[tree.Node]:
    """Every node of a declaration; a stack instead of recursion. Raises ``Refused`` if it is nested too deeply."""
    waiting: list[tuple[object, int]] = [(declaration, 0)]
    while waiting:
        item, depth = waiting.pop()
        if isinstance(item, tuple):
            waiting += [(part, depth) for part in item]
        elif isinstance(item, tree.Node):
            depth += isinstance(item, _LEVELS) or (isinstance(item, tree.Apply) and bool(item.args))
            if depth > DEEPEST:
                help_ = "give a part of it a name with `@theory.define`, or make a part of the program a procedure"
                raise refused(Code.NESTING, f"nesting is deeper than {DEEPEST} levels", declaration.span, help_)
            yield item
            waiting += [(part, depth) for part in vars(item).values()]
