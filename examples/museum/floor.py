"""Distances in the museum, worked out from its floor plan: `#` is a wall, a letter the first one of a room's name."""

from collections import deque
from functools import cache
from pathlib import Path

PLAN = Path(__file__).with_name("floor.txt").read_text(encoding="utf-8").splitlines()
CELLS = {(row, column): sign for row, line in enumerate(PLAN) for column, sign in enumerate(line) if sign != "#"}


def metres(start, end):
    """The length of the shortest way between two rooms."""
    (place,) = [cell for cell, sign in CELLS.items() if sign == end[0]]
    return _distances(start)[place]


@cache
def _distances(start):
    """How far each cell is from a room: breadth-first search."""
    places = [cell for cell, sign in CELLS.items() if sign == start[0]]
    found = dict.fromkeys(places, 0)
    queue = deque(places)
    while queue:
        row, column = queue.popleft()
        for cell in ((row - 1, column), (row + 1, column), (row, column - 1), (row, column + 1)):
            if cell in CELLS and cell not in found:
                found[cell] = found[row, column] + 1
                queue.append(cell)
    return found
