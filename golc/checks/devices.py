"""Devices (row 8 of what ``golc check`` proves): who does an action, who reports one, and what a brick can take."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction

from golc.checks.host import check_host
from golc.diagnostics import Code, Findings, Label, Span, UserError
from golc.nqc.actionmap import ActionMap, Entry
from golc.nqc.behaviours import check_forms
from golc.nqc.numbering import implied, number_device
from golc.nqc.userfiles import scan_file, user_file
from golc.nqc.wire import DEFAULTS, LAST_RANGE
from golc.nqc.words import LONGEST_NAME, complaint
from golc.theory.fitting import size
from golc.theory.suggest import did_you_mean
from golc.theory.theory import Action, BasicActionTheory, Binding, ByCall, ByStart, Device, Fixed, Parameter

RCX = "rcx"
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
    sound = [device for device in theory.devices if _check_settings(device, findings)]
    bricks = [number_device(theory, device, findings) for device in theory.devices if device.kind == RCX]
    for device in theory.devices:
        if device.kind == "host":
            check_host(theory, device, findings)
    _check_implicit(theory, findings)
    _check_done(theory, bricks, findings)
    _check_answers(theory, findings)
    _check_reported(theory, bricks, findings)
    _check_ranges([actions for actions in bricks if actions.device in sound], findings)
    for actions in bricks:
        _check_ends(actions, findings)
        _check_behaviour_names(actions, findings)
        _check_file(actions, findings)


def _check_settings(device: Device, findings: Findings) -> bool:
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
            help=f"bind it in a device's block; `device self:` with the line `{action.name}` is for mere bookkeeping",
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
        return f"write a line `{action.name}` in the brick's block"
    if RCX in action.sources:
        return "declare the device"
    return f"only bricks and operators report: write `from {RCX}` or `from {OPERATOR}`"


def _check_ranges(bricks: list[ActionMap], findings: Findings) -> None:
    """The messages of a brick lie in 1..255 and apart from each other and from those of every other brick."""
    taken: list[_Messages] = []
    for actions in bricks:
        own = [_Messages(actions.device, kind, numbers) for kind, numbers in actions.wire.ranges().items()]
        for messages in own:
            if messages.numbers.start < 1 or messages.numbers.stop > 256:
                findings.error(
                    Code.MESSAGE_RANGES,
                    f"the {messages} of `{actions.device.name}` do not fit: there are the messages 1 to 255",
                    _place(actions.device),
                )
        clashes = [(one, two) for place, one in enumerate(own) for two in [*taken, *own[:place]] if one.meets(two)]
        if clashes:
            _report_overlap(*clashes[0], findings)
        else:
            taken += own


@dataclass(frozen=True)
class _Messages:
    """One kind of message of a brick."""

    device: Device
    kind: str
    numbers: range

    def meets(self, other: _Messages) -> bool:
        return self.numbers.start < other.numbers.stop and other.numbers.start < self.numbers.stop

    def __str__(self) -> str:
        return f"{self.kind} ({self.numbers.start} to {self.numbers.stop - 1})"


def _report_overlap(one: _Messages, two: _Messages, findings: Findings) -> None:
    if one.device is two.device:
        findings.error(Code.MESSAGE_RANGES, f"the {one} and the {two} overlap", _place(one.device))
        return
    findings.error(
        Code.MESSAGE_RANGES,
        f"the {one} of `{one.device.name}` overlap with the {two} of `{two.device.name}`",
        _place(one.device),
        labels=(Label(_place(two.device), f"`{two.device.name}`"),),
        help=f"each brick in sight needs messages of its own: write `set range 1` for `{one.device.name}`",
    )


def _place(device: Device) -> Span:
    """The setting that chooses the messages, or the device itself."""
    chosen = [setting for name, setting in device.settings.items() if name == "range" or name in DEFAULTS]
    return chosen[0].span if chosen else device.span


def _check_ends(actions: ActionMap, findings: Findings) -> None:
    """A task goes on when its action is done; something has to say that it has ended."""
    if any(entry.exogenous for entry in actions.entries):
        return
    for entry in actions.entries:
        if isinstance(entry.behaviour, ByStart):
            findings.warning(
                Code.NO_END,
                f"`{entry.action}` starts a task, but the brick reports nothing that could tell its end",
                entry.behaviour.span,
                help=f"bind an exogenous action to `{actions.device.name}`, or use `by call` to wait for the end",
            )


def _check_behaviour_names(actions: ActionMap, findings: Findings) -> None:
    """A behaviour is named as NQC allows it, and used in one way."""
    first: dict[str, Entry] = {}
    for entry in actions.entries:
        if entry.exogenous and len(entry.action) > LONGEST_NAME:
            message = f"`{entry.action[:20]}…` is too long for a name on the brick, which has {LONGEST_NAME} characters"
            findings.error(Code.NQC_NAME, message, entry.span)
        if not isinstance(entry.behaviour, (ByCall, ByStart)):
            continue
        name = entry.behaviour.function if isinstance(entry.behaviour, ByCall) else entry.behaviour.task
        if (reason := complaint(name)) is not None:
            findings.error(
                Code.NQC_NAME,
                f"`{name}` {reason}",
                entry.behaviour.span,
                help=f"name the behaviour otherwise: `by call do_{name}`" if name.isidentifier() else None,
            )
        other = first.setdefault(name, entry)
        if type(other.behaviour) is not type(entry.behaviour) or len(other.args) != len(entry.args):
            _report_mixed(name, entry, other, findings)


def _report_mixed(name: str, entry: Entry, other: Entry, findings: Findings) -> None:
    assert isinstance(entry.behaviour, (ByCall, ByStart)) and isinstance(other.behaviour, (ByCall, ByStart))
    if type(other.behaviour) is not type(entry.behaviour):
        problem = f"`{name}` is called for one action and started for another"
    else:
        problem = (
            f"`{name}` has {len(entry.args)} arguments for `{entry.action}` but {len(other.args)} for `{other.action}`"
        )
    findings.error(
        Code.NQC_BEHAVIOUR, problem, entry.behaviour.span, labels=(Label(other.behaviour.span, "the other use"),)
    )


def _check_file(actions: ActionMap, findings: Findings) -> None:
    """Look into the brick's NQC file, if there is one: are the behaviours there of the right form?"""
    path = user_file(actions.device)
    try:
        nqc = None if path is None else scan_file(path)
    except UserError as error:
        for diagnostic in error.diagnostics:
            findings.error(diagnostic.code, diagnostic.message, actions.device.span)
        return
    if nqc is not None:
        check_forms(actions, nqc, findings)
