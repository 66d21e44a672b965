"""What the templates of the NQC program are filled with."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from golc.nqc.actionmap import ActionMap, Entry
from golc.nqc.behaviours import Wanted, has_hooks, reach, wanted
from golc.nqc.dispatch import Counter, Dispatch, Names, counters, dispatch, numbers
from golc.nqc.files import open_seal, seal
from golc.nqc.source import Kind, NqcSource
from golc.nqc.words import HOOKS
from golc.theory.theory import BasicActionTheory, ByCall, ByStart, Device, Fixed

if TYPE_CHECKING:
    from jinja2 import Environment

TIMER = 3
"""The timer of the brick that the event loop takes for itself."""

QUEUE_BITS = 14
"""Bits of a brick's variable in which events are packed: the place of the next one must be a positive number too."""


NOTHING = Dispatch((), (), 0)


@dataclass(frozen=True)
class Queue:
    """How events are packed into one variable: numbers counted from ``first``, which is 1, in digits of ``base``.

    ``base`` is a power of two with room for every event and for none; ``depth`` events fit.
    """

    first: int
    last: int
    base: int
    depth: int

    @property
    def full(self) -> int:
        """What the place of the next event is when there is no room."""
        return int(self.base**self.depth)


def queue_of(actions: ActionMap) -> Queue:
    """The queue for the exogenous actions of a brick; ``depth`` is 0 where it has none or they lie too far apart."""
    exogenous = [entry for entry in actions.entries if entry.exogenous]
    if not exogenous:
        return Queue(1, 0, 2, 0)
    first, last = min(e.first for e in exogenous), max(e.last for e in exogenous)
    bits = (last - first + 1).bit_length()
    return Queue(first, last, 2**bits, QUEUE_BITS // bits)


class Program:
    """The texts for one brick: ``user`` is what the NQC files of the user bring."""

    def __init__(self, theory: BasicActionTheory, actions: ActionMap, user: NqcSource, tones: bool = False) -> None:
        self.device: Device = actions.device
        self.counters: list[Counter] = counters(actions)
        self._theory = theory
        self.actions = actions
        self._user = user
        self._tones = tones
        self._names = Names(actions)
        self._calls = dispatch(theory, actions, self._names, ByCall, "number")
        self._starts = dispatch(theory, actions, self._names, ByStart, "golc_number")

    @property
    def own_hooks(self) -> bool:
        """Whether the user's files dispatch themselves, as Legolog's applications do."""
        return has_hooks(self._user)

    @property
    def sampled(self) -> bool:
        """Whether the user's files report through Legolog's variable ``exogAction``."""
        return "exogAction" in self._user.words and bool(self.counters)

    @property
    def counted(self) -> list[Counter]:
        """The counters that the program has: none where the user's files know nothing of them."""
        return [] if self.own_hooks and "golc_report" not in self._user.words else self.counters

    @property
    def variables(self) -> list[str]:
        """The variables that the generated program has beside those of the event loop and the user."""
        return [*self.arguments, *(counter.name for counter in self.counted)]

    @property
    def arguments(self) -> list[str]:
        """The variables in which arguments reach a behaviour; none where the user's files dispatch themselves."""
        count = 0 if self.own_hooks else max(self._calls.arguments, self._starts.arguments)
        return [f"golc_arg{place}" for place in range(1, count + 1)]

    @property
    def macros(self) -> list[str]:
        return [number.macro for number in numbers(self.actions, self._names)]

    @property
    def started(self) -> list[str]:
        """The tasks that an action starts, directly or through a behaviour: what an abort has to stop."""
        behaviours = wanted(self.actions)
        bound = [behaviour.name for behaviour in behaviours if behaviour.kind is ByStart]
        _, further = reach([behaviour.name for behaviour in behaviours], self._user)
        return [*bound, *sorted(further - set(bound))]

    @property
    def monitors(self) -> list[str]:
        """The user's tasks that nothing starts: they run all the time."""
        bodies = [definition.body for definition in self._user.definitions.values()]
        begun = {
            token.text
            for body in bodies
            for index, token in enumerate(body)
            if index and body[index - 1].text == "start"
        }
        bound = {behaviour.name for behaviour in wanted(self.actions)}
        return [task.name for task in self._user.of(Kind.TASK) if task.name not in begun | bound | {"main"}]

    def text(self, name: str, files: Sequence[str], includes: str) -> str:
        """The program; ``files`` are the NQC files to include, ``includes`` the option that finds what they include."""
        wire = self.actions.wire
        ranges = wire.ranges()
        return _render(
            "program.nqc.j2",
            name=name,
            image=f"{name.removesuffix('.nqc')}.rcx",
            device=self._spoken_device,
            domain=self._theory.name,
            origin=self._origin,
            includes=includes,
            numbers=numbers(self.actions, self._names),
            wire=wire,
            action_digit=_digit(wire.action_digits),
            lowest=min(ranges["action numbers"].start, wire.abort),
            highest=max(ranges["action numbers"].stop - 1, wire.request),
            timer=TIMER,
            polled=bool(self.counters),
            queue=queue_of(self.actions),
            arguments=self.arguments,
            declared=self._user.variables,
            counters=self.counted,
            sampled=self.sampled,
            files=files,
            hooks=HOOKS - self._user.definitions.keys(),
            monitors=self.monitors,
            calls=self._calls,
            starts=NOTHING if self.own_hooks else self._starts,
            started=self.started,
            tones=self._tones,
        )

    def stubs(self, name: str, behaviours: Sequence[Wanted]) -> str:
        """The file with a beginning for each behaviour that the user's files lack."""
        return _render("stubs.nqc.j2", name=name, origin=self._origin, stubs=[self._stub(b) for b in behaviours])

    def _stub(self, behaviour: Wanted) -> Mapping[str, object]:
        entry = behaviour.entries[0]
        slots = [f"{slot.name}: {slot.type}" if not isinstance(slot, Fixed) else str(slot.value) for slot in entry.args]
        signature = f"{entry.action}({', '.join(slots)})" if slots else entry.action
        lines = []
        if entry.sensed is not None:
            lines.append(f"sensorVal = {_some_number(entry)};     // what it has sensed: {entry.sensed}")
        if behaviour.kind is ByStart:
            ends = ", ".join(counter.name for counter in self.counters[:4]) or "an exogenous action of the brick"
            lines.append(f"// its end: golc_report(NAME); where NAME is {ends}")
            head = f"task {behaviour.name}()"
        else:
            parameters = ", ".join(f"int argument{place}" for place in range(1, behaviour.arguments + 1))
            head = f"void {behaviour.name}({parameters})"
        return {"purpose": f"The action {signature}.", "head": head, "lines": lines}

    @property
    def _spoken_device(self) -> str:
        return "the brick" if self.device.name == self.device.kind else f"the brick `{self.device.name}`"

    @property
    def _origin(self) -> str:
        return self.device.file or "a file of your own, which the device has to name"


def control() -> str:
    """The event loop, the same for every brick."""
    return _render("control.nqh.j2")


def _some_number(entry: Entry) -> int:
    """A sensing number that means something."""
    if entry.table:
        return min(entry.table)
    if entry.sensed is not None and entry.sensed.kinds == {"int"} and entry.sensed.finite:
        return int(str(entry.sensed.values[0]))
    return 0


def _digit(base: int) -> str:
    """The last digit of ``n``: cheap on the brick where the base is a power of two."""
    return f"(n) & {base - 1}" if base & (base - 1) == 0 else f"(n) % {base}"


def _render(template: str, **values: object) -> str:
    return seal(_environment().get_template(template).render(seal=open_seal(), **values))


@functools.cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader("golc.templates", ""),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
