"""Walking over the tree without knowing what is in it."""

from __future__ import annotations

from collections.abc import Iterator

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
            stack.extend(_fields(item))


def children(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in the order of the text."""
    stack: list[object] = [*_fields(node)]
    while stack:
        item = stack.pop()
        if isinstance(item, tuple):
            stack.extend(reversed(item))
        elif isinstance(item, Node):
            yield item


def _fields(node: Node) -> Iterator[object]:
    """What a node holds, last first: that is how a stack wants it. A dataclass keeps its fields in their order."""
    return reversed(vars(node).values())
