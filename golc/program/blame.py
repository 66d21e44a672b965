"""Why a program cannot go on: what the rules reported, put into words with the values that things had."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from golc.diagnostics import ProgramError, Span
from golc.program.labels import Act, Expect
from golc.situation.dynamics import Dynamics
from golc.situation.knowing import who_senses
from golc.situation.worlds import State
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.terms import Operation, Operator, Term
from golc.theory.types import Value, show, show_call

if TYPE_CHECKING:
    from golc.program.paths import NoPath, Path


@dataclass(frozen=True)
class Blamed:
    """The place of a rule that had no transition, the reason's name, and what belongs to it."""

    span: Span
    reason: str
    details: tuple[Any, ...]


@dataclass(frozen=True)
class Blocked:
    """A branch that cannot go on: its place, a sentence, and the values of what the failed condition speaks of.

    ``actions``: where a plan of ``search`` was lost, how many actions had been done under it.
    """

    span: Span
    text: str
    values: tuple[tuple[str, Value], ...] = ()
    actions: int | None = None

    def __str__(self) -> str:
        return f"{self.span}: {valued(self)}"


def explain(dynamics: Dynamics, state: State, blamed: Blamed) -> Blocked:
    """What a rule reported, in words."""
    with deep_recursion(EVALUATION):
        return _explained(dynamics, state, blamed)


def _explained(dynamics: Dynamics, state: State, blamed: Blamed) -> Blocked:
    span, details = blamed.span, blamed.details
    match blamed.reason:
        case "false":
            return _not_true(dynamics, state, span, *details)
        case "impossible":
            return _impossible(dynamics, state, span, *details)
        case "no interrupt":
            handler, env = details
            text = f"no interrupt here: `{_text(handler.term)}` is not known to hold"
            if not dynamics.compiler.uncertain:
                text = f"no interrupt here: `{_text(handler.term)}` does not hold"
            return Blocked(handler.span, text, _values(dynamics, handler.term, state, env))
        case "undecided":
            (error,) = details
            return Blocked(error.diagnostic.span, error.diagnostic.message)
        case "no value":
            return Blocked(span, "no value can be picked")
        case "waits":
            return Blocked(
                span, "look-ahead cannot wait: nothing happens while it thinks" + _unexpected(dynamics, state)
            )
        case "waits for":
            blocked = _not_true(dynamics, state, span, *details)
            return replace(blocked, text=blocked.text + _unexpected(dynamics, state))
        case "pruned":
            return pruned(span, *details)
        case "aborts":
            return Blocked(span, "the program would end itself as failed here")
        case "lost":
            return _lost(dynamics, state, *details)
        case _:
            (none,) = details
            return Blocked(span, "`search` finds no way to the end of its block" + _how_far(none))


def valued(branch: Blocked) -> str:
    """Why a branch cannot go on, with the values that things have, in one line."""
    values = ", ".join(f"{name} = {show(value)}" for name, value in branch.values)
    return branch.text + (f" ({values})" if values else "")


def false_parts(dynamics: Dynamics, state: State, formula: Term, env: tuple[Value, ...] = ()) -> list[Blocked]:
    """Each conjunct of a formula that is not known to be true in a state, with the values of what it speaks of.

    ``env``: the values of its variables. Behind a false conjunct others may have no value (``x != none and x < 3``);
    those are left out.
    """
    found = []
    with deep_recursion(EVALUATION):
        for part in _conjuncts(formula):
            try:
                holds = dynamics.knowing.verdict(part, state, env)
            except ProgramError:
                continue
            if not holds:
                text = f"`{_text(part)}` {_is(dynamics, part, holds)}"
                found.append(Blocked(part.span, text, _values_if_any(dynamics, part, state, env)))
    return found


def obstacles(dynamics: Dynamics, state: State, action: str, args: tuple[Value, ...]) -> list[Blocked]:
    """Each part of an action's precondition that is not known to be true in a state."""
    preconditions = dynamics.theory.actions[action].preconditions
    return [part for term in preconditions for part in false_parts(dynamics, state, term, args)]


def _values_if_any(
    dynamics: Dynamics, term: Term, state: State, env: tuple[Value, ...]
) -> tuple[tuple[str, Value], ...]:
    """The values of what a term speaks of; none where a part that decides nothing has no value."""
    try:
        return _values(dynamics, term, state, env)
    except ProgramError:
        return ()


def _not_true(dynamics: Dynamics, state: State, span: Span, term: Term, env: tuple[Value, ...]) -> Blocked:
    """A formula that is not known to be true, and whether it is false."""
    text = f"`{_text(term)}` {_is(dynamics, term, dynamics.knowing.verdict(term, state, env))}"
    return Blocked(span, text, _values(dynamics, term, state, env))


def _is(dynamics: Dynamics, term: Term, verdict: bool | None) -> str:
    """What is the matter with a formula that is not known to be true."""
    if verdict is not None:
        return "is false"
    senses = who_senses(dynamics.knowing.sensing(term))
    return "is not known" + (f" ({senses})" if senses else ", and no action senses it")


def impossible(dynamics: Dynamics, state: State, action: str, args: tuple[Value, ...]) -> Blocked:
    """Which part of an action's precondition is false in a state."""
    with deep_recursion(EVALUATION):
        return _impossible(dynamics, state, dynamics.theory.actions[action].span, action, args)


def _impossible(dynamics: Dynamics, state: State, span: Span, action: str, args: tuple[Value, ...]) -> Blocked:
    call = dynamics.call(action, args)
    for term in dynamics.theory.actions[action].preconditions:
        for part in _conjuncts(term):
            verdict = dynamics.knowing.verdict(part, state, args)
            if not verdict:
                text = f"`{call}` is not possible: `{_text(part)}` {_is(dynamics, part, verdict)}"
                return Blocked(span, text, _values(dynamics, part, state, args))
    return Blocked(span, f"`{call}` is not possible")


def pruned(span: Span, prune: str, label: Act | Expect, results: tuple[Value, ...] = ()) -> Blocked:
    """An action is possible and leads, where it has these results, to a situation that look-ahead does not enter."""
    answer = f" where it answers {', '.join(map(show, results))}" if results else ""
    return Blocked(span, f"`{show_call(label.action, label.args)}` is pruned by `{prune}`{answer}")


def _how_far(none: NoPath) -> str:
    """How far a search came that found no way, and what stopped it."""
    text = f"; {none.limit}" if none.limit else ""
    if none.reasons:
        way = f"the longest way was {', '.join(none.deepest)}; there" if none.deepest else "stuck at once:"
        text += f"; {way} {' and '.join(map(valued, none.reasons))}"
    return text


def _unexpected(dynamics: Dynamics, state: State) -> str:
    """Why none of the expected exogenous actions happens, if there are any."""
    expected = [action for action in dynamics.theory.actions.values() if action.expected]
    reasons = [
        f"no `{action.name}` is possible"
        if action.parameters
        else valued(_impossible(dynamics, state, action.span, action.name, ()))
        for action in expected
    ]
    return f", and nothing is expected: {'; '.join(reasons)}" if reasons else ""


def _lost(dynamics: Dynamics, state: State, path: Path, index: int, none: NoPath) -> Blocked:
    """A plan that no longer leads to the end: what it expected, and how the state is instead."""
    expected = dynamics.show(path.states[index])
    changed = tuple((name, value) for name, value in dynamics.show(state).items() if expected[name] != value)
    were = ", ".join(f"{name} = {show(expected[name])}" for name, _ in changed)
    text = "the plan of `search` no longer leads to its end, and alternatives that it has passed are lost"
    if changed:
        text += f"; it counted on {were}"
    text += _how_far(none)
    at = path.labels[index].span if index < len(path.labels) else path.labels[-1].span
    return Blocked(at, text, changed, path.actions(index))


def _conjuncts(term: Term) -> Iterator[Term]:
    stack = [term]
    while stack:
        term = stack.pop()
        if isinstance(term, Operation) and term.op is Operator.AND:
            stack.extend(reversed(term.args))
        else:
            yield term


def _text(term: Term) -> str:
    return " ".join(term.span.text.split())


def _values(dynamics: Dynamics, term: Term, state: State, env: tuple[Value, ...]) -> tuple[tuple[str, Value], ...]:
    return tuple(dynamics.knowing.spoken_of(term, state, env).items())
