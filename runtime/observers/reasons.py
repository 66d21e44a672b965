"""Where a step of a program stands and under which condition: what a trace says about why something was done."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from golc.diagnostics import Span
from golc.theory import statements as st
from golc.theory.theory import BasicActionTheory


@dataclass(frozen=True)
class Where:
    """The procedure that a statement belongs to, and the innermost condition around it, as the file writes it."""

    procedure: str
    condition: str


class Reasons:
    """Looks up the statements of a theory by their places."""

    def __init__(self, theory: BasicActionTheory) -> None:
        self._where: dict[Span, Where] = {}
        for procedure in theory.procedures.values():
            for statement, condition in _statements(procedure.body):
                self._where.setdefault(statement.span, Where(procedure.name, condition))

    def where(self, span: Span) -> Where:
        """What is known about the statement at a place."""
        return self._where.get(span, Where("", ""))

    def line(self, span: Span) -> str:
        """The place in a few words: file, line and procedure."""
        procedure = self.where(span).procedure
        place = f"{Path(span.source.name).name}:{span.line}"
        return f"{place} {procedure}" if procedure else place


def one_line(span: Span, longest: int = 39) -> str:
    """The text of a place in one line, cut off where it is long."""
    text = " ".join(span.text.split())
    return text if len(text) <= longest else text[: longest - 1] + "…"


def _statements(body: st.Statement) -> Iterator[tuple[st.Statement, str]]:
    """Every statement of a program with the innermost condition around it; no recursion, the depth is the input's."""
    stack: list[tuple[st.Statement, str]] = [(body, "")]
    while stack:
        statement, condition = stack.pop()
        yield statement, condition
        match statement:
            case st.Sequence(parts=parts):
                stack.extend((part, condition) for part in parts)
            case st.If(condition=term, then=then, otherwise=otherwise):
                stack.append((then, f"if {one_line(term.span)}"))
                stack.append((otherwise, f"if not {one_line(term.span)}"))
            case st.While(condition=term, body=inner):
                stack.append((inner, f"while {one_line(term.span)}"))
            case st.Choose(branches=branches) | st.Together(branches=branches) | st.Prefer(branches=branches):
                stack.extend((branch, condition) for branch in branches)
            case st.Pick(binders=binders, where=where, body=inner):
                names = ", ".join(binder.variable.name for binder in binders)
                stack.append((inner, f"pick {names}" + (f" where {one_line(where.span)}" if where else "")))
            case st.For(binders=binders, where=where, body=inner):
                names = ", ".join(binder.variable.name for binder in binders)
                stack.append((inner, f"for {names}" + (f" where {one_line(where.span)}" if where else "")))
            case st.Guard(condition=term, body=inner):
                stack.append((inner, f"guard {one_line(term.span)}"))
            case st.Within(body=inner, otherwise=otherwise):
                stack.extend(((inner, condition), (otherwise, "time is up")))
            case st.Star(body=inner) | st.TogetherStar(body=inner) | st.Let(body=inner) | st.Search(body=inner):
                stack.append((inner, condition))
            case st.Interrupts(handlers=handlers):
                stack.extend((handler.body, _trigger(handler)) for handler in handlers)


def _trigger(handler: st.Interrupt) -> str:
    condition = one_line(handler.condition.span)
    if not handler.binders:
        return f"on {condition}"
    names = ", ".join(binder.variable.name for binder in handler.binders)
    return f"on some {names} where {condition}"
