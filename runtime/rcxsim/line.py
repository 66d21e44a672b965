"""The infrared line between host and brick: a tower with echo, air time and sleep, and everything that goes wrong.

The core has no clock and no thread: the caller says what time it is. Times are in seconds since the start.
"""

from __future__ import annotations

import heapq
import random
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol, TypeVar

from golc.runtime.rcxsim.frames import BYTE_SECONDS, Receiver, message_in, packet
from golc.runtime.rcxsim.trace import Trace

T = TypeVar("T")

TOWER_SLEEPS_AFTER = 4.0
"""Seconds after the host's last byte from which the tower hears nothing; the next byte of the host wakes it."""
QUIET_RESETS_AFTER = 0.1
"""A gap inside a packet after which the receiver starts anew. The ROM takes 30 ms; a busy host may be slower."""
LATEST = 0.5
"""Seconds by which a packet is late at most, apart from those before it in the same direction."""
MOST_NOISE = 8
"""Bytes that noise makes before a packet, at most."""


class Air(Protocol):
    """What a brick sends into."""

    def send(self, payload: bytes, now: float, delay: float = 0.0) -> float:
        """Send a packet, not before ``delay``, scaled like air time, has passed; when it is through."""


class Brick(Protocol):
    """What is at the other end of the line: one brick or several."""

    def hear(self, payload: bytes, now: float, air: Air) -> None:
        """Take a packet."""

    def run(self, until: float, air: Air) -> None:
        """Let time pass."""

    def due(self) -> float | None:
        """When it may do something by itself next."""

    def switch(self, on: bool, now: float) -> None:
        """Somebody has switched it off, or on again and started its program if that ran before."""


@dataclass(frozen=True)
class LineOptions:
    """``air_time`` scales 2400 baud (0: at once).

    ``loss``, ``garble``, ``repeat``, ``late`` and ``noise`` are chances for each packet either way: that it is lost,
    damaged, arrives twice, arrives up to half a second late, has random bytes before it. Packets never overtake.
    ``outages`` are the times, from and to, for which the brick is switched off.
    """

    air_time: float = 1.0
    loss: float = 0.0
    garble: float = 0.0
    echo: bool = True
    sleep: float | None = TOWER_SLEEPS_AFTER
    repeat: float = 0.0
    late: float = 0.0
    noise: float = 0.0
    outages: tuple[tuple[float, float], ...] = ()


class Line:
    """Carries bytes from the host to the brick, and its packets back."""

    def __init__(self, brick: Brick, options: LineOptions, noise: random.Random, trace: Trace) -> None:
        self._brick = brick
        self._options = options
        self._byte = BYTE_SECONDS * options.air_time
        self._noise = noise
        self._trace = trace
        self._coming: list[tuple[float, int, int]] = []  # the host's bytes: time, order, byte
        self._arriving: list[tuple[float, int, bytes]] = []  # what is left of its packets
        self._going: list[tuple[float, int, int]] = []  # the bytes to the host
        self._switches = [(time, index % 2 == 1) for outage in options.outages for index, time in enumerate(outage)]
        self._on = True
        self._order = 0
        self._now = 0.0
        self._free = 0.0  # until when the host's bytes fill the air
        self._sending = (0.0, 0.0)  # when the brick sends, or sent last
        self._through = {"host": 0.0, "brick": 0.0}  # when the last packet of each arrives, however late
        self._heard_at = float("-inf")
        self._awake_until = float("-inf")
        self._clean = Receiver()
        self._noisy = Receiver()

    def host_sent(self, data: bytes, now: float) -> bytes:
        """Bytes that the host wrote at ``now``; the bytes that have reached the host by then."""
        received = self.advance(now)
        for byte in data:
            self._free = max(self._free, now) + self._byte
            self._push(self._coming, self._free, byte)
        return received + self.advance(now)

    def due(self) -> float | None:
        """When ``advance`` is wanted next."""
        due = self._brick.due()
        return min([*self._due(), *([] if due is None else [due])], default=None)

    def advance(self, now: float) -> bytes:
        """Let everything happen that happens until ``now``, each thing at its own time; the bytes for the host."""
        received = bytearray()
        while True:
            self._brick.run(min([*self._due(), now]), self)  # which may send something that arrives before
            due = min(self._due(), default=None)
            if due is None or due > now:
                self._now = max(self._now, now)
                return bytes(received)
            self._now = max(self._now, due)  # what was held up is due in the past
            if self._switches and self._switches[0][0] == due:
                self._on = self._switches.pop(0)[1]
                self._brick.switch(self._on, self._now)
            elif self._coming and self._coming[0][0] == due:
                received += self._host_byte(heapq.heappop(self._coming)[2], self._now)
            elif self._arriving and self._arriving[0][0] == due:
                self._arrive(heapq.heappop(self._arriving)[2], self._now)
            else:
                received.append(heapq.heappop(self._going)[2])

    def send(self, payload: bytes, now: float, delay: float = 0.0) -> float:
        """A packet of the brick, which waits until the air is free; when it is through."""
        if (value := message_in(payload)) is not None:
            self._trace.tell(now, "sent", message=value)
        data = packet(payload)
        before, free = self._sending
        start = max(now + delay * self._options.air_time, self._free, free)
        end = start + len(data) * self._byte
        self._sending = (before if start == free else start, end)
        if self._options.sleep is not None and end > self._awake_until:
            self._trace.tell(now, "lost", by="brick", packet=data.hex(" "), why="the tower sleeps")
            return end
        lateness, copies = self._through_noise(data, "brick", now)
        arrival = max(start + lateness, self._through["brick"])
        for byte in b"".join(copies):
            arrival += self._byte
            self._push(self._going, arrival, byte)
        self._through["brick"] = arrival
        return end

    def _due(self) -> Iterator[float]:
        for queue in (self._switches, self._coming, self._arriving, self._going):
            if queue:
                yield queue[0][0]

    def _host_byte(self, byte: int, now: float) -> bytes:
        """A byte of the host is through: what the tower echoes."""
        if self._options.sleep is not None:
            self._awake_until = now + self._options.sleep
        if self._hears(now):
            if now - self._heard_at > QUIET_RESETS_AFTER:
                self._clean.reset()
                self._noisy.reset()
            self._heard_at = now
            payload = self._clean.feed(byte)
            if payload is not None:
                self._deliver(packet(payload), now)
        return bytes((byte,)) if self._options.echo else b""

    def _hears(self, now: float) -> bool:
        """Whether the brick is on, and does not send."""
        start, end = self._sending
        return self._on and not start < now <= end

    def _deliver(self, data: bytes, now: float) -> None:
        """A whole packet of the host is through: what noise leaves of it reaches the brick, soon or late."""
        lateness, copies = self._through_noise(data, "host", now)
        arrival = max(now + lateness, self._through["host"])
        for place, copy in enumerate(copies):
            arrival += len(copy) * self._byte if place else 0.0
            self._push(self._arriving, arrival, copy)
        self._through["host"] = arrival

    def _arrive(self, data: bytes, now: float) -> None:
        if not self._hears(now):
            return
        for byte in data:
            payload = self._noisy.feed(byte)
            if payload is not None:
                if (value := message_in(payload)) is not None:
                    self._trace.tell(now, "heard", message=value)
                self._brick.hear(payload, now, self)

    def _through_noise(self, data: bytes, sender: str, now: float) -> tuple[float, list[bytes]]:
        """By how many seconds a packet is late, and what arrives of it.

        All chances are drawn each time, so that one option does not shift the others'.
        """
        options = self._options
        chances = (options.loss, options.garble, options.repeat, options.late, options.noise)
        lost, garbled, repeated, late, noisy = [self._noise.random() < chance for chance in chances]
        if lost:
            self._trace.tell(now, "lost", by=sender, packet=data.hex(" "), why="noise")
            return 0.0, []
        copies = [data]
        if garbled:
            copies = [damage(data, self._noise)]
            self._trace.tell(now, "garbled", by=sender, packet=data.hex(" "), into=copies[0].hex(" "))
        if repeated:
            copies.append(data)
            self._trace.tell(now, "doubled", by=sender, packet=data.hex(" "))
        if noisy:
            copies.insert(0, self._noise.randbytes(self._noise.randint(1, MOST_NOISE)))
            self._trace.tell(now, "noise", by=sender, bytes=copies[0].hex(" "))
        lateness = self._noise.uniform(0, LATEST) if late else 0.0
        if late:
            self._trace.tell(now, "late", by=sender, packet=data.hex(" "), seconds=round(lateness, 6))
        return lateness, copies

    def _push(self, queue: list[tuple[float, int, T]], time: float, item: T) -> None:
        heapq.heappush(queue, (time, self._order, item))
        self._order += 1


def damage(data: bytes, noise: random.Random) -> bytes:
    """A packet with one bit changed, one byte missing, one byte too many, or its end cut off."""
    place = noise.randrange(len(data))
    match noise.randrange(4):
        case 0:
            return data[:place] + bytes((data[place] ^ 1 << noise.randrange(8),)) + data[place + 1 :]
        case 1:
            return data[:place] + data[place + 1 :]
        case 2:
            return data[:place] + bytes((noise.randrange(256),)) + data[place:]
        case _:
            return data[:place]
