"""What actions do where they are possible: rows 3 to 5 of what ``golc check`` proves, and the first part of row 6."""

from __future__ import annotations

from golc.checks.obligations import Obligations
from golc.checks.pairs import pairs
from golc.diagnostics import Code, Label
from golc.proofs.questions import Afterwards, Asked, Changed, Compared, Question, Step, Undecided, Witness
from golc.theory.reading import fluents_read
from golc.theory.terms import Binder, Choice, Operation, Operator
from golc.theory.theory import Action, Effect, Parameter
from golc.theory.types import BOOL

MOST_PAIRS = 5_000
"""How many pairs of effects of one action are compared."""


def check_effects(obligations: Obligations) -> None:
    """Rows 3, 4, 5 and, of row 6, the actions that can never be possible."""
    for action in obligations.theory.actions.values():
        if not _is_ever_possible(action, obligations):
            continue
        for number in range(len(action.effects)):
            _check_effect(action, number, obligations)
            _check_condition(action, action.effects[number], obligations)
        _check_conflicts(action, obligations)
        for name in obligations.theory.invariants:
            _check_invariant(action, name, obligations)


def possible(action: Action) -> tuple[Step, ...]:
    """The action's preconditions, asked of the first variables."""
    env = tuple(range(len(action.parameters)))
    return tuple([Asked(condition, env, known=not action.exogenous) for condition in action.preconditions])


def _is_ever_possible(action: Action, obligations: Obligations) -> bool:
    if not action.preconditions:
        return True
    steps, span = possible(action), action.preconditions[0].span
    witness = obligations.witness(
        Question(action.parameters, steps, fails=True), f"whether the precondition of `{action.name}` has a value", span
    )
    if witness is not None:
        _report(action, witness, obligations)
        return True
    what = f"whether `{action.name}` is ever possible"
    if obligations.is_impossible(Question(action.parameters, steps), what, span):
        message = f"`{action.name}` can never be possible"
        obligations.warning(Code.NEVER_POSSIBLE, message, span, f"false {obligations.everywhere}")
        obligations.never_possible.add(action.name)
        return False
    return True


def _check_effect(action: Action, number: int, obligations: Obligations) -> None:
    """One effect can be carried out wherever the action is possible."""
    effect = action.effects[number]
    binders = effect.binders if all(binder.within is None for binder in effect.binders) else ()
    variables = (*action.parameters, *_parameters(binders))
    change = Changed(action.name, number, tuple(range(len(variables))))
    what = f"whether this effect of `{action.name}` always gives `{effect.fluent}` a value of its type"
    witness = obligations.witness(Question(variables, (*possible(action), change), fails=True), what, effect.span)
    if witness is not None:
        _report(action, witness, obligations)


def _check_condition(action: Action, effect: Effect, obligations: Obligations) -> None:
    """The condition of an effect can hold where the action is possible. What reads no fluent is a matter of constants,
    which may well be meant."""
    condition = effect.condition
    if condition is None or not fluents_read(obligations.theory, [condition]):
        return
    variables = (*action.parameters, *_parameters(effect.binders))
    steps = (*possible(action), *_applies(effect, tuple(range(len(variables)))))
    what = f"whether this effect of `{action.name}` ever takes place"
    if obligations.is_impossible(Question(variables, steps), what, condition.span):
        message = f"this effect of `{action.name}` never takes place: its condition is false {obligations.everywhere}"
        obligations.warning(Code.CONSTANT, message, condition.span, "never true")


def _report(action: Action, witness: Witness, obligations: Obligations) -> None:
    assert witness.error is not None
    found = witness.error.diagnostic
    message = f"`{action.name}` can go wrong: {found.message}"
    obligations.error(Code.EFFECT_FAILS, message, found.span, found.marker, action, witness, found.labels)


def _check_conflicts(action: Action, obligations: Obligations) -> None:
    """No two effects give one ground fluent two values."""
    met = pairs(action.effects, len(action.parameters), MOST_PAIRS)
    if len(met) > MOST_PAIRS:
        obligations.asked += 1
        why = Undecided(f"more than {MOST_PAIRS:,} pairs of them would have to be compared")
        obligations.not_decided(why, f"whether all effects of `{action.name}` agree", action.span)
        return
    for one, two in met:
        _check_conflict(action, one, two, obligations)


def _check_conflict(action: Action, first: Effect, second: Effect, obligations: Obligations) -> None:
    """Two effects, or two instances of one, never give one ground fluent two values."""
    own = tuple(range(len(action.parameters)))
    one = (*own, *range(len(own), len(own) + len(first.binders)))
    two = (*own, *range(len(one), len(one) + len(second.binders)))
    variables = (*action.parameters, *_parameters(first.binders), *_parameters(second.binders))
    same = [
        Compared(Asked(left, one), Asked(right, two), equal=True)
        for left, right in zip(first.args, second.args, strict=True)
    ]
    steps = (*possible(action), *_applies(first, one), *_applies(second, two), *same, *_differ(first, one, second, two))
    what = f"whether these effects of `{action.name}` agree on `{first.fluent}`"
    witness = obligations.witness(Question(variables, steps), what, second.span)
    if witness is None:
        return
    message = f"`{action.name}` may give `{first.fluent}` two values at once"
    labels = (Label(first.span, "and this one"),) if first is not second else ()
    obligations.error(Code.EFFECT_CONFLICT, message, second.span, "this effect", action, witness, labels)


def _parameters(binders: tuple[Binder, ...]) -> tuple[Parameter, ...]:
    return tuple([Parameter(binder.variable.name, binder.variable.type) for binder in binders])


def _applies(effect: Effect, env: tuple[int, ...]) -> tuple[Step, ...]:
    """The effect takes place for the values of its binders."""
    inside = [
        Asked(Operation(Operator.ELEMENT, (binder.variable, binder.within), type=BOOL), env)
        for binder in effect.binders
        if binder.within is not None
    ]
    conditions = [Asked(part, env) for part in (effect.where, effect.condition) if part is not None]
    return (*inside, *conditions)


def _differ(first: Effect, one: tuple[int, ...], second: Effect, two: tuple[int, ...]) -> tuple[Step, ...]:
    """Their values differ; that of ``unknown`` is like no other."""
    if isinstance(first.value, Choice) or isinstance(second.value, Choice):
        return ()
    return (Compared(Asked(first.value, one), Asked(second.value, two), equal=False),)


def _check_invariant(action: Action, name: str, obligations: Obligations) -> None:
    """The action preserves an invariant."""
    invariant = obligations.theory.definitions[name]
    touched = {effect.fluent for effect in action.effects} & fluents_read(obligations.theory, [invariant.body])
    if not touched:
        return
    env = tuple(range(len(action.parameters)))
    question = Question(action.parameters, (*possible(action), Afterwards(action.name, env, invariant.body)))
    what = f"whether `{action.name}` preserves invariant `{name}`"
    witness = obligations.witness(question, what, action.span)
    if witness is not None:
        message = f"`{action.name}` may break invariant `{name}`"
        labels = (Label(invariant.body.span, "false afterwards"),)
        obligations.error(Code.INVARIANT_NOT_KEPT, message, action.span, "breaks it", action, witness, labels)
