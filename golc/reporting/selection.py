"""Which codes are wanted: ``--select`` and ``--ignore``."""

from __future__ import annotations

from dataclasses import dataclass

from golc.diagnostics import Code
from golc.theory.suggest import did_you_mean

CODES = tuple(code.code for code in Code)


@dataclass(frozen=True)
class Selection:
    """Codes by their beginnings: those that are selected (all if there are none), less those that are ignored.

    The longest beginning of a code decides; ``ignored`` if both are the same.
    """

    selected: tuple[str, ...] = ()
    ignored: tuple[str, ...] = ()

    def wants(self, code: Code) -> bool:
        """Whether findings with the code are to be shown."""
        selected = max((len(start) for start in self.selected or ("",) if code.code.startswith(start)), default=-1)
        ignored = max((len(start) for start in self.ignored if code.code.startswith(start)), default=-1)
        return selected > ignored


def parse_codes(text: str) -> tuple[str, ...]:
    """The beginnings of codes in ``GL0, GL041``; raises ``ValueError`` for one that begins no code."""
    starts = tuple(start.strip().upper() for start in text.split(","))
    for start in starts:
        if not start or not any(code.startswith(start) for code in CODES):
            question = did_you_mean(start, CODES)
            raise ValueError(f"there is no code `{start}`" + (f": {question}" if question else ""))
    return starts
