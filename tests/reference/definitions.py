"""*Trans* and *Final*, written out naively, by which the machine and the planners are judged."""

from __future__ import annotations

import itertools
from typing import Any, TypeAlias

from golc.theory import statements as typed
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value
from tests.reference.knowledge import Knowledge, NotKnownError, Worlds

Config: TypeAlias = tuple[Any, ...]
"""What is left of a program."""

Transition: TypeAlias = tuple[Any, Config, Worlds]

NIL: Config = ("nil",)


class Definitions:
    """*Trans* and *Final* as the reference defines them, in look-ahead or online.

    The typed statements are evaluated by recursion, without normal forms, and everything at once. A label is ``test``,
    ``wait``, ``clock``, or the name and the arguments of an action.
    """

    def __init__(self, theory: BasicActionTheory, ahead: bool) -> None:
        self.theory = theory
        self.ahead = ahead
        self.k = Knowledge(theory)

    def start(self, procedure: str, args: tuple[Value, ...] = ()) -> Config:
        return ("at", self.theory.procedures[procedure].body, args)

    def trans(self, p: Config, s: Worlds, entered: frozenset[str] = frozenset()) -> list[Transition]:
        """Nothing, in look-ahead, where something has to be known that is not."""
        try:
            return self._trans(p, s, entered)
        except NotKnownError:
            if not self.ahead:
                raise
            return []

    def final(self, p: Config, s: Worlds, entered: frozenset[str] = frozenset()) -> bool:
        try:
            return self._is_final(p, s, entered)
        except NotKnownError:
            if not self.ahead:
                raise
            return False

    def _trans(self, p: Config, s: Worlds, entered: frozenset[str]) -> list[Transition]:
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
                steps = self.trans(inside, s, entered) if self.k.holds(condition, s, env) else []
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

    def _is_final(self, p: Config, s: Worlds, entered: frozenset[str]) -> bool:
        match p:
            case ("nil",):
                return True
            case ("seq", first, rest):
                return self.final(first, s, entered) and self.final(rest, s, entered)
            case ("together" | "prefer", parts):
                return all(self.final(part, s, entered) for part in parts)
            case ("guard", condition, env, inside):
                return self.k.refuted(condition, s, env) or self.final(inside, s, entered)
            case ("rounds", *_):
                return True
            case ("pause",):
                return False
            case ("interrupts", _, _, bodies):
                return all(b is None or self.final(b, s) for b in bodies) and not self.trans(p, s)
            case ("at", statement, env):
                return self._final(statement, env, s, entered)
        raise AssertionError(p)

    def _branch(self, kind: str, parts: Any, index: int, s: Worlds, entered: frozenset[str]) -> list[Transition]:
        return [
            (label, (kind, (*parts[:index], left, *parts[index + 1 :])), after)
            for label, left, after in self.trans(parts[index], s, entered)
        ]

    def _interrupts(
        self, statement: Any, env: Any, bodies: Any, s: Worlds, entered: frozenset[str]
    ) -> list[Transition]:
        going_on = [None if b is None or self.final(b, s) else b for b in bodies]

        def inside(index: int, body: Config) -> list[Transition]:
            return [
                (label, ("interrupts", statement, env, (*going_on[:index], left, *going_on[index + 1 :])), after)
                for label, left, after in self.trans(body, s, entered)
            ]

        for index, handler in enumerate(statement.handlers):
            if bodies[index] is not None and (found := inside(index, bodies[index])):
                return found
            if going_on[index] is None:
                for inner in self.k.bindings(handler.binders, handler.condition, s, env):
                    if found := inside(index, ("at", handler.body, inner)):
                        return found
        return []

    def _statement(self, d: Any, env: Any, s: Worlds, entered: frozenset[str]) -> list[Transition]:
        match d:
            case typed.Skip():
                return []
            case typed.Perform():
                args = tuple(self.k.value(arg, s, env) for arg in d.args)
                if not self.k.possible(d.action, s, args):
                    return []
                return [((d.action, args), NIL, self.k.progress(d.action, s, args))]
            case typed.Test():
                return [("test", NIL, s)] if self.k.holds(d.condition, s, env) else []
            case typed.Say():
                return [("test", NIL, s)]
            case typed.Abort():
                return [] if self.ahead else [("abort", NIL, s)]
            case typed.Wait():
                return [("wait", NIL, s)] if self._can_wait(s) else []
            case typed.WaitTime():
                return [("clock", NIL if self.ahead else ("pause",), s)]
            case typed.WaitUntil():
                if self.k.holds(d.condition, s, env):
                    return [("test", NIL, s)] if self.ahead else []
                return [("wait", ("at", d, env), s)] if self._can_wait(s) else []
            case typed.While():
                if not self.k.decides(d.condition, s, env):
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
                inner = self.k.bindings(d.binders, d.where, s, env)
                return [t for e in inner for t in self.trans(("at", d.body, e), s, entered)]
            case typed.Invoke():
                return self._call(d, env, s, entered)
        return self.trans(self._unfolded(d, env, s), s, entered)

    def _then(self, body: Config, rest: Config, s: Worlds, entered: frozenset[str]) -> list[Transition]:
        return [(label, ("seq", left, rest), after) for label, left, after in self.trans(body, s, entered)]

    def _call(self, d: Any, env: Any, s: Worlds, entered: frozenset[str]) -> list[Transition]:
        procedure = self.theory.procedures[d.procedure]
        args = tuple(self.k.value(arg, s, env) for arg in d.args)
        if procedure.recursive and d.procedure in entered:
            return [("test", ("at", procedure.body, args), s)]
        inside = entered | {d.procedure} if procedure.recursive else entered
        return self.trans(("at", procedure.body, args), s, inside)

    def _unfolded(self, d: Any, env: Any, s: Worlds) -> Config:
        """A statement that is another program in this state, without a step."""
        config: Config
        match d:
            case typed.Sequence():
                config = ("at", d.parts[-1], env)
                for part in reversed(d.parts[:-1]):
                    config = ("seq", ("at", part, env), config)
                return config
            case typed.If():
                return ("at", d.then if self.k.decides(d.condition, s, env) else d.otherwise, env)
            case typed.Let():
                return ("at", d.body, (*env, self.k.value(d.value, s, env)))
            case typed.Star():
                most: Any = d.limit and self.k.value(d.limit, s, env)
                return ("rounds", d.body, env, max(0, most))
            case typed.For():
                config = NIL
                for inner in reversed(self.k.bindings(d.binders, None, s, env)):
                    turn = d.body if d.where is None else typed.If(d.where, d.body, typed.Skip())
                    config = ("seq", ("at", turn, inner), config)
                return config
            case typed.Within():
                return ("at", d.body, env)
            case typed.Search() if self.ahead:
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

    def _final(self, d: Any, env: Any, s: Worlds, entered: frozenset[str]) -> bool:
        match d:
            case typed.Skip() | typed.Star() | typed.TogetherStar():
                return True
            case typed.Perform() | typed.Test() | typed.Wait() | typed.WaitTime() | typed.Say() | typed.Abort():
                return False
            case typed.WaitUntil():
                return not self.ahead and self.k.holds(d.condition, s, env)
            case typed.While():
                return not self.k.decides(d.condition, s, env) or self.final(("at", d.body, env), s, entered)
            case typed.Choose():
                return any(self.final(("at", branch, env), s, entered) for branch in d.branches)
            case typed.Pick():
                inner = self.k.bindings(d.binders, d.where, s, env)
                return any(self.final(("at", d.body, e), s, entered) for e in inner)
            case typed.Invoke():
                procedure = self.theory.procedures[d.procedure]
                if procedure.recursive and d.procedure in entered:
                    return False
                args = tuple(self.k.value(arg, s, env) for arg in d.args)
                inside = entered | {d.procedure} if procedure.recursive else entered
                return self.final(("at", procedure.body, args), s, inside)
        return self.final(self._unfolded(d, env, s), s, entered)

    def _can_wait(self, s: Worlds) -> bool:
        return not self.ahead or self.expected(s) is not None

    def expected(self, s: Worlds) -> tuple[str, tuple[Value, ...]] | None:
        """The exogenous action that happens in look-ahead where nothing else can."""
        for action in self.theory.actions.values():
            if action.expected:
                for args in itertools.product(*[parameter.type.values for parameter in action.parameters]):
                    if self.k.possible(action.name, s, args):
                        return action.name, args
        return None
