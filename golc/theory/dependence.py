"""What the value of a term depends on."""

from __future__ import annotations

from golc.theory.terms import DefinedTerm, FluentTerm, PossTerm, Term, subterms
from golc.theory.theory import BasicActionTheory


def fluents_of(theory: BasicActionTheory, *terms: Term) -> frozenset[str]:
    """The fluents that terms read, also through definitions and preconditions."""
    fluents: set[str] = set()
    seen: set[str] = set()
    stack = [*terms]
    while stack:
        for part in subterms(stack.pop()):
            match part:
                case FluentTerm(fluent=name):
                    fluents.add(name)
                case DefinedTerm(definition=name) if name not in seen:
                    seen.add(name)
                    stack.append(theory.definitions[name].body)
                case PossTerm(action=name) if f"{name}()" not in seen:
                    seen.add(f"{name}()")
                    stack.extend(theory.actions[name].preconditions)
    return frozenset(fluents)
