"""``golc check``: every finding about some domain files."""

from __future__ import annotations

from collections.abc import Mapping

import click

from golc.cli.console import Console
from golc.cli.options import console_options, constants_option


def _starts(context: click.Context, parameter: click.Parameter, values: tuple[str, ...]) -> tuple[str, ...]:
    from golc.reporting.selection import parse_codes

    try:
        return tuple(start for value in values for start in parse_codes(value))
    except ValueError as error:
        raise click.BadParameter(str(error)) from None


@click.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE…")
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "json", "sarif", "github"]),
    default="text",
    help="How to write the findings.",
)
@click.option("--strict", is_flag=True, help="Warnings count as errors do.")
@click.option("--no-proofs", is_flag=True, help="Leave out what takes all situations into account.")
@click.option("--reachable", is_flag=True, help="Show only what can happen in states that can be reached.")
@click.option("--trust", is_flag=True, help="Execute the Python code that the files name, where a value depends on it.")
@click.option(
    "--select", multiple=True, metavar="CODES", callback=_starts, help="Only findings whose codes begin so: GL0,GL041."
)
@click.option(
    "--ignore", multiple=True, metavar="CODES", callback=_starts, help="No findings whose codes begin so: GL027."
)
@click.option("--fix", "fixing", is_flag=True, help="Put right what is safe to put right, and write the files.")
@click.option("--diff", is_flag=True, help="Change nothing: show what --fix would change.")
@click.option("--watch", "watching", is_flag=True, help="Check again whenever one of the files changes, until Ctrl-C.")
@constants_option
@console_options
def command(
    files: tuple[str, ...],
    form: str,
    strict: bool,
    no_proofs: bool,
    reachable: bool,
    trust: bool,
    select: tuple[str, ...],
    ignore: tuple[str, ...],
    fixing: bool,
    diff: bool,
    watching: bool,
    constants: Mapping[str, str],
    console: Console,
) -> int:
    """Find what is wrong with domain files, without running them.

    The findings go to stdout, a summary to stderr. Ends with 1 if there is an error (with --strict: or a warning).

    \b
    golc check examples/delivery/delivery.gl
    golc check --strict -D floors=12 elevator.gl
    golc check --fix my.gl
    """
    from golc.cli.checking import LINES, Checking
    from golc.reporting.selection import Selection

    if diff and form != "text":
        raise click.UsageError("--diff shows a patch, and has no other --format.")
    if watching and form not in LINES:
        raise click.UsageError(f"--watch goes on writing, and --format {form} is one whole.")
    checking = Checking(
        files,
        constants,
        console,
        Selection(select, ignore),
        form,
        strict=strict,
        proofs=not no_proofs,
        reachable=reachable,
        trust=trust,
        fixing=fixing,
        diff=diff,
    )
    if not watching:
        return checking.run()
    from golc.cli.watching import watch
    from golc.syntax.parser import parser

    parser()  # which every run needs
    return watch(checking.run, files, console)
