"""How ``golc plan`` writes plans: as text, as JSON, as a graph. No recursion anywhere, for plans are deep."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from itertools import count, pairwise
from typing import Any, TypeAlias

from golc.diagnostics import counted
from golc.planning.plans import INDENT, Outcome, Plan, Step, answers, lines_of
from golc.program.labels import Act
from golc.program.paths import bottom_up
from golc.theory.types import Number, writable

Write: TypeAlias = Callable[[str], None]


class Listing:
    """Writes plans one after the other, ``numbered`` or a single one, and then what the search came to."""

    def __init__(self, write: Write, numbered: bool) -> None:
        self._write = write
        self._numbered = numbered

    def add(self, plan: Plan) -> None:
        """Write or keep a plan."""
        raise NotImplementedError

    def close(self, outcome: Outcome) -> None:
        """Write what comes at the end."""


class Text(Listing):
    """One step a line; with several plans a heading for each. Below a sensing action stands each result that it may
    have, with the rest of the plan indented."""

    def __init__(self, write: Write, numbered: bool) -> None:
        super().__init__(write, numbered)
        self._count = 0

    def add(self, plan: Plan) -> None:
        self._count += 1
        if self._numbered:
            self._write(f"# plan {self._count}: {counted(len(plan.actions), 'action')}")
        for line in lines_of(plan):
            self._write(line)


class Json(Listing):
    """One object with ``outcome``, ``gave_up``, ``plans``, ``cost``, ``deepest``, ``failed`` and ``expanded``.

    A plan is a list of steps. A step is ``{"action": name, "args": [...]}``, with ``expected`` instead of ``action``
    for something that happens. If a plan branches, its last step has what it ``senses`` and its ``branches``:
    ``results`` and a ``plan`` each.
    """

    def __init__(self, write: Write, numbered: bool) -> None:
        super().__init__(write, numbered)
        self._plans: list[Any] = []
        self._cost: Number | None = None

    def add(self, plan: Plan) -> None:
        self._cost = plan.cost
        lists: dict[int, list[dict[str, Any]]] = {}
        for part in bottom_up(plan, lambda part: part.ways):
            lists[id(part)] = steps = [_as_object(step) for step in part.steps]
            if part.cases:
                steps[-1]["senses"] = part.senses
                steps[-1]["branches"] = [
                    {"results": writable(case.results), "plan": lists[id(case.plan)]} for case in part.cases
                ]
        self._plans.append(lists[id(plan)])

    def close(self, outcome: Outcome) -> None:
        result = "found" if outcome.plans else "gave up" if outcome.gave_up else "impossible"
        document = {
            "outcome": result,
            "gave_up": outcome.gave_up,
            "plans": self._plans,
            "cost": writable(self._cost),
            "deepest": outcome.stuck,
            "failed": [str(reason) for reason in outcome.reasons],
            "expanded": outcome.expanded,
        }
        self._write("".join(_json_text(document)))


def _as_object(step: Step) -> dict[str, Any]:
    if isinstance(step, Act):
        return {"action": step.action, "args": writable(step.written)}
    return {"expected": step.action, "args": writable(step.args)}


def _json_text(thing: Any) -> Iterator[str]:
    """Like ``json.dumps`` with an indent of 2."""
    pending: list[tuple[str, Any]] = [("", thing)]
    while pending:
        indent, part = pending.pop()
        if isinstance(part, _Raw):
            yield part
        elif isinstance(part, dict | list | tuple) and part:
            is_object = isinstance(part, dict)
            inner, start = indent + "  ", "{" if is_object else "["
            pieces: list[tuple[str, Any]] = []
            for key in part if is_object else range(len(part)):
                name = f"{json.dumps(key)}: " if is_object else ""
                pieces += [("", _Raw(f"{start}\n{inner}{name}")), (inner, part[key])]
                start = ","
            pending += [("", _Raw(f"\n{indent}{'}' if is_object else ']'}")), *reversed(pieces)]
        else:
            yield json.dumps(part)


class _Raw(str):
    """Text of the document itself."""


class Dot(Listing):
    """A graph for Graphviz: a box for each step, dashed if it is expected to happen; equal ends of branches are drawn
    once. Several plans are drawn beside each other."""

    def __init__(self, write: Write, numbered: bool) -> None:
        super().__init__(write, numbered)
        self._plans = 0
        self._nodes = count(1)
        write("digraph plans {")
        write("    node [shape=box];")

    def add(self, plan: Plan) -> None:
        self._plans += 1
        indent = INDENT
        if self._numbered:
            self._write(f'    subgraph cluster_{self._plans} {{\n        label="plan {self._plans}";')
            indent += INDENT
        begin, end = f"begin{self._plans}", f"end{self._plans}"
        self._write(f"{indent}{begin} [shape=point];")
        self._write(f'{indent}{end} [shape=doublecircle, label=""];')
        names: dict[int, str] = {}
        for part in bottom_up(plan, lambda part: part.ways):
            names[id(part)] = self._part(part, names, end, indent)
        self._write(f"{indent}{begin} -> {names[id(plan)]};")
        if self._numbered:
            self._write("    }")

    def close(self, outcome: Outcome) -> None:
        self._write("}")

    def _part(self, part: Plan, names: Mapping[int, str], end: str, indent: str) -> str:
        """Draw the steps of a part and the edges from the last one; the name of the first node."""
        nodes = [f"n{next(self._nodes)}" for _ in part.steps]
        for node, step in zip(nodes, part.steps, strict=True):
            style = "" if isinstance(step, Act) else ", style=dashed"
            self._write(f"{indent}{node} [label={_quoted(str(step))}{style}];")
        for node, after in pairwise(nodes):
            self._write(f"{indent}{node} -> {after};")
        for case in part.cases:
            label = _quoted(answers(part.senses, case.results))
            self._write(f"{indent}{nodes[-1]} -> {names[id(case.plan)]} [label={label}];")
        if nodes and not part.cases:
            self._write(f"{indent}{nodes[-1]} -> {end};")
        return nodes[0] if nodes else end


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


FORMATS: Mapping[str, type[Listing]] = {"text": Text, "json": Json, "dot": Dot}
"""By the value of ``--format``."""
