"""From the path of a domain file to its theory, or to everything that is wrong with it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from golc.checks import check
from golc.checks.bricks import review_bricks
from golc.checks.hosts import review_hosts
from golc.checks.outlines import check_outline
from golc.checks.proofs import prove
from golc.diagnostics import Code, Diagnostic, Findings, Severity, Source, UserError
from golc.imports import Joined, Reading, join
from golc.proofs.reachable import Scope
from golc.syntax import tree
from golc.syntax.parse import parse_file
from golc.syntax.text import read_domain
from golc.theory.elaborate import outline
from golc.theory.recursion import deep_recursion
from golc.theory.theory import BasicActionTheory

if TYPE_CHECKING:
    from golc.embed.parts import Written
    from golc.embed.theory import Theory

Domain: TypeAlias = "str | Path | Theory"
"""Where a theory comes from: the path of a file, which is Python if it ends in ``.py``, or an object of Python."""


def load(domain: Domain, constants: Mapping[str, str] | None = None, trust: bool = True) -> BasicActionTheory:
    """The theory of a domain; ``constants`` replace consts of the file, name to text (``-D``).

    Python code that the domain names (``extern``) is executed when a function of it is needed, which may be now, for a
    constant; without ``trust`` never, and what needs it fails. Raises ``UserError`` with every error if there is one;
    warnings are not mentioned.
    """
    return theory_of(examine(domain, constants, trust=trust))


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

    There is none, either, if a constant would take Python code that is not executed.

    ``sources``: the texts of it and of what it imports, its own first; none if it cannot be read. ``file``: the tree,
    joined with those of what it imports; none if there is none. ``constants``: what replaces consts of the file.
    ``asked``: how many questions about all its situations were put; ``undecided``: how many of them were not decided;
    ``scope``: which states can be reached, if that was asked.
    """

    theory: BasicActionTheory | None
    findings: tuple[Diagnostic, ...]
    asked: int = 0
    undecided: int = 0
    sources: tuple[Source, ...] = ()
    scope: Scope | None = None
    file: tree.File | None = None
    constants: Mapping[str, str] = field(default_factory=dict)


def examine(
    domain: Domain,
    constants: Mapping[str, str] | None = None,
    proofs: bool = False,
    reachable: bool = False,
    trust: bool = False,
    read: Reading = read_domain,
) -> Examined:
    """What is to be said of a domain, including what it imports.

    ``constants`` are as for ``load``; with ``proofs`` also what takes all situations into account, or all that are
    ``reachable``, and what the files of the devices say. Python code that the domain names (``extern``) is executed
    only with ``trust``. ``read`` gives the texts of files that are not Python.
    """
    findings = Findings()
    try:
        joined = _read(domain, findings, read)
    except UserError as error:
        sources = _sources_of(error.diagnostics)
        return Examined(None, tuple(sorted(error.diagnostics, key=by_place(sources))), sources=sources)
    examined = examine_file(joined.file, joined.sources, findings, constants, trust)
    if not proofs or examined.theory is None:
        return examined
    return with_behaviours(with_proofs(examined, reachable), examined.theory)


def _read(domain: Domain, findings: Findings, read: Reading) -> Joined:
    """The tree of a domain, joined with what it imports; raises ``UserError`` if there is none."""
    if not isinstance(domain, (str, Path)):
        return _join_written(domain.written(), findings, read)
    if Path(domain).suffix == ".py":
        from golc.embed.modules import read_theory

        return _join_written(read_theory(domain), findings, read)
    source = read(domain)
    file = parse_file(source, findings)
    if file is None:
        raise UserError(*findings.diagnostics)
    return join(file, source, findings, read)


def _join_written(written: Written, findings: Findings, read: Reading) -> Joined:
    """The tree of a theory in Python, joined with what it imports."""
    for diagnostic in written.findings.diagnostics:
        findings.add(diagnostic)
    joined = join(written.file, written.sources[0], findings, read)
    return Joined(joined.file, (*written.sources, *joined.sources[1:]))


def _sources_of(diagnostics: tuple[Diagnostic, ...]) -> tuple[Source, ...]:
    """The texts that some findings are about; none of a file that cannot be read."""
    return tuple({id(each.span.source): each.span.source for each in diagnostics if each.span.source.text}.values())


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
    theory = outline(file, source, findings, constants, trust)
    if theory is not None and findings.has_errors:
        check_outline(theory, findings)
    elif theory is not None:
        with deep_recursion():
            for diagnostic in check(theory, file):
                # What an imported file declares need not be used by every file that imports it.
                if diagnostic.code is not Code.UNUSED or diagnostic.span.source is source:
                    findings.add(diagnostic)
    # What Python writes once may stand for many parts of a theory, with the same to say of each.
    found = tuple(sorted(dict.fromkeys(findings.diagnostics), key=by_place(sources)))
    theory = None if findings.has_errors else theory
    return Examined(theory, found, sources=sources, file=file, constants=constants)


def with_proofs(examined: Examined, reachable: bool = False) -> Examined:
    """The same with what takes all situations into account, or all that are ``reachable``; nothing more
    where there is no theory."""
    if examined.theory is None:
        return examined
    with deep_recursion():
        proved = prove(examined.theory, reachable)
    found = _with_findings(examined, proved.findings)
    return replace(found, asked=proved.asked, undecided=proved.undecided, scope=proved.scope)


def with_behaviours(examined: Examined, theory: BasicActionTheory) -> Examined:
    """The same with what the files of the devices say; ``theory`` is the one examined, which may have errors."""
    findings = Findings()
    review_bricks(theory, findings)
    review_hosts(theory, findings)
    return _with_findings(examined, findings.diagnostics)


def _with_findings(examined: Examined, more: Iterable[Diagnostic]) -> Examined:
    found = sorted([*examined.findings, *more], key=by_place(examined.sources))
    wrong = any(finding.severity is Severity.ERROR for finding in found)
    return replace(examined, theory=None if wrong else examined.theory, findings=tuple(found))


def by_place(sources: tuple[Source, ...]) -> Callable[[Diagnostic], tuple[int, int, int, str]]:
    """A key that orders findings by file and place: what is wrong with the command line (``-D``) comes first."""
    ranks = {id(source): rank for rank, source in enumerate(sources)}

    def place(diagnostic: Diagnostic) -> tuple[int, int, int, str]:
        source, span = diagnostic.span.source, diagnostic.span
        rank = ranks.get(id(source), -1 if source.name.startswith("-D ") else len(ranks))
        return rank, span.start, span.end, diagnostic.code.code

    return place
