"""The one queue through which the world reaches the online loop, in order of arrival.

Any thread may put items in; only the loop takes them out.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal, Protocol, TypeAlias

from golc.diagnostics import Diagnostic
from golc.theory.theory import Action
from golc.theory.types import Value

Reply: TypeAlias = Callable[[object], None]
"""Gets what a command answers: a mapping (state), a list of texts (history), or ``None``."""


@dataclass(frozen=True, slots=True)
class Report:
    """An exogenous action that has occurred: it is declared, its arguments fit, and its source may report it."""

    action: str
    args: tuple[Value, ...]
    source: str


@dataclass(frozen=True, slots=True)
class Command:
    """What the operator wants of the run itself."""

    name: Literal["state", "history", "abort", "stop"]
    source: str
    reply: Reply = field(compare=False)


@dataclass(frozen=True, slots=True)
class Refusal:
    """A line that was refused."""

    text: str
    source: str
    diagnostics: tuple[Diagnostic, ...]


@dataclass(frozen=True, slots=True)
class Closed:
    """A source will report nothing any more."""

    source: str


@dataclass(frozen=True, slots=True)
class Broken:
    """A source or a device failed outside an action; the run ends with this error."""

    source: str
    error: Exception


Item: TypeAlias = Report | Command | Refusal | Closed | Broken


class Source(Protocol):
    """Something that may report exogenous actions."""

    @property
    def name(self) -> str:
        """How messages speak of it."""
        ...

    @property
    def ended(self) -> bool:
        """Whether it will never report anything again."""
        ...

    def may_report(self, action: Action) -> bool:
        """Whether it is allowed and able to report this exogenous action."""
        ...

    def start(self) -> None:
        """Begin to report."""
        ...

    def close(self) -> None:
        """Report nothing more."""
        ...


class Inbox:
    """A queue whose reader may look without cost, and wait."""

    def __init__(self) -> None:
        self.items: deque[Item] = deque()
        self.at_once: Callable[[Command], bool] = lambda command: False
        """Answers a command that cannot wait; whether it did."""
        self.hasten: Callable[[Command], None] = lambda command: None
        """Told of a command that is in the queue, and for which what takes long may be given up."""
        self._arrived = threading.Event()

    def put(self, item: Item) -> None:
        """Add an item, or have the command answered at once if the loop is busy with something that takes long."""
        if isinstance(item, Command) and self.at_once(item):
            return
        self.items.append(item)
        self._arrived.set()
        if isinstance(item, Command):
            self.hasten(item)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until there is an item, at most for some seconds; whether there is one."""
        self._arrived.clear()
        return bool(self.items) or self._arrived.wait(timeout)


def reporting_thread(inbox: Inbox, name: str, work: Callable[[], None]) -> threading.Thread:
    """A thread for a source; what it raises ends the run, so that no source falls silent unnoticed."""

    def run() -> None:
        try:
            work()
        except Exception as error:
            inbox.put(Broken(name, error))

    return threading.Thread(target=run, name=f"golc {name}", daemon=True)


def end_thread(thread: threading.Thread) -> None:
    """Wait for a thread that was told to end, if it ever began, but not for long: it must not hold up the others."""
    if thread.is_alive():
        thread.join(2)
