"""The words of the language: what is reserved, what begins a line, and what people write instead."""

from __future__ import annotations

_RESERVED = """
abort choose for guard if interrupts let pick prefer say search skip star test together wait while within
count exists false forall known knows max min none not possible sum true
and or implies iff in if elif else when where
one some set list unknown
"""

RESERVED = frozenset(_RESERVED.split())
"""The words that may not be names."""

DECLARATIONS = (
    "domain",
    "import",
    "const",
    "type",
    "static",
    "extern",
    "fluent",
    "initially",
    "define",
    "action",
    "exog",
    "axiom",
    "invariant",
    "goal",
    "prune",
    "scenario",
    "proc",
    "device",
)
"""The words that begin a declaration."""

CLAUSES = {
    "poss": "`action` or `exog`",
    "causes": "`action` or `exog`",
    "senses": "`action`",
    "cost": "`action`",
    "after": "`axiom`",
    "otherwise": "`axiom`",
    "given": "`scenario`",
    "run": "`scenario`",
    "until": "`scenario`",
    "expect": "`scenario`",
    "on": "`interrupts` or `scenario`",
}
"""The words that begin a line inside a declaration, and of which."""

STATEMENTS = frozenset(_RESERVED.split("\n")[1].split())
"""The words that begin a statement."""

BRANCHES = {"elif": "if", "else": "if` or `within", "or": "choose", "and": "together", "over": "prefer"}
"""The words that go on with a statement."""

OTHER_NAMES = {
    "procedure": "proc",
    "def": "proc",
    "function": "define",
    "func": "define",
    "macro": "define",
    "program": "proc",
    "predicate": "fluent",
    "relation": "fluent",
    "state": "fluent",
    "var": "fluent",
    "variable": "fluent",
    "sort": "type",
    "enum": "type",
    "constant": "const",
    "let": "const",
    "external": "extern",
    "foreign": "extern",
    "native": "extern",
    "primitive": "action",
    "prim_action": "action",
    "operator": "action",
    "exogenous": "exog",
    "exog_action": "exog",
    "event": "exog",
    "initial": "initially",
    "init": "initially",
    "include": "import",
    "constraint": "invariant",
    "test": "scenario",
    "robot": "device",
}
"""What a declaration is called elsewhere."""
