"""Who is at fault where uses and a declaration contradict each other: one mistake is one finding.

A finding about a use names the declarations that it contradicts; a use that fits clears them. A declaration that
several uses contradict and none clears is probably wrong itself, and so is one with a finding of its own: the first
use, or that finding, then speaks for all.
"""

from __future__ import annotations

import bisect
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

from golc.diagnostics import Diagnostic, Label, Source, Span


class Matter(Enum):
    """What a use and a declaration may disagree about; the value is what helps in golc's own form."""

    TYPE = "correct the type of `{name}` where it is declared, or each of these uses"
    NONE = "write `?` behind the type of `{name}` where it is declared, or correct each of these uses"
    ARITY = "correct the parameters of `{name}` where it is declared, or each of these uses"
    NAME = "declare it by the name `{used}`: nothing uses `{name}`"


OPTIONAL = "write `… | None` as the type of `{name}` where it is declared, or correct each of these uses"
"""What helps in Python where a declaration leaves out ``none``."""


@dataclass(frozen=True)
class Suspect:
    """A declaration, by the place of its name, and what may be wrong with it."""

    matter: Matter
    place: Span


@dataclass
class Blame:
    """Collects which findings blame whom, and whom a use has cleared."""

    accused: list[tuple[Diagnostic, tuple[Suspect, ...]]] = field(default_factory=list)
    cleared: set[Suspect] = field(default_factory=set)
    short: set[Span] = field(default_factory=set)
    """The declarations to which some use gives more arguments than they have parameters."""

    def accuse(self, finding: Diagnostic, suspects: Iterable[Suspect]) -> None:
        """A finding that is somebody else's fault if one of the suspects is wrong."""
        self.accused.append((finding, tuple(suspects)))

    def without_parameters(self) -> set[Span]:
        """The declarations that have fewer parameters than every use gives them arguments."""
        return {place for place in self.short if Suspect(Matter.ARITY, place) not in self.cleared}

    def settle(
        self, findings: list[Diagnostic], faulty: Iterable[Suspect], names: Mapping[Span, str]
    ) -> list[Diagnostic]:
        """The findings without those that another one speaks for; ``faulty`` have findings of their own, ``names`` are
        those of declarations, by their places."""
        known = {id(finding) for finding in findings}
        accused = [(finding, suspects) for finding, suspects in self.accused if id(finding) in known]
        own = set(faulty)
        uses: dict[Suspect, list[Diagnostic]] = {}
        for finding, suspects in accused:
            for suspect in suspects:
                uses.setdefault(suspect, []).append(finding)
        guilty = {suspect for suspect, found in uses.items() if len(found) > 1 and suspect not in self.cleared} | own
        spoken: dict[int, Diagnostic | None] = {}
        for suspect in sorted(filter(guilty.__contains__, uses), key=lambda each: (each not in own, -len(uses[each]))):
            found = [finding for finding in uses[suspect] if id(finding) not in spoken]
            spoken.update(dict.fromkeys(map(id, found)))
            if suspect not in own and found:
                found.sort(key=lambda finding: (finding.span.source.name, finding.span.start))
                spoken[id(found[0])] = _for_all(suspect, found, names)
        settled = [spoken.get(id(finding), finding) for finding in findings]
        return [finding for finding in settled if finding is not None]


def _for_all(suspect: Suspect, uses: list[Diagnostic], names: Mapping[Span, str]) -> Diagnostic:
    first = uses[0]
    if len(uses) == 1:
        return first
    name = names.get(suspect.place, suspect.place.text)
    help_ = suspect.matter.value.format(name=name, used=first.span.text)
    if suspect.matter is Matter.NONE:
        help_ = suspect.place.either(help_, OPTIONAL.format(name=name))
    labels = first.labels or (Label(suspect.place, f"`{name}` is declared here"),)
    return replace(first, labels=labels, notes=(*first.notes, *also(uses)), help=help_)


def also(uses: list[Diagnostic]) -> tuple[str, ...]:
    """A note with the lines of all findings but the first."""
    source = uses[0].span.source
    lines = [*dict.fromkeys([_line(use.span, source) for use in uses[1:]])]
    if not lines:
        return ()
    more = ", …" if len(lines) > 10 else ""
    return (f"also used in line{'s' * (len(lines) > 1)} {', '.join(lines[:10])}{more}",)


def _line(span: Span, source: Source) -> str:
    return str(span.line) if span.source is source else f"{span.line} of {span.source.name}"


class Places:
    """Where some spans begin, to be asked many times."""

    def __init__(self, spans: Iterable[Span]) -> None:
        self._starts: dict[int, list[int]] = {}
        for span in spans:
            self._starts.setdefault(id(span.source), []).append(span.start)
        for starts in self._starts.values():
            starts.sort()

    def inside(self, span: Span) -> bool:
        """Whether one of them begins inside a span."""
        starts = self._starts.get(id(span.source), [])
        place = bisect.bisect_left(starts, span.start)
        return place < len(starts) and starts[place] < span.end
