"""From the path of a domain file to its theory, or to everything that is wrong with it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from golc.checks import check
from golc.checks.proofs import prove
from golc.diagnostics import Code, Diagnostic, Findings, Severity, Source, Span, UserError
from golc.imports import Reading, join
from golc.syntax import tree
from golc.syntax.parse import parse_expression, parse_file
from golc.syntax.text import read_domain
from golc.theory.elaborate import elaborate
from golc.theory.recursion import deep_recursion
from golc.theory.theory import BasicActionTheory

GOAL = "<goal>"
"""The name of the goal that a formula from outside the file becomes; no declaration can have it."""


def load(path: str | Path, constants: Mapping[str, str] | None = None, goal: str | None = None) -> BasicActionTheory:
    """The theory of a domain file; ``constants`` replace consts of the file, name to text (``-D``).

    ``goal`` is a formula that becomes one more goal, under the name ``GOAL``. Raises ``UserError`` with every error if
    there is one; warnings are not mentioned.
    """
    examined = examine(path, constants, goal)
    if examined.theory is None:
        raise UserError(*[finding for finding in examined.findings if finding.severity is Severity.ERROR])
    return examined.theory


@dataclass(frozen=True)
class Examined:
    """A domain file: its theory, or none if it has errors, and all findings in the order of their places.

    ``sources``: the texts of it and of what it imports, its own first; none if it cannot be read. ``asked``: how many
    questions about all its situations were put; ``undecided``: how many of them were not decided.
    """

    theory: BasicActionTheory | None
    findings: tuple[Diagnostic, ...]
    asked: int = 0
    undecided: int = 0
    sources: tuple[Source, ...] = ()


def examine(
    path: str | Path,
    constants: Mapping[str, str] | None = None,
    goal: str | None = None,
    proofs: bool = False,
    read: Reading = read_domain,
) -> Examined:
    """What is to be said of a domain file, including what it imports.

    ``constants`` and ``goal`` are as for ``load``; with ``proofs`` also what takes all situations into account;
    ``read`` gives the texts.
    """
    try:
        source = read(path)
    except UserError as error:
        return Examined(None, error.diagnostics)
    findings = Findings()
    file = parse_file(source, findings)
    if file is None:
        return Examined(None, tuple(sorted(findings.diagnostics, key=by_place((source,)))), sources=(source,))
    joined = join(file, source, findings, read)
    return examine_file(joined.file, joined.sources, findings, constants, goal, proofs)


def examine_file(
    file: tree.File,
    sources: tuple[Source, ...],
    findings: Findings,
    constants: Mapping[str, str] | None = None,
    goal: str | None = None,
    proofs: bool = False,
) -> Examined:
    """What is to be said of a tree whose imports have been joined, wherever it comes from.

    ``sources``: the texts in which its spans lie, that of the domain itself first; ``findings``: what has been found
    so far, to which the rest is added. The others are as for ``examine``.
    """
    if goal is not None:
        file = _with_goal(file, goal, findings)
    source = sources[0]
    theory = elaborate(file, source, findings, constants, sources)
    proved = None
    if theory is not None:
        with deep_recursion():
            for diagnostic in check(theory, file):
                # What an imported file declares need not be used by every file that imports it.
                if diagnostic.code is not Code.UNUSED or diagnostic.span.source is source:
                    findings.add(diagnostic)
        if proofs and not findings.has_errors:
            proved = prove(theory)
    found = sorted([*findings.diagnostics, *(proved.findings if proved else ())], key=by_place(sources))
    theory = None if findings.has_errors else theory
    asked, undecided = (proved.asked, proved.undecided) if proved else (0, 0)
    return Examined(theory, tuple(found), asked, undecided, sources)


def _with_goal(file: tree.File, text: str, findings: Findings) -> tree.File:
    source = Source(GOAL, text)
    condition = parse_expression(source, findings)
    if condition is None:
        return file
    span = Span(source, 0, len(text))
    goal = tree.Goal(tree.Ident(GOAL, span=span), condition, span=span)
    return replace(file, declarations=(*file.declarations, goal))


def by_place(sources: tuple[Source, ...]) -> Callable[[Diagnostic], tuple[int, int, int, str]]:
    """A key that orders findings by file and place: what is wrong with the command line (``-D``) comes first, a goal
    from there last."""
    ranks = {id(source): rank for rank, source in enumerate(sources)}

    def place(diagnostic: Diagnostic) -> tuple[int, int, int, str]:
        source, span = diagnostic.span.source, diagnostic.span
        rank = ranks.get(id(source), -1 if source.name.startswith("-D ") else len(ranks))
        return rank, span.start, span.end, diagnostic.code.code

    return place
