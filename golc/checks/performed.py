"""The primitive actions that a statement may perform, also in the procedures that it calls."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from golc.theory import statements as st
from golc.theory.calls import components, substatements
from golc.theory.statements import Statement
from golc.theory.theory import Procedure


class Performed:
    """Of the procedures of a theory they are found out once."""

    def __init__(self, procedures: Mapping[str, Procedure]) -> None:
        direct = {name: _direct(procedure.body) for name, procedure in procedures.items()}
        self._by: dict[str, frozenset[str]] = {}
        for part in components({name: called for name, (_, called) in direct.items()}):
            own = [direct[name][0] for name in part]
            callees = [self._by[called] for name in part for called in direct[name][1] if called in self._by]
            self._by |= dict.fromkeys(part, frozenset[str]().union(*own, *callees))

    def by(self, statement: Statement) -> frozenset[str]:
        """By one statement."""
        actions, called = _direct(statement)
        return actions.union(*[self._by[name] for name in called])

    def by_others(self, statements: Sequence[Statement]) -> list[frozenset[str]]:
        """By all but one of some statements, for each of them."""
        each = [self.by(statement) for statement in statements]
        times = Counter(action for actions in each for action in actions)
        return [frozenset(times) - {action for action in actions if times[action] == 1} for actions in each]


def _direct(statement: Statement) -> tuple[frozenset[str], frozenset[str]]:
    """The actions in a statement itself, and the procedures that it calls."""
    actions, called = set(), set()
    for part in substatements(statement):
        match part:
            case st.Perform(action=name):
                actions.add(name)
            case st.Invoke(procedure=name):
                called.add(name)
    return frozenset(actions), frozenset(called)
