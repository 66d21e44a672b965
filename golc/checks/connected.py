"""Which of the formulas that are known somewhere bear on a question there: those that speak of the same things.

What is known of other things cannot change the answer, as far as it is possible at all; leaving it out keeps a long
row of tests from being gone through for each of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from golc.proofs.questions import Asked
from golc.theory.reading import fluents_read
from golc.theory.terms import Variable, subterms
from golc.theory.theory import BasicActionTheory


class Connected:
    """Remembers what each formula reads; fluents of one invariant are connected.

    ``some``: only some of the situations are looked at, where any fluents may go together.
    """

    def __init__(self, theory: BasicActionTheory, some: bool) -> None:
        self._theory = theory
        self._read: dict[int, tuple[Asked, frozenset[str]]] = {}
        invariants = [fluents_read(theory, [theory.definitions[name].body]) for name in theory.invariants]
        self._tied = _tied([frozenset(theory.fluents)] if some else invariants)

    def fluents(self, asked: Asked) -> frozenset[str]:
        """The fluents that a formula reads."""
        key = id(asked.term)
        if key not in self._read:  # kept with the formula, so that no other one gets its identity
            self._read[key] = asked, fluents_read(self._theory, [asked.term])
        return self._read[key][1]

    def known(self, known: Sequence[Asked], asked: Iterable[Asked]) -> tuple[Asked, ...]:
        """Those of the known formulas that bear on what is asked, in their order."""
        reached = set[object]().union(*map(self._things, asked))
        rest = [(place, self._things(each)) for place, each in enumerate(known)]
        kept = [place for place, things in rest if not things]
        while near := [(place, things) for place, things in rest if not things.isdisjoint(reached)]:
            kept += [place for place, _ in near]
            rest = [(place, things) for place, things in rest if things.isdisjoint(reached)]
            reached.update(*[things for _, things in near])
        return tuple([known[place] for place in sorted(kept)])

    def _things(self, asked: Asked) -> frozenset[object]:
        """The fluents that a formula reads, one name for connected ones, and its variables by their places."""
        parts = subterms(asked.term)
        levels = [part.level for part in parts if isinstance(part, Variable) and part.level < len(asked.env)]
        fluents = [self._tied.get(fluent, fluent) for fluent in self.fluents(asked)]
        return frozenset([*fluents, *[asked.env[level] for level in levels]])


def _tied(groups: Iterable[frozenset[str]]) -> dict[str, str]:
    """One name for all elements of groups that overlap, directly or through others."""
    links: dict[str, str] = {}

    def root(name: str) -> str:
        while links.setdefault(name, name) != name:
            links[name] = name = links[links[name]]
        return name

    for group in groups:
        first = min(group, default="")
        for name in group:
            links[root(name)] = root(first)
    return {name: root(name) for name in [*links]}
