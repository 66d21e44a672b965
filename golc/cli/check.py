"""``golc check``: every finding about some domain files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import click

from golc.cli.common import Console, console_options, constants_option
from golc.diagnostics import counted

if TYPE_CHECKING:
    from golc.diagnostics import Diagnostic
    from golc.fixing.rounds import Looked, Outcome
    from golc.fixing.texts import Texts
    from golc.reporting.selection import Selection
    from golc.theory.theory import BasicActionTheory

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
@click.option(
    "--select", multiple=True, metavar="CODES", callback=_starts, help="Only findings whose codes begin so: GL0,GL041."
)
@click.option(
    "--ignore", multiple=True, metavar="CODES", callback=_starts, help="No findings whose codes begin so: GL027."
)
@click.option("--fix", "fixing", is_flag=True, help="Put right what is safe to put right, and write the files.")
@click.option("--diff", is_flag=True, help="Change nothing: show what --fix would change.")
@constants_option
@console_options
def command(
    files: tuple[str, ...],
    form: str,
    strict: bool,
    no_proofs: bool,
    select: tuple[str, ...],
    ignore: tuple[str, ...],
    fixing: bool,
    diff: bool,
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
    from golc.reporting.selection import Selection

    if diff and form != "text":
        raise click.UsageError("--diff shows a patch, and has no other --format.")
    selection = Selection(select, ignore)
    return _Check(files, form, strict, not no_proofs, selection, fixing, diff, constants, console).run()


@dataclass(frozen=True)
class _Check:
    """What is to be done."""

    files: tuple[str, ...]
    form: str
    strict: bool
    proofs: bool
    selection: Selection
    fixing: bool
    diff: bool
    constants: Mapping[str, str]
    console: Console

    def run(self) -> int:
        """Check all files; the exit code."""
        from golc.cli.fixing import show, write
        from golc.fixing.texts import Texts

        texts, total, written = Texts(), _Total(), True
        for file in self.files:
            first = self.look(file, texts)
            outcome = self.fixed(file, texts, first)
            total.add(first if self.diff else outcome.looked, len(outcome.fixed))
            if self.fixing and not self.diff:
                written &= write(self.console, texts.take())
            if self.form in LINES and not self.diff:
                _write(self.console, outcome.looked.wanted, self.form)
            if self.console.verbosity > 0:
                self.console.err(f"{file}: {_contents(outcome.looked.examined.theory)}")
        if self.diff:
            show(texts.take())
        elif self.form not in LINES:
            _write_whole(self.console, total, self.form)
        self.console.note(total.summary(len(self.files), self.fixing, self.diff))
        return int(not written or total.errors > 0 or (self.strict and total.warnings > 0))

    def look(self, file: str, texts: Texts) -> Looked:
        """What is found in a file."""
        from golc.fixing.rounds import Looked
        from golc.loading import examine
        from golc.reporting.ignores import heed

        examined = examine(file, self.constants, proofs=self.proofs, read=texts.read)
        wanted = (finding for finding in heed(examined, self.proofs) if self.selection.wants(finding.code))
        return Looked(examined, tuple(wanted))

    def fixed(self, file: str, texts: Texts, first: Looked) -> Outcome:
        """What is found when all is fixed that is to be."""
        from golc.cli.fixing import tell
        from golc.fixing.rounds import Outcome, fix

        if not self.fixing and not self.diff:
            return Outcome(first)
        outcome = fix(texts, first, lambda: self.look(file, texts))
        tell(self.console, outcome, self.diff)
        return outcome


class _Total:
    """What was found in all files."""

    def __init__(self) -> None:
        self.findings: list[Diagnostic] = []
        self.asked = self.undecided = self.fixed = 0

    def add(self, looked: Looked, fixed: int) -> None:
        self.findings += looked.wanted
        self.asked += looked.examined.asked
        self.undecided += looked.examined.undecided
        self.fixed += fixed

    @property
    def errors(self) -> int:
        return self.count("error")

    @property
    def warnings(self) -> int:
        return self.count("warning")

    def count(self, severity: str) -> int:
        return sum(finding.severity.value == severity for finding in self.findings)

    def counts(self) -> dict[str, int]:
        """The numbers that stand beside the findings in JSON and SARIF."""
        asked = {"questions": self.asked, "undecided": self.undecided}
        return {"errors": self.errors, "warnings": self.warnings, "fixed": self.fixed, **asked}

    def summary(self, files: int, fixing: bool, diff: bool) -> str:
        kinds = ((self.errors, "error"), (self.warnings, "warning"))
        found = ", ".join(counted(number, what) for number, what in kinds if number)
        done = f"{counted(self.fixed, 'finding')} fixed, " if self.fixed and not diff else ""
        parts = [f"checked {counted(files, 'file')}: {done}{found or ('nothing left' if done else 'nothing found')}"]
        if self.undecided:
            parts.append(f"{counted(self.undecided, 'question')} not decided")
        able = self.fixed if diff else sum(finding.fix is not None for finding in self.findings)
        if able and (diff or not fixing):
            parts.append(f"--fix would fix {able}" + (" of them" if not diff else ""))
        return "; ".join(parts)


def _write(console: Console, findings: Iterable[Diagnostic], form: str) -> None:
    import sys

    from golc.rendering import render
    from golc.reporting.github import annotation

    for finding in findings:
        console.out(annotation(finding) if form == "github" else render(finding, console.colored(sys.stdout)) + "\n")


def _write_whole(console: Console, total: _Total, form: str) -> None:
    import json

    from golc.rendering import to_json
    from golc.reporting import sarif

    counts = total.counts()
    json_ = {"findings": [to_json(finding) for finding in total.findings], **counts}
    console.out(json.dumps(sarif.log(total.findings, counts) if form == "sarif" else json_, indent=2))


def _contents(theory: BasicActionTheory | None) -> str:
    if theory is None:
        return "not a theory"
    parts = (
        (theory.fluents, "fluent"),
        (theory.actions, "action"),
        (theory.procedures, "procedure"),
        (theory.devices, "device"),
    )
    return f"domain {theory.name} with " + ", ".join(counted(len(part), what) for part, what in parts)
