"""Random walks through the examples: what is listed as possible can be done; for everything else there is a reason."""

from __future__ import annotations

from functools import cache
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import golc

EXAMPLES = Path(__file__).parents[2] / "examples"


@cache
def theory(name: str) -> golc.Theory:
    return golc.load(EXAMPLES / name / f"{name}.gl")


def instances(theory: golc.Theory) -> list[golc.Call]:
    """Every ground action of a theory whose parameters are all finite."""
    return [
        golc.Call(action.name, args)
        for action in theory.actions.values()
        if all(parameter.type.finite for parameter in action.parameters)
        for args in product(*[parameter.type.values for parameter in action.parameters])
    ]


@given(name=st.sampled_from(["delivery", "gates", "sorter", "greenhouse"]), data=st.data())
def test_what_is_possible_can_be_done_and_nothing_else(name: str, data: st.DataObject) -> None:
    domain = theory(name)
    state = domain.initial()
    for _ in range(data.draw(st.integers(0, 5))):
        own, events = domain.possible(state), domain.possible(state, exogenous=True)
        for call in instances(domain):
            listed = call in (events if domain.actions[call.action].exogenous else own)
            assert (domain.why_not(state, call) == ()) is listed
            if not listed:
                with pytest.raises(golc.ProgramError):
                    domain.do(state, call)
        if not own + events:
            return
        before = dict(state)
        state, old = _done(domain, state, data.draw(st.sampled_from(own + events)), data), state
        assert dict(old) == before


def _done(theory: golc.Theory, state: golc.State, call: golc.Call, data: st.DataObject) -> golc.State:
    """The state after an action; what it senses is any value that it may sense."""
    try:
        return theory.do(state, str(call))
    except golc.UserError:
        senses = theory.actions[call.action].senses
        possible = []
        for values in product(*[term.type.values for term in senses]):
            try:
                possible.append(theory.do(state, call, *values))
            except golc.ProgramError:
                continue
        assert len(possible) > 1
        assert all(after.worlds <= state.worlds for after in possible)
        return data.draw(st.sampled_from(possible))
