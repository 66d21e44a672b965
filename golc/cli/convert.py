"""``golc convert``: a domain file as a theory in Python, and back."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from golc.cli.console import Console
from golc.cli.files import written
from golc.cli.options import console_options

if TYPE_CHECKING:
    from golc.diagnostics import Findings, Source
    from golc.syntax import tree


@click.command(name="convert", short_help="Write a domain as Python, or Python as a domain.")
@click.argument("file", metavar="FROM")
@click.argument("target", metavar="[TO]", default="-")
@click.option("-f", "--force", is_flag=True, help="Replace the file TO if it exists.")
@console_options
def command(console: Console, file: str, target: str, force: bool) -> int:
    """Write the domain file FROM as a theory in Python, or a theory in Python (*.py) as a domain file.

    Without TO, or with `-`, the text goes to standard output. A theory in Python is run. Comments are not carried over.
    Files that the domain names are named relative to the folder of TO.

    \b
    golc convert examples/delivery/delivery.gl delivery.py
    golc convert delivery.py delivery.gl
    """
    from golc.diagnostics import Findings, UserError

    to_golc = Path(file).suffix == ".py"
    if Path(target).suffix == (".py" if to_golc else ".gl"):
        raise click.UsageError(f"of `{file}` and `{target}` one has to end in `.py`, the other not")
    if target != "-" and not force and Path(os.path.realpath(target)).is_file():
        console.err(f"error: `{target}` exists already\n  = help: `--force` replaces it")
        return 1
    findings = Findings()
    try:
        folder = Path(file if target == "-" else target).parent
        source, text = (_as_golc if to_golc else _as_python)(file, folder, findings)
    except UserError as error:
        findings.diagnostics += error.diagnostics
    console.findings(findings.diagnostics)
    if findings.has_errors or not _write(console, text, target):
        return 1
    if (_python_comments if to_golc else _golc_comments)(source.text):
        console.note(f"the comments of `{file}` are not carried over")
    return 0


def _as_python(file: str, folder: Path, findings: Findings) -> tuple[Source, str]:
    from golc.cli.convert_paths import moved
    from golc.embed.printing import python_text
    from golc.syntax.parse import parse_file
    from golc.syntax.text import read_source

    source = read_source(file)
    tree = parse_file(source, findings)
    return source, "" if tree is None else python_text(moved(tree, folder))


def _as_golc(file: str, folder: Path, findings: Findings) -> tuple[Source, str]:
    from golc.cli.convert_paths import moved
    from golc.diagnostics import Source
    from golc.embed.modules import read_theory
    from golc.syntax.format import formatted
    from golc.syntax.unparse import unparse

    read = read_theory(file)
    findings.diagnostics += read.findings.diagnostics
    _refuse_nested_messages(read.file)
    if findings.has_errors:
        return read.sources[0], ""
    text = formatted(Source(f"<{file} as a domain>", unparse(moved(read.file, folder))), findings)
    return read.sources[0], text or ""


def _refuse_nested_messages(file: tree.File) -> None:
    """Python can write a message inside a message, golc cannot. Raises ``UserError``."""
    from golc.diagnostics import Code, Diagnostic, UserError
    from golc.syntax.tree import Message
    from golc.syntax.walk import descendants

    for node in descendants(file):
        if isinstance(node, Message):
            _, *inside = descendants(node)
            for part in inside:
                if isinstance(part, Message):
                    raise UserError(
                        Diagnostic(Code.STRING, "a message inside a message has no text in golc", part.span)
                    )


def _write(console: Console, text: str, target: str) -> bool:
    """Write the text, all of it or nothing; whether that has gone well."""
    if target == "-":
        sys.stdout.write(text)
        return True
    return written(console, target, text)


def _golc_comments(text: str) -> bool:
    from golc.syntax.comments import lines

    return any(row.comment is not None for line in lines(text) for row in line.rows)


def _python_comments(text: str) -> bool:
    """Whether there are comments, or docstrings, which say the same."""
    import ast
    import io
    import tokenize

    if any(token.type == tokenize.COMMENT for token in tokenize.generate_tokens(io.StringIO(text).readline)):
        return True
    documented = (ast.Module, ast.FunctionDef)
    return any(ast.get_docstring(node) for node in ast.walk(ast.parse(text)) if isinstance(node, documented))
