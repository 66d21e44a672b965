"""The behaviours of a brick: which the bindings name, which the NQC files lack, and which do not fit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass

from golc.diagnostics import Code, Findings, Label, Span
from golc.nqc.actionmap import ActionMap, Entry
from golc.nqc.source import Definition, Kind, NqcSource
from golc.nqc.wire import Wire
from golc.nqc.words import complaint
from golc.theory.forms import behaviour_text, setting_text
from golc.theory.suggest import closest, did_you_mean
from golc.theory.theory import ByCall, ByStart, Device

SPOKEN = {Kind.TASK: "a task", Kind.SUB: "a sub", Kind.FUNCTION: "a function"}

LEGOLOG_MACROS = {
    "ACTION_MESG_LOW": "action_base",
    "ACTION_MESG_BASE": "action_digits",
    "VALUE_MESG_LOW": "value_base",
    "VALUE_MESG_BASE": "value_digits",
}
"""The macros by which an application of Legolog says its messages, with the settings that say the same here."""


@dataclass(frozen=True)
class Wanted:
    """A behaviour that some bindings name: ``arguments`` is how many it is given."""

    name: str
    kind: type[ByCall] | type[ByStart]
    arguments: int
    entries: tuple[Entry, ...]

    @property
    def agreed(self) -> bool:
        """Whether all bindings use it in the same way."""
        return all(type(e.behaviour) is self.kind and len(e.args) == self.arguments for e in self.entries)


def wanted(actions: ActionMap) -> list[Wanted]:
    """The behaviours that the bindings of a brick name, each once, in the order of their numbers."""
    found: dict[str, list[Entry]] = {}
    for entry in actions.entries:
        if isinstance(entry.behaviour, (ByCall, ByStart)):
            found.setdefault(behaviour_name(entry), []).append(entry)
    return [
        Wanted(name, type(entries[0].behaviour), len(entries[0].args), tuple(entries))  # type: ignore[arg-type]
        for name, entries in found.items()
    ]


def behaviour_name(entry: Entry) -> str:
    """The function, sub or task of an entry that has one."""
    match entry.behaviour:
        case ByCall(function=name):
            return name
        case ByStart(task=name):
            return name
    raise ValueError(entry)


def has_hooks(nqc: NqcSource) -> bool:
    """Whether the files bring Legolog's own dispatch, so that golc generates only what is missing around it."""
    return "startBehaviour" in nqc.definitions


def lacking(actions: ActionMap, nqc: NqcSource) -> list[Wanted]:
    """The behaviours that no file brings; none where the files dispatch themselves."""
    if has_hooks(nqc):
        return []
    return [behaviour for behaviour in wanted(actions) if behaviour.name not in nqc.definitions]


def check_behaviours(actions: ActionMap, nqc: NqcSource, taken: Set[str], findings: Findings) -> None:
    """Find what the files define otherwise than the bindings and the control program need it.

    ``taken`` are the names that the generated program defines for this theory.
    """
    check_forms(actions, nqc, findings)
    _check_names(nqc, taken, actions.device, findings)
    _check_messages(actions.wire, nqc, actions.device, findings)


def check_lacking(actions: ActionMap, nqc: NqcSource, findings: Findings) -> None:
    """Warn of behaviours that no file brings."""
    for behaviour in lacking(actions, nqc):
        if complaint(behaviour.name) is not None:
            continue  # it cannot be there, which has been said
        entry = behaviour.entries[0]
        assert isinstance(entry.behaviour, (ByCall, ByStart))
        findings.warning(
            Code.NQC_BEHAVIOUR,
            f"`{behaviour.name}` is not in the NQC files of `{actions.device.name}`",
            entry.behaviour.span,
            "not defined",
            help=did_you_mean(behaviour.name, _spare(actions, behaviour, nqc)) or f"write `{_head(behaviour)}` there",
            notes=("until then, golc gen-nqc puts a stub in its place",),
        )


def _spare(actions: ActionMap, behaviour: Wanted, nqc: NqcSource) -> list[str]:
    """The definitions of the right kind that no binding names."""
    named = {other.name for other in wanted(actions)}
    is_task = behaviour.kind is ByStart
    return [d.name for d in nqc.definitions.values() if (d.kind is Kind.TASK) == is_task and d.name not in named]


def _head(behaviour: Wanted) -> str:
    if behaviour.kind is ByStart:
        return f"task {behaviour.name}()"
    return f"void {behaviour.name}({_parameters(behaviour.arguments)})"


def check_forms(actions: ActionMap, nqc: NqcSource, findings: Findings) -> None:
    """Find behaviours that are tasks where a function is needed, and so on, or that take other arguments."""
    for behaviour in [] if has_hooks(nqc) else wanted(actions):
        definition = nqc.definitions.get(behaviour.name)
        if definition is not None and behaviour.agreed:
            _check_form(behaviour, definition, findings)


def _check_form(behaviour: Wanted, definition: Definition, findings: Findings) -> None:
    entry = behaviour.entries[0]
    span = entry.behaviour.span if isinstance(entry.behaviour, (ByCall, ByStart)) else entry.span
    labels = (Label(definition.span, f"{SPOKEN[definition.kind]}"),)
    is_task = definition.kind is Kind.TASK
    if (behaviour.kind is ByStart) != is_task:
        word = "start" if is_task else "call"
        findings.error(
            Code.NQC_BEHAVIOUR,
            f"`{behaviour.name}` is {SPOKEN[definition.kind]}, which cannot be {'called' if is_task else 'started'}",
            span,
            labels=labels,
            help=f"write `{behaviour_text(word, behaviour.name, span)}`",
        )
    elif not is_task and definition.kind is Kind.SUB and behaviour.arguments:
        findings.error(
            Code.NQC_BEHAVIOUR,
            f"`{behaviour.name}` is a sub, which takes no arguments, but `{entry.action}` has {behaviour.arguments}",
            span,
            labels=labels,
            help=f"make it a function: `{_head(behaviour)}`",
        )
    elif not is_task and definition.parameters != behaviour.arguments:
        findings.error(
            Code.NQC_BEHAVIOUR,
            f"`{behaviour.name}` takes {_count(definition.parameters)}, but `{entry.action}` has {behaviour.arguments}",
            span,
            labels=labels,
            help=f"write `{_head(behaviour)}`, one `int` for each argument",
        )


def _parameters(count: int) -> str:
    return ", ".join(f"int {letter}" for letter in "abcdefghijklmnopqrstuvwxyz"[:count])


def _count(number: int) -> str:
    return f"{number or 'no'} argument{'' if number == 1 else 's'}"


def _check_names(nqc: NqcSource, taken: Set[str], device: Device, findings: Findings) -> None:
    """The control program has names of its own; the hooks are the user's to define, and its two variables too."""
    places = {**nqc.variables, **{name: definition.span for name, definition in nqc.definitions.items()}}
    places |= {name: device.span for name in nqc.macros if name in taken}
    for name, span in places.items():
        if name == "main" or name in taken or name.startswith("golc_"):
            findings.error(
                Code.NQC_NAME,
                f"`{name}` is a name of the control program",
                span,
                help="the task `main` is generated; `void initialize()` is called when it starts"
                if name == "main"
                else "give it another name",
            )


def _check_messages(wire: Wire, nqc: NqcSource, device: Device, findings: Findings) -> None:
    """An application of Legolog says its messages in macros: they must be those that the host will use."""
    for macro, setting in LEGOLOG_MACROS.items():
        value = nqc.macros.get(macro, "").strip()
        if value.isdecimal() and int(value) != getattr(wire, setting):
            findings.error(
                Code.DEVICE_SETTING,
                f"the NQC file says {macro} {value}, but the device's {setting} is {getattr(wire, setting)}",
                device.span,
                help=f"write `{setting_text(setting, value, device.span)}` in the device's block",
            )


def check_reports(actions: ActionMap, counters: Mapping[str, Entry], nqc: NqcSource, findings: Findings) -> None:
    """Warn of events that no file reports, and find reports of what is no event."""
    told: set[str] = set()
    meant = set()
    for word in sorted(nqc.words):
        if word.startswith("EXOG_") and word not in counters:
            similar = closest(word, counters)
            meant.add(similar)
            findings.error(
                Code.NQC_NAME,
                f"`{word}` is no exogenous action of the device",
                _place_of(word, nqc) or actions.device.span,
                help=f"did you mean `{similar}`?" if similar else f"there are {', '.join(counters) or 'none'}",
            )
    for name, entry in counters.items():
        if name not in nqc.words and name not in meant and entry.action not in told:
            told.add(entry.action)
            findings.warning(
                Code.UNREPORTED,
                f"nothing in the NQC files reports `{entry.action}`" + (f" as `{name}`" if entry.count > 1 else ""),
                entry.span,
                help=f"write `golc_report({name});` where it happens",
            )


def _place_of(word: str, nqc: NqcSource) -> Span | None:
    for definition in nqc.definitions.values():
        for token in definition.body:
            if token.text == word:
                return Span(definition.span.source, token.start, token.end)
    return None


def check_timer(nqc: NqcSource, timer: int, findings: Findings) -> None:
    """Warn where a file uses the timer of the control program."""
    for definition in nqc.definitions.values():
        for place in _uses_of_timer(definition, timer):
            findings.warning(
                Code.NQC_BEHAVIOUR,
                f"timer {timer} is the control program's own",
                place,
                help="use one of the timers 0 to 2",
            )


def _uses_of_timer(definition: Definition, timer: int) -> Iterator[Span]:
    names = {str(timer), f"T{timer + 1}"}
    body = definition.body
    for index, token in enumerate(body[:-2]):
        if token.text in ("Timer", "ClearTimer", "SetTimer", "FastTimer") and body[index + 2].text in names:
            yield Span(definition.span.source, token.start, body[index + 2].end)


def reach(names: Iterable[str], nqc: NqcSource, starts: bool = True) -> tuple[set[str], set[str]]:
    """What some behaviours lead to: every definition reached, and those of them that are started as tasks.

    With ``starts=False`` only what runs in the same task is followed.
    """
    seen: set[str] = set()
    started: set[str] = set()
    waiting = [name for name in names if name in nqc.definitions]
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        before = ""
        for token in nqc.definitions[name].body:
            if token.text in nqc.definitions and before == "start":
                started.add(token.text)
            if token.text in nqc.definitions and (before != "start" or starts) and before != "stop":
                waiting.append(token.text)
            before = token.text
    return seen, started
