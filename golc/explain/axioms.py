"""Reiter's successor state axiom of a fluent, put together from the effects of all actions.

``F(x, do(a, s)) ≡ γ⁺(x, a, s) ∨ F(x, s) ∧ ¬γ⁻(x, a, s)`` for a relational fluent, for any other
``f(x, do(a, s)) = y ≡ γ(x, y, a, s) ∨ f(x, s) = y ∧ ¬∃y′. γ(x, y′, a, s)`` ("Knowledge in Action", section 3.2): here
the γ are lists of causes, which are disjuncts. The variables of the axiom are x, then y; those of each cause follow.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, field, replace

from golc.explain.logic import conjuncts, equal, negated
from golc.explain.renaming import Renaming
from golc.theory.fitting import includes
from golc.theory.terms import Binder, Choice, Display, Literal, Membership, Operation, Operator, Term, Variable
from golc.theory.theory import Action, BasicActionTheory, Effect, Fluent
from golc.theory.types import BOOL, Value


@dataclass(frozen=True)
class Cause:
    """``∃ variables. a = action(args) ∧ conditions``, the conditions evaluated from left to right in the situation s.

    The action's own parameters come first among the variables.
    """

    variables: tuple[Variable, ...]
    action: str
    args: tuple[Term, ...]
    conditions: tuple[Term, ...]


@dataclass(frozen=True)
class SuccessorState:
    """The axiom of a fluent.

    Relational: ``value`` is none, ``gains`` are γ⁺ and ``losses`` γ⁻. Functional: ``gains`` are γ, in which ``value``
    is y. Not ``certain``: some causes leave open what the fluent becomes; then the axiom holds of each world that is
    possible afterwards, and each value that it allows is that of one of them.
    """

    fluent: Fluent
    parameters: tuple[Variable, ...]
    value: Variable | None
    gains: tuple[Cause, ...]
    losses: tuple[Cause, ...]
    certain: bool


def successor_state(theory: BasicActionTheory, fluent: Fluent) -> SuccessorState:
    """The successor state axiom of a fluent."""
    named = enumerate(fluent.parameters)
    parameters = tuple([Variable(level, parameter.name, type=parameter.type) for level, parameter in named])
    relational = fluent.type == BOOL
    value = None if relational else Variable(len(parameters), "y", type=fluent.type)
    gains, losses = list[Cause](), list[Cause]()
    certain = True
    for action in theory.actions.values():
        for effect in action.effects:
            if effect.fluent != fluent.name:
                continue
            certain = certain and not isinstance(effect.value, Choice)
            if value is not None:
                gains.append(_Causing(action, effect, parameters, value).cause())
                continue
            for truth, causes in ((True, gains), (False, losses)):
                if _may_become(effect.value, truth):
                    causes.append(_Causing(action, effect, parameters, truth).cause())
    return SuccessorState(fluent, parameters, value, tuple(gains), tuple(losses), certain)


def _may_become(value: Term | Choice, truth: bool) -> bool:
    """Whether an effect can give a relational fluent a truth value, as far as one sees without evaluating anything."""
    match value:
        case Literal(value=found):
            return found is truth
        case Choice(among=among) if (constants := _constants(among)) is not None:
            return truth in constants
        case _:
            return True


def _constants(among: Term) -> Collection[Value] | None:
    """The values of a collection that is written out."""
    match among:
        case Literal(value=tuple() | frozenset() as values):
            return values
        case Display(elements=elements):
            values = tuple([element.value for element in elements if isinstance(element, Literal)])
            return values if len(values) == len(elements) else None
        case _:
            return None


@dataclass
class _Causing:
    """Makes a cause of an effect. ``becomes`` is what the fluent is set to: the variable y, or a truth value.

    ``terms`` collects what the variables of the effect are in the axiom.
    """

    action: Action
    effect: Effect
    parameters: tuple[Variable, ...]
    becomes: Variable | bool
    terms: dict[int, Term] = field(default_factory=dict)
    ranges: list[Membership] = field(default_factory=list)

    def cause(self) -> Cause:
        demands = [*conjuncts(self.effect.where), *conjuncts(self.effect.condition)]
        arguments = list(zip(self.parameters, self.effect.args, strict=True))
        equations = [(head, arg) for head, arg in arguments if not self.identified(arg, head)]
        given = isinstance(self.becomes, Variable) and self.identified(self.effect.value, self.becomes)
        demands = [demand for demand in demands if not self.is_constant(demand)]
        variables = tuple(self.variables())
        scope = len(self.parameters) + isinstance(self.becomes, Variable)
        renaming = Renaming(self.terms, scope + len(variables))
        args = tuple([self.terms[level] for level in range(len(self.action.parameters))])
        conditions = [
            *self.ranges,
            *self.elements(renaming),
            *map(renaming, demands),
            *(equal(head, renaming(arg)) for head, arg in equations),
            *([] if given else self.value(renaming)),
        ]
        return Cause(variables, self.action.name, args, tuple(conditions))

    def identified(self, term: Term | Choice, head: Variable) -> bool:
        """Whether a term is a variable that can be called by the name of a variable of the axiom from now on."""
        if not isinstance(term, Variable) or term.level in self.terms:
            return False
        self.terms[term.level] = head
        covered = term.type.finite and head.type.finite and includes(term.type, head.type)
        if term.level >= len(self.action.parameters) and self.binder(term.level).within is None and not covered:
            self.ranges.append(Membership(head, term.type, type=BOOL))
        return True

    def is_constant(self, demand: Term) -> bool:
        """Whether a demand only says which constant a parameter of the action is, which its place can say as well."""
        match demand:
            case Operation(op=Operator.EQUAL, args=(Variable(level=level), Literal() as constant)):
                if level < len(self.action.parameters) and level not in self.terms:
                    self.terms[level] = constant
                    return True
        return False

    def binder(self, level: int) -> Binder:
        return self.effect.binders[level - len(self.action.parameters)]

    def variables(self) -> Iterator[Variable]:
        """The variables of the effect that are nothing yet become variables of the cause."""
        depth = len(self.parameters) + isinstance(self.becomes, Variable)
        for level, parameter in enumerate(self.action.parameters):
            if level not in self.terms:
                self.terms[level] = variable = Variable(depth, parameter.name, type=parameter.type)
                depth += 1
                yield variable
        for binder in self.effect.binders:
            if binder.variable.level not in self.terms:
                self.terms[binder.variable.level] = variable = replace(binder.variable, level=depth)
                depth += 1
                yield variable

    def elements(self, renaming: Renaming) -> Iterator[Term]:
        """That the variables which run over collections are elements of these."""
        for binder in self.effect.binders:
            if binder.within is not None:
                variable = self.terms[binder.variable.level]
                yield Operation(Operator.ELEMENT, (variable, renaming(binder.within)), type=BOOL)

    def value(self, renaming: Renaming) -> Iterator[Term]:
        """That the fluent becomes what it does: y, true, or false."""
        match self.becomes, self.effect.value:
            case Variable() as y, Choice(among=among):
                yield Operation(Operator.ELEMENT, (y, renaming(among)), type=BOOL)
            case Variable() as y, value:
                assert not isinstance(value, Choice)
                yield equal(y, renaming(value))
            case _, Literal():
                return
            case _, Choice(among=among) if _constants(among) is not None:
                return
            case bool(truth), Choice(among=among):
                yield Operation(Operator.ELEMENT, (Literal(truth, type=BOOL), renaming(among)), type=BOOL)
            case truth, value:
                assert not isinstance(value, Choice)
                formula = renaming(value)
                yield formula if truth else negated(formula)
