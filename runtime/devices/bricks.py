"""The device ``rcx``: a brick at the end of an infra-red link, which does actions by number and reports others."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import asdict

from golc.diagnostics import DeviceError
from golc.nqc.numbering import ActionMap
from golc.runtime.devices.base import Args, Device, GivenUpError
from golc.runtime.devices.rcx.brick import Brick
from golc.runtime.devices.rcx.errors import InterruptedLinkError, NonsenseError, PanicError, SilentBrickError
from golc.runtime.devices.rcx.numbers import ClassicParameters
from golc.runtime.devices.rcx.tower import Tower, open_tower
from golc.runtime.devices.rcx.transport import Transport
from golc.theory.types import show_call

POLL_SECONDS = 0.25
"""How often a brick is asked for exogenous actions where the device does not say (``set poll``)."""
FASTEST_POLL = 0.01
MOST_EVENTS = 16
"""Exogenous actions that are fetched in a row before the link is free for something else."""
BUSY_SECONDS = 3.0
"""Real seconds after which an abort no longer waits for another exchange to end."""

HASTE_HELP = "with --speed {:g}, is the brick a simulated one of the same speed, and the computer not too busy for it?"


class Link:
    """A tower and its lock: several bricks share it, and an exchange is never cut in two.

    The tower is at a port, or at the end of a ``transport`` of its own.
    """

    def __init__(self, port: str, speed: float = 1.0, transport: Transport | None = None) -> None:
        self.port = port
        self._transport = transport
        self._interrupted = threading.Event()
        self._interruptible: int | None = None
        self._speed = speed
        self._lock = threading.Lock()
        self._tower: Tower | None = None

    @property
    def tower(self) -> Tower:
        """The tower, opened when it is first asked for; raises ``DeviceError`` if that cannot be done."""
        if self._tower is None:
            self._tower = open_tower(self._transport or self.port, self._speed, self._is_interrupted)
        return self._tower

    @contextmanager
    def exchange(self, patience: float = -1) -> Iterator[None]:
        """Have the link alone; ``patience`` is after how many seconds it is taken all the same."""
        owned = self._lock.acquire(timeout=patience)
        try:
            yield
        except (SilentBrickError, PanicError, NonsenseError) as error:
            if self._speed > 1 and self._transport is None:
                raise type(error)(str(error), f"{error.help}; {HASTE_HELP.format(self._speed)}") from error
            raise
        finally:
            if owned:
                self._lock.release()

    @contextmanager
    def action(self) -> Iterator[None]:
        """Have the link alone for an action, which ``interrupt`` makes raise ``GivenUpError``; polls are left alone."""
        self._interruptible = threading.get_ident()
        try:
            with self.exchange():
                yield
        except InterruptedLinkError as error:
            raise GivenUpError(str(error)) from error
        finally:
            self._interruptible = None
            self._interrupted.clear()

    def interrupt(self) -> None:
        """Give up the action under way."""
        self._interrupted.set()

    def _is_interrupted(self) -> bool:
        return self._interrupted.is_set() and self._interruptible == threading.get_ident()

    def close(self) -> None:
        """Close the tower; does nothing if it is closed."""
        tower, self._tower = self._tower, None
        if tower is not None:
            tower.close()


class RcxDevice(Device):
    """Translates between ground actions and the numbers of a brick."""

    def __init__(self, actions: ActionMap, link: Link) -> None:
        super().__init__(actions.device.name)
        self._actions = actions
        self._link = link
        self._brick: Brick | None = None
        setting = actions.device.settings.get("poll")
        interval = POLL_SECONDS if setting is None else float(setting.value)
        if any(entry.exogenous for entry in actions.entries):
            self.poll_interval = max(interval, FASTEST_POLL)

    def open(self) -> None:
        """Reach the brick and bring it into a known state: nothing runs, and what it had to report is forgotten."""
        brick = Brick(self._link.tower, ClassicParameters(**asdict(self._actions.wire)))
        try:
            with self._link.exchange():
                brick.abort()
        except SilentBrickError as error:
            self._link.close()
            raise DeviceError(f"no brick answers on {self._link.port}", help=error.help) from error
        self._brick = brick

    def handles(self, action: str, args: Args) -> bool:
        return self._actions.handles(action, args)

    def label(self, action: str, args: Args) -> str:
        return f"{self.name} {self._actions.encode(action, args)}"

    def perform(self, action: str, args: Args) -> Args:
        """Send the action's number and wait for what the brick answers; the link has been made ``free``."""
        number = self._actions.encode(action, args)
        answer = self._opened().perform(number, self._actions.timeout(action, args))
        entry = self._actions.entry(action, args)
        return () if entry is None or entry.sensed is None else (self._actions.sensed(action, answer, args),)

    def free(self) -> AbstractContextManager[None]:
        return self._link.action()

    def poll(self, report: Callable[[str, Args], None]) -> None:
        """Fetch what the brick has to report, until it says that there is nothing more.

        An event is reported before the link is free for anything else: no action begins that did not know of it.
        """
        self.polling = True
        try:
            for _ in range(MOST_EVENTS):
                with self._link.exchange():
                    number = self._opened().poll()
                    if number is None:
                        break
                    report(*self._event(number))
        finally:
            self.polling = False

    def _event(self, number: int) -> tuple[str, Args]:
        decoded = self._actions.decode(number)
        entry = None if decoded is None else self._actions.entry(*decoded)
        if decoded is None or entry is None:
            problem = "which is the number of no action"
        elif not entry.exogenous:
            problem = f"which is the number of `{show_call(*decoded)}`, an action of the robot"
        else:
            return decoded
        help_ = "is another program on the brick? generate its NQC again and download it"
        raise DeviceError(f"the brick {self.name} reported {number}, {problem}", help=help_)

    def interrupt(self) -> None:
        self._link.interrupt()

    def abort(self) -> None:
        """Tell the brick to stop everything; whatever exchange is under way does not matter any more."""
        if self._brick is not None:
            with self._link.exchange(BUSY_SECONDS):
                self._brick.abort()

    def close(self) -> None:
        self._link.close()

    def _opened(self) -> Brick:
        if self._brick is None:
            raise DeviceError(f"the brick {self.name} has not been opened")
        return self._brick
