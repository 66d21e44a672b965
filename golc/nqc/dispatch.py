"""From the number of an action to its behaviour and its arguments, as the cases of a switch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from golc.nqc.actionmap import ActionMap, Entry, results, value_number
from golc.nqc.behaviours import behaviour_name
from golc.theory.fitting import size
from golc.theory.theory import BasicActionTheory, ByCall, ByStart, Fixed, Parameter
from golc.theory.types import Type, show


@dataclass(frozen=True)
class Number:
    """A ``#define`` of the action map."""

    macro: str
    value: int
    comment: str


@dataclass(frozen=True)
class Case:
    """One number and what is done for it."""

    macro: str
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Range:
    """The numbers ``first..last`` and what is done for them."""

    first: str
    last: str
    lines: tuple[str, ...]


@dataclass(frozen=True)
class Counter:
    """The variable that counts a ground exogenous action; ``code`` is its number from the first event's, which is 1."""

    name: str
    entry: Entry
    code: int


class Names:
    """The macros of the numbers, all different: ``NUMBER_a``, for an action with several entries ``NUMBER_a_left``."""

    def __init__(self, actions: ActionMap) -> None:
        self._taken: set[str] = set()
        self.of_entry: dict[int, str] = {}
        several = {
            entry.action
            for one, entry in pairwise(sorted(actions.entries, key=lambda e: e.action))
            if one.action == entry.action
        }
        for entry in actions.entries:
            fixed = [slot.value for slot in entry.args if isinstance(slot, Fixed)] if entry.action in several else []
            self.of_entry[entry.first] = self.unique("_".join([entry.action, *map(_word, fixed)]), entry.first)

    def unique(self, name: str, number: int) -> str:
        """The name itself, or with the number where another entry has it already."""
        if name in self._taken:
            name = f"{name}_{number}"
        self._taken.add(name)
        return name


def _word(value: object) -> str:
    """A value as part of a name."""
    return show(value).replace("-", "m")


def numbers(actions: ActionMap, names: Names) -> list[Number]:
    """The action map: a macro for each number, two for a range."""
    found = []
    for entry in actions.entries:
        name = names.of_entry[entry.first]
        if entry.count == 1:
            found.append(Number(f"NUMBER_{name}", entry.first, ""))
        else:
            slots = ", ".join(show(s.value) if isinstance(s, Fixed) else f"{s.name}: {s.type}" for s in entry.args)
            found.append(Number(f"NUMBER_{name}", entry.first, f"     // {entry.action}({slots})"))
            found.append(Number(f"LAST_{name}", entry.last, ""))
    return found


def counters(actions: ActionMap) -> list[Counter]:
    """One counter for each ground exogenous action of the brick."""
    exogenous = [entry for entry in actions.entries if entry.exogenous]
    first = min((entry.first for entry in exogenous), default=1)
    taken: set[str] = set()
    found = []
    for entry in exogenous:
        for number, args in entry.ground():
            name = "_".join(["EXOG", entry.action, *map(_word, args)])
            if name in taken:
                name = f"{name}_{number}"
            taken.add(name)
            found.append(Counter(name, entry, number - first + 1))
    return found


@dataclass(frozen=True)
class Dispatch:
    """What is done for the numbers of some actions, and how many argument variables that needs."""

    cases: tuple[Case, ...]
    ranges: tuple[Range, ...]
    arguments: int


def dispatch(
    theory: BasicActionTheory, actions: ActionMap, names: Names, kind: type[ByCall] | type[ByStart], number: str
) -> Dispatch:
    """The dispatch of the actions that call something, or of those that start something.

    ``number`` is the variable that has the number of the action.
    """
    cases, ranges, arguments = [], [], 0
    for entry in actions.entries:
        if not isinstance(entry.behaviour, kind):
            continue
        name = names.of_entry[entry.first]
        types = [parameter.type for parameter in theory.actions[entry.action].parameters]
        if entry.count == 1:
            cases.append(Case(f"NUMBER_{name}", tuple(_single(entry, types))))
        else:
            lines = tuple(_several(entry, types, f"{number} - NUMBER_{name}"))
            ranges.append(Range(f"NUMBER_{name}", f"LAST_{name}", lines))
        if entry.count > 1 or kind is ByStart:
            arguments = max(arguments, len(entry.args))
    return Dispatch(tuple(cases), tuple(ranges), arguments)


def _single(entry: Entry, types: Sequence[Type]) -> Iterator[str]:
    values = [str(value_number(type_, v)) for type_, v in zip(types, entry.arguments(0), strict=True)]
    if isinstance(entry.behaviour, ByStart):
        yield from (f"golc_arg{place} = {value};" for place, value in enumerate(values, start=1))
    yield _invocation(entry, values)


def _invocation(entry: Entry, arguments: Sequence[str]) -> str:
    if isinstance(entry.behaviour, ByStart):
        return f"start {behaviour_name(entry)};"
    return f"{behaviour_name(entry)}({', '.join(arguments)});"


def _several(entry: Entry, types: Sequence[Type], index: str) -> Iterator[str]:
    """Take the place in the range apart, the last argument first; the first one that varies keeps what remains."""
    variables = [f"golc_arg{place}" for place in range(1, len(entry.args) + 1)]
    slots = list(zip(variables, entry.args, types, strict=True))
    varying = [(variable, size(slot.type)) for variable, slot, _ in slots if isinstance(slot, Parameter)]
    rest = varying[0][0]
    yield f"{rest} = {index};"
    for variable, count in reversed(varying[1:]):
        yield f"{variable} = {rest} % {count};"
        yield f"{rest} /= {count};"
    for variable, slot, type_ in slots:
        if isinstance(slot, Fixed):
            yield f"{variable} = {value_number(type_, slot.value)};"
        else:
            yield from _from_index(variable, slot, type_)
    yield _invocation(entry, variables)


def _from_index(variable: str, slot: Parameter, type_: Type) -> Iterator[str]:
    """Turn the index of an argument into its number: by adding, by multiplying, or by a list."""
    values = [value_number(type_, value) or 0 for value in slot.type.values]
    steps = {after - before for before, after in pairwise(values)} or {1}
    comment = f"// {slot.name}: {slot.type}"
    if len(steps) == 1:
        if (step := steps.pop()) != 1:
            yield f"{variable} *= {step};"
        if values[0]:
            yield f"{variable} += {values[0]};     {comment}"
        return
    yield f"switch ({variable}) {{     {comment}"
    for index, value in enumerate(values):
        yield f"    case {index}: {variable} = {value}; break;"
    yield "}"


def facts(actions: ActionMap, names: Names) -> Mapping[str, object]:
    """The action map for programs: every ground action with its number, its behaviour and what its answers mean."""
    return {
        "messages": {
            name.replace(" ", "_"): {"first": messages.start, "last": messages.stop - 1}
            for name, messages in actions.wire.ranges().items()
        },
        "fingerprint": actions.fingerprint,
        "actions": [
            {
                "number": number,
                "action": entry.action,
                "arguments": [argument if isinstance(argument, (bool, int)) else show(argument) for argument in args],
                "exogenous": entry.exogenous,
                "behaviour": _spelt_behaviour(entry),
                "timeout": None if entry.exogenous else entry.timeout,
                "results": results(entry),
            }
            for entry in actions.entries
            for number, args in entry.ground()
        ],
    }


def _spelt_behaviour(entry: Entry) -> Mapping[str, str] | None:
    if entry.behaviour is None:
        return None
    return {"start" if isinstance(entry.behaviour, ByStart) else "call": behaviour_name(entry)}
