"""From lark's parse tree to the abstract syntax tree: one function a rule, from the leaves up, without recursion."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from lark import Token, Tree

from golc.diagnostics import Code, Findings, Span
from golc.syntax import tree as ast
from golc.syntax.layout import DEEPEST, LONGEST_NUMBER
from golc.syntax.messages import parse_message, plain_text
from golc.syntax.rules import NESTING, RULES, SIMPLE
from golc.syntax.words import RESERVED

Inner: TypeAlias = Callable[[Span], ast.Expr | None]
"""Parses the expression at a place inside a message."""

Placed: TypeAlias = Callable[[int, int], Span]
"""The place in the source of what was parsed, by its offsets in the text."""


class Builder:
    """Builds the nodes of one text; what is wrong with names or messages is added to the findings."""

    def __init__(self, placed: Placed, findings: Findings, inner: Inner) -> None:
        self.placed = placed
        self.findings = findings
        self.inner = inner

    def build(self, root: Tree[Token]) -> Any:
        """The node of a parse tree, or None if it is nested too deeply; children are built before their parents."""
        order = self._in_order(root)
        if order is None:
            return None
        built: dict[int, Any] = {}
        for tree in reversed(order):
            children = [self._child(child, built) for child in tree.children]
            built[id(tree)] = self._node(tree, children)
        return built[id(root)]

    def _in_order(self, root: Tree[Token]) -> list[Tree[Token]] | None:
        """Every tree before its parts, later parts first; None, with a finding, if the nesting is too deep."""
        order: list[Tree[Token]] = []
        waiting = [(root, 0)]
        while waiting:
            tree, depth = waiting.pop()
            order.append(tree)
            depth += tree.data in NESTING
            if depth > DEEPEST:
                too_deep(self.findings, self.span(tree))
                return None
            waiting += [(child, depth) for child in tree.children if isinstance(child, Tree)]
        return order

    def _child(self, child: Any, built: dict[int, Any]) -> Any:
        if isinstance(child, Tree):
            return built.pop(id(child))
        if isinstance(child, Token) and child.type == "NAME":
            return ast.Ident(str(child), span=self.span(child))
        return child

    def _node(self, tree: Tree[Token], children: list[Any]) -> Any:
        span = self.span(tree)
        if simple := SIMPLE.get(tree.data):
            return simple(*children, span=span)
        return RULES[tree.data](self, span, children)

    def span(self, part: Tree[Token] | Token) -> Span:
        """Where a tree or token stands in the source."""
        place: Any = part.meta if isinstance(part, Tree) else part
        return self.placed(place.start_pos, place.end_pos)

    def declare(self, *names: ast.Ident) -> None:
        """Names that come into being here: a reserved word among them is a finding."""
        for name in names:
            if name.text in RESERVED:
                reserved_name(self.findings, name)

    def declare_parts(self, parts: tuple[ast.Parameter, ...] | tuple[ast.Binder, ...]) -> None:
        """The names of parameters or binders."""
        self.declare(*(part.name for part in parts))

    def integer(self, token: Token) -> int:
        """The value of digits."""
        if len(token) > LONGEST_NUMBER:
            message = f"a number of {len(token)} digits is too long: the limit is {LONGEST_NUMBER}"
            self.findings.error(Code.SYNTAX, message, self.span(token))
            return 0
        return int(token)

    def message(self, token: Token) -> ast.Message:
        """The parts of a message."""
        return parse_message(self.span(token), self.findings, self.inner)

    def plain(self, token: Token) -> str:
        """The text of a string in which braces mean themselves: a path."""
        return plain_text(self.span(token), self.findings)


def too_deep(findings: Findings, span: Span) -> None:
    """Nesting that no person writes and no pass over the tree has to bear begins where a span does."""
    findings.error(
        Code.NESTING,
        f"nesting is deeper than {DEEPEST} levels",
        Span(span.source, span.start, span.start + 1),
        help="give a part of it a name with `define`, or make a part of the program a procedure",
    )


def reserved_name(findings: Findings, name: ast.Ident) -> None:
    """A word of the language stands where a name is declared."""
    findings.error(
        Code.RESERVED,
        f"`{name.text}` is a word of the language and cannot be a name",
        name.span,
        help=f"choose another name, for example `{name.text}_` or `the_{name.text}`",
    )
