"""How golc's values show themselves in a notebook: HTML without colours of its own, readable on light and dark pages.

Whatever stands in a domain is text here, never markup.
"""

from __future__ import annotations

import linecache
import traceback
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING

from golc.api.contents import tables
from golc.embed.places import source_of
from golc.planning.plans import Plan, answers
from golc.program.labels import Act
from golc.rendering import render
from golc.situation.summary import Family, arguments, families
from golc.theory.types import show

if TYPE_CHECKING:
    from golc.api.declared import Declared
    from golc.api.report import Report
    from golc.api.state import State
    from golc.api.unfinished import Unfinished
    from golc.diagnostics import Diagnostic, GolcError
    from golc.runtime.record import Run

MOST = 200
"""Rows of a table and steps of a plan that are shown."""

CELL = ' style="text-align: left; vertical-align: top"'


def theory_html(theory: Declared) -> str:
    """Everything that a theory declares, in tables."""
    head = f"<p><b>{escape(theory.name)}</b> ({escape(theory.path)}): {escape(theory.counts())}</p>"
    return _div(head, *[_table(each.headings, each.rows) for each in tables(theory.elaborated)])


def unfinished_html(unfinished: Unfinished) -> str:
    """The names that are declared so far, and the findings about them."""
    name, path = escape(unfinished.name), escape(unfinished.path)
    head = f"<p><b>{name}</b> ({path}): {escape(unfinished.counts())}</p>"
    table = _table(unfinished.declared.headings, unfinished.declared.rows) if unfinished.declared.rows else ""
    return _div(head, table, *_findings(unfinished.findings))


def state_html(state: State) -> str:
    """A row for each fluent; of one with arguments the exceptions and the usual value."""
    rows = [(family.name, _values(family)) for family in families(state.dynamics, state.raw)]
    note = f"<p>{state.worlds} possible worlds</p>" if state.worlds > 1 else ""
    return _div(_table(("fluent", "value"), rows), note)


def plan_html(plan: Plan) -> str:
    """A numbered list of steps; below a step that senses, what it may answer, each with the rest of the plan.

    The cost of a plan stands below, if it has one.
    """
    if not plan.steps:
        return _div("<p>nothing is to be done</p>")
    parts: list[str] = []
    shown = 0
    stack: list[str | tuple[Plan, int]] = [(plan, 1)]  # no recursion, for plans are deep
    while stack:
        top = stack.pop()
        if isinstance(top, str):
            parts.append(top)
            continue
        part, first = top
        steps = part.steps[: MOST - shown]
        shown += len(steps)
        items = [f"<li>{_step(step)}" for step in steps]
        parts.append(f'<ol start="{first}">{"</li>".join(items)}')
        stack.append("</li></ol>" if steps else "</ol>")
        if len(steps) < len(part.steps):
            parts.append(" …")
        elif part.cases:
            stack += ["</ul>", *_cases(part, first + len(steps)), "<ul>"]
    return _div("".join(parts), "" if plan.cost is None else f"<p>cost {escape(show(plan.cost))}</p>")


def _cases(part: Plan, after: int) -> Iterator[str | tuple[Plan, int]]:
    """What a plan may go on with, the last one first; its steps are numbered from ``after``."""
    for case in reversed(part.cases):
        text = escape(answers(part.senses, case.results))
        if case.plan.steps:
            yield from ("</li>", (case.plan, after), f"<li>{text}:")
        else:
            yield f"<li>{text}: nothing more</li>"


def run_html(run: Run) -> str:
    """Why a run ended, what happened in it, and the state that it reached."""
    rows = [(f"{entry.time:.2f} s", str(entry), entry.source or "") for entry in run.history[:MOST]]
    more = [("", f"… and {len(run.history) - MOST} more", "")] if len(run.history) > MOST else []
    said = [f"<p>“{escape(text)}”</p>" for text in run.messages[:MOST]]
    table = _table(("time", "what happened", "from"), [*rows, *more]) if rows else ""
    return _div(f"<p>{escape(run.summary())}</p>", table, *said, state_html(run.state))


def report_html(report: Report) -> str:
    """Findings as the command line writes them."""
    return _div(f"<p>{escape(report.counts())}</p>", *_findings(report.findings))


def _findings(findings: Sequence[Diagnostic]) -> Iterator[str]:
    return (f"<pre>{escape(render(finding))}</pre>" for finding in findings[:MOST])


def error_lines(error: GolcError) -> list[str]:
    """The lines of an error: where in cells and files outside golc it was met, and what it says."""
    lines: list[str] = []
    for frame, number in traceback.walk_tb(error.__traceback__):
        if str(frame.f_globals.get("__name__")).partition(".")[0] not in ("golc", "IPython"):
            file = frame.f_code.co_filename
            lines += [f"{source_of(file).name}, line {number}:", f"    {linecache.getline(file, number).strip()}"]
    return [*lines, *str(error).splitlines()]


def _values(family: Family) -> str:
    """The values of a fluent in a few words."""
    if not family.relational and family.mentioned and family.mentioned[0][0] == ():
        return show(family.usual)
    if family.relational:
        return "true for " + (", ".join([arguments(args) for args, _ in family.mentioned]) or "nothing")
    shown = [f"{arguments(args)}: {show(value)}" for args, value in family.mentioned]
    return "; ".join(shown if family.whole else [*shown, f"{'all others' if shown else 'all'}: {show(family.usual)}"])


def _step(step: object) -> str:
    text = escape(str(step))
    return text if isinstance(step, Act) else f"<i>{text}</i>"


def _table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head = "".join(f"<th{CELL}>{escape(heading)}</th>" for heading in headings)
    body = "".join(f"<tr>{''.join(f'<td{CELL}>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _div(*parts: str) -> str:
    return f"<div>{''.join(parts)}</div>"
