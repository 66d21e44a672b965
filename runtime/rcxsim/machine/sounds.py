"""The loudspeaker: sounds are played one after the other, while the program goes on."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence

from golc.runtime.rcxsim.machine.clocks import HUNDREDTH
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.surroundings import Tone

SYSTEM_SOUNDS = (
    (Tone(2000, 4),),
    (Tone(2000, 10), Tone(2000, 10)),
    tuple(Tone(frequency, 8) for frequency in (1320, 1100, 880, 660, 440)),
    tuple(Tone(frequency, 8) for frequency in (440, 660, 880, 1100, 1320)),
    (Tone(100, 50),),
    tuple(Tone(frequency, 4) for frequency in (440, 660, 880, 1100, 1320)),
)
"""Blip, two beeps, downward, upward, low buzz, fast upward: what they are like is known, not the exact tones."""


class Sounds:
    """At most ``room`` sounds wait or are played; more are lost. ``play`` is told of each that is taken."""

    def __init__(self, room: int, play: Callable[[Sequence[Tone]], None], lose: Callable[[str], None]) -> None:
        self._room = room
        self._play = play
        self._lose = lose
        self._ends: deque[int] = deque()  # when each sound that waits or is played is over
        self.muted = False

    def system(self, number: int, now: int) -> None:
        """Play one of the six sounds of the system."""
        if number >= len(SYSTEM_SOUNDS):
            raise MachineError(f"there is no sound {number}")
        self.tones(SYSTEM_SOUNDS[number], now)

    def tones(self, tones: Sequence[Tone], now: int) -> None:
        """Play some tones after those before them."""
        while self._ends and self._ends[0] <= now:
            self._ends.popleft()
        if self.muted:
            return
        if len(self._ends) >= self._room:
            self._lose(f"{self._room} sounds wait already")
            return
        start = self._ends[-1] if self._ends else now
        self._ends.append(start + sum(tone.duration for tone in tones) * HUNDREDTH)
        self._play(tones)

    def clear(self) -> None:
        """Be silent."""
        self._ends.clear()
