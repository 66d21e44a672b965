"""``golc explain``: a name of a domain in the notation of the papers."""

from __future__ import annotations

import re
from collections.abc import Mapping

import click

from golc.cli.common import Console, console_options, constants_option


@click.command(name="explain", short_help="Show a name of a domain in the notation of the papers.")
@click.argument("about", nargs=-1, metavar="FILE NAME")
@click.option(
    "--format", "form", type=click.Choice(["text", "latex"]), default="text", help="Unicode, or LaTeX with amsmath."
)
@constants_option
@console_options
def command(console: Console, about: tuple[str, ...], form: str, constants: Mapping[str, str]) -> int:
    """Show what NAME stands for in the domain FILE, in the notation of the papers.

    Of a fluent its successor state axiom, of an action its precondition and its effects, of a procedure the program; of
    everything else its definition. Where several things have the name, all of them.

    \b
    golc explain examples/elevator/elevator.gl lit
    golc explain examples/delivery/delivery.gl push_go_button --format latex
    """
    from golc.explain.pages import explain
    from golc.explain.rendering import as_latex, as_text
    from golc.loading import load

    file, name = _file_and_name(about)
    pages = explain(load(file, constants), name)
    console.out(as_latex(pages) if form == "latex" else as_text(pages))
    return 0


def _file_and_name(about: tuple[str, ...]) -> tuple[str, str]:
    if len(about) == 1 and re.fullmatch(r"GL\d{3}", about[0]):
        raise click.UsageError(
            f"{about[0]} is a code, and this explains the names of a domain; "
            "the table of the codes is at the end of docs/command-line.md"
        )
    if len(about) != 2:
        raise click.UsageError("a FILE and a NAME are needed: golc explain elevator.gl lit")
    return about[0], about[1]
