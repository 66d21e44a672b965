"""A brick by itself: its messages, what tells the end of its tasks, and its NQC files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from golc.diagnostics import Code, Diagnostic, Findings, Label, Severity, Span, UserError
from golc.nqc.actionmap import LARGEST, ActionMap, Entry
from golc.nqc.behaviours import check_lacking, lacking
from golc.nqc.limits import check_limits
from golc.nqc.numbering import number_device
from golc.nqc.program import Program
from golc.nqc.review import review
from golc.nqc.toolchain import Target
from golc.nqc.userfiles import user_file, user_files
from golc.nqc.wire import CONTROLS, DEFAULTS, Wire
from golc.nqc.words import LONGEST_NAME, complaint
from golc.theory.forms import behaviour_text, setting_text
from golc.theory.reading import fluents_read
from golc.theory.suggest import did_you_mean
from golc.theory.terms import Choice
from golc.theory.theory import Action, BasicActionTheory, ByCall, ByStart, Device

RCX = "rcx"


def check_brick(theory: BasicActionTheory, actions: ActionMap, findings: Findings) -> None:
    """What concerns one brick alone; ``actions`` are its numbers."""
    _check_messages(theory, actions, findings)
    _check_ends(theory, actions, findings)
    _check_behaviour_names(actions, findings)


def review_bricks(theory: BasicActionTheory, findings: Findings) -> None:
    """Look into the NQC files of every brick: is everything there that the lines name, and does it fit?"""
    for device in theory.devices:
        if device.kind == RCX:
            wrong = Findings()
            actions = number_device(theory, device, wrong)
            if not wrong.has_errors:  # otherwise that has been said, and the program depends on the numbers
                _review(theory, actions, findings)


def check_ranges(bricks: list[ActionMap], findings: Findings) -> None:
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
        help="each brick in sight needs messages of its own: "
        f"write `{setting_text('range', 1, one.device.span)}` for `{one.device.name}`",
    )


def _place(device: Device) -> Span:
    """The setting that chooses the messages, or the device itself."""
    chosen = [setting for name, setting in device.settings.items() if name == "range" or name in DEFAULTS]
    return chosen[0].span if chosen else device.span


def _check_messages(theory: BasicActionTheory, actions: ActionMap, findings: Findings) -> None:
    """Note the actions whose numbers the host cannot tell in one message."""
    digits = actions.wire.action_digits
    done = [entry for entry in actions.entries if not entry.exogenous]
    long = [entry for entry in done if digits <= entry.last <= LARGEST]
    if not long or digits < 2:
        return
    first = long[0]
    number = max(first.first, digits)
    findings.add(
        Diagnostic(
            Code.SEVERAL_MESSAGES,
            f"the number {number} of `{first.action}` takes several messages, as all from {digits} on",
            first.span,
            Severity.NOTE,
            labels=tuple([Label(entry.span, "and these") for entry in long[1:]]),
            help=_fewer_messages(theory, actions),
        )
    )


def _fewer_messages(theory: BasicActionTheory, actions: ActionMap) -> str | None:
    """How the brick could do with one message for each number."""
    done = [entry for entry in actions.entries if not entry.exogenous]
    digits, wanted = actions.wire.action_digits, max(entry.last for entry in done) + 1
    if sum(entry.count for entry in done) <= digits:
        return f"number the actions from 0 to {digits - 1}, and what the brick reports after them"
    alone = sum(device.kind == actions.device.kind for device in theory.devices) == 1
    base = actions.wire.control_base + CONTROLS
    if alone and base + 2 * wanted <= 256 and actions.wire == Wire():
        place = actions.device.span
        both = f"`{setting_text('action_base', base, place)}` and `{setting_text('action_digits', wanted, place)}`"
        return f"{both} make it one message"
    return None


def _check_ends(theory: BasicActionTheory, actions: ActionMap, findings: Findings) -> None:
    """A task goes on when its action is done; something has to say that it has ended."""
    reports = any(entry.exogenous for entry in actions.entries)
    for entry in actions.entries:
        if not isinstance(entry.behaviour, ByStart):
            continue
        changed = {effect.fluent for effect in theory.actions[entry.action].effects}
        if not reports:
            problem = "the brick reports nothing that could tell its end"
            help_ = f"bind an exogenous action to `{actions.device.name}`"
        elif changed and not any(_concerns(theory, action, changed) for action in _events(theory)):
            fluents = " or ".join(f"`{fluent}`" for fluent in sorted(changed))
            problem = f"no exogenous action has to do with {fluents}, so that nothing tells its end"
            help_ = "let one of what the brick reports ask for it or change it"
        else:
            continue
        call = entry.span.either("by call", 'call="…"')
        findings.warning(
            Code.NO_END,
            f"`{entry.action}` starts a task, but {problem}",
            entry.behaviour.span,
            help=f"{help_}, or use `{call}` to wait for the end",
        )


def _events(theory: BasicActionTheory) -> list[Action]:
    return [action for action in theory.actions.values() if action.exogenous]


def _concerns(theory: BasicActionTheory, event: Action, fluents: set[str]) -> bool:
    """Whether an exogenous action changes or asks for one of some fluents."""
    terms = [*event.preconditions]
    for effect in event.effects:
        if effect.fluent in fluents:
            return True
        value = effect.value.among if isinstance(effect.value, Choice) else effect.value
        terms += [term for term in (effect.where, effect.condition, value) if term is not None]
    return not fluents.isdisjoint(fluents_read(theory, terms))


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
                help=f"name the behaviour otherwise: `{behaviour_text('call', f'do_{name}', entry.span)}`"
                if name.isidentifier()
                else None,
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


def _review(theory: BasicActionTheory, actions: ActionMap, findings: Findings) -> None:
    device = actions.device
    try:
        nqc = user_files(theory.name, device, Path(theory.source.name).parent / "build")
    except UserError as error:
        for diagnostic in error.diagnostics:
            findings.error(diagnostic.code, diagnostic.message, device.span)
        return
    if nqc.own is None:
        _check_missing_file(device, findings)
        return
    program = Program(theory, actions, nqc.all)
    review(program, nqc.all, findings)
    check_lacking(actions, nqc.all, findings)
    check_limits(program, nqc.all, tuple(lacking(actions, nqc.all)), Target.RCX2, device.span, findings)


def _check_missing_file(device: Device, findings: Findings) -> None:
    """A file that is not there is written later, unless there is one with nearly its name."""
    path = user_file(device)
    if path is None:
        return
    help_ = did_you_mean(path.name, _neighbours(path))
    if help_ is not None:
        findings.warning(Code.NQC_BEHAVIOUR, f"there is no NQC file `{device.file}`", device.span, help=help_)


def _neighbours(path: Path) -> list[str]:
    try:
        return sorted(other.name for other in path.parent.iterdir() if other.suffix == path.suffix)
    except OSError:
        return []
