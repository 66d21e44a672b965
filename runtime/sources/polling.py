"""Asks the bricks for exogenous actions, one after the other, while the loop does other things."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence

from golc.diagnostics import GolcError
from golc.runtime.clock import Clock
from golc.runtime.devices.base import Device
from golc.runtime.loop.inbox import Broken, Inbox, Report, end_thread, reporting_thread
from golc.theory.theory import Action


class Poller:
    """A source with a thread that polls each device at the rate it wants, in turn."""

    def __init__(self, devices: Sequence[Device], reported: frozenset[str], inbox: Inbox, clock: Clock) -> None:
        """``reported`` names the exogenous actions that these devices may report."""
        self.name = " or ".join(device.name for device in devices)
        self.ended = False
        self._devices = devices
        self._reported = reported
        self._inbox = inbox
        self._clock = clock
        self._stop = threading.Event()
        self._thread = reporting_thread(inbox, self.name, self._run)

    def may_report(self, action: Action) -> bool:
        return action.name in self._reported

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        """Stop asking; an answer that is awaited is still waited for, but not for long."""
        self._stop.set()
        end_thread(self._thread)

    def _run(self) -> None:
        due = dict.fromkeys(self._devices, 0.0)
        while not self._stop.is_set():
            device = min(due, key=due.__getitem__)
            if self._stop.wait(max(0.0, due[device] - time.monotonic())):
                return
            try:
                self._poll(device)
            except GolcError as error:
                if not self._stop.is_set():
                    self._inbox.put(Broken(device.name, error))
                self.ended = True
                return
            due[device] = time.monotonic() + self._clock.real(device.poll_interval or 0.0)

    def _poll(self, device: Device) -> None:
        device.poll(lambda action, args: self._inbox.put(Report(action, args, device.name)))
