"""Tasks: where each is in its code, and what it waits for."""

from __future__ import annotations

from dataclasses import dataclass, field

from golc.runtime.rcxsim.machine.memory import Code

NEVER = 1 << 62
"""A time that does not come: a task that waits for it is not running."""
LOWEST_PRIORITY = 255
MOST_LOOPS = 4
OWN_VARIABLES = 16


@dataclass(frozen=True, slots=True)
class Handler:
    """Where a task goes on when an event that it monitors happens, or when it loses or is refused a resource.

    ``what``: the events, or the resources, a bit each.
    """

    what: int
    code: Code
    place: int
    back: tuple[Code, int] | None


@dataclass(eq=False, slots=True)
class Task:
    """One of the ten tasks.

    ``wake`` is when its next op code may be executed. ``back`` is where a sub returns to: there is one such place only,
    so that a sub called by a sub takes it from the first. Its own variables (firmware 2.0) outlive it.
    """

    number: int
    code: Code | None = None
    place: int = 0
    wake: int = NEVER
    back: tuple[Code, int] | None = None
    loops: list[int] = field(default_factory=list)
    own: list[int] = field(default_factory=lambda: [0] * OWN_VARIABLES)
    priority: int = LOWEST_PRIORITY
    monitor: Handler | None = None
    triggered: int = 0
    access: Handler | None = None

    @property
    def running(self) -> bool:
        return self.wake != NEVER

    @property
    def within(self) -> list[Code]:
        """The code that it executes, and that to which it returns."""
        return [code for code in (self.code, self.back and self.back[0]) if code is not None]

    def start(self, code: Code, now: int) -> None:
        """Begin at the top, whatever was before."""
        self.stop()
        self.code, self.place, self.wake = code, 0, now

    def stop(self) -> None:
        """End it."""
        self.wake = NEVER
        self.code = self.back = self.monitor = self.access = None
        self.loops.clear()
        self.triggered = 0
        self.priority = LOWEST_PRIORITY

    def go(self, handler: Handler, now: int) -> None:
        """Go on at a handler, even out of a wait."""
        self.code, self.place, self.back, self.wake = handler.code, handler.place, handler.back, now
