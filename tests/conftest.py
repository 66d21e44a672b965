"""What several rooms share: how many examples property tests try, the definitions, written out naively, and a port.

Property tests try 200 examples, the same every time, or with ``GOLC_EXAMPLES=5000`` that many new ones.
"""

from __future__ import annotations

import ast
import itertools
import keyword
import os
import re
import signal
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import pytest
from hypothesis import HealthCheck, settings

from golc.situation.interpret import Interpreter
from golc.theory import statements as typed
from golc.theory.terms import Before, Choice, Epistemic, Term
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value

if TYPE_CHECKING:
    from golc.runtime.rcxsim.line import Line

EXAMPLES = os.environ.get("GOLC_EXAMPLES")

settings.register_profile(
    "golc",
    max_examples=int(EXAMPLES or 200),
    derandomize=EXAMPLES is None,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("golc")

# A shell that starts the tests in the background has them ignore Ctrl-C, and with them what they interrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)

GOLC_NOTATION = re.compile(
    r"""
    .+:=
    | (abort|action|after|axiom|by|causes|const|cost|define|device|domain|exog|expect|extern|fluent|from|given|goal
      |guard|import|initially|invariant|let|on|one|pick|poss|proc|prune|run|say|scenario|search|senses|set|star|static
      |test|type|until|wait|within)[ ]
    | (true|false|none|skip|exists|forall|one[ ]of)$
    | .*[\w\]}]\?$                   # t?
    | .*\w\.\.[-\w]                  # 1..6
    | \{[a-z]\w*(,[ ]\w+)+\}$        # {a, b} as a type
    | .*[ ](=[ ]…|implies|iff)
    | \w+(\(.*\))?:                  # the head of a block
    """,
    re.VERBOSE,
)
"""Code that only golc's own form of the language has."""

SOURCE_LINE = re.compile(r"\s*\d+ \||\s*(-->|:::) ")


@pytest.fixture(scope="session")
def no_python() -> Callable[[str], list[str]]:
    """What rendered findings about a theory in Python quote in another form: golc's notation, and code in a help that
    Python cannot read. The lines of the theory that they show do not count."""

    def found(rendered: str) -> list[str]:
        lines = [line for line in rendered.splitlines() if not SOURCE_LINE.match(line)]
        quoted = [(piece, "= help: " in line) for line in lines for piece in re.findall("`([^`]+)`", line)]
        return [piece for piece, help in quoted if GOLC_NOTATION.match(piece) or (help and not _reads(piece))]

    return found


def _reads(piece: str) -> bool:
    """Whether Python can read a piece of code with holes; options, signs and NQC it need not read."""
    if piece.startswith(("--", "void ", "task ")) or keyword.iskeyword(piece) or re.fullmatch(r"\W+", piece):
        return True
    whole = piece + "\ndef f(): ..." * piece.startswith("@") + " ..." * piece.endswith(":")
    if piece.startswith("for ") and not piece.endswith(":"):
        whole = f"[0 {piece}]"
    for hole in ("...", "_", ""):
        try:
            ast.parse(whole.replace("…", hole))
        except SyntaxError:
            continue
        return True
    return False


World: TypeAlias = tuple[Value, ...]
Worlds: TypeAlias = frozenset[World]
"""What an agent holds possible: one tuple of values for each possible world."""

Config: TypeAlias = tuple[Any, ...]
"""What is left of a program."""

Transition: TypeAlias = tuple[Any, Config, Worlds]

NIL: Config = ("nil",)


class NotKnownError(Exception):
    """The possible worlds disagree on something that has to be known."""


class Actual(tuple[Value, ...]):
    """A world among those that are possible."""

    among: Worlds

    @classmethod
    def each(cls, worlds: Worlds) -> Iterator[Actual]:
        for world in worlds:
            actual = cls(world)
            actual.among = worlds
            yield actual


class Terms(Interpreter):
    """Evaluates terms in one of several worlds that are written down one by one."""

    then: Worlds = frozenset()
    """What was possible before the last action."""

    def evaluate(self, term: Term, situation: Any, env: tuple[Value, ...]) -> Value:
        if isinstance(term, Before):
            return agreed(self.evaluate(term.body, world, env) for world in Actual.each(self.then))
        return super().evaluate(term, situation, env)

    def epistemic(self, term: Epistemic, situation: Any, env: tuple[Value, ...]) -> bool:
        values = {self.evaluate(term.body, world, env) for world in Actual.each(situation.among)}
        return {"knows": values == {True}, "possible": True in values, "known": len(values) == 1}[term.kind]


def agreed(values: Iterator[Value]) -> Value:
    """The value, if all are the same."""
    first, *others = set(values)
    if others:
        raise NotKnownError
    return first


class Knowledge:
    """What is known, possible and brought about where these worlds are possible."""

    def __init__(self, theory: BasicActionTheory) -> None:
        self.theory = theory
        self.terms = Terms(theory)

    def initial(self) -> Worlds:
        options = []
        for name, args in self.terms.layout.ground_fluents:
            initial = self.theory.fluents[name].initial
            chosen = isinstance(initial, Choice)
            value = self.terms.evaluate(initial.among if isinstance(initial, Choice) else initial, (), args)
            options.append(cast(tuple[Value, ...], value) if chosen else (value,))
        worlds = [*Actual.each(frozenset(itertools.product(*options)))]
        return frozenset(tuple(w) for w in worlds if self.terms.all_hold(self.theory.initially, w, ()))

    def holds(self, formula: Term, s: Worlds, env: tuple[Value, ...]) -> bool:
        return all(self.terms.holds(formula, world, env) for world in Actual.each(s))

    def refuted(self, formula: Term, s: Worlds, env: tuple[Value, ...]) -> bool:
        return not any(self.terms.holds(formula, world, env) for world in Actual.each(s))

    def decides(self, formula: Term, s: Worlds, env: tuple[Value, ...]) -> bool:
        return bool(self.value(formula, s, env))

    def value(self, term: Term, s: Worlds, env: tuple[Value, ...]) -> Any:
        return agreed(self.terms.evaluate(term, world, env) for world in Actual.each(s))

    def bindings(self, binders: Any, where: Term | None, s: Worlds, env: tuple[Value, ...]) -> list[tuple[Value, ...]]:
        """The environments that binders make, as far as a condition is known to hold."""
        found = [env]
        for binder in binders:
            longer: list[tuple[Value, ...]] = []
            for inner in found:
                if binder.within is not None:
                    self.value(binder.within, s, inner)
                self.terms.visit((binder,), None, next(Actual.each(s)), inner, longer.append)
            found = longer
        return [inner for inner in found if where is None or self.holds(where, s, inner)]

    def possible(self, action: str, s: Worlds, args: tuple[Value, ...]) -> bool:
        conditions = self.theory.actions[action].preconditions
        return all(self.terms.all_hold(conditions, world, args) for world in Actual.each(s))

    def progress(self, action: str, s: Worlds, args: tuple[Value, ...]) -> Worlds:
        """All worlds that an action may lead to."""
        return frozenset(after for world in Actual.each(s) for after in self._after(action, world, args))

    def _after(self, action: str, world: Actual, args: tuple[Value, ...]) -> Iterator[World]:
        changes: dict[int, tuple[Value, ...]] = {}
        for effect in self.theory.actions[action].effects:
            envs: list[tuple[Value, ...]] = []
            self.terms.visit(effect.binders, effect.where, world, args, envs.append)
            for env in envs:
                if effect.condition is None or self.terms.holds(effect.condition, world, env):
                    place = self.terms.layout.places[effect.fluent]
                    of = tuple(self.terms.evaluate(arg, world, env) for arg in effect.args)
                    value = effect.value
                    if isinstance(value, Choice):
                        changes[place.slot(of)] = tuple(cast(Any, self.terms.evaluate(value.among, world, env)))
                    else:
                        changes[place.slot(of)] = (self.terms.evaluate(value, world, env),)
        options = [changes.get(slot, (value,)) for slot, value in enumerate(world)]
        return itertools.product(*options)

    def outcomes(self, action: str, s: Worlds, args: tuple[Value, ...]) -> dict[tuple[Value, ...], Worlds]:
        """What may be sensed, with the worlds that agree with it."""
        found: dict[tuple[Value, ...], set[World]] = {}
        for world in Actual.each(s):
            results = tuple(self.terms.evaluate(term, world, args) for term in self.theory.actions[action].senses)
            found.setdefault(results, set()).add(tuple(world))
        return {results: frozenset(worlds) for results, worlds in found.items()}

    def pruned(self, action: str, args: tuple[Value, ...], before: Worlds, after: Worlds) -> bool:
        """Whether a prune is known to hold when an action has led from one situation to another."""
        self.terms.then = before
        for prune in self.theory.prunes.values():
            try:
                if prune.action in (None, action) and self.holds(prune.condition, after, args if prune.action else ()):
                    return True
            except NotKnownError:
                pass
        return False


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


@pytest.fixture(scope="session")
def definitions() -> Callable[[BasicActionTheory, bool], Definitions]:
    """The definitions for a theory, in look-ahead or online."""
    return Definitions


class VirtualPort:
    """A transport whose other end is a simulated line; waiting for bytes is what makes time pass."""

    name = "virtual"

    def __init__(self, line: Line) -> None:
        self._line = line
        self._now = 0.0
        self._arrived = b""

    def open(self) -> None:
        """There is nothing to open."""

    def close(self) -> None:
        """There is nothing to close."""

    def now(self) -> float:
        return self._now

    def write(self, data: bytes) -> None:
        self._arrived += self._line.host_sent(data, self._now)

    def read(self, deadline: float) -> bytes:
        while not self._arrived and self._now < deadline:
            due = self._line.due()
            self._now = deadline if due is None else min(deadline, max(due, self._now))
            self._arrived += self._line.advance(self._now)
        data, self._arrived = self._arrived, b""
        return data


@pytest.fixture(scope="session")
def virtual_port() -> type[VirtualPort]:
    """A port to a simulated line in virtual time."""
    return VirtualPort
