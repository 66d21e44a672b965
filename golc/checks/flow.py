"""Programs: what can never happen where it stands (row 6 of what ``golc check`` proves).

Each procedure is walked through with what is known to hold at every place: the conditions passed on the way there, as
long as nothing that may happen since has touched them. Exogenous actions and the other parts of a concurrent program
may come between any two steps, unless they are impossible as long as the conditions hold.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from golc.checks.connected import Connected
from golc.checks.obligations import Obligations
from golc.checks.performed import Performed
from golc.diagnostics import Code, Label, Span
from golc.proofs.among import Among
from golc.proofs.questions import Asked, Question, Step
from golc.theory import statements as st
from golc.theory.reading import fluents_read
from golc.theory.statements import Statement
from golc.theory.terms import Binder, Literal, Operation, Operator, PossTerm, Term
from golc.theory.theory import Parameter
from golc.theory.types import BOOL

MOST_KNOWN = 50
"""How many formulas are remembered at a place, the latest; each is looked at wherever something is asked."""


@dataclass(frozen=True)
class Place:
    """What is known at some place of a program.

    ``variables`` are those in scope; ``known`` are formulas over them that hold there. ``others``: the actions that may
    come between two steps. ``guards``: conditions without which no step is made.
    """

    variables: tuple[Parameter, ...]
    known: tuple[Asked, ...] = ()
    others: frozenset[str] = frozenset()
    guards: tuple[Asked, ...] = ()

    def asked(self, term: Term, false: bool = False) -> Asked:
        """A formula of the program here."""
        return Asked(term, tuple(range(len(self.variables))), false)

    def knowing(self, *more: Asked) -> Place:
        """The same place, with more that holds."""
        return replace(self, known=tuple(dict.fromkeys((*self.known, *more)))[-MOST_KNOWN:])

    def inside(self, binders: Iterable[Binder]) -> Place:
        """The place with further variables, of which those that run over a collection are elements of it."""
        place = self
        for binder in binders:
            place = replace(place, variables=(*place.variables, Parameter(binder.variable.name, binder.variable.type)))
            within = binder.within
            if within is not None:
                element = Operation(Operator.ELEMENT, (binder.variable, within), type=BOOL, span=within.span)
                place = place.knowing(place.asked(element))
        return place


class Flow:
    """Walks through the programs of a theory."""

    def __init__(self, obligations: Obligations) -> None:
        self._obligations = obligations
        self._theory = theory = obligations.theory
        self._touched = {
            action.name: frozenset(effect.fluent for effect in action.effects) | fluents_read(theory, action.senses)
            for action in theory.actions.values()
        }
        self._touching: dict[str, set[str]] = {}
        """The actions that touch a fluent."""
        for name, touched in self._touched.items():
            for fluent in touched:
                self._touching.setdefault(fluent, set()).add(name)
        self._performed = Performed(theory.procedures)
        self._connected = Connected(theory, some=isinstance(obligations.prover, Among))
        self._exogenous = frozenset(action.name for action in theory.actions.values() if action.exogenous)

    def check(self) -> None:
        """Every procedure, whoever calls it."""
        for procedure in self._theory.procedures.values():
            self._walk(procedure.body, Place(procedure.parameters, others=self._exogenous))

    def _walk(self, statement: Statement, place: Place) -> Place:
        """What is known after a statement."""
        match statement:
            case st.Sequence(parts=parts):
                for part in parts:
                    place = self._walk(part, place)
                return place
            case st.Perform():
                return self._perform(statement, place)
            case st.Test(condition=condition):
                if self._constant(condition, place, "this test", (False,)) is False:
                    return replace(place, known=())
                return self._later(place.knowing(place.asked(condition)))
            case st.WaitUntil():
                return self._wait_until(statement, place)
            case st.Wait() | st.WaitTime() | st.Say():
                return self._later(place)
            case st.If():
                return self._if(statement, place)
            case st.While():
                return self._while(statement, place)
            case st.Choose(branches=branches):
                return self._common(place, [self._walk(branch, place) for branch in branches])
            case st.Together(branches=branches) | st.Prefer(branches=branches):
                return self._concurrent(branches, place)
            case st.Interrupts():
                return self._interrupts(statement, place)
            case st.Pick(body=body):
                self._some(statement, place)
                return self._after_all(body, place)
            case st.For(body=body):
                place = self._after_all(body, place)
                self._some(statement, place)
                return place
            case st.Let(variable=variable, value=value, body=body):
                inner = place.inside((Binder(variable),))
                equal = Operation(Operator.EQUAL, (variable, value), type=BOOL, span=value.span)
                self._walk(body, inner.knowing(inner.asked(equal)))
                return self._after_all(body, place)
            case st.Guard(condition=condition, body=body):
                if self._constant(condition, place, "this condition", (False,)) is not False:
                    held = place.asked(condition)
                    self._walk(body, replace(place, guards=(*place.guards, held)).knowing(held))
                return self._after_all(body, place)
            case st.TogetherStar(body=body):
                others = place.others | self._performed.by(body)
                return self._repeated(body, replace(place, others=others), place)
            case st.Star(body=body):
                return self._repeated(body, place, place)
            case st.Search(body=body) | st.Within(body=body):
                self._walk(body, place)
                if isinstance(statement, st.Within):
                    self._walk(statement.otherwise, self._after_all(body, place))
                return self._after_all(statement, place)
            case st.Invoke():
                return self._after_all(statement, place)
            case _:
                return place

    def _perform(self, statement: st.Perform, place: Place) -> Place:
        action = self._theory.actions[statement.action]
        possible = place.asked(PossTerm(statement.action, statement.args, type=BOOL, span=statement.span))
        if action.preconditions and action.name not in self._obligations.never_possible:
            here = self._connected.known((*place.guards, *place.known), (possible,))
            what = f"whether `{statement.span.text}` is ever possible here"
            # An instance may never be possible whatever is known, though others of the action are.
            if (here or statement.args) and self._never(place, (*here, possible), what, statement.span):
                culprits = [known for known in here if self._never(place, (known, possible), "", statement.span)]
                labels = [Label(known.term.span, _held(known)) for known in culprits or here]
                message = f"`{statement.span.text}` can never be possible here"
                self._obligations.warning(
                    Code.STUCK, message, statement.span, "never possible", (*labels, *self._why(statement))
                )
                return replace(place, known=())
        return self._later(self._without(place.knowing(possible), self._touched[statement.action]))

    def _why(self, statement: st.Perform) -> list[Label]:
        return [Label(part.span, "needs this") for part in self._theory.actions[statement.action].preconditions[:1]]

    def _if(self, statement: st.If, place: Place) -> Place:
        holds, fails = place.asked(statement.condition), place.asked(statement.condition, false=True)
        always = self._constant(statement.condition, place, "this condition")
        ends = [] if always is False else [self._walk(statement.then, place.knowing(holds))]
        return self._common(place, ends if always else [*ends, self._walk(statement.otherwise, place.knowing(fails))])

    def _while(self, statement: st.While, place: Place) -> Place:
        condition = statement.condition
        place = self._after_all(statement.body, place)
        always = self._constant(condition, place, "this condition")
        if always is False:
            return place
        self._walk(statement.body, place.knowing(place.asked(condition)))
        if always:
            return replace(place, known=())
        reads = fluents_read(self._theory, [condition])
        changing = self._performed.by(statement.body) | place.others
        if reads and not any(self._touched[name] & reads for name in changing):
            message = "nothing in this loop changes its condition, so that it never ends once it has begun"
            self._obligations.warning(Code.ENDLESS_LOOP, message, condition.span, "stays as it is")
        return place.knowing(place.asked(condition, false=True))

    def _wait_until(self, statement: st.WaitUntil, place: Place) -> Place:
        """What is known once a condition holds, which may be when anything has happened meanwhile."""
        later = self._later(place, self._exogenous | place.others)
        if self._constant(statement.condition, later, "this condition", (False,)) is False:
            return replace(later, known=())
        return later.knowing(place.asked(statement.condition))

    def _some(self, statement: st.Pick | st.For, place: Place) -> None:
        """The body of a statement that binds variables."""
        inner, where = place.inside(statement.binders), statement.where
        if where is None:
            self._walk(statement.body, inner)
        elif self._constant(where, inner, "this condition", (False,)) is not False:
            self._walk(statement.body, inner.knowing(inner.asked(where)))

    def _concurrent(self, branches: Sequence[Statement], place: Place) -> Place:
        for branch, rest in zip(branches, self._performed.by_others(branches), strict=True):
            self._walk(branch, self._later(replace(place, others=place.others | rest)))
        return self._later(place, place.others.union(*map(self._performed.by, branches)))

    def _interrupts(self, statement: st.Interrupts, place: Place) -> Place:
        place = self._later(place, place.others | self._performed.by(statement))
        rests = self._performed.by_others([handler.body for handler in statement.handlers])
        for handler, rest in zip(statement.handlers, rests, strict=True):
            inner = place.inside(handler.binders)
            if self._fires(handler, inner):
                among = replace(inner, others=place.others | rest)
                self._walk(handler.body, among.knowing(inner.asked(handler.condition)))
        return place

    def _fires(self, handler: st.Interrupt, place: Place) -> bool:
        """Whether an interrupt may fire; otherwise that is reported."""
        condition = handler.condition
        fires = place.asked(condition)
        known = self._connected.known(place.known, (fires,))
        what = "whether this interrupt can ever fire"
        if not isinstance(condition, Literal) and self._never(place, (*known, fires), what, condition.span):
            message = f"this interrupt can never fire: its condition is false {self._obligations.everywhere}"
            self._obligations.warning(Code.NEVER_FIRES, message, condition.span, "never true")
            return False
        return True

    def _constant(
        self, condition: Term, place: Place, what: str, only: tuple[bool, ...] = (False, True)
    ) -> bool | None:
        """Report a condition that is always false, or always true, of which only some are asked, and which of them it
        is. What reads no fluent is a matter of constants, which may well be meant."""
        if not fluents_read(self._theory, [condition]):
            return None
        known = self._connected.known((*place.guards, *place.known), (place.asked(condition),))
        for value, always, never in ((False, "always false", "never true"), (True, "always true", "never false")):
            asked = (*known, place.asked(condition, false=value))
            question = f"whether {what} is {always}"
            if value in only and self._never(place, asked, question, condition.span):
                self._obligations.warning(Code.CONSTANT, f"{what} is {always} here", condition.span, never)
                return value
        return None

    def _never(self, place: Place, steps: tuple[Step, ...], what: str, span: Span) -> bool:
        return self._obligations.is_impossible(Question(place.variables, steps), what, span)

    def _later(self, place: Place, others: frozenset[str] | None = None) -> Place:
        """Other actions may have happened meanwhile, as often as they are possible."""
        others = place.others if others is None else others
        while True:
            reads = frozenset[str]().union(*map(self._connected.fluents, place.known))
            near = frozenset[str]().union(*[self._touching.get(fluent, ()) for fluent in reads]) & others
            touched = frozenset[str]().union(*[self._touched[name] for name in near if self._may_happen(name, place)])
            kept = self._without(place, touched)
            if kept.known == place.known:
                return kept
            place = kept

    def _may_happen(self, name: str, place: Place) -> bool:
        action = self._theory.actions[name]
        first = len(place.variables)
        env = tuple(range(first, first + len(action.parameters)))
        possible = [Asked(condition, env) for condition in action.preconditions]
        steps = (*self._connected.known(place.known, possible), *possible)
        variables = (*place.variables, *action.parameters)
        return not self._obligations.is_impossible(Question(variables, steps), "", action.span)

    def _without(self, place: Place, touched: frozenset[str]) -> Place:
        kept = [known for known in place.known if touched.isdisjoint(self._connected.fluents(known))]
        return replace(place, known=tuple(kept))

    def _after_all(self, statement: Statement, place: Place) -> Place:
        """What remains known whatever of a statement has been done, however often."""
        touched = frozenset[str]().union(*[self._touched[name] for name in self._performed.by(statement)])
        return self._later(self._without(place, touched))

    def _repeated(self, body: Statement, inside: Place, place: Place) -> Place:
        self._walk(body, self._after_all(body, inside))
        return self._after_all(body, place)

    def _common(self, place: Place, ends: Sequence[Place]) -> Place:
        shared = [known for known in ends[0].known if all(known in end.known for end in ends)]
        return replace(place, known=tuple(shared))


def _held(known: Asked) -> str:
    return "is false here" if known.false else "holds here"
