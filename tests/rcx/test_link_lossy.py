"""Whatever is lost, cut, garbled, late or echoed: what the brick does and what the host learns, in virtual time."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from golc.runtime.devices.rcx import Brick, LinkError, PanicError, SilentBrickError, Timing, Tower

WAIT_FOR_CONTINUE = 20.0
"""Longer than the host sends a message again and again."""


@dataclass
class Robot:
    """Legolog's control program: obeys at once, reports events, panics when it is left alone in a number.

    ``remembers``: it takes a message that comes again after three seconds for the same one and answers as before.
    ``drops``: a message that does not belong into the middle of a number ends the number; otherwise it is ignored.
    """

    remembers: bool
    drops: bool = True
    events: list[int] = field(default_factory=list)
    done: list[int] = field(default_factory=list)
    reported: list[int] = field(default_factory=list)
    digits: list[int] = field(default_factory=list)
    rest: list[int] = field(default_factory=list)
    waiting_since: float = 0.0
    panic: bool = False
    last: tuple[int, float] = (0, 0.0)
    answer: Sequence[int] = ()

    def __call__(self, message: int, at: float) -> list[tuple[float, int]]:
        if self.remembers and message == self.last[0] != 83 and at - self.last[1] > 3.2:
            pass
        else:
            self.answer = self.take(message, at)
        self.last = (message, at)
        return [(0.05, number) for number in self.answer]

    def take(self, message: int, at: float) -> Sequence[int]:
        if message == 81:
            self.digits, self.rest, self.panic = [], [], False
            return ()
        self.panic |= bool(self.rest) and at - self.waiting_since > WAIT_FOR_CONTINUE
        if self.panic:
            return (80,)
        if self.rest and message == 82:
            return self.next_digit(at)
        if self.rest and not self.drops:
            return ()
        self.rest = []
        if message == 83 and not (self.digits and not self.drops):
            self.digits = []
            return self.number(self.events.pop(0), 32, 16, at) if self.events else (84,)
        return self.digit(message, at) if 32 <= message <= 63 else ()

    def digit(self, message: int, at: float) -> Sequence[int]:
        more, digit = divmod(message - 32, 16)
        self.digits.append(digit)
        if more:
            return (82,)
        number = sum(digit * 16**place for place, digit in enumerate(self.digits))
        self.digits = []
        self.done.append(number)
        return self.number(value_of(number), 64, 8, at)

    def number(self, number: int, base: int, radix: int, at: float) -> Sequence[int]:
        if base == 32:
            self.reported.append(number)
        parts = []
        while number >= radix:
            number, digit = divmod(number, radix)
            parts.append(base + radix + digit)
        self.rest = [*parts, base + number]
        return self.next_digit(at)

    def next_digit(self, at: float) -> Sequence[int]:
        self.waiting_since = at
        first, *self.rest = self.rest
        return (first,)


def value_of(number: int) -> int:
    """What the robot senses; several digits in one of three cases."""
    return number * 7 % 300 if number % 3 == 0 else number % 8


class Weather:
    """Damages the frames whose places in the sequence are named; from some frame on, all is well."""

    def __init__(self, damages: dict[int, tuple[str, int]]) -> None:
        self.damages = damages
        self.count = 0

    def __call__(self, data: bytes, from_brick: bool) -> tuple[float, bytes]:
        self.count += 1
        kind, detail = self.damages.get(self.count, ("none", 0))
        place = detail % len(data)
        match kind:
            case "lost":
                return 0.0, b""
            case "cut":
                return 0.0, data[:place]
            case "garbled":
                return 0.0, data[:place] + bytes((data[place] ^ 1 << detail % 8,)) + data[place + 1 :]
            case "noisy":
                return 0.0, data[:place] + bytes((detail % 256,)) + data[place:]
            case "late" if from_brick:
                return 2.2 + detail % 3, data
        return 0.0, data


KINDS = st.sampled_from(["lost", "cut", "garbled", "noisy"])
DAMAGES = st.dictionaries(st.integers(1, 40), st.tuples(KINDS, st.integers(3, 300)), max_size=4)
STEPS = st.lists(st.sampled_from(["poll", "event"]) | st.integers(0, 300), min_size=1, max_size=8)
# More than four damages in a row would be a silent brick; every action gets the time it may need.
PATIENT = Timing(sends=6, part_sends=6)
TIMEOUT = 300.0
REUSED = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None, max_examples=150)


def run(brick: Brick, robot: Robot, line: Any, steps: Sequence[str | int]) -> tuple[list[int], list[int]]:
    """Do the steps: the values returned, and the events received in the end."""
    values, events = [], []
    for step in steps:
        if step == "event":
            robot.events.append(20 + len(robot.events))
        elif step == "poll":
            events.append(brick.poll())
        else:
            values.append(brick.perform(int(step), TIMEOUT))
        line.time += 0.1
    for _ in range(20):
        events.append(brick.poll())
        line.time += 0.3
    return values, [number for number in events if number is not None]


@REUSED
@given(steps=STEPS, damages=DAMAGES, echo=st.booleans(), sleeps=st.booleans())
def test_a_brick_with_memory_does_everything_and_nothing_twice(
    air: Any, steps: list[str | int], damages: dict[int, tuple[str, int]], echo: bool, sleeps: bool
) -> None:
    robot = Robot(remembers=True)
    line = air(robot, damage=Weather(damages), echo=echo, sleeps=sleeps)
    values, events = run(Brick(Tower(line), timing=PATIENT), robot, line, steps)
    numbers = [step for step in steps if isinstance(step, int)]
    if all(value_of(number) < 64 for number in numbers):
        assert robot.done == numbers
    else:  # a value of three digits has two equal acknowledgements, and may have to be sensed again
        assert is_part(numbers, robot.done)
        assert set(robot.done) <= set(numbers)
    assert values == [value_of(number) for number in numbers]
    assert is_part(events, robot.reported)


@REUSED
@given(steps=STEPS, damages=DAMAGES, echo=st.booleans(), drops=st.booleans())
def test_a_brick_without_memory_may_do_things_twice_but_nothing_wrong(
    air: Any, steps: list[str | int], damages: dict[int, tuple[str, int]], echo: bool, drops: bool
) -> None:
    robot = Robot(remembers=False, drops=drops)
    line = air(robot, damage=Weather(damages), echo=echo)
    numbers = [step for step in steps if isinstance(step, int)]
    try:
        values, events = run(Brick(Tower(line), timing=PATIENT, remembers=False), robot, line, steps)
    except (PanicError, SilentBrickError):
        assert damages
    else:
        assert values == [value_of(number) for number in numbers]
        assert is_part(numbers, robot.done)
        assert is_part(events, robot.reported)
    assert set(robot.done) <= set(numbers)


@REUSED
@given(steps=STEPS, late=st.dictionaries(st.integers(1, 30), st.tuples(st.just("late"), st.integers(0, 2)), max_size=1))
def test_a_late_answer_is_never_the_answer_to_something_else(
    air: Any, steps: list[str | int], late: dict[int, tuple[str, int]]
) -> None:
    robot = Robot(remembers=True)
    line = air(robot, damage=Weather(late))
    try:
        values, _ = run(Brick(Tower(line), timing=PATIENT), robot, line, steps)
    except SilentBrickError:
        assert late
    else:
        assert values == [value_of(step) for step in steps if isinstance(step, int)]


@settings(REUSED, max_examples=60)
@given(noise=st.lists(st.tuples(st.floats(0, 20), st.binary(max_size=30)), max_size=20), echo=st.booleans())
def test_noise_on_the_line_changes_nothing(air: Any, noise: list[tuple[float, bytes]], echo: bool) -> None:
    robot = Robot(remembers=True)
    line = air(robot, echo=echo)
    for at, data in noise:
        # A message can only come out of noise that says what all the complements are.
        line.arrive(line.now() + at, data.replace(b"\xf7\x08", b""))
    values, _ = run(Brick(Tower(line), timing=PATIENT), robot, line, [4, "poll", 65, 300])
    assert robot.done == [4, 65, 300]
    assert values == [value_of(4), value_of(65), value_of(300)]


@REUSED
@given(replies=st.lists(st.lists(st.integers(1, 255), max_size=3), min_size=1, max_size=30), number=st.integers(0, 300))
def test_a_brick_that_answers_anything_gives_a_value_or_a_clear_error(
    air: Any, replies: list[list[int]], number: int
) -> None:
    left = iter(replies * 20)
    line = air(lambda message, at: [(0.05, answer) for answer in next(left, [])])
    brick = Brick(Tower(line))
    started = line.now()
    try:
        assert brick.perform(number) >= 0
    except LinkError as error:
        assert str(error)
        assert error.help
    assert line.now() - started < 300


def is_part(part: Sequence[int], whole: Sequence[int]) -> bool:
    """Whether ``part`` is what is left of ``whole`` when some elements are taken away."""
    rest = iter(whole)
    return all(element in rest for element in part)


def test_the_robot_itself() -> None:
    robot = Robot(remembers=False, events=[20])
    assert robot(49, 1.0) == [(0.05, 82)]
    assert robot(36, 2.0) == [(0.05, 64 + value_of(65))]
    assert robot(83, 3.0) == [(0.05, 52)]
    assert robot(82, 4.0) == [(0.05, 33)]
    assert (robot.done, robot.reported) == ([65], [20])
