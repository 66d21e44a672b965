"""What the keys of the infrared remote control do: each is a bit of a word, sent again and again while it is down.

The bits are those that nqc and its successors name; that a motor stops when its key is let go is known, that it does
not stop by itself if the packet of letting go is lost is a choice.
"""

from __future__ import annotations

from golc.runtime.rcxsim.machine.machine import Machine

MESSAGES = {0x0100: 1, 0x0200: 2, 0x0400: 3}
FORWARD = {0x0800: 0, 0x1000: 1, 0x2000: 2}
BACKWARD = {0x4000: 0, 0x8000: 1, 0x0001: 2}
PROGRAMS = {0x0002: 0, 0x0004: 1, 0x0008: 2, 0x0010: 3, 0x0020: 4}
STOP, SOUND = 0x0040, 0x0080


class Remote:
    """Takes the words of the remote control for a machine."""

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        self._driven: set[int] = set()

    def take(self, word: int) -> None:
        """Do what the keys say that are down now."""
        machine = self._machine
        for bit, message in MESSAGES.items():
            if word & bit:
                machine.hear(message)
        for bit, slot in PROGRAMS.items():
            if word & bit:
                machine.select(slot)
                machine.start(0)
        if word & STOP:
            machine.stop_all()
            machine.outputs.off()
        if word & SOUND:
            machine.sounds.system(1, machine.now)
        self._drive(word)

    def _drive(self, word: int) -> None:
        outputs = self._machine.outputs
        driven = {motor for bits in (FORWARD, BACKWARD) for bit, motor in bits.items() if word & bit}
        for motor in self._driven - driven:
            outputs.own.set_modes(0x40 | 1 << motor)
        for bits, direction in ((FORWARD, 0x80), (BACKWARD, 0x00)):
            for bit, motor in bits.items():
                if word & bit:
                    outputs.own.set_directions(direction | 1 << motor)
                    outputs.own.set_modes(0x80 | 1 << motor)
        self._driven = driven
        outputs.update()
