"""States as users see them: a mapping from ground fluents to values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Any, TypeAlias

from golc.situation import worlds
from golc.situation.dynamics import Dynamics
from golc.situation.summary import summary
from golc.theory.suggest import did_you_mean
from golc.theory.types import Value

Key: TypeAlias = str | tuple[Value, ...]
"""A ground fluent: its name, its text as in ``"holding(4)"``, or its name and its arguments."""


class State(Mapping[Key, Any]):
    """What the agent knows: the value of every ground fluent, or an ``Unknown`` with the possible ones.

    ``state["location"]``, ``state["holding", 4]`` and ``state["holding(4)"]`` are values; ``KeyError`` for what is no
    ground fluent. It is iterated over by the texts of the ground fluents, in the order of declaration. Values are
    Python's integers and truth values, ``None``, strings for symbols and texts, ``Fraction`` for real numbers that are
    not whole, ``frozenset`` and ``tuple``. A state never changes; it can be compared and kept in sets.

    >>> import golc
    >>> state = golc.load("examples/delivery/delivery.gl").initial()
    >>> state["location"], state["holding_delivery_for", 4]
    (3, True)
    >>> "holding_delivery_for(7)" in state
    False
    """

    def __init__(self, dynamics: Dynamics, raw: worlds.State) -> None:
        self.raw = raw
        """As the rooms inside golc have it."""
        self.dynamics = dynamics

    @cached_property
    def _values(self) -> tuple[Value, ...]:
        """By slot."""
        return worlds.shown(self.raw)

    def __getitem__(self, key: Key) -> Any:
        slot = self._slot(key)
        if slot is None:
            raise KeyError(self._missing(key))
        return self._values[slot]

    def _slot(self, key: Key) -> int | None:
        layout = self.dynamics.layout
        match key:
            case str():
                return layout.slots.get(key.replace(" ", ""))
            case (str(name), *args) if name in layout.places:
                return layout.places[name].find(tuple(args))
            case _:
                return None

    def _missing(self, key: Key) -> str:
        name = key.partition("(")[0] if isinstance(key, str) else str(key[0] if key else "")
        fluent = self.dynamics.theory.fluents.get(name)
        if fluent is None:
            help_ = did_you_mean(name, self.dynamics.theory.fluents)
            return f"unknown fluent `{name}`" + (f": {help_}" if help_ else "")
        if not fluent.parameters:
            return f"the fluent `{name}` has no arguments"
        parameters = ", ".join(f"{parameter.name}: {parameter.type}" for parameter in fluent.parameters)
        return f"the fluent is `{name}({parameters})`"

    def __iter__(self) -> Iterator[str]:
        return iter(self.dynamics.layout.slots)

    def __len__(self) -> int:
        return self.dynamics.layout.size

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, State):
            return NotImplemented
        return self.dynamics.theory is other.dynamics.theory and self.raw == other.raw

    def __hash__(self) -> int:
        return hash(self.raw)

    @property
    def worlds(self) -> int:
        """How many worlds the agent holds possible; 1 if it knows everything."""
        return len(self.raw) if isinstance(self.raw, worlds.Worlds) else 1

    def __str__(self) -> str:
        return "\n".join(summary(self.dynamics, self.raw)) or "there are no fluents"

    def __repr__(self) -> str:
        return f"<State: {'; '.join(summary(self.dynamics, self.raw))}>"

    def _repr_html_(self) -> str:
        from golc.notebook import state_html

        return state_html(self)
