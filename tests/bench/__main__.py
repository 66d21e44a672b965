"""Measures golc and prints a table: ``python tests/bench [ROW …] [--repeat N]``; ``--list`` names the rows.

Every figure is a median, beside it the figure scaled to the machine of the aims, on which the calibration takes 0.25 s.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tests.bench.measure import Row

CALIBRATION = 0.25
"""Seconds that the calibration takes on the machine for which the aims were set."""


def main() -> None:
    sys.path.insert(0, str(Path(__file__).parent.parent.parent))  # the rows are modules of `tests.bench`
    from tests.bench.rows import every_row

    rows = {row.name: row for row in every_row()}
    parser = argparse.ArgumentParser(prog="tests/bench", description="Measure golc.")
    parser.add_argument("rows", nargs="*", metavar="ROW", help="only these rows")
    parser.add_argument("--list", action="store_true", help="name the rows")
    parser.add_argument("--repeat", type=int, default=5, metavar="N", help="samples of each row (default 5)")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.rows if name not in rows]
    if unknown:
        parser.error(f"unknown row {unknown[0]!r}; there are {', '.join(rows)}")
    if arguments.list:
        for row in rows.values():
            print(f"{row.name:<16} {row.work}")
        return
    chosen = [rows[name] for name in arguments.rows] or list(rows.values())
    _print_table(chosen, max(1, arguments.repeat))


def _print_table(rows: list[Row], repeat: int) -> None:
    """A machine with other things to do changes its speed, so each row is scaled by calibrations right around it."""
    from tests.bench.rows import calibrate

    before = calibrate()
    print(f"calibration: `for i in range(10**7): pass` takes {before:.3f} s, {CALIBRATION} s where the aims were set")
    print(f"\n{'row':<16} {'work':<52} {'median':>12} {'scaled':>12} {'aim':>12} {'aim : scaled':>13}")
    for row in rows:
        median = row.median(repeat)
        after = calibrate()
        scaled = row.unit.scaled(median, (before + after) / 2 / CALIBRATION)
        figures = " ".join(f"{row.unit.show(value):>12}" for value in (median, scaled, row.aim))
        print(f"{row.name:<16} {row.work:<52} {figures} {row.unit.ratio(scaled, row.aim):>12.2f}×", flush=True)
        before = after
    print("\nThe last column is how many times better than the aim a row is.")


if __name__ == "__main__":
    main()
