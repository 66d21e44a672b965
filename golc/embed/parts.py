"""The declarations of a theory in Python in their order, each made when the theory is complete."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from golc.diagnostics import Findings, Source, Span
from golc.embed.depth import nodes
from golc.embed.errors import Refused
from golc.embed.owners import Owned, check_owners
from golc.embed.places import calling_frame, statement_around
from golc.syntax import tree
from golc.theory.recursion import deep_recursion

if TYPE_CHECKING:
    from golc.embed.types import TypeHandle

Making: TypeAlias = Callable[[], tree.Declaration]
"""Makes a declaration; raises ``Refused``."""


@dataclass(frozen=True)
class Written:
    """The tree of a theory, what is wrong with its Python, and the sources, its own file first."""

    file: tree.File
    findings: Findings
    sources: tuple[Source, ...]


@dataclass(eq=False)
class Parts:
    """What one theory is made of: declarations by their keys, and the parts of theories that are included.

    ``domain`` is its name, ``place`` where it began; ``types`` are the handles of its types so far.
    """

    domain: tree.Ident
    place: Span
    types: dict[str, TypeHandle] = field(default_factory=dict)
    entries: list[tuple[object, Making | Parts]] = field(default_factory=list)

    def put(self, key: object, making: Making) -> None:
        """Add a declaration. In a notebook, where cells are run again, it takes the place of one with its key."""
        if _is_interactive():
            for place, (known, _) in enumerate(self.entries):
                if known == key:
                    self.entries[place] = (key, making)
                    return
        self.entries.append((key, making))

    def expect(self, missing: Making) -> Callable[[], None]:
        """Something is to follow, or else ``missing`` says that it did not; what is called when it does follow.

        In a notebook a cell that was wrong may never follow.
        """
        entry = (object(), missing)
        if not _is_interactive():
            self.entries.append(entry)

        def withdraw() -> None:
            self.entries = [each for each in self.entries if each is not entry]

        return withdraw

    def include(self, other: Parts) -> None:
        """Add the declarations of another theory, those still to come among them."""
        self.entries.append((None, other))

    def type_of(self, name: str) -> TypeHandle | None:
        """The handle of a type that is named in this theory, if there is one so far."""
        home = name.owner if isinstance(name, Owned) else self
        return home.types.get(name)

    def written(self) -> Written:
        """The tree of all declarations; what is wrong with one does not hide the others."""
        findings = Findings()
        made: list[tree.Declaration] = []
        unread: list[Span] = []
        with deep_recursion():
            owners = self._joined()
            for making in self._makings(set()):
                node, wrong = _made(making, owners)
                made += node
                for error in wrong:
                    findings.diagnostics += error.diagnostics
                    unread += error.unread or map(statement_around, (each.span for each in error.diagnostics))
        sources = {id(each): each for each in (self.place.source, *(node.span.source for node in made))}
        file = tree.File(self.domain, tuple(made), unread=tuple(unread), span=self.place)
        return Written(file, findings, tuple(sources.values()))

    def _makings(self, seen: set[Parts]) -> Iterator[Making]:
        seen.add(self)
        for _, entry in self.entries:
            if not isinstance(entry, Parts):
                yield entry
            elif entry not in seen:
                yield from entry._makings(seen)

    def _joined(self) -> set[Parts]:
        """These parts with all that are included in them, or in one of those."""
        found, waiting = {self}, [self]
        while waiting:
            new = {entry for _, entry in waiting.pop().entries if isinstance(entry, Parts)} - found
            found |= new
            waiting += new
        return found


def _made(making: Making, owners: Container[Parts]) -> tuple[list[tree.Declaration], list[Refused]]:
    """The declaration that is made, if anything is left of it, and what is wrong with it."""
    wrong: list[Refused] = []
    try:
        node: tree.Declaration | None = making()
    except Refused as error:
        node = error.rest
        wrong.append(error)
    try:
        check_owners(nodes(node) if node else (), owners)
    except Refused as error:
        node = None
        wrong.append(error)
    return [node] if node else [], wrong


def _is_interactive() -> bool:
    """Whether the code that runs was typed into a session: it comes from no file."""
    return not Path(calling_frame().f_code.co_filename).is_file()
