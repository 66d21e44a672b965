"""``golc plan``: offline execution of a program."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, TypedDict, Unpack

import click

from golc.cli.console import Console
from golc.cli.files import completed
from golc.cli.options import Quantity, at_most_one, console_options, constants_option
from golc.diagnostics import counted

if TYPE_CHECKING:
    from golc.api.theory import StrategyName
    from golc.planning.goals import GoalPlanning
    from golc.planning.planner import Planning
    from golc.planning.plans import Outcome
    from golc.theory.types import Number

DONE, NO_PLAN, GAVE_UP = 0, 1, 3
EVERY = 10**12
"""What `--all` without a number stands for."""


class Search(TypedDict):
    """The options that a search takes as they are."""

    steps: int | None
    seconds: float | None
    nodes: int | None
    conformant: bool


@click.command(name="plan", short_help="Plan offline with a program.")
@click.argument("file", type=click.Path())
@click.argument("procedure", metavar="[PROC]", required=False)
@click.option("--goal", metavar="NAME|FORMULA", help="Plan without a program: the fewest actions that make this true.")
@click.option("--first", is_flag=True, help="One plan, the first in program order; this is the default.")
@click.option("--shortest", is_flag=True, help="One plan with the fewest actions.")
@click.option("--cheapest", is_flag=True, help="One plan whose actions cost the least in sum.")
@click.option(
    "--all",
    "most",
    is_flag=False,
    flag_value=EVERY,
    type=click.IntRange(1, EVERY),
    metavar="[N]",
    help="Every distinct sequence of actions, once, or the first N of them.",
)
@click.option("--steps", type=click.IntRange(min=0), metavar="N", help="At most N actions in a plan.")
@click.option("--time", "seconds", type=Quantity(min=0), metavar="S", help="Give up after S seconds.")
@click.option(
    "--nodes", type=click.IntRange(min=1), metavar="N", help="Give up after N expanded pairs of program and state."
)
@click.option("--stats", is_flag=True, help="Say what the search took.")
@click.option("--conformant", is_flag=True, help="Plans that work without knowing what is sensed.")
@click.option(
    "--format", "form", type=click.Choice(["text", "json", "dot"]), default="text", help="How to write plans."
)
@click.option("-o", "--output", type=click.Path(dir_okay=False), metavar="FILE", help="Write the plans to a file.")
@constants_option
@console_options
def command(
    console: Console,
    file: str,
    procedure: str | None,
    goal: str | None,
    first: bool,
    shortest: bool,
    cheapest: bool,
    most: int | None,
    stats: bool,
    form: str,
    output: str | None,
    constants: Mapping[str, str],
    **search: Unpack[Search],
) -> int:
    """Execute a program of FILE offline and print the actions of a plan, one a line.

    PROC is a procedure, with arguments where it takes some; the default is `control`. `search` blocks are part of the
    program. With --goal there is no program: any action may be done that is possible. Nothing is sent to any device.

    \b
    golc plan examples/elevator/elevator.gl
    golc plan examples/elevator/elevator.gl 'handle(25)' --all
    golc plan examples/elevator/elevator.gl --goal 'at = 5 and not lit(5)'
    """
    from golc.api.loading import load

    at_most_one({"--first": first, "--shortest": shortest, "--cheapest": cheapest, "--all": most is not None})
    if goal is not None and (procedure is not None or cheapest or most is not None):
        raise click.UsageError("--goal asks for one shortest plan without a program: no PROC, --all or --cheapest")
    theory = load(file, constants)
    strategy: StrategyName = "shortest" if shortest else "cheapest" if cheapest else "first"
    try:
        planning = theory.planning(procedure, goal=goal, strategy=strategy, every=most is not None, **search)
    except ValueError:
        raise click.UsageError(
            "--all lists sequences of actions, but plans of this domain depend on what is sensed; "
            "those that do not are listed with --conformant"
        ) from None
    cost = _write(planning, form, most, output)
    _report(console, goal or procedure or "control", planning.outcome, stats, cost)
    if planning.outcome.gave_up and (most is None or planning.outcome.plans < most):
        return GAVE_UP
    return DONE if planning.outcome.plans else NO_PLAN


def _write(planning: Planning | GoalPlanning, form: str, most: int | None, output: str | None) -> Number | None:
    """Write the plans as they are found, at most so many of them; what the last one costs."""
    from golc.cli.plan_writing import FORMATS

    cost = None
    with _writer(output) as write:
        listing = FORMATS[form](write, most is not None)
        for plan in islice(planning, most):
            listing.add(plan)
            cost = plan.cost
        listing.close(planning.outcome)
    return cost


@contextmanager
def _writer(output: str | None) -> Iterator[Callable[[str], None]]:
    """Writes lines to a file, which appears only when it is complete, or to stdout as they come."""
    if output is None:
        yield lambda line: print(line, flush=True)
        return
    if not output:
        raise click.BadParameter("a file has a name", param_hint="--output")
    try:
        with completed(Path(os.path.realpath(output))) as stream:
            yield lambda line: print(line, file=stream)
    except OSError as error:
        raise click.FileError(output, error.strerror or str(error)) from None


def _report(console: Console, program: str, outcome: Outcome, stats: bool, cost: Number | None) -> None:
    """Say on stderr what became of the search, and with ``stats`` what it took."""
    from golc.theory.types import show

    found = counted(outcome.plans, "plan")
    if not outcome.plans:
        for line in outcome.failure(program):
            console.err(line)
    elif outcome.gave_up:
        console.note(f"not all plans: {outcome.gave_up}")
    elif not stats:
        console.note(found)
    if stats:
        rate = outcome.expanded / outcome.seconds if outcome.seconds else 0
        costing = "" if cost is None else f" of cost {show(cost)}"
        console.err(
            f"{found}{costing}, {outcome.expanded} pairs of program and state expanded in "
            f"{outcome.seconds:.3f} s ({rate:,.0f} a second)"
        )
