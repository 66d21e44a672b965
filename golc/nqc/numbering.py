"""How the actions of a brick get their numbers: from the lines of the device, the others in order."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from golc.diagnostics import Code, Findings, Label, UserError
from golc.nqc.actionmap import DEFAULT_TIMEOUT, LARGEST, ActionMap, Entry, value_number
from golc.nqc.wire import wire_of
from golc.theory.fitting import size
from golc.theory.forms import name_text, type_text, word
from golc.theory.theory import Action, BasicActionTheory, Binding, ByCall, Device, Parameter
from golc.theory.types import INT, Interval, Optional, Type, show

__all__ = ["ActionMap", "Entry", "implied", "number_bricks", "number_device"]


def number_device(theory: BasicActionTheory, device: Device, findings: Findings) -> ActionMap:
    """The numbers of a device of kind ``rcx``: those of its bindings, the others by the order of the lines.

    A binding without a number takes the smallest free numbers in a row, after all explicit ones have their place. What
    is wrong with the numbers goes to the findings; the map that comes back is then incomplete but usable.
    """
    bindings = device.bindings or tuple(implied(theory, device))
    drafts = [entry for binding in bindings if (entry := _draft(theory, binding, findings)) is not None]
    explicit = {id(entry) for entry in drafts if entry.first >= 0}
    entries = _place(drafts, explicit)
    _check_clashes(entries, findings)
    _check_ends(entries, explicit, findings)
    for entry in entries:
        if entry.count <= LARGEST:
            _check_arguments(entry, findings)
        _check_results(theory.actions[entry.action], entry, findings)
    return ActionMap(device, tuple(sorted(entries, key=lambda entry: entry.first)), wire_of(device))


def number_bricks(theory: BasicActionTheory) -> dict[str, ActionMap]:
    """The numbers of each brick by its name; raises ``UserError`` if those of one make no sense."""
    findings = Findings()
    maps = {brick.name: number_device(theory, brick, findings) for brick in theory.bricks}
    if findings.has_errors:
        raise UserError(*findings.diagnostics)
    return maps


def implied(theory: BasicActionTheory, device: Device) -> Iterator[Binding]:
    """Bindings for a device that has none: every primitive action that no other device has, and every exogenous
    action that a brick may report, in the order of declaration."""
    elsewhere = {binding.action for other in theory.devices if other is not device for binding in other.bindings}
    for action in theory.actions.values():
        if action.name not in elsewhere and (not action.exogenous or _may_report(action, device)):
            yield Binding(action.name, action.parameters, None, None, None, None, span=action.span)


def _may_report(action: Action, device: Device) -> bool:
    """Whether an exogenous action that no line binds is one of the brick's; anyone's must at least fit a range."""
    if not action.sources:
        return all(parameter.type.finite for parameter in action.parameters)
    return device.kind in action.sources or device.name in action.sources


def _draft(theory: BasicActionTheory, binding: Binding, findings: Findings) -> Entry | None:
    """The entry of a binding; ``first`` is -1 where the number is left out."""
    action = theory.actions.get(binding.action)
    if action is None:
        return None
    for slot in binding.args:
        if isinstance(slot, Parameter) and not slot.type.finite:
            findings.error(
                Code.BINDING_UNBOUNDED,
                f"`{action.name}` cannot have a number for each argument: "
                f"`{slot.name}` is of type `{type_text(slot.type, binding.span)}`",
                binding.span,
                help=f"bind an interval, such as `{_interval_of(binding, slot.name)}`" if slot.type == INT else None,
            )
            return None
    return Entry(
        first=-1 if binding.number is None else binding.number,
        count=math.prod(size(slot.type) for slot in binding.args if isinstance(slot, Parameter)),
        action=action.name,
        exogenous=action.exogenous,
        behaviour=None if action.exogenous else binding.behaviour or ByCall(action.name, binding.span),
        args=binding.args,
        table=binding.table,
        sensed=action.senses[0].type if action.senses else None,
        timeout=DEFAULT_TIMEOUT if binding.timeout is None else float(binding.timeout),
        span=binding.span,
    )


def _interval_of(binding: Binding, parameter: str) -> str:
    name = name_text(binding.action, binding.span)
    python = f'bind({name}(var("{parameter}", interval(1, 8))))'
    return binding.span.either(f"{name}({parameter}: 1..8)", python)


def _place(drafts: Sequence[Entry], explicit: set[int]) -> list[Entry]:
    """Give the entries without a number the smallest free numbers in a row, one line after the other."""
    taken = sorted((entry.first, entry.last) for entry in drafts if id(entry) in explicit)
    placed = []
    for entry in drafts:
        if id(entry) not in explicit:
            entry = replace(entry, first=_free(taken, entry.count))
            taken = sorted([*taken, (entry.first, entry.last)])
        placed.append(entry)
    return placed


def _free(taken: Iterable[tuple[int, int]], count: int) -> int:
    """The first of the smallest ``count`` numbers in a row that lie in none of the taken ranges."""
    first = 0
    for low, high in taken:
        if first + count <= low:
            break
        first = max(first, high + 1)
    return first


def _check_clashes(entries: Sequence[Entry], findings: Findings) -> None:
    for one, other in pairwise(sorted(entries, key=lambda entry: entry.first)):
        # The same instances, bound again, are a finding already.
        again = (other.action, other.args) == (one.action, one.args)
        if other.first <= one.last and not again:
            findings.error(
                Code.NUMBER_CLASH,
                f"`{other.action}` takes {_numbers(other)}, which `{one.action}` has already",
                other.span,
                labels=(Label(one.span, f"`{one.action}` takes {_numbers(one)}"),),
                help=f"{_free(sorted((entry.first, entry.last) for entry in entries), other.count)} is free",
            )


def _check_ends(entries: Sequence[Entry], explicit: set[int], findings: Findings) -> None:
    """No number is too large. Numbers that only follow others that are too large are no finding of their own."""
    beyond = sorted((entry for entry in entries if entry.last > LARGEST), key=lambda entry: entry.first)
    for entry in beyond:
        if entry is beyond[0] or id(entry) in explicit:
            findings.error(
                Code.NUMBER_RANGE,
                f"`{entry.action}` takes {_numbers(entry)}, but a brick's numbers end at {LARGEST}",
                entry.span,
            )


def _numbers(entry: Entry) -> str:
    return f"number {entry.first}" if entry.count == 1 else f"numbers {entry.first} to {entry.last}"


def _check_arguments(entry: Entry, findings: Findings) -> None:
    """Arguments reach a behaviour as 16-bit integers that tell them apart."""
    for slot in entry.args:
        if not entry.exogenous and isinstance(slot, Parameter) and not _fits(slot.type, -LARGEST - 1):
            findings.error(
                Code.ARGUMENT_NUMBER,
                f"the values of `{type_text(slot.type, entry.span)}` cannot be given to a behaviour "
                "as 16-bit integers that differ",
                slot.span if slot.span.end else entry.span,
                help="integers reach the brick as they are, symbols by their index, "
                f"and `{word('none', entry.span)}` not at all",
            )


def _fits(type_: Type, low: int) -> bool:
    """Whether each value of a finite type has a number of its own from ``low`` to the largest."""
    if isinstance(type_, Interval):
        return low <= type_.low and type_.high <= LARGEST
    if isinstance(type_, Optional):
        return False
    if size(type_) > 2 * (LARGEST + 1):
        return False  # more values than there are numbers
    numbers = [value_number(type_, value) for value in type_.values]
    return len(set(numbers)) == len(numbers) and all(n is not None and low <= n <= LARGEST for n in numbers)


def _check_results(action: Action, entry: Entry, findings: Findings) -> None:
    """A brick answers with one number from 0 to 32767."""
    if len(action.senses) > 1:
        findings.error(
            Code.SENSING_NUMBER,
            f"`{action.name}` senses {len(action.senses)} values, but a brick answers with one number",
            entry.span,
            help="split it into one action for each value",
        )
    elif entry.table is not None:
        _check_table(action, entry, findings)
    elif entry.sensed is not None and not _answers(entry.sensed):
        example = word(show(entry.sensed.values[0]), entry.span) if entry.sensed.finite else "…"
        table = entry.span.either(f"{{0: {example}}}", f"table={{0: {example}}}")
        findings.error(
            Code.SENSING_NUMBER,
            f"`{action.name}` senses a value of `{type_text(entry.sensed, entry.span)}`, "
            f"but a brick answers with a number from 0 to {LARGEST}",
            entry.span,
            help=f"say in the binding what each number means, such as `{table}`",
        )


def _answers(type_: Type) -> bool:
    """Whether a brick can answer each value of a type with a number of its own; if there is no end of them, some."""
    return _fits(type_, 0) if type_.finite else "int" in type_.kinds


def _check_table(action: Action, entry: Entry, findings: Findings) -> None:
    assert entry.table is not None
    if entry.sensed is None:
        findings.error(
            Code.SENSING_NUMBER, f"`{action.name}` has a table of sensing values but senses nothing", entry.span
        )
        return
    for number, value in entry.table.items():
        if not 0 <= number <= LARGEST:
            findings.error(
                Code.SENSING_NUMBER, f"a brick answers with a number from 0 to {LARGEST}, never {number}", entry.span
            )
        if value not in entry.sensed:
            findings.error(
                Code.SENSING_NUMBER,
                f"`{word(show(value), entry.span)}` is not a value of `{type_text(entry.sensed, entry.span)}`, "
                "which is sensed",
                entry.span,
            )
