"""The machine as the line sees it: packets in and out, on the line's clock."""

from __future__ import annotations

from golc.runtime.rcxsim.frames import TOGGLE, message_in
from golc.runtime.rcxsim.line import Air
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.machine import Machine
from golc.runtime.rcxsim.machine.messages import Alone
from golc.runtime.rcxsim.machine.options import Firmware, Options
from golc.runtime.rcxsim.machine.remote import Remote
from golc.runtime.rcxsim.machine.requests import Requests
from golc.runtime.rcxsim.surroundings import Surroundings
from golc.runtime.rcxsim.trace import Trace

REMOTE = 0xD2


class MachineBrick:
    """A machine with a firmware that answers; it sends into the air of whoever lets its time pass."""

    def __init__(
        self, firmware: Firmware, surroundings: Surroundings, trace: Trace, options: Options | None = None
    ) -> None:
        self._radio = _Radio()
        self.machine = Machine(firmware, surroundings, self._radio, trace, options)
        self._requests = Requests(self.machine, trace)
        self._remote = Remote(self.machine)
        self._ran = False
        self.error: MachineError | None = None
        """Why the program was stopped last."""

    def hear(self, payload: bytes, now: float, air: Air) -> None:
        """Take a packet; a brick that is off does not."""
        machine = self.machine
        if not machine.on:
            return
        machine.heard()
        value = message_in(payload)
        if value is not None:
            machine.hear(value)
        elif payload[0] & ~TOGGLE == REMOTE:
            self._remote.take(int.from_bytes(payload[1:3], "little"))
        elif (reply := self._requests.answer(payload)) is not None:
            through = air.send(reply, now, machine.options.reply_delay / 1e6)
            machine.messages.occupied(_microseconds(through))

    def run(self, until: float, air: Air) -> None:
        """Let time pass; an error of the program is in the trace, and the brick goes on without it."""
        self._radio.air = air
        end = _microseconds(until)
        while self.machine.now < end:
            try:
                self.machine.run(end)
            except MachineError as error:
                self.error = error
        self._radio.air = None

    def due(self) -> float | None:
        return self.machine.due() / 1e6

    def switch(self, on: bool, now: float) -> None:
        """Somebody switches it off; or on, and presses Run if the program ran before."""
        if not on:
            self._ran = self.machine.processor.running
        self.machine.switch(on)
        if on and self._ran:
            self.machine.start(0)


class _Radio:
    """Sends into the air, if there is any; the machine counts in microseconds."""

    def __init__(self) -> None:
        self.air: Air | None = None
        self._alone = Alone()

    def send(self, payload: bytes, now: int) -> int:
        if self.air is None:
            return self._alone.send(payload, now)
        return _microseconds(self.air.send(payload, now / 1e6))


def _microseconds(seconds: float) -> int:
    return round(seconds * 1e6)
