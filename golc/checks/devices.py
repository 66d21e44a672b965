"""Devices (row 8 of what ``golc check`` proves): who does an action, who reports one, and what a brick can take."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction

from golc.checks.bricks import RCX, check_brick, check_ranges
from golc.diagnostics import Code, Findings, Label
from golc.nqc.actionmap import ActionMap, Entry
from golc.nqc.numbering import implied, number_device
from golc.nqc.wire import LAST_RANGE
from golc.theory.fitting import size
from golc.theory.forms import name_text
from golc.theory.suggest import did_you_mean
from golc.theory.theory import Action, BasicActionTheory, Binding, Device, Fixed, Parameter

OPERATOR = "operator"
"""The kind of device that reports even where none is declared: there is always someone at the terminal."""


@dataclass(frozen=True)
class Rule:
    """What a setting may be."""

    allows: Callable[[Fraction], bool]
    said: str


def _whole(low: int, high: int) -> Rule:
    return Rule(lambda value: value.denominator == 1 and low <= value <= high, f"a whole number from {low} to {high}")


SETTINGS = {
    "poll": Rule(lambda value: value >= 0, "a time, 0 s or more"),
    "silence": Rule(lambda value: value >= 0, "a time, 0 s or more; 0 is never"),
    "range": _whole(0, LAST_RANGE),
    "action_base": _whole(1, 254),
    "action_digits": _whole(2, 127),
    "value_base": _whole(1, 254),
    "value_digits": _whole(2, 127),
    "control_base": _whole(1, 250),
}
"""The settings of a brick: the parameters of its link."""


def check_devices(theory: BasicActionTheory, findings: Findings) -> None:
    """Everything about devices that elaboration does not see by itself."""
    if not theory.devices:
        return
    sound = [device for device in theory.devices if check_settings(device, findings)]
    bricks = [number_device(theory, device, findings) for device in theory.devices if device.kind == RCX]
    _check_implicit(theory, findings)
    _check_done(theory, bricks, findings)
    _check_answers(theory, findings)
    _check_reported(theory, bricks, findings)
    check_ranges([actions for actions in bricks if actions.device in sound], findings)
    for actions in bricks:
        check_brick(theory, actions, findings)


def check_settings(device: Device, findings: Findings) -> bool:
    """Whether the settings of a device are known and make sense."""
    before = len(findings.diagnostics)
    for setting in device.settings.values():
        rule = SETTINGS.get(setting.name) if device.kind == RCX else None
        if rule is None:
            known = SETTINGS if device.kind == RCX else ()
            findings.error(
                Code.DEVICE_SETTING,
                f"a device `{device.kind}` has no setting `{setting.name}`",
                setting.span,
                help=did_you_mean(setting.name, known) or f"there are {', '.join(known) or 'none'}",
            )
        elif not rule.allows(setting.value):
            findings.error(
                Code.DEVICE_SETTING, f"`{setting.name}` is {rule.said}, not {_shown(setting.value)}", setting.span
            )
        elif setting.name == "silence" and setting.value:
            findings.warning(
                Code.DEVICE_SETTING,
                "`silence` has no effect with the classic protocol: the brick goes on when the host falls silent",
                setting.span,
            )
    return all(found.code is not Code.DEVICE_SETTING for found in findings.diagnostics[before:])


def _shown(value: Fraction) -> str:
    return str(value.numerator) if value.denominator == 1 else str(float(value))


def _check_implicit(theory: BasicActionTheory, findings: Findings) -> None:
    """A device without bindings takes what no other device has: there can be one of them."""
    bare = [device for device in theory.devices if not device.bindings]
    for device in bare[1:]:
        findings.error(
            Code.NO_DEVICE,
            f"neither `{bare[0].name}` nor `{device.name}` says which actions it does",
            device.span,
            labels=(Label(bare[0].span, "has no bindings either"),),
            help="write at least for one of them which actions it does",
        )


def _check_done(theory: BasicActionTheory, bricks: Iterable[ActionMap], findings: Findings) -> None:
    """Every instance of a primitive action has a device."""
    bound: dict[str, list[Binding | Entry]] = {}
    for device in theory.devices:
        if device.kind != RCX:
            for binding in device.bindings or implied(theory, device):
                bound.setdefault(binding.action, []).append(binding)
    for actions in bricks:
        for entry in actions.entries:
            bound.setdefault(entry.action, []).append(entry)
    for action in theory.actions.values():
        if not action.exogenous:
            _check_covered(action, bound.get(action.name, []), findings)


def _check_covered(action: Action, bindings: list[Binding | Entry], findings: Findings) -> None:
    if not bindings:
        findings.error(
            Code.NO_DEVICE,
            f"no device does `{action.name}`",
            action.span,
            help=action.span.either(
                f"bind it in a device's block; `device self:` with the line `{action.name}` is for mere bookkeeping",
                f"write `bind({name_text(action.name, action.span)})` under a device; "
                'one under `@theory.device("self")` is for mere bookkeeping',
            ),
        )
        return
    wanted_count = _instances(action.parameters)
    if wanted_count is None or any(_instances(binding.args) is None for binding in bindings):
        return
    covered = sum(_instances(binding.args) or 0 for binding in bindings)
    if covered < wanted_count:
        findings.error(
            Code.NO_DEVICE,
            f"devices do only {covered} of the {wanted_count} instances of `{action.name}`",
            action.span,
            labels=tuple(Label(binding.span, "these") for binding in bindings),
        )


def _instances(slots: Iterable[Parameter | Fixed]) -> int | None:
    """How many ground actions there are, or None if they cannot be counted."""
    count = 1
    for slot in slots:
        if isinstance(slot, Parameter):
            if not slot.type.finite:
                return None
            count *= size(slot.type)
    return count


def _check_answers(theory: BasicActionTheory, findings: Findings) -> None:
    """Nothing is sensed by a device that only keeps books."""
    for device in theory.devices:
        for binding in (device.bindings or implied(theory, device)) if device.kind == "self" else ():
            if theory.actions[binding.action].senses:
                message = f"`{binding.action}` senses, but the device `self` cannot answer"
                findings.error(Code.NO_DEVICE, message, binding.span, help="bind it to another device")


def _check_reported(theory: BasicActionTheory, bricks: Iterable[ActionMap], findings: Findings) -> None:
    """An exogenous action that only certain devices may report is reported by one of them, and by no other brick."""
    reported = set()
    for actions in bricks:
        for entry in actions.entries:
            sources = theory.actions[entry.action].sources
            if not entry.exogenous or not sources or not {RCX, actions.device.name}.isdisjoint(sources):
                reported.add(entry.action)
                continue
            message = f"`{entry.action}` may come only from {' or '.join(sources)}, not from `{actions.device.name}`"
            findings.error(Code.BINDING, message, entry.span, help="leave this line out, or name this source too")
    people = {OPERATOR} | {device.name for device in theory.devices if device.kind == OPERATOR}
    for action in theory.actions.values():
        if action.exogenous and action.sources and action.name not in reported and people.isdisjoint(action.sources):
            message = f"no device reports `{action.name}`, which may come only from {' or '.join(action.sources)}"
            findings.error(Code.UNREPORTED, message, action.span, help=_reporting_help(theory, action))


def _reporting_help(theory: BasicActionTheory, action: Action) -> str:
    """How an exogenous action that nobody reports gets a source: only bricks and people report anything."""
    bricks = [device for device in theory.devices if device.kind == RCX]
    if any(not {RCX, device.name}.isdisjoint(action.sources) for device in bricks):
        bound = f"write `bind({name_text(action.name, action.span)})` under the brick"
        return action.span.either(f"write a line `{action.name}` in the brick's block", bound)
    if RCX in action.sources:
        return "declare the device"
    one, other = [action.span.either(f"from {kind}", f'sources=["{kind}"]') for kind in (RCX, OPERATOR)]
    return f"only bricks and operators report: write `{one}` or `{other}`"
