"""How large definitions and preconditions are once all that they use is written out: what doubles grows without end."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from golc.diagnostics import Code, Span
from golc.theory.context import Context
from golc.theory.terms import DefinedTerm, PossTerm, Term, children
from golc.theory.theory import BasicActionTheory

MOST_TERMS = 100_000
"""How many terms may have to be evaluated, in every situation anew."""

MOST_LEVELS = 1_000
"""How deeply terms may be nested; evaluating them is recursive."""


@dataclass(frozen=True)
class Extent:
    """How many terms there are, and how deeply they are nested."""

    terms: int
    levels: int

    @property
    def excess(self) -> str | None:
        """What there is too much of."""
        if self.terms > MOST_TERMS:
            return f"stands for more than {MOST_TERMS:,} terms"
        return f"is nested more than {MOST_LEVELS:,} levels deep" if self.levels > MOST_LEVELS else None


NONE = Extent(0, 0)


def check_unfolding(context: Context, theory: BasicActionTheory) -> None:
    """Report each definition or precondition that is too large while none of those it uses is; none may be circular."""
    bodies: dict[str, tuple[Span, tuple[Term, ...]]] = {
        f"definition {name}": (found.span, (found.body,)) for name, found in theory.definitions.items()
    }
    bodies |= {f"action {name}": (action.span, action.preconditions) for name, action in theory.actions.items()}
    extents: dict[str, Extent] = {}
    said: set[str] = set()
    for key in _callees_first({key: terms for key, (_, terms) in bodies.items()}):
        span, terms = bodies[key]
        if not said.isdisjoint(_used(terms)):
            said.add(key)
            continue
        extents[key] = extent = _extent(terms, extents)
        if extent.excess is not None:
            said.add(key)
            kind, name = key.split(" ")
            what = f"the precondition of `{name}`" if kind == "action" else f"`{name}`"
            context.error(
                Code.NESTING,
                f"{what} {extent.excess} once all definitions in it are written out",
                span,
                "too much to evaluate",
                "a fluent that the actions keep up to date, or a shorter formula, takes less time",
            )


def _callees_first(bodies: Mapping[str, tuple[Term, ...]]) -> Iterator[str]:
    """All keys, each behind those that it uses; a stack instead of recursion, for a chain of them may be long."""
    done: set[str] = set()
    stack = [(key, False) for key in reversed([*bodies])]
    while stack:
        key, is_open = stack.pop()
        if is_open and key not in done:
            done.add(key)
            yield key
        elif key not in done:
            stack.append((key, True))
            stack.extend((used, False) for used in _used(bodies[key]) if used in bodies and used not in done)


def _used(terms: tuple[Term, ...]) -> Iterator[str]:
    stack = [*terms]
    while stack:
        term = stack.pop()
        key = _key(term)
        if key is not None:
            yield key
        stack.extend(children(term))


def _extent(terms: tuple[Term, ...], extents: Mapping[str, Extent]) -> Extent:
    count = deepest = 0
    stack = [(term, 1) for term in terms]
    while stack:
        term, level = stack.pop()
        inside = extents.get(_key(term) or "", NONE)
        count += 1 + inside.terms
        deepest = max(deepest, level + inside.levels)
        stack.extend((child, level + 1) for child in children(term))
    return Extent(count, deepest)


def _key(term: Term) -> str | None:
    match term:
        case DefinedTerm(definition=name):
            return f"definition {name}"
        case PossTerm(action=name):
            return f"action {name}"
    return None
