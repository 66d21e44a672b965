"""``golc explain``: a code of a finding, or a name of a domain in the notation of the papers."""

from __future__ import annotations

import re
import shutil
from collections.abc import Mapping

import click

from golc.cli.common import Console, console_options, constants_option


@click.command(name="explain", short_help="Explain a code, or show a name of a domain in the notation of the papers.")
@click.argument("about", nargs=-1, metavar="CODE | FILE NAME")
@click.option(
    "--format", "form", type=click.Choice(["text", "latex"]), default="text", help="Unicode, or LaTeX with amsmath."
)
@constants_option
@console_options
def command(console: Console, about: tuple[str, ...], form: str, constants: Mapping[str, str]) -> int:
    """Explain the CODE of a finding, or show what NAME stands for in the domain FILE, in the notation of the papers.

    A code has a page that says what it means, with a wrong and a right example.

    Of a fluent its successor state axiom, of an action its precondition and its effects, of a procedure the program; of
    everything else its definition. Where several things have the name, all of them.

    \b
    golc explain GL012
    golc explain examples/elevator/elevator.gl lit
    golc explain examples/delivery/delivery.gl push_go_button --format latex
    """
    if len(about) == 1:
        console.out(_page(about[0], form, constants))
        return 0
    if len(about) != 2:
        raise click.UsageError("a CODE, or a FILE and a NAME are needed: golc explain elevator.gl lit")

    from golc.api.loading import load

    file, name = about
    console.out(load(file, constants).explain(name, latex=form == "latex"))
    return 0


def _page(word: str, form: str, constants: Mapping[str, str]) -> str:
    from golc.codes.pages import page
    from golc.codes.text import as_text
    from golc.diagnostics import Code
    from golc.theory.suggest import did_you_mean

    codes = {code.code: code for code in Code}
    code = codes.get(word.upper())
    if code is None and re.fullmatch(r"gl\d+", word, re.IGNORECASE):
        question = did_you_mean(word.upper(), codes)
        raise click.UsageError(f"there is no code `{word}`" + (f": {question}" if question else ""))
    if code is None:
        raise click.UsageError("a CODE, or a FILE and a NAME are needed: golc explain elevator.gl lit")
    if form != "text" or constants:
        raise click.UsageError("--format and -D are for a FILE and a NAME, not for a CODE")
    return as_text(page(code), shutil.get_terminal_size().columns)
