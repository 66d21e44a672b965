"""Loops that never rest: each busy task divides the speed at which the brick answers the host."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from golc.diagnostics import Code, Findings, Span
from golc.nqc.source import NqcSource, Token, tokens

RESTING = frozenset({"Wait"})
LOOPS = frozenset({"while", "until", "do"})


def check_rests(nqc: NqcSource, findings: Findings) -> None:
    """Warn of every loop of unknown length in which nothing waits."""
    resting = _resting(nqc)
    for definition in nqc.definitions.values():
        for first, last in _busy(definition.body, resting):
            span = Span(definition.span.source, definition.body[first].start, definition.body[last].end)
            findings.warning(
                Code.NQC_BUSY,
                f"a loop in {definition.kind.value} `{definition.name}` never rests, which makes the brick answer late",
                _first_line(span),
                "no Wait in here",
                help="put a `Wait(1);` into it: 10 ms, in which the other tasks get their turn",
            )


def _first_line(span: Span) -> Span:
    length = len(span.text.partition("\n")[0].rstrip())
    return Span(span.source, span.start, span.start + length)


def _resting(nqc: NqcSource) -> frozenset[str]:
    """The words that make a loop rest: ``Wait``, and every macro, function and sub that leads to it."""
    uses = {name: {token.text for token in definition.body} for name, definition in nqc.definitions.items()}
    uses |= {name: {token.text for token in tokens(body)} for name, body in nqc.macros.items()}
    resting = set(RESTING)
    while found := {name for name, words in uses.items() if name not in resting and words & resting}:
        resting |= found
    return frozenset(resting)


def _busy(body: Sequence[Token], resting: frozenset[str]) -> Iterator[tuple[int, int]]:
    """The innermost loops without rest, as places of their first and last token."""
    found: list[tuple[int, int]] = []
    tails = {_statement(body, place + 1) + 1 for place, token in enumerate(body) if token.text == "do"}
    for place in range(len(body) - 1, -1, -1):
        if body[place].text not in LOOPS or place in tails:
            continue
        last = _end(body, place)
        holds_one = any(place <= first and end <= last for first, end in found)
        if not holds_one and not any(token.text in resting for token in body[place : last + 1]):
            found.append((place, last))
    yield from reversed(found)


def _end(body: Sequence[Token], place: int) -> int:
    """The last token of the loop that begins at ``place``: of its statement, or of the condition after a ``do``."""
    if body[place].text != "do":
        return _statement(body, _bracket(body, place + 1) + 1)
    tail = _statement(body, place + 1) + 1
    return _bracket(body, tail + 1) if tail < len(body) else len(body) - 1


def _statement(body: Sequence[Token], place: int) -> int:
    """The last token of the statement that begins at ``place``; conditions and loops take the next one in."""
    while place < len(body):
        match body[place].text:
            case "if" | "while" | "until" | "for" | "repeat" | "switch":
                place = _bracket(body, place + 1) + 1
                continue
            case "do":
                place += 1
                continue
            case "{":
                place = _bracket(body, place)
            case _:
                while place < len(body) and body[place].text != ";":
                    place += 1
        if place + 1 >= len(body) or body[place + 1].text != "else":
            return min(place, len(body) - 1)
        place += 2
    return len(body) - 1


def _bracket(body: Sequence[Token], place: int) -> int:
    """The place of the bracket that closes the one at ``place``, or the last token."""
    depth = 0
    for index in range(place, len(body)):
        depth += body[index].text in ("(", "{")
        depth -= body[index].text in (")", "}")
        if depth <= 0:
            return index
    return len(body) - 1
