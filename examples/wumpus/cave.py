"""The cave itself: what happens when the agent does something, and what it perceives."""

from __future__ import annotations

CAVE = """
. . . P
W G P .
. . . .
S . P .
"""
"""S: the entrance, where the agent is at first, P: a pit, W: the wumpus, G: the gold. Change it, and run again."""

ROWS = [line.split() for line in reversed(CAVE.split("\n")) if line]
"""From the entrance on."""
SIZE = len(ROWS)

agent = 1
wumpus_lives = True


def symbol(cell: int) -> str:
    return ROWS[(cell - 1) // SIZE][(cell - 1) % SIZE]


def neighbours() -> list[str]:
    """What lies in the cells beside the agent."""
    row, column = (agent - 1) // SIZE, (agent - 1) % SIZE
    beside = [(row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)]
    return [ROWS[r][c] for r, c in beside if 0 <= r < SIZE and 0 <= c < SIZE]


def go(cell: int) -> None:
    global agent
    agent = cell
    if symbol(cell) == "P" or (symbol(cell) == "W" and wumpus_lives):
        raise RuntimeError("the agent is dead")


def perceive() -> tuple[bool, bool, bool]:
    """Breeze, stench, glitter."""
    return "P" in neighbours(), "W" in neighbours(), symbol(agent) == "G"


def grab() -> None:
    pass


def shoot(cell: int) -> None:
    global wumpus_lives
    wumpus_lives = symbol(cell) != "W"


def climb_out() -> None:
    pass
