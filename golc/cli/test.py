"""``golc test``: the scenarios of domain files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from golc.cli.console import Console
from golc.cli.options import console_options, constants_option
from golc.diagnostics import UserError, counted

if TYPE_CHECKING:
    from golc.diagnostics import Diagnostic
    from golc.scenarios.junit import Case
    from golc.scenarios.play import Played

RECENT = 40
"""How many of the latest lines of a trace are shown; with -v all of them are."""


@click.command(name="test", short_help="Run the scenarios of domain files.")
@click.argument("files", nargs=-1, required=True, type=click.Path(), metavar="FILE…")
@click.option("--junit", type=click.Path(dir_okay=False), metavar="FILE", help="Also write the results as JUnit XML.")
@constants_option
@console_options
def command(console: Console, files: tuple[str, ...], junit: str | None, constants: Mapping[str, str]) -> int:
    """Run the scenarios of the FILEs offline, in the order in which they are written, and say how each went.

    A line for each goes to stdout; below a failed one stands the first difference and the run up to it. Ends with 1 if
    a scenario has failed or a file has errors.

    \b
    golc test examples/delivery/delivery.gl
    golc test examples/*/*.gl --junit results.xml
    """
    cases = [case for file in files for case in _run(console, file, constants)]
    if junit is not None:
        _write(junit, cases)
    wrong = sum(case.problem is not None for case in cases)
    console.note(f"{counted(len(cases), 'scenario')}: {wrong or 'none'} failed")
    return int(wrong > 0)


def _run(console: Console, file: str, constants: Mapping[str, str]) -> Iterator[Case]:
    import sys

    from golc.api.loading import load
    from golc.rendering import render
    from golc.scenarios.junit import Case

    try:
        theory = load(file, constants)
    except UserError as error:
        console.findings(error.diagnostics)
        details = "\n".join(map(render, error.diagnostics))
        console.out(f"FAILED  {file}: the file has errors")
        yield Case(file, "load", error.diagnostics[0].message, details, error=True)
        return
    for played in theory.test():
        scenario = played.scenario
        counts = f"{counted(played.actions, 'action')}, {counted(played.events, 'event')}"
        if played.failure is None:
            console.out(f"ok      {file}: {scenario.name} ({counts})")
            yield Case(file, scenario.name)
            continue
        console.out(f"FAILED  {file}: {scenario.name} ({counts})")
        most = RECENT if console.verbosity <= 0 else None
        console.out(_explained(played, played.failure, console.colored(sys.stdout), most) + "\n")
        details = _explained(played, played.failure, False, None)
        yield Case(file, scenario.name, played.failure.message, details)


def _explained(played: Played, failure: Diagnostic, color: bool, most: int | None) -> str:
    """What is wrong, and the run up to there, of which at most the latest lines."""
    from golc.rendering import render

    shown = played.trace[-most:] if most is not None else played.trace
    left_out = len(played.trace) - len(shown)
    head = f"after this run, without its first {left_out} lines:" if left_out else "after this run:"
    return "\n".join([render(failure, color), *([head, *shown] if shown else ["before anything has happened"])])


def _write(path: str, cases: list[Case]) -> None:
    from golc.scenarios.junit import report

    try:
        Path(path).write_text(report(cases), encoding="utf-8")
    except OSError as error:
        raise click.FileError(path, error.strerror or str(error)) from None
