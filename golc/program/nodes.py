"""Residual programs: rules applied to operands, hash-consed, so that equal residual programs are one object.

For a statement the rule is the compiled statement and the operands are the values of the variables in scope (``None``
where the statement does not read one). For what execution builds (a sequence whose first part has begun, branches of a
concurrency, …) the operands are the residual programs of the parts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from weakref import WeakValueDictionary

if TYPE_CHECKING:
    from golc.program.rules import Rule


class Node:
    """A rule with its operands; made by a ``Pool`` only, compared by identity.

    ``may_finish``: whether it can be final in any state, as far as that is plain from its form.
    """

    __slots__ = ("__weakref__", "may_finish", "operands", "rule")

    def __init__(self, rule: Rule, operands: tuple[Any, ...]) -> None:
        self.rule = rule
        self.operands = operands
        self.may_finish: bool = all(part.may_finish for part in operands) if rule.needs_all else rule.may_finish

    def __repr__(self) -> str:
        return f"{self.rule!r}{self.operands!r}"


class Pool:
    """All nodes of one program that are in use; a node that nobody holds any more is forgotten."""

    def __init__(self) -> None:
        self._nodes: WeakValueDictionary[tuple[Any, ...], Node] = WeakValueDictionary()

    def node(self, rule: Rule, operands: tuple[Any, ...]) -> Node:
        """The one node of a rule and its operands."""
        key = (rule, operands)
        node = self._nodes.get(key)
        if node is None:
            node = self._nodes[key] = Node(rule, operands)
        return node

    def __len__(self) -> int:
        return len(self._nodes)
