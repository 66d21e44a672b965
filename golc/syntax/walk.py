"""Walking over the tree without knowing what is in it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from functools import cache

from golc.syntax.tree import Node


def descendants(node: Node) -> Iterator[Node]:
    """The node and every node inside it in the order of the text; no recursion, for the depth is the input's."""
    stack: list[object] = [node]
    while stack:
        item = stack.pop()
        if isinstance(item, tuple):
            stack.extend(reversed(item))
        elif isinstance(item, Node):
            yield item
            values = item.__dict__
            stack.extend([values[name] for name in _fields(type(item))])


def children(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in the order of the text."""
    stack: list[object] = [node.__dict__[name] for name in _fields(type(node))]
    while stack:
        item = stack.pop()
        if isinstance(item, tuple):
            stack.extend(reversed(item))
        elif isinstance(item, Node):
            yield item


@cache
def _fields(kind: type[Node]) -> tuple[str, ...]:
    """The fields that may hold nodes, last first: that is how a stack wants them."""
    return tuple(field.name for field in reversed(fields(kind)) if field.name not in ("span", "text", "op", "kind"))
