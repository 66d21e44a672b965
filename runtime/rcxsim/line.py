"""The infrared line between host and brick: a tower with echo, air time, sleep, and messages lost or garbled.

The core has no clock and no thread: the caller says what time it is. Times are in seconds since the start.
"""

from __future__ import annotations

import heapq
import random
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from golc.runtime.rcxsim import firmware
from golc.runtime.rcxsim.frames import BYTE_SECONDS, Receiver, message, message_in, packet
from golc.runtime.rcxsim.trace import Trace

TOWER_SLEEPS_AFTER = 4.0
"""Seconds after the host's last byte from which the tower hears nothing; the next byte of the host wakes it."""
QUIET_RESETS_AFTER = 0.1
"""A gap inside a packet after which the receiver starts anew. The ROM takes 30 ms; a busy host may be slower."""
REACTION = 0.03
"""From the end of a request to the start of its answer, scaled like air time: some fifteen op codes of 2 ms."""


class Program(Protocol):
    """A program on a brick: hears messages, keeps an eye on the clock, and answers with messages."""

    def hear(self, message: int, now: float) -> Sequence[int]:
        """Take a message; the messages that answer it at once."""

    def tick(self, now: float) -> Sequence[int]:
        """Do what is due at ``now``; the messages to send."""

    def due(self) -> float | None:
        """When ``tick`` is wanted next."""


@dataclass(frozen=True)
class LineOptions:
    """``air_time`` scales 2400 baud (0: at once); ``loss`` and ``garble`` are chances for each message either way."""

    air_time: float = 1.0
    loss: float = 0.0
    garble: float = 0.0
    echo: bool = True
    sleep: float | None = TOWER_SLEEPS_AFTER


class Line:
    """Carries bytes from the host to every program in sight, and their answers back."""

    def __init__(self, programs: Sequence[Program], options: LineOptions, noise: random.Random, trace: Trace) -> None:
        self._programs = programs
        self._options = options
        self._byte = BYTE_SECONDS * options.air_time
        self._noise = noise
        self._trace = trace
        self._coming: list[tuple[float, int, int]] = []  # the host's bytes: time, order, byte
        self._going: list[tuple[float, int, int]] = []  # the bytes to the host
        self._order = 0
        self._now = 0.0
        self._free = 0.0  # until when the host's bytes fill the air
        self._sending = (0.0, 0.0)  # when the brick sends, or sent last
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
        times = [queue[0][0] for queue in (self._coming, self._going) if queue]
        times += [due for program in self._programs if (due := program.due()) is not None]
        return min(times, default=None)

    def advance(self, now: float) -> bytes:
        """Let everything happen that happens until ``now``, each thing at its own time; the bytes for the host."""
        received = bytearray()
        while (due := self.due()) is not None and due <= now:
            self._now = max(self._now, due)  # what was held up is due in the past
            if self._coming and self._coming[0][0] == due:
                received += self._host_byte(heapq.heappop(self._coming)[2], self._now)
            elif self._going and self._going[0][0] == due:
                received.append(heapq.heappop(self._going)[2])
            else:
                for program in self._programs:
                    if program.due() == due:
                        self._answer(program.tick(self._now), self._now)
        self._now = max(self._now, now)
        return bytes(received)

    def _host_byte(self, byte: int, now: float) -> bytes:
        """A byte of the host is through: what the tower echoes."""
        if self._options.sleep is not None:
            self._awake_until = now + self._options.sleep
        start, end = self._sending
        if not start < now <= end:  # a brick that sends hears nothing
            if now - self._heard_at > QUIET_RESETS_AFTER:
                self._clean.reset()
                self._noisy.reset()
            self._heard_at = now
            payload = self._clean.feed(byte)
            if payload is not None:
                self._deliver(payload, now)
        return bytes((byte,)) if self._options.echo else b""

    def _deliver(self, payload: bytes, now: float) -> None:
        """A whole packet of the host is through: what noise leaves of it reaches the bricks."""
        for byte in self._through_noise(packet(payload), "host", now):
            heard = self._noisy.feed(byte)
            if heard is not None:
                self._hear(heard, now)

    def _hear(self, payload: bytes, now: float) -> None:
        value = message_in(payload)
        if value is None:
            answer = firmware.reply(payload)
            self._trace.tell(now, "request", payload=payload.hex(" "), answered=answer is not None)
            if answer is not None:
                self._send(packet(answer), now)
            return
        self._trace.tell(now, "heard", message=value)
        for program in self._programs:
            self._answer(program.hear(value, now), now)

    def _answer(self, messages: Sequence[int], now: float) -> None:
        for value in messages:
            self._trace.tell(now, "sent", message=value)
            self._send(message(value), now)

    def _send(self, data: bytes, now: float) -> None:
        start = max(now + REACTION * self._options.air_time, self._free, self._sending[1])
        self._sending = (start, start + len(data) * self._byte)
        if self._options.sleep is not None and self._sending[1] > self._awake_until:
            self._trace.tell(now, "lost", by="brick", packet=data.hex(" "), why="the tower sleeps")
            return
        left = self._through_noise(data, "brick", now)
        for place, byte in enumerate(left, 1):
            self._push(self._going, start + min(place, len(data)) * self._byte, byte)

    def _through_noise(self, data: bytes, sender: str, now: float) -> bytes:
        """What arrives of a packet. Both chances are drawn each time, so that one option does not shift the other's."""
        lost = self._noise.random() < self._options.loss
        garbled = self._noise.random() < self._options.garble
        if lost:
            self._trace.tell(now, "lost", by=sender, packet=data.hex(" "), why="noise")
            return b""
        if not garbled:
            return data
        damaged = damage(data, self._noise)
        self._trace.tell(now, "garbled", by=sender, packet=data.hex(" "), into=damaged.hex(" "))
        return damaged

    def _push(self, queue: list[tuple[float, int, int]], time: float, byte: int) -> None:
        heapq.heappush(queue, (time, self._order, byte))
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
