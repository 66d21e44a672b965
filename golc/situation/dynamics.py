"""How situations develop: the initial state, what is possible in a state, and the state after an action.

A state holds the value of every ground fluent now (*progression*); the history is no part of it and is never replayed,
so that no answer here gets slower with time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias

from golc.diagnostics import Span
from golc.situation.beginning import initial_state
from golc.situation.branching import Branching
from golc.situation.compile import Cells, Compiler, variables
from golc.situation.interpret import Interpreter
from golc.situation.knowing import Knowing, placed
from golc.situation.layout import Layout, World
from golc.situation.worlds import Assignment, State, Worlds, agreed, keep, shown, survey, with_value
from golc.theory import errors
from golc.theory.fitting import includes
from golc.theory.forms import describe
from golc.theory.order import spelt
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.terms import Choice, FluentTerm, Term, Variable
from golc.theory.theory import Action, BasicActionTheory, Effect
from golc.theory.types import Number, Unknown, Value, show, show_call

Args: TypeAlias = tuple[Value, ...]


@dataclass(frozen=True)
class Surprise:
    """A sensing result that the state did not expect.

    ``fluent`` is the ground fluent that took the value; none if something other than a fluent was sensed, and the state
    could not be changed.
    """

    action: str
    sensed: Value
    expected: Value
    fluent: str | None
    span: Span


@dataclass(frozen=True)
class Outcome:
    """Sensing results that are possible, and the state of an agent that has got them."""

    results: tuple[Value, ...]
    state: State


class Dynamics:
    """The compiled theory: every question about states and ground actions.

    Arguments of actions are taken to be of the right types (``misfit`` checks them where they come from outside).
    Methods that evaluate raise ``ProgramError`` where the language says that something is an error.
    """

    def __init__(self, theory: BasicActionTheory) -> None:
        self.theory = theory
        self.layout = Layout(theory)
        self.interpreter = Interpreter(theory, self.layout)
        self.compiler = Compiler(theory, self.layout)
        self.knowing = Knowing(theory, self.compiler, self.interpreter)
        self._possible_in = _Lazy(self._compile_possible_in)
        self._possible = _Lazy(self._compile_possible)
        self._progress = _Lazy(self._compile_progress)
        self._sense = _Lazy(self._compile_sense)
        self._cost = _Lazy(self._compile_cost)

    def initial(self, given: Mapping[int, Value] = MappingProxyType({})) -> State:
        """The initial state; ``given`` are values of slots that replace those of the theory."""
        with deep_recursion(EVALUATION):
            return initial_state(self.interpreter, self.compiler, given)

    def possible(self, state: State, action: str, args: Args) -> bool:
        """Whether the action's preconditions are known to hold."""
        return bool(self._possible[action](state, *args))

    def possible_function(self, action: str) -> Callable[..., bool]:
        """The compiled precondition: a function of the state and each argument."""
        return self._possible[action]

    def progress(self, state: State, action: str, args: Args) -> State:
        """The state after the action: all its effects at once, everything else unchanged."""
        after: State = self._progress[action](state, *args)
        return after

    def cost(self, state: State, action: str, args: Args) -> Number:
        """What the action costs in the situation before it: at least 0; 1 if the theory does not say.

        Where that is not known, the most that it may cost.
        """
        function = self._cost[action]
        costs: Iterator[tuple[Assignment, Number]] = survey(state, lambda world: function(world, *args))
        return max(cost for _, cost in costs)

    def outcomes(self, state: State, action: str, args: Args) -> list[Outcome]:
        """What the sensing of an action may answer in a state (the one after its effects), each with the state then.

        In the order of the possible worlds; one outcome if the agent knows what will be sensed.
        """
        cases: dict[tuple[Value, ...], list[Assignment]] = {}
        with placed(self.theory.actions[action].senses):
            for case, results in self._sensed(state, action, args):
                cases.setdefault(results, []).append(case)
            return [Outcome(results, keep(state, kept)) for results, kept in cases.items()]

    def sense(self, world: World, action: str, args: Args) -> tuple[Value, ...]:
        """What the action's sensed terms are in a world (the one after its effects), in order."""
        return tuple(self._sense[action](world, *args))

    def assimilate(
        self, state: State, action: str, args: Args, results: Sequence[Value]
    ) -> tuple[State, list[Surprise]]:
        """Put sensing results into the state after the action's effects.

        The worlds that agree with them remain. If there is none, a sensed fluent takes the value in every world.
        """
        senses = self.theory.actions[action].senses
        with placed(senses):
            kept = [case for case, sensed in self._sensed(state, action, args) if sensed == tuple(results)]
            if kept:
                return keep(state, kept), []
        surprises = []
        for number, (term, sensed) in enumerate(zip(senses, results, strict=True)):
            cases = [(case, answer[number]) for case, answer in self._sensed(state, action, args)]
            kept = [case for case, answer in cases if answer == sensed]
            if kept:
                state = keep(state, kept)
                continue
            expected = agreed(answer for _, answer in cases)
            state, name = self._put(state, term, args, sensed)
            surprises.append(Surprise(action, sensed, expected, name, term.span))
        return state, surprises

    def witness(self, state: State, action: str, args: Args) -> State | None:
        """What is possible when an exogenous action has occurred, before its effects: the worlds in which it could.

        None if it could in no world.
        """
        function = self._possible_in[action]
        with placed(self.theory.actions[action].preconditions):
            cases = survey(state, lambda world: function(world, *args))
            kept = [case for case, could in cases if could]
            return keep(state, kept) if kept else None

    def realize(self, state: State, choose: Callable[[int], int] = lambda count: 0) -> World:
        """One of the possible worlds; ``choose`` takes one of so many alternatives, by default the first."""
        if not isinstance(state, Worlds):
            return state
        return state.world([factor.rows[choose(len(factor.rows))] for factor in state.factors])

    def _sensed(self, state: State, action: str, args: Args) -> Iterator[tuple[Assignment, tuple[Value, ...]]]:
        function = self._sense[action]
        return survey(state, lambda world: function(world, *args))

    def _put(self, state: State, term: Term, args: Args, value: Value) -> tuple[State, str | None]:
        """Give a sensed fluent a value in every world, if it is one and its arguments are known."""
        if not isinstance(term, FluentTerm):
            return state, None
        place = self.layout.places[term.fluent]
        of = tuple(self.knowing.evaluate(arg, state, args) for arg in term.args)
        if any(isinstance(arg, Unknown) for arg in of):
            return state, None
        if value not in place.fluent.type:
            raise errors.value_outside(term.span, show_call(term.fluent, of), value, place.fluent.type)
        return with_value(state, place.slot(of), value), show_call(term.fluent, of)

    def value(self, state: State, fluent: str, args: Args = ()) -> Value:
        """The value of a ground fluent; an ``Unknown`` if the worlds disagree."""
        place = self.layout.places[fluent]
        return spelt(shown(state)[place.slot(args)], place.fluent.type)

    def values(self, state: State) -> Iterator[tuple[tuple[str, Args], Value]]:
        """Each ground fluent, as name and arguments, with its value or an ``Unknown``, as they are to be written."""
        fluents = self.theory.fluents
        for (name, args), value in zip(self.layout.ground_fluents, shown(state), strict=True):
            yield (name, args), spelt(value, fluents[name].type)

    def show(self, state: State) -> dict[str, Value]:
        """Each ground fluent as text with its value or an ``Unknown``."""
        return {show_call(*name): value for name, value in self.values(state)}

    def call(self, action: str, args: Args) -> str:
        """A ground action as text."""
        parameters = self.theory.actions[action].parameters
        return show_call(action, [spelt(arg, p.type) for arg, p in zip(args, parameters, strict=True)])

    def misfit(self, action: str, args: Args) -> str | None:
        """What is wrong with the arguments of a ground action, or none: their number or their types."""
        parameters = self.theory.actions[action].parameters
        if len(args) != len(parameters):
            takes = f"{len(parameters)} argument{'' if len(parameters) == 1 else 's'}"
            return f"`{action}` takes {takes}, not {len(args)}"
        for parameter, arg in zip(parameters, args, strict=True):
            if arg not in parameter.type:
                call = show_call(action, args)
                return f"{show(arg)} in `{call}` is outside {describe(parameter.type, parameter.span)}"
        return None

    def _compile_possible_in(self, name: str) -> Callable[..., bool]:
        function: Callable[..., bool] = self.compiler.namespace[self.compiler.precondition(name)]
        return function

    def _compile_possible(self, name: str) -> Callable[..., bool]:
        return self.knowing.known_true(self._possible_in[name], self.theory.actions[name].preconditions)

    def _compile_sense(self, name: str) -> Callable[..., tuple[Value, ...]]:
        action = self.theory.actions[name]
        cells = variables(len(action.parameters))
        terms = "".join(f"{self.compiler.expression(term, cells)}, " for term in action.senses)
        return self.compiler.function(_signature(cells), [f"return ({terms})"])

    def _compile_cost(self, name: str) -> Callable[..., Number]:
        action = self.theory.actions[name]
        cells = variables(len(action.parameters))
        if action.cost is None:
            return self.compiler.function(_signature(cells), ["return 1"])
        span = action.cost.span

        def negative(cost: Number, *args: Value) -> None:
            raise errors.negative_cost(span, show_call(name, args), cost)

        call = f"{self.compiler.bind('negative', negative)}(c{''.join(f', {cell.text}' for cell in cells)})"
        lines = [f"c = {self.compiler.some(action.cost, cells, 0, 'a cost')}", f"if c < 0: {call}", "return c"]
        return self.compiler.function(_signature(cells), lines)

    def _compile_progress(self, name: str) -> Callable[..., State]:
        action = self.theory.actions[name]
        if not action.effects or not self.compiler.uncertain:
            return self._compile_certain(action)
        branching = Branching(action, self.layout, self.compiler)
        values = [effect.value for effect in action.effects]

        def several(state: State, *args: Value) -> State:
            with placed([value.among if isinstance(value, Choice) else value for value in values]):
                return branching.progress(state, args)

        if any(isinstance(value, Choice) for value in values):
            return several
        certain = self._compile_certain(action)
        return lambda state, *args: certain(state, *args) if type(state) is tuple else several(state, *args)

    def _compile_certain(self, action: Action) -> Callable[..., World]:
        cells = variables(len(action.parameters))
        if not action.effects:
            return self.compiler.function(_signature(cells), ["return s"])
        if _may_conflict(action):
            lines = ["w = {}", *self._effect_lines(action, cells, collect=True), "r = list(s)"]
            lines += ["for i in w: r[i] = w[i]", "return tuple(r)"]
        else:
            lines = ["r = list(s)", *self._effect_lines(action, cells, collect=False), "return tuple(r)"]
        return self.compiler.function(_signature(cells), lines)

    def _effect_lines(self, action: Action, cells: Cells, collect: bool) -> list[str]:
        lines = []
        for effect in action.effects:
            indent, inner = "", cells
            for binder in effect.binders:
                inner, loop = self.compiler.loops((binder,), None, inner)
                lines.append(f"{indent}{loop}:")
                indent += "  "
            for condition in (effect.where, effect.condition):
                if condition is not None:
                    lines.append(f"{indent}if {self.compiler.formula(condition, inner)}:")
                    indent += "  "
            lines += [indent + line for line in self._assignment(effect, inner, collect)]
        return lines

    def _assignment(self, effect: Effect, cells: Cells, collect: bool) -> list[str]:
        place = self.layout.places[effect.fluent]
        slot = self.compiler.slot(place, effect.args, cells)
        assert not isinstance(effect.value, Choice)
        lines = [f"i = {slot}", f"x = {self.compiler.expression(effect.value, cells)}"]
        if not includes(place.fluent.type, effect.value.type):
            values = self.compiler.bind("type", place.fluent.type)
            lines.append(f"if x not in {values}: {self.compiler.bind('outside', self._outside(effect))}(i, x)")
        if not collect:
            return [*lines, "r[i] = x"]
        conflict = self.compiler.bind("conflict", self._conflict(effect))
        return [*lines, f"if w.setdefault(i, x) != x: {conflict}(i, w[i], x)"]

    def _outside(self, effect: Effect) -> Callable[[int, Value], None]:
        assert not isinstance(effect.value, Choice)
        span = effect.value.span

        def outside(slot: int, value: Value) -> None:
            name, args = self.layout.ground_fluents[slot]
            type_ = self.theory.fluents[name].type
            raise errors.value_outside(span, show_call(name, args), value, type_)

        return outside

    def _conflict(self, effect: Effect) -> Callable[[int, Value, Value], None]:
        def conflict(slot: int, first: Value, second: Value) -> None:
            raise errors.conflicting_effects(effect.span, show_call(*self.layout.ground_fluents[slot]), first, second)

        return conflict


class _Lazy(dict[str, Callable[..., Any]]):
    """Compiles a function for an action when it is first asked for."""

    def __init__(self, make: Callable[[str], Callable[..., Any]]) -> None:
        super().__init__()
        self._make = make

    def __missing__(self, name: str) -> Callable[..., Any]:
        with deep_recursion():
            self[name] = function = self._make(name)
        return function


def _signature(cells: Cells) -> str:
    return ", ".join(["s", *(cell.text for cell in cells)])


def _may_conflict(action: Action) -> bool:
    """Whether two of an action's effects, or two bindings of one, might touch the same ground fluent."""
    fluents = [effect.fluent for effect in action.effects]
    return len(set(fluents)) < len(fluents) or not all(is_injective(effect) for effect in action.effects)


def is_injective(effect: Effect) -> bool:
    """Whether different bindings certainly lead to different arguments: each bound variable is one of them."""
    args = {arg.level for arg in effect.args if isinstance(arg, Variable)}
    return all(binder.variable.level in args for binder in effect.binders)
