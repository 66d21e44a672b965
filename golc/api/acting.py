"""What can be done in a state, why something cannot, and what comes of it."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import TypeAlias

from golc.diagnostics import Code, Diagnostic, Label, ProgramError, Source, Span, UserError, counted
from golc.program.blame import Blocked, obstacles, valued
from golc.program.labels import Act, Expect
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.fitting import MOST_INSTANCES, combinations
from golc.theory.foreign import golc_value
from golc.theory.forms import describe
from golc.theory.ground import Call, read_action
from golc.theory.theory import Action
from golc.theory.types import Value, show

Doing: TypeAlias = str | Call | Act | Expect
"""An action with its arguments: as text, as in ``"push(left)"``, as a ``Call``, or as a step of a plan."""


def call_of(dynamics: Dynamics, doing: Doing) -> Call:
    """The ground action that somebody means; raises ``UserError`` if the theory has none such."""
    if isinstance(doing, str):
        return read_action(dynamics.theory, doing)
    call = Call(doing.action, doing.args)
    action = dynamics.theory.actions.get(call.action)
    if action is None:
        return read_action(dynamics.theory, call.action)
    if len(call.args) == len(action.parameters):
        args = [golc_value(arg, parameter.type) for arg, parameter in zip(call.args, action.parameters, strict=True)]
        call = Call(call.action, tuple(args))
    problem = dynamics.misfit(call.action, call.args)
    if problem is not None:
        raise UserError(_diagnostic(call, problem))
    return call


def listed(dynamics: Dynamics, state: State, exogenous: bool) -> Iterator[Call]:
    """The ground actions that are possible, in the order of declaration, the last argument fastest.

    Primitive ones that are known to be possible, or exogenous ones that may happen by what is known. Those of an action
    whose instances cannot be listed, or are too many, are left out.
    """
    for action in dynamics.theory.actions.values():
        if action.exogenous is exogenous and _is_listable(action):
            for args in itertools.product(*[parameter.type.values for parameter in action.parameters]):
                if _can_be(dynamics, state, action, args):
                    yield Call(action.name, args)


def _is_listable(action: Action) -> bool:
    count = combinations([parameter.type for parameter in action.parameters])
    return count is not None and count <= MOST_INSTANCES


def _can_be(dynamics: Dynamics, state: State, action: Action, args: tuple[Value, ...]) -> bool:
    if action.exogenous:
        return dynamics.witness(state, action.name, args) is not None
    return dynamics.possible(state, action.name, args)


def against(dynamics: Dynamics, state: State, call: Call) -> tuple[Blocked, ...]:
    """Each part of the precondition that keeps an action from being done, or from happening; none if nothing does."""
    if _can_be(dynamics, state, dynamics.theory.actions[call.action], call.args):
        return ()
    return tuple(obstacles(dynamics, state, call.action, call.args))


def after(dynamics: Dynamics, state: State, call: Call, sensed: Sequence[object]) -> State:
    """The state after an action, which has sensed something if it is one that senses.

    Raises ``ProgramError`` if it is not possible or cannot sense this, ``UserError`` if it is not clear what it senses.
    """
    action = dynamics.theory.actions[call.action]
    if not _can_be(dynamics, state, action, call.args):
        raise _impossible(dynamics, state, call)
    if action.exogenous:
        state = dynamics.witness(state, call.action, call.args) or state
    state = dynamics.progress(state, call.action, call.args)
    outcomes = dynamics.outcomes(state, call.action, call.args)
    if not sensed and len(outcomes) == 1:
        return outcomes[0].state
    results = _results(dynamics, action, call, sensed)
    for outcome in outcomes:
        if outcome.results == results:
            return outcome.state
    may = " or ".join([_listing(outcome.results) for outcome in outcomes[:5]])
    problem = f"`{dynamics.call(call.action, call.args)}` cannot sense {_listing(results)} here, only {may}"
    raise ProgramError(Diagnostic(Code.SURPRISE, problem, action.senses[0].span))


def _results(dynamics: Dynamics, action: Action, call: Call, sensed: Sequence[object]) -> tuple[Value, ...]:
    """Sensing results as golc's values, one for each term that is sensed."""
    senses = action.senses
    if len(sensed) != len(senses):
        what = ", ".join([f"`{' '.join(term.span.text.split())}`: {describe(term.type, term.span)}" for term in senses])
        problem = f"`{dynamics.call(call.action, call.args)}` senses {what or 'nothing'}"
        problem += f"; {counted(len(sensed), 'value')} given" if sensed else ", and the value is not known"
        help_ = "say after the action what it senses: do(state, action, value)" if senses else None
        raise UserError(_diagnostic(call, problem, help_))
    results = tuple([golc_value(value, term.type) for value, term in zip(sensed, senses, strict=True)])
    for given, value, term in zip(sensed, results, senses, strict=True):
        if value not in term.type:
            type_ = describe(term.type, term.span)
            raise UserError(_diagnostic(call, f"the sensed value {given!r} is outside {type_}"))
    return results


def _impossible(dynamics: Dynamics, state: State, call: Call) -> ProgramError:
    action = dynamics.theory.actions[call.action]
    code = Code.IMPOSSIBLE_EVENT if action.exogenous else Code.EVENT
    labels = tuple([Label(part.span, valued(part)) for part in against(dynamics, state, call)])
    message = f"`{dynamics.call(call.action, call.args)}` is not possible in this state"
    return ProgramError(Diagnostic(code, message, action.span, labels=labels))


def _diagnostic(call: Call, message: str, help_: str | None = None) -> Diagnostic:
    text = str(call)
    return Diagnostic(Code.EVENT, message, Span(Source("<action>", text), 0, len(text)), help=help_)


def _listing(values: Sequence[Value]) -> str:
    return ", ".join(map(show, values))
