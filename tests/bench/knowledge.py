"""What an agent knows of many possible worlds."""

from __future__ import annotations

from golc.situation.dynamics import Dynamics
from golc.situation.worlds import Worlds
from tests.bench.measure import Row, Unit, seconds
from tests.bench.programs import theory_of

ENTANGLED = """domain bench
type number = 1..47
fluent x: number = unknown
fluent y: number = unknown
fluent z: number = unknown
initially x + y + z > 10
action compare:
    senses x < y
"""
INDEPENDENT = """domain bench
type number = 1..1000
fluent lit(n: number): bool = unknown
action look(n: number):
    senses lit(n)
"""


def sensing() -> float:
    """Seconds to sense in some 10⁵ worlds that no smaller sets make up."""
    dynamics = Dynamics(theory_of(ENTANGLED))
    state = dynamics.initial()
    assert isinstance(state, Worlds) and len(state) == 103_703
    return seconds(lambda: dynamics.assimilate(state, "compare", (), (True,)))


def looking_around() -> float:
    """Seconds to sense 1,000 switches of which nothing is known, in 2¹⁰⁰⁰ worlds at first."""
    dynamics = Dynamics(theory_of(INDEPENDENT))
    state = dynamics.initial()

    def look() -> None:
        now = state
        for number in range(1, 1001):
            now, _ = dynamics.assimilate(now, "look", (number,), (True,))
        assert not isinstance(now, Worlds)

    return seconds(look)


ROWS = [
    Row("sensing", "sense in 103,703 entangled worlds", 0.5, Unit.SECONDS, sensing),
    Row("switches", "sense 1,000 independent switches", 1.0, Unit.SECONDS, looking_around),
]
