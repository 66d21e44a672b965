"""Which theory a name belongs to: a handle of another one is not taken for what has its name in this one."""

from __future__ import annotations

from collections.abc import Container, Iterable
from typing import TYPE_CHECKING

from golc.diagnostics import Code, Diagnostic
from golc.embed.errors import Refused
from golc.syntax import tree

if TYPE_CHECKING:
    from golc.embed.parts import Parts


class Owned(str):
    """The name of something that a theory declares, as its handle brings it into the tree."""

    __slots__ = ("owner",)

    owner: Parts

    def __new__(cls, name: str, owner: Parts) -> Owned:
        self = super().__new__(cls, name)
        self.owner = owner
        return self


def owned(name: str, owner: Parts | None) -> str:
    """A name with its owner, if it has one."""
    return name if owner is None else Owned(name, owner)


def check_owners(nodes: Iterable[tree.Node], owners: Container[Parts]) -> None:
    """Raise ``Refused`` for every name among some nodes that a theory not among the ``owners`` has declared."""
    foreign = [node for node in nodes if isinstance(node, tree.Ident) and _is_foreign(node.text, owners)]
    if foreign:
        raise Refused(*map(_finding, sorted(foreign, key=lambda name: name.span.start)))


def _is_foreign(name: str, owners: Container[Parts]) -> bool:
    return isinstance(name, Owned) and name.owner not in owners


def _finding(name: tree.Ident) -> Diagnostic:
    assert isinstance(name.text, Owned)
    message = f"`{name.text}` is declared by another theory, `{name.text.owner.domain.text}`"
    help_ = f"join that theory with this one by `theory.include(…)`, or declare `{name.text}` in this one"
    return Diagnostic(Code.PYTHON_MEANING, message, name.span, help=help_)
