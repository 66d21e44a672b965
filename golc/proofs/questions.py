"""Questions about all situations of a theory: is there one in which this holds, or goes wrong?

A question is a list of formulas over variables. The situations are all those of the right types in which the theory's
invariants hold, whether or not they can be reached.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from golc.diagnostics import ProgramError
from golc.theory.terms import Term
from golc.theory.theory import BasicActionTheory, Parameter
from golc.theory.types import Value, show


@dataclass(frozen=True)
class Asked:
    """A formula that has to hold; ``env`` says which of the question's variables stand for those of the term.

    ``false``: it has to be false instead. ``known``: the agent has to know it.
    """

    term: Term
    env: tuple[int, ...] = ()
    false: bool = False
    known: bool = False


@dataclass(frozen=True)
class Compared:
    """Two terms that have to be equal, or different."""

    left: Asked
    right: Asked
    equal: bool


@dataclass(frozen=True)
class Changed:
    """An effect is carried out, which has to succeed: ``env`` are the action's parameters and the effect's binders."""

    action: str
    effect: int
    env: tuple[int, ...]


@dataclass(frozen=True)
class Afterwards:
    """A formula that has to be false after an action; ``env`` are its parameters."""

    action: str
    env: tuple[int, ...]
    term: Term


Step: TypeAlias = Asked | Compared | Changed | Afterwards


@dataclass(frozen=True)
class Question:
    """Is there a situation, and values of the variables, in which every step succeeds?

    ``fails``: whether there is one instead in which a step, those before it having succeeded, has no value.
    """

    variables: tuple[Parameter, ...]
    steps: tuple[Step, ...]
    fails: bool = False


@dataclass(frozen=True)
class Witness:
    """A situation that answers a question with yes: the values of the ground fluents that matter, and those of the
    variables. ``error``: what goes wrong when something that was asked is evaluated there. ``certain``: false if it was
    guessed several times what the agent knows, which need not go together. ``way``: the actions that lead to the
    situation from the initial one, if it is known to be reached."""

    fluents: Mapping[str, Value]
    variables: tuple[Value, ...]
    error: ProgramError | None = None
    certain: bool = True
    way: tuple[str, ...] | None = None

    def __str__(self) -> str:
        return ", ".join(f"{name} = {show(value)}" for name, value in self.fluents.items())


@dataclass(frozen=True)
class Undecided:
    """Neither a witness was found, nor a proof that there is none: why, and what would decide it.

    ``function``: the static that would have to be called for that, a function of Python that is not executed.
    """

    reason: str
    help: str | None = None
    function: str | None = None


def terms_of(theory: BasicActionTheory, step: Step) -> Iterator[Term]:
    """What a step looks at."""
    match step:
        case Asked(term=term):
            yield term
        case Compared(left=left, right=right):
            yield from (left.term, right.term)
        case Afterwards(action=name, term=term):
            yield term
            for effect in theory.actions[name].effects:
                yield from effect.terms
        case Changed(action=name, effect=number):
            yield from theory.actions[name].effects[number].terms
