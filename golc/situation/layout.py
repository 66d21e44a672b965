"""Where each ground fluent stands in a state: a flat tuple of values, one slot for each ground fluent.

Fluents follow one another in the order of declaration; the ground fluents of one fluent in the order of their
arguments, the last one fastest.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import prod
from typing import Protocol, TypeAlias

from golc.theory.theory import BasicActionTheory, Fluent
from golc.theory.types import Type, Value, show_call

World: TypeAlias = tuple[Value, ...]
"""One way the world may be: a value for each slot."""


class Slots(Protocol):
    """What a compiled term reads: the value in each slot."""

    def __getitem__(self, slot: int, /) -> Value: ...


@dataclass(frozen=True)
class Place:
    """The slots of one fluent: ``base`` is the first; ``strides`` has one element for each parameter."""

    fluent: Fluent
    base: int
    strides: tuple[int, ...]

    @property
    def types(self) -> tuple[Type, ...]:
        return tuple(parameter.type for parameter in self.fluent.parameters)

    @cached_property
    def positions(self) -> tuple[dict[Value, int], ...]:
        """For each parameter, the place of each value in its type's order."""
        return tuple({value: index for index, value in enumerate(type_.values)} for type_ in self.types)

    def slot(self, args: tuple[Value, ...]) -> int:
        """The slot of a ground fluent; a ``KeyError`` for an argument outside its type."""
        return self.base + sum(
            stride * position[arg] for stride, position, arg in zip(self.strides, self.positions, args, strict=True)
        )

    def find(self, args: tuple[Value, ...]) -> int | None:
        """The slot of a ground fluent; none for arguments that it cannot have."""
        fits = len(args) == len(self.types) and all(arg in type_ for arg, type_ in zip(args, self.types, strict=True))
        return self.slot(args) if fits else None

    def arguments(self) -> Iterator[tuple[Value, ...]]:
        """The arguments of the ground fluents in the order of their slots."""
        return product(*(type_.values for type_ in self.types))


class Layout:
    """The places of all fluents of a theory."""

    def __init__(self, theory: BasicActionTheory) -> None:
        self.places: dict[str, Place] = {}
        base = 0
        for fluent in theory.fluents.values():
            sizes = [len(parameter.type.values) for parameter in fluent.parameters]
            strides = tuple(prod(sizes[index + 1 :]) for index in range(len(sizes)))
            self.places[fluent.name] = Place(fluent, base, strides)
            base += prod(sizes)
        self.size = base

    @cached_property
    def ground_fluents(self) -> tuple[tuple[str, tuple[Value, ...]], ...]:
        """Name and arguments of each slot."""
        return tuple((name, args) for name, place in self.places.items() for args in place.arguments())

    def placed(self, values: Mapping[tuple[str, tuple[Value, ...]], Value]) -> dict[int, Value]:
        """The values of ground fluents by their slots."""
        return {self.places[name].slot(args): value for (name, args), value in values.items()}

    @cached_property
    def slots(self) -> dict[str, int]:
        """The slot of each ground fluent by its text."""
        return {show_call(*name): slot for slot, name in enumerate(self.ground_fluents)}
