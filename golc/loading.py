"""From the path of a domain file to its theory, or to everything that is wrong with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from golc.checks import check
from golc.checks.proofs import prove
from golc.diagnostics import Code, Diagnostic, Findings, Severity, Source, UserError
from golc.imports import join
from golc.syntax import tree
from golc.syntax.parse import parse_file
from golc.syntax.text import read_source
from golc.theory.elaborate import elaborate
from golc.theory.recursion import deep_recursion
from golc.theory.theory import BasicActionTheory


def load(path: str | Path, constants: Mapping[str, str] | None = None, trust: bool = True) -> BasicActionTheory:
    """The theory of a domain file; ``constants`` replace consts of the file, name to text (``-D``).

    Python code that the file names is executed when a function of it is needed, which may be now, for a constant;
    without ``trust`` never, and what needs it fails. Raises ``UserError`` with every error if there is one; warnings
    are not mentioned.
    """
    return theory_of(examine(path, constants, trust=trust))


def theory_of(examined: Examined) -> BasicActionTheory:
    """The theory of what was examined; raises ``UserError`` with every error if there is one, or with what keeps its
    constants from being worked out."""
    if examined.theory is None:
        errors = [finding for finding in examined.findings if finding.severity is Severity.ERROR]
        raise UserError(*(errors or examined.findings))
    return examined.theory


@dataclass(frozen=True)
class Examined:
    """A domain file: its theory, or none if it has errors, and all findings in the order of their places.

    There is none, either, if a constant would take Python code that is not executed. ``sources``: the texts of it and of
    what it imports, its own first; none if it cannot be read. ``file``: the tree, joined with those of what it imports;
    none if there is none. ``constants``: what replaces consts of the file. ``asked``: how many questions about all its
    situations were put; ``undecided``: how many of them were not decided.
    """

    theory: BasicActionTheory | None
    findings: tuple[Diagnostic, ...]
    asked: int = 0
    undecided: int = 0
    sources: tuple[Source, ...] = ()
    file: tree.File | None = None
    constants: Mapping[str, str] = field(default_factory=dict)


def examine(
    path: str | Path, constants: Mapping[str, str] | None = None, proofs: bool = False, trust: bool = False
) -> Examined:
    """What is to be said of a domain file, including what it imports.

    ``constants`` are as for ``load``; with ``proofs`` also what takes all situations into account. Python code that the
    file names is executed only with ``trust``.
    """
    try:
        source = read_source(path)
    except UserError as error:
        return Examined(None, error.diagnostics)
    findings = Findings()
    file = parse_file(source, findings)
    if file is None:
        return Examined(None, tuple(sorted(findings.diagnostics, key=by_place((source,)))), sources=(source,))
    joined = join(file, source, findings)
    examined = examine_file(joined.file, joined.sources, findings, constants, trust)
    return with_proofs(examined) if proofs else examined


def examine_file(
    file: tree.File,
    sources: tuple[Source, ...],
    findings: Findings,
    constants: Mapping[str, str] | None = None,
    trust: bool = False,
) -> Examined:
    """What is to be said of a tree whose imports have been joined, wherever it comes from.

    ``sources``: the texts in which its spans lie, that of the domain itself first; ``findings``: what has been found
    so far, to which the rest is added; ``constants`` and ``trust`` as for ``examine``.
    """
    source, constants = sources[0], constants or {}
    theory = elaborate(file, source, findings, constants, sources, trust)
    if theory is not None:
        with deep_recursion():
            for diagnostic in check(theory, file):
                # What an imported file declares need not be used by every file that imports it.
                if diagnostic.code is not Code.UNUSED or diagnostic.span.source is source:
                    findings.add(diagnostic)
    found = tuple(sorted(findings.diagnostics, key=by_place(sources)))
    theory = None if findings.has_errors else theory
    return Examined(theory, found, sources=sources, file=file, constants=constants)


def with_proofs(examined: Examined) -> Examined:
    """The same with what takes all situations into account; nothing more where there is no theory."""
    if examined.theory is None:
        return examined
    with deep_recursion():
        proved = prove(examined.theory)
    found = sorted([*examined.findings, *proved.findings], key=by_place(examined.sources))
    wrong = any(finding.severity is Severity.ERROR for finding in found)
    return replace(
        examined,
        theory=None if wrong else examined.theory,
        findings=tuple(found),
        asked=proved.asked,
        undecided=proved.undecided,
    )


def by_place(sources: tuple[Source, ...]) -> Callable[[Diagnostic], tuple[int, int, int, str]]:
    """A key that orders findings by file and place: what is wrong with the command line (``-D``) comes first."""
    ranks = {id(source): rank for rank, source in enumerate(sources)}

    def place(diagnostic: Diagnostic) -> tuple[int, int, int, str]:
        source, span = diagnostic.span.source, diagnostic.span
        rank = ranks.get(id(source), -1 if source.name.startswith("-D ") else len(ranks))
        return rank, span.start, span.end, diagnostic.code.code

    return place
