"""What is wrong with declarations and with the uses of their names: said once, and where the fault lies.

Some of it is only known when all has been elaborated: whether other uses agree with a declaration, and which of several
uses of a name comes first in the text.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from golc.diagnostics import Code, Diagnostic, Findings, Label, Severity, Source, Span
from golc.syntax import tree
from golc.theory.blame import Blame, Matter, Places, Suspect, also
from golc.theory.scope import Entry, Kind, Names, Suggestion

WORD = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_COLUMN = re.compile(r"^[^\s#]", re.MULTILINE)
_TYPE_FAULTS = (Code.TYPE_MISMATCH, Code.NO_INITIAL, Code.TABLE)


@dataclass
class Complaints:
    """Adds findings about a text and its ``names`` to ``findings``; what has to wait comes when it is finished."""

    source: Source
    names: Names
    findings: Findings
    blame: Blame = field(default_factory=Blame)
    _missing: dict[tuple[str, str], list[Diagnostic]] = field(default_factory=dict)
    _misspelt: dict[tuple[str, Code, Span | None], list[Diagnostic]] = field(default_factory=dict)
    """The uses of each name that is like another one, by what it is like."""
    _words: Counter[str] | None = None
    _spare: dict[Span, bool] = field(default_factory=dict)

    def error(
        self,
        code: Code,
        message: str,
        span: Span,
        marker: str = "",
        help: str | None = None,
        labels: tuple[Label, ...] = (),
        suspects: Iterable[Suspect] = (),
    ) -> None:
        """A finding; ``suspects`` are declarations whose fault it may be."""
        finding = Diagnostic(code, message, span, Severity.ERROR, marker, labels, help=help)
        self.findings.add(finding)
        self.blame.accuse(finding, suspects)

    def clear(self, suspects: Iterable[Suspect]) -> None:
        """Somebody uses these declarations as they are."""
        self.blame.cleared.update(suspects)

    def misspelt(self, code: Code, name: tree.Ident, similar: Suggestion, bound: Span | None = None) -> None:
        """A name that is declared nowhere, but one like it is; ``bound`` is the place that binds that one if it is a
        variable."""
        kind = "type" if code is Code.UNKNOWN_TYPE else similar.kind
        place = similar.labels[0].span if similar.labels else bound
        spare = place is not None and self._is_spare(similar.name, bound)
        suspects = [Suspect(Matter.NAME, place)] if place is not None and spare else []
        message = f"unknown {kind} `{name.text}`"
        help_ = similar.help(name.span)
        self.error(code, message, name.span, "not declared", help_, similar.labels, suspects)
        self._misspelt.setdefault((name.text, code, place), []).append(self.findings.diagnostics[-1])

    def _is_spare(self, name: str, bound: Span | None) -> bool:
        """Whether a name stands nowhere but in its declaration, or a variable but where it is bound."""
        if bound is not None:
            if bound not in self._spare:
                self._spare[bound] = WORD.findall(_around(bound)).count(name) == 1
            return self._spare[bound]
        if self._words is None:
            texts = {id(entry.span.source): entry.span.source.text for entry in self.names.values.entries.values()}
            texts[id(self.source)] = self.source.text
            self._words = Counter(word for text in texts.values() for word in WORD.findall(text))
        return self._words[name] == 1

    def missing(self, code: Code, message: str, span: Span, help: str) -> None:
        """A name that is declared nowhere and is like no other: one finding, however often it is used."""
        if self.names.nameless:
            return  # it may be the name that is missing in a declaration
        finding = Diagnostic(code, message, span, Severity.ERROR, "not declared", help=help)
        space = "action" if code is Code.UNKNOWN_ACTION else "value"
        self._missing.setdefault((space, span.text or message), []).append(finding)

    def finish(self) -> None:
        """Report what could only be known at the end, and leave out what is only a consequence."""
        self._merge_missing()
        for uses in self._missing.values():
            first, rest = uses[0], uses[1:]
            self.findings.add(replace(first, notes=also([first, *rest])))
        wrong = self._wrong(_TYPE_FAULTS)
        faulty = [Suspect(matter, entry.span) for entry in wrong for matter in _untyped(entry.node)]
        faulty += [Suspect(Matter.ARITY, entry.span) for entry in self._wrong((Code.TABLE, Code.PYTHON))]
        faulty += [Suspect(Matter.NAME, entry.span) for entry in self._wrong((Code.PYTHON,))]
        spaces = (self.names.values, self.names.doings)
        names = {entry.span: entry.name for space in spaces for entry in space.entries.values()}
        settled = self.blame.settle(self.findings.diagnostics, faulty, names)
        self.findings.diagnostics[:] = _said_once(settled, self._misspelt.values())

    def _merge_missing(self) -> None:
        """Sort the uses of each missing name. A use that is like some other name is one of them all the same; and
        what is missing inside a declaration to which nothing gives so few arguments, or which has two parameters of one
        name, is its parameters."""
        kept: list[Diagnostic] = []
        for finding in self.findings.diagnostics:
            uses = self._missing.get(("value", finding.span.text)) if _is_unknown(finding) else None
            (kept if uses is None else uses).append(finding)
        self.findings.diagnostics[:] = kept
        bodies = self._without_parameters()
        for key, uses in [*self._missing.items()]:
            uses[:] = [use for use in uses if not any(_begins_in(use.span, body) for body in bodies)]
            uses.sort(key=lambda finding: (finding.span.source.name, finding.span.start))
            if not uses:
                del self._missing[key]

    def _without_parameters(self) -> list[Span]:
        """The declarations whose parameters are probably wrong, as far as names are missing in them."""
        short = self.blame.without_parameters()
        names = {entry.span for space in (self.names.values, self.names.doings) for entry in space.entries.values()}
        found = [finding.span for finding in self.findings.diagnostics if finding.code is Code.DUPLICATE]
        twice = Places(span for span in found if span not in names)
        return [
            entry.node.span
            for space in (self.names.values, self.names.doings)
            for entry in space.entries.values()
            if entry.span in short or twice.inside(entry.node.span)
        ]

    def _wrong(self, codes: tuple[Code, ...]) -> list[Entry]:
        """The declarations of values that have a finding of their own with one of some codes."""
        found = Places(finding.span for finding in self.findings.diagnostics if finding.code in codes)
        kinds = (Kind.FLUENT, Kind.STATIC, Kind.EXTERN, Kind.DEFINITION)
        return [entry for entry in self.names.values.of(*kinds) if found.inside(entry.node.span)]


def _said_once(findings: list[Diagnostic], uses: Iterable[list[Diagnostic]]) -> list[Diagnostic]:
    """The findings, of which those about several uses of one name are one; each comes in the order of the text."""
    left = {id(finding): finding for finding in findings}
    for same in uses:
        found = [left[id(use)] for use in same if id(use) in left]
        found.sort(key=lambda finding: (finding.span.source.name, finding.span.start))
        for more in found[1:]:
            del left[id(more)]
        if found[1:]:
            left[id(found[0])] = replace(found[0], notes=(*found[0].notes, *also(found)))
    return [*left.values()]


def _around(span: Span) -> str:
    """The declaration that a span stands in: what begins in the first column, to the next that does."""
    text = span.source.text
    start = text.rfind("\n", 0, span.start) + 1
    while start and text[start] in " \t\r\n#":
        start = text.rfind("\n", 0, start - 1) + 1
    end = _COLUMN.search(text, span.end)
    return text[start : len(text) if end is None else end.start()]


def _begins_in(span: Span, body: Span) -> bool:
    return span.source is body.source and body.start <= span.start < body.end


def _untyped(node: tree.Node) -> tuple[Matter, ...]:
    """What a declaration with a finding has probably left out: its type, or the ``?`` behind it."""
    match node:
        case tree.Fluent(type=None) | tree.Static(type=None) | tree.Extern(type=None):
            return Matter.TYPE, Matter.NONE
        case tree.Fluent(initial=tree.Nothing()):
            return (Matter.NONE,)
        case _:
            return ()


def _is_unknown(finding: Diagnostic) -> bool:
    return finding.code in (Code.UNKNOWN_NAME, Code.UNKNOWN_TYPE)
