"""Random programs: the machine's *Trans* and *Final* are those of the definitions, written out naively here.

The clock stands still: a wait for a time does not end, and no time is up.
The naive evaluator works on the typed statements by recursion, builds no normal forms, and computes everything at once.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from golc.situation.interpret import Interpreter
from golc.theory import statements as typed
from golc.theory.types import show_call

Config = tuple[Any, ...]
NIL: Config = ("nil",)


class Definitions:
    """*Trans* and *Final* as the reference defines them, in look-ahead or online."""

    def __init__(self, interpreter: Interpreter, ahead: bool) -> None:
        self.i = interpreter
        self.theory = interpreter.theory
        self.ahead = ahead

    def trans(self, p: Config, s: Any, entered: frozenset[str] = frozenset()) -> list[tuple[str, Config, Any]]:
        match p:
            case ("nil",):
                return []
            case ("seq", first, rest):
                mine = [(label, ("seq", left, rest), after) for label, left, after in self.trans(first, s, entered)]
                return (self.trans(rest, s, entered) if self.final(first, s, entered) else []) + mine
            case ("together", parts):
                return [t for index in range(len(parts)) for t in self._branch("together", parts, index, s, entered)]
            case ("prefer", parts):
                for index in range(len(parts)):
                    if found := self._branch("prefer", parts, index, s, entered):
                        return found
                return []
            case ("guard", condition, env, inside):
                steps = self.trans(inside, s, entered) if self.i.holds(condition, s, env) else []
                return [(label, ("guard", condition, env, left), after) for label, left, after in steps]
            case ("pause",):
                return [("wait", p, s)]
            case ("rounds", _, _, 0):
                return []
            case ("rounds", body, env, left):
                return self._then(("at", body, env), ("rounds", body, env, left - 1), s, entered)
            case ("interrupts", statement, env, bodies):
                return self._interrupts(statement, env, bodies, s, entered)
            case ("at", statement, env):
                return self._statement(statement, env, s, entered)
        raise AssertionError(p)

    def final(self, p: Config, s: Any, entered: frozenset[str] = frozenset()) -> bool:
        match p:
            case ("nil",):
                return True
            case ("seq", first, rest):
                return self.final(first, s, entered) and self.final(rest, s, entered)
            case ("together" | "prefer", parts):
                return all(self.final(part, s, entered) for part in parts)
            case ("guard", condition, env, inside):
                return not self.i.holds(condition, s, env) or self.final(inside, s, entered)
            case ("rounds", *_):
                return True
            case ("pause",):
                return False
            case ("interrupts", _, _, bodies):
                return all(b is None or self.final(b, s) for b in bodies) and not self.trans(p, s)
            case ("at", statement, env):
                return self._final(statement, env, s, entered)
        raise AssertionError(p)

    def _bindings(self, binders: Any, where: Any, s: Any, env: Any) -> list[Any]:
        found: list[Any] = []
        self.i.visit(binders, where, s, env, found.append)
        return found

    def _branch(self, kind: str, parts: Any, index: int, s: Any, entered: frozenset[str]) -> list[Any]:
        return [
            (label, (kind, (*parts[:index], left, *parts[index + 1 :])), after)
            for label, left, after in self.trans(parts[index], s, entered)
        ]

    def _interrupts(self, statement: Any, env: Any, bodies: Any, s: Any, entered: frozenset[str]) -> list[Any]:
        going_on = [None if b is None or self.final(b, s) else b for b in bodies]

        def inside(index: int, body: Config) -> list[Any]:
            return [
                (label, ("interrupts", statement, env, (*going_on[:index], left, *going_on[index + 1 :])), after)
                for label, left, after in self.trans(body, s, entered)
            ]

        for index, handler in enumerate(statement.handlers):
            if bodies[index] is not None and (found := inside(index, bodies[index])):
                return found
            if going_on[index] is None:
                for inner in self._bindings(handler.binders, handler.condition, s, env):
                    if found := inside(index, ("at", handler.body, inner)):
                        return found
        return []

    def _statement(self, d: Any, env: Any, s: Any, entered: frozenset[str]) -> list[Any]:
        match d:
            case typed.Skip():
                return []
            case typed.Perform():
                action = self.theory.actions[d.action]
                args = tuple(self.i.evaluate(arg, s, env) for arg in d.args)
                if not self.i.possible(action, s, args):
                    return []
                return [(show_call(d.action, args), NIL, self.i.progress(action, s, args))]
            case typed.Test():
                return [("test", NIL, s)] if self.i.holds(d.condition, s, env) else []
            case typed.Wait():
                return [] if self.ahead else [("wait", NIL, s)]
            case typed.WaitTime():
                return [("clock", NIL if self.ahead else ("pause",), s)]
            case typed.WaitUntil():
                holds = self.i.holds(d.condition, s, env)
                if self.ahead:
                    return [("test", NIL, s)] if holds else []
                return [] if holds else [("wait", ("at", d, env), s)]
            case typed.While():
                if not self.i.holds(d.condition, s, env):
                    return []
                return self._then(("at", d.body, env), ("at", d, env), s, entered)
            case typed.Star(limit=None):
                return self._then(("at", d.body, env), ("at", d, env), s, entered)
            case typed.TogetherStar():
                steps = self.trans(("at", d.body, env), s, entered)
                return [(label, ("together", (left, ("at", d, env))), after) for label, left, after in steps]
            case typed.Choose():
                return [t for branch in d.branches for t in self.trans(("at", branch, env), s, entered)]
            case typed.Pick():
                inner = self._bindings(d.binders, d.where, s, env)
                return [t for e in inner for t in self.trans(("at", d.body, e), s, entered)]
            case typed.Invoke():
                return self._call(d, env, s, entered)
        return self.trans(self._unfolded(d, env, s), s, entered)

    def _then(self, body: Config, rest: Config, s: Any, entered: frozenset[str]) -> list[Any]:
        return [(label, ("seq", left, rest), after) for label, left, after in self.trans(body, s, entered)]

    def _call(self, d: Any, env: Any, s: Any, entered: frozenset[str]) -> list[Any]:
        procedure = self.theory.procedures[d.procedure]
        args = tuple(self.i.evaluate(arg, s, env) for arg in d.args)
        if procedure.recursive and d.procedure in entered:
            return [("test", ("at", procedure.body, args), s)]
        inside = entered | {d.procedure} if procedure.recursive else entered
        return self.trans(("at", procedure.body, args), s, inside)

    def _unfolded(self, d: Any, env: Any, s: Any) -> Config:
        """A statement that is another program in this state, without a step."""
        config: Config
        match d:
            case typed.Sequence():
                config = ("at", d.parts[-1], env)
                for part in reversed(d.parts[:-1]):
                    config = ("seq", ("at", part, env), config)
                return config
            case typed.If():
                return ("at", d.then if self.i.holds(d.condition, s, env) else d.otherwise, env)
            case typed.Let():
                return ("at", d.body, (*env, self.i.evaluate(d.value, s, env)))
            case typed.Star():
                most: Any = d.limit and self.i.evaluate(d.limit, s, env)
                return ("rounds", d.body, env, max(0, most))
            case typed.For():
                config = NIL
                for inner in reversed(self._bindings(d.binders, None, s, env)):
                    turn = d.body if d.where is None else typed.If(d.where, d.body, typed.Skip())
                    config = ("seq", ("at", turn, inner), config)
                return config
            case typed.Within():
                return ("at", d.body, env)
            case typed.Guard():
                return ("guard", d.condition, env, ("at", d.body, env))
            case typed.Together():
                return ("together", tuple(("at", branch, env) for branch in d.branches))
            case typed.Prefer():
                return ("prefer", tuple(("at", branch, env) for branch in d.branches))
            case typed.Interrupts():
                return ("interrupts", d, env, (None,) * len(d.handlers))
        raise AssertionError(d)

    def _final(self, d: Any, env: Any, s: Any, entered: frozenset[str]) -> bool:
        match d:
            case typed.Skip() | typed.Star() | typed.TogetherStar():
                return True
            case typed.Perform() | typed.Test() | typed.Wait() | typed.WaitTime():
                return False
            case typed.WaitUntil():
                return not self.ahead and self.i.holds(d.condition, s, env)
            case typed.While():
                return not self.i.holds(d.condition, s, env) or self.final(("at", d.body, env), s, entered)
            case typed.Choose():
                return any(self.final(("at", branch, env), s, entered) for branch in d.branches)
            case typed.Pick():
                inner = self._bindings(d.binders, d.where, s, env)
                return any(self.final(("at", d.body, e), s, entered) for e in inner)
            case typed.Invoke():
                procedure = self.theory.procedures[d.procedure]
                if procedure.recursive and d.procedure in entered:
                    return False
                args = tuple(self.i.evaluate(arg, s, env) for arg in d.args)
                inside = entered | {d.procedure} if procedure.recursive else entered
                return self.final(("at", procedure.body, args), s, inside)
        return self.final(self._unfolded(d, env, s), s, entered)


CONDITIONS = ["x = 0", "x < 2", "not p", "on(1)", "exists n: digit. on(n)", "x % 2 = 1", "x in todo", "true", "false"]
LEAVES = ["a", "b", "inc", "act(x)", "off(1)", "off(x % 4)", "push(x % 4)", "never", "skip", "wait", "wait 5 s", "q(1)"]
LEAVES += ["q(x)", "push(len(seen))"]
PROCEDURES = """
proc q(n: int):
    choose:
        act(n)
    or:
        test n < 2
        q(n + 1)
    or:
        if n < 1:
            q(n + 2)
        else:
            skip
"""


def lines(depth: int) -> st.SearchStrategy[list[str]]:
    """A block, as lines."""
    statement = st.sampled_from(LEAVES).map(lambda line: [line])
    condition = st.sampled_from(CONDITIONS)
    statement |= condition.map(lambda c: [f"test {c}"]) | condition.map(lambda c: [f"wait until {c}"])
    if depth > 0:
        inner = lines(depth - 1).map(lambda block: ["    " + line for line in block])
        two = st.lists(inner, min_size=2, max_size=3)

        def joined(first: str, other: str) -> Callable[[list[list[str]]], list[str]]:
            return lambda blocks: [
                line for k, block in enumerate(blocks) for line in [f"{other if k else first}:", *block]
            ]

        handlers = st.lists(st.tuples(condition, inner), min_size=1, max_size=3)
        statement |= st.one_of(
            st.tuples(condition, inner, inner).map(lambda t: [f"if {t[0]}:", *t[1], "else:", *t[2]]),
            st.tuples(condition, inner).map(lambda t: [f"while {t[0]}:", *t[1]]),
            inner.map(lambda block: ["star:", *block]),
            st.tuples(st.sampled_from(["0", "2", "x - 1"]), inner).map(lambda t: [f"star at most {t[0]}:", *t[1]]),
            inner.map(lambda block: ["together star:", *block]),
            st.tuples(condition, inner).map(lambda t: [f"guard {t[0]}:", *t[1]]),
            inner.map(lambda block: ["within x + 1 s:", *block, "else:", "    a"]),
            inner.map(lambda block: ["for n: digit where on(n):", *block]),
            inner.map(lambda block: ["for k in 1..2, p2: bool:", "    if p2 = p:", "        act(k)", *block]),
            inner.map(lambda block: ["for n in todo where n in seen or on(n):", *block]),
            inner.map(lambda block: ["for n in seen, m in [n, x], b: bool:", "    if b:", "        act(m)", *block]),
            inner.map(lambda block: ["pick n: digit where on(n):", *block]),
            inner.map(lambda block: ["pick n in todo where on(n):", *block]),
            inner.map(lambda block: ["pick p2: bool, s in {todo, [x]}, n in s:", "    act(n)", *block]),
            inner.map(lambda block: ["pick m: digit:", "    off(m)", *block]),
            inner.map(lambda block: ["let y = x + 1:", "    act(y)", *block]),
            two.map(joined("choose", "or")),
            two.map(joined("together", "and")),
            two.map(joined("prefer", "over")),
            handlers.map(
                lambda hs: [
                    "interrupts:",
                    *(f"    {line}" for c, block in hs for line in [f"on {c}:", *block]),
                    "    on some n: digit where on(n) and n > x:",
                    "        off(n)",
                    "    on some n in seen, m in todo where n = m:",
                    "        push(n)",
                ]
            ),
        )
    return st.lists(statement, min_size=1, max_size=3).map(lambda blocks: [line for block in blocks for line in block])


@given(body=lines(2), ahead=st.booleans())
def test_transitions_and_finality_are_those_of_the_definitions(start: Any, body: list[str], ahead: bool) -> None:
    program = start("\n".join(body), PROCEDURES, ahead)
    definitions = Definitions(program.executable.dynamics.interpreter, ahead)
    control = program.executable.dynamics.theory.procedures["control"].body
    pending = [(program, ("at", control, ()))]
    for _ in range(40):
        if not pending:
            break
        running, config = pending.pop(0)
        assert running.final == definitions.final(config, running.state)
        wanted = definitions.trans(config, running.state)
        assert running.labels() == [label for label, _, _ in wanted]
        for index, (_, left, after) in enumerate(wanted):
            taken = running.take(index)
            assert taken.state == after
            pending.append((taken, left))
