"""The host's link and the simulated brick, which share no code of the wire, in virtual time over a noisy line."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import pytest

from golc.runtime.devices.rcx.brick import Brick
from golc.runtime.devices.rcx.errors import PanicError
from golc.runtime.devices.rcx.tower import Tower
from golc.runtime.rcxsim.frames import message
from tests.rcxsim.virtual_port import VirtualPort

MakeWire = Callable[..., Any]
Connect = Callable[[Any], tuple[Brick, VirtualPort]]
NUMBERS = {"up": 0, "go": 1, "look(1)": 2, "weigh": 5, "unload": 6, "turn_off(1)": 65, "turn_off(3)": 67}
EVENTS = {8: "arrived", 9: "stuck", 10: "bell", 16: "call(1)", 17: "call(2)", 18: "call(3)"}


@pytest.fixture
def connect() -> Connect:
    def connected(lift: Any) -> tuple[Brick, VirtualPort]:
        port = VirtualPort(lift.line)
        return Brick(Tower(port)), port

    return connected


def happened(lift: Any, *kinds: str) -> list[str]:
    """The actions of some records, in order."""
    return [record["action"] for record in lift.records if record["what"] in kinds]


def test_one_exchange_takes_the_time_of_two_messages_and_a_reaction(wire: MakeWire, connect: Connect) -> None:
    brick, port = connect(wire(air_time=1.0, echo=True))
    brick.poll()
    start = port.now()
    assert brick.poll() is None
    assert port.now() - start == pytest.approx(0.1475, abs=0.003)


def test_values_and_events_arrive(wire: MakeWire, connect: Connect) -> None:
    lift = wire("on go after 1 s: arrived\n", air_time=1.0, echo=True)
    brick, port = connect(lift)
    assert brick.perform(5) == 9
    assert brick.perform(1) == 0
    port.read(port.now() + 2)
    assert [brick.poll(), brick.poll()] == [8, None]


@pytest.mark.parametrize("seed", range(50))
def test_everything_arrives_exactly_once_whatever_is_lost(wire: MakeWire, connect: Connect, seed: int) -> None:
    chance = random.Random(seed)
    lift = wire(None, seed=seed, air_time=1.0, echo=True, loss=0.06, garble=0.06)
    brick, port = connect(lift)
    ordered, values, reported = [], [], []
    for _ in range(8):
        name = chance.choice(list(NUMBERS))
        ordered.append(name)
        values.append(brick.perform(NUMBERS[name], 60.0))
        for _ in range(chance.randrange(12)):
            port.read(port.now() + 0.25)
            if (number := brick.poll()) is not None:
                reported.append(EVENTS[number])
    assert happened(lift, "reported") == reported
    done = happened(lift, "done", "started")
    if brick.statistics.repeated:  # half a value was lost for too long, and the host knows it
        assert len(ordered) < len(done) <= len(ordered) + brick.statistics.repeated
    else:
        assert done == ordered
        sensed = iter(lift.told("sensed"))
        assert values == [next(sensed)["number"] if name in ("look(1)", "weigh") else 0 for name in ordered]


def test_abort_stops_a_behaviour(wire: MakeWire, connect: Connect) -> None:
    lift = wire(air_time=1.0, echo=True)
    brick, port = connect(lift)
    port.write(message(32))
    port.read(0.2)
    brick.abort()
    assert [record["action"] for record in lift.told("stopped")] == ["up"]
    assert brick.perform(1) == 0


def test_panic_reaches_the_host_and_is_ended(wire: MakeWire, connect: Connect) -> None:
    lift = wire(air_time=0.0, echo=False, sleep=None)
    assert lift.say(37, 3.0)[-1] == 73
    lift.wait(14)
    assert lift.told("panicked")
    brick, port = connect(lift)
    port.read(20.0)
    with pytest.raises(PanicError):
        brick.perform(0)
    assert brick.perform(0) == 0
