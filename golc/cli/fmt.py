"""``golc fmt``: domain files in canonical layout."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from golc.cli.console import Console
from golc.cli.files import patch, written
from golc.cli.options import console_options
from golc.diagnostics import counted

if TYPE_CHECKING:
    from golc.diagnostics import Source

STDIN = "<stdin>"


@click.command(name="fmt", short_help="Lay out domain files canonically.")
@click.argument("files", nargs=-1, required=True, metavar="FILE…")
@click.option("--check", "only_check", is_flag=True, help="Change nothing: list the files that would change.")
@click.option("--diff", is_flag=True, help="Change nothing: show what would change.")
@console_options
def command(console: Console, files: tuple[str, ...], only_check: bool, diff: bool) -> int:
    """Bring the FILEs into canonical layout; comments stay where they are. `-` goes from stdin to stdout.

    A file that does not parse is left as it is, with its findings on stderr. Ends with 1 if there is one, and with
    --check also if a file would change.

    \b
    golc fmt examples/delivery/delivery.gl
    golc fmt --check examples/*/*.gl
    """
    results = [result for file in files for result in _laid_out(console, file)]
    if diff:
        for result in results:
            sys.stdout.writelines(result.difference())
    elif only_check:
        for result in results:
            if result.changed:
                console.out(result.name)
    else:
        results = [result for result in results if result.write(console)]
    changed = sum(result.changed for result in results)
    console.note(_summary(len(results), changed, len(files) - len(results), only_check or diff))
    return int(len(results) < len(files) or (only_check and changed > 0))


@dataclass(frozen=True)
class _Result:
    """A file with its text and its canonical text; ``changed`` is told by the bytes, a byte order mark among them."""

    source: Source
    text: str
    changed: bool

    @property
    def name(self) -> str:
        return self.source.name

    def difference(self) -> Iterator[str]:
        """The lines of a patch."""
        return patch(self.name, self.source.text, self.text, "canonical")

    def write(self, console: Console) -> bool:
        """Write the text if it is another one; whether that has gone well."""
        if self.name == STDIN:
            sys.stdout.write(self.text)
        elif self.changed:
            return written(console, self.name, self.text)
        return True


def _laid_out(console: Console, file: str) -> Iterator[_Result]:
    """What is to become of a file: nothing, but its findings are told, if it cannot be read or does not parse."""
    from golc.diagnostics import Findings, UserError
    from golc.syntax.format import formatted
    from golc.syntax.text import read_source, read_stream

    findings = Findings()
    if Path(file).is_fifo() or Path(file).is_char_device():
        console.err(f"error: `{file}` is no file that could be written anew; `-` stands for standard input")
        return
    if Path(file).suffix == ".py":
        console.err(f"error: `{file}` is Python: use a formatter of Python; `golc fmt` lays out `.gl` files")
        return
    try:
        source = read_stream(STDIN, sys.stdin.buffer) if file == "-" else read_source(file)
        text = formatted(source, findings)
        if text is not None:
            same = source.text == text if file == "-" else Path(file).read_bytes() == text.encode()
            yield _Result(source, text, not same)
    except UserError as error:
        findings.diagnostics += error.diagnostics
    console.findings(findings.diagnostics)


def _summary(files: int, changed: int, left: int, would: bool) -> str:
    parts = [f"{counted(files, 'file')}: {changed or 'none'} {'would change' if would else 'changed'}"]
    return ", ".join([*parts, f"{left} left as {'it is' if left == 1 else 'they are'}"] if left else parts)
