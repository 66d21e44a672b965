"""``golc check``: every finding about some domain files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import click

from golc.cli.common import Console, console_options, constants_option
from golc.diagnostics import counted

if TYPE_CHECKING:
    from golc.api.theory import Theory
    from golc.diagnostics import Diagnostic

LINES = ("text", "github")
"""The formats that need not wait for the last file."""


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
    constants: Mapping[str, str],
    console: Console,
) -> int:
    """Find what is wrong with domain files, without running them.

    The findings go to stdout, a summary to stderr. Ends with 1 if there is an error (with --strict: or a warning).

    \b
    golc check examples/delivery/delivery.gl
    golc check --strict -D floors=12 elevator.gl
    """
    from golc.api.loading import check
    from golc.diagnostics import Code, Severity
    from golc.reporting.selection import Selection

    selection = Selection(select, ignore)
    findings: list[Diagnostic] = []
    asked = undecided = 0
    scopes: list[dict[str, Any]] = []
    for file in files:
        report = check(file, constants, proofs=not no_proofs, reachable=reachable, trust=trust)
        found = [finding for finding in report.findings if selection.wants(finding.code)]
        findings.extend(found)
        asked += report.asked
        undecided += report.undecided
        if form in LINES:
            _write(console, found, form)
        if report.scope is not None:
            scopes.append({"file": file, **asdict(report.scope)})
            console.note(f"{file}: {report.scope}")
        if console.verbosity > 0:
            console.err(f"{file}: {_contents(report.theory)}")
    errors = sum(finding.severity is Severity.ERROR for finding in findings)
    warnings = sum(finding.severity is Severity.WARNING for finding in findings)
    notes = sum(finding.severity is Severity.NOTE and finding.code is not Code.NOT_DECIDED for finding in findings)
    if form not in LINES:
        counts = {"errors": errors, "warnings": warnings, "questions": asked, "undecided": undecided}
        _write_whole(console, findings, {**counts, **({"reachable": scopes} if reachable else {})}, form)
    console.note(_summary(len(files), errors, warnings, notes, undecided))
    return int(errors > 0 or (strict and warnings > 0))


def _write(console: Console, findings: Iterable[Diagnostic], form: str) -> None:
    import sys

    from golc.rendering import render
    from golc.reporting.github import annotation

    for finding in findings:
        console.out(annotation(finding) if form == "github" else render(finding, console.colored(sys.stdout)) + "\n")


def _write_whole(console: Console, findings: Iterable[Diagnostic], counts: Mapping[str, Any], form: str) -> None:
    import json

    from golc.rendering import to_json
    from golc.reporting import sarif

    json_ = {"findings": [to_json(finding) for finding in findings], **counts}
    console.out(json.dumps(sarif.log(findings, counts) if form == "sarif" else json_, indent=2))


def _summary(files: int, errors: int, warnings: int, notes: int, undecided: int) -> str:
    kinds = ((errors, "error"), (warnings, "warning"), (notes, "note"))
    found = [counted(number, what) for number, what in kinds if number]
    open_ = f"; {counted(undecided, 'question')} not decided" if undecided else ""
    return f"checked {counted(files, 'file')}: {', '.join(found) or 'nothing found'}{open_}"


def _contents(theory: Theory | None) -> str:
    return "not a theory" if theory is None else f"domain {theory.name} with {theory.counts()}"
