"""Where a simulated robot is, beside what the program believes."""

from __future__ import annotations

from collections.abc import Callable

from golc.runtime.loop.happenings import Ended, Happening, TakenIn


class Whereabouts:
    """An observer that says where the robot is, when that has changed since an exogenous action or at the end."""

    def __init__(self, where: Callable[[], str], say: Callable[[str], None]) -> None:
        self._where = where
        self._say = say
        self._said = ""

    def __call__(self, happening: Happening) -> None:
        if isinstance(happening, TakenIn | Ended):
            where = self._where()
            if where != self._said or isinstance(happening, Ended):
                self._say(f"the robot is {where}")
            self._said = where
