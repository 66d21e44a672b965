"""What terms read, also through the definitions and the preconditions that they ask for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import cast

from golc.theory.terms import DefinedTerm, Epistemic, FluentTerm, PossTerm, StaticTerm, Term, children
from golc.theory.theory import BasicActionTheory


def reached(theory: BasicActionTheory, terms: Iterable[Term], *, into_knowledge: bool = True) -> Iterator[Term]:
    """Some terms and all inside them, with the bodies of definitions and preconditions, each of these once, and of
    statics that read fluents.

    ``into_knowledge``: also what stands inside ``known``, ``knows`` and ``possible``.
    """
    stack = [*terms]
    seen: set[str] = set()
    while stack:
        term = stack.pop()
        yield term
        match term:
            case DefinedTerm(definition=name) if f"definition {name}" not in seen:
                seen.add(f"definition {name}")
                stack.append(theory.definitions[name].body)
            case PossTerm(action=name) if f"action {name}" not in seen:
                seen.add(f"action {name}")
                stack.extend(theory.actions[name].preconditions)
            case StaticTerm(static=name) if theory.statics[name].reads and f"static {name}" not in seen:
                seen.add(f"static {name}")
                stack.append(cast(Term, theory.statics[name].body))
            case Epistemic() if not into_knowledge:
                continue
        stack.extend(children(term))


def fluents_read(theory: BasicActionTheory, terms: Iterable[Term], *, into_knowledge: bool = True) -> frozenset[str]:
    """The names of the fluents that some terms read."""
    parts = reached(theory, terms, into_knowledge=into_knowledge)
    return frozenset([part.fluent for part in parts if isinstance(part, FluentTerm)])
