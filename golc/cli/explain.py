"""``golc explain``: a code of a finding, or a name of a domain in the notation of the papers."""

from __future__ import annotations

import re
import shutil
from collections.abc import Mapping
from typing import TYPE_CHECKING

import click

from golc.cli.console import Console
from golc.cli.options import console_options, constants_option

if TYPE_CHECKING:
    from golc.codes.pages import Page


@click.command(name="explain", short_help="Explain a code, or show a name of a domain in the notation of the papers.")
@click.argument("about", nargs=-1, metavar="CODE | FILE NAME")
@click.option(
    "--format", "form", type=click.Choice(["text", "latex"]), default="text", help="Unicode, or LaTeX with amsmath."
)
@click.option("--python", is_flag=True, help="Show the examples of a CODE as theories in Python.")
@constants_option
@console_options
def command(console: Console, about: tuple[str, ...], form: str, python: bool, constants: Mapping[str, str]) -> int:
    """Explain the CODE of a finding, or show what NAME stands for in the domain FILE, in the notation of the papers.

    A code has a page that says what it means, with a wrong and a right example, with --python as theories in Python.

    Of a fluent its successor state axiom, of an action its precondition and its effects, of a procedure the program; of
    everything else its definition. Where several things have the name, all of them.

    \b
    golc explain GL012
    golc explain GL012 --python
    golc explain examples/elevator/elevator.gl lit
    golc explain examples/delivery/delivery.gl push_go_button --format latex
    """
    if len(about) == 1:
        if form != "text" or constants:
            raise click.UsageError("--format and -D are for a FILE and a NAME, not for a CODE")
        console.out(_page(about[0], python, console))
        return 0
    if python:
        raise click.UsageError("--python is for a CODE, not for a FILE and a NAME")
    if len(about) != 2:
        raise click.UsageError("a CODE, or a FILE and a NAME are needed: golc explain elevator.gl lit")

    from golc.api.loading import load

    file, name = about
    console.out(load(file, constants).explain(name, latex=form == "latex"))
    return 0


def _page(word: str, python: bool, console: Console) -> str:
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
    return as_text(_in_python(page(code), console) if python else page(code), shutil.get_terminal_size().columns)


def _in_python(page: Page, console: Console) -> Page:
    from golc.codes.python import in_python

    found = in_python(page)
    if found is None:
        console.note(f"{page.code.code} is about the text of a `.gl` file: its examples have no form in Python")
    return found or page
