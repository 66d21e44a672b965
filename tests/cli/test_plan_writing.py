"""Plans as they are written: the forms themselves, apart from any domain."""

from __future__ import annotations

import json
import re
from typing import Any

from golc.cli.plan_writing import FORMATS
from golc.diagnostics import NOWHERE
from golc.planning.plans import Case, Outcome, Plan
from golc.program.labels import Act, Expect


def act(name: str, *args: Any) -> Act:
    return Act(name, args, NOWHERE)


def written(format_: str, *plans: Plan) -> str:
    lines: list[str] = []
    listing = FORMATS[format_](lines.append, len(plans) > 1)
    for plan in plans:
        listing.add(plan)
    listing.close(Outcome(plans=len(plans)))
    return "\n".join(lines)


def test_json_is_laid_out_as_usual() -> None:
    plan = Plan((act("a", 1, None, True, "x"), Expect("e", (), NOWHERE), act("b", (1, 2), ())))
    text = written("json", plan, Plan(()))
    document = json.loads(text)
    assert text == json.dumps(document, indent=2)
    assert document["plans"] == [
        [
            {"action": "a", "args": [1, None, True, "x"]},
            {"expected": "e", "args": []},
            {"action": "b", "args": [[1, 2], []]},
        ],
        [],
    ]


def test_a_graph_quotes_what_it_has_to() -> None:
    step = act("say", 'a "quoted" \\ word')
    [label] = re.findall(r'n1 \[label=(".*")\];', written("dot", Plan((step,))))
    assert json.loads(label) == str(step)


def test_equal_ends_of_branches_are_drawn_once_and_written_twice() -> None:
    end = Plan((act("c"),))
    plan = Plan((act("look"),), ("door",), (Case(("open",), end), Case(("shut",), end)))
    assert written("dot", plan).count('label="c"') == 1
    assert written("text", plan).splitlines() == ["look", "door = open:", "    c", "door = shut:", "    c"]


def test_deep_plans_are_written() -> None:
    depth = 1500
    plan = Plan(())
    for number in range(depth):
        plan = Plan((act("look", number),), ("seen",), (Case((True,), plan), Case((False,), Plan(()))))
    assert written("text", plan).count("look(") == depth
    assert written("dot", plan).count('label="look(') == depth
    assert written("json", plan).count('"look"') == depth
