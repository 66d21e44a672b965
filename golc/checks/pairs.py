"""The effects of one action that may meet in one ground fluent, without those that can be told apart at a glance.

Of effects such as ``f := 1 when x = 1``, ``f := 4 when x = 2`` and so on, or those of a table ``f(1) := …``,
``f(2) := …``, no two take place for one value of ``x`` or of the argument. A thousand of them are half a million pairs.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, islice
from typing import TypeAlias

from golc.situation.dynamics import is_injective
from golc.theory.terms import FluentTerm, Literal, Operation, Operator, Term, Variable
from golc.theory.theory import Effect
from golc.theory.types import Value

Fixed: TypeAlias = Mapping[object, Value]
"""What has a certain value where an effect takes place."""


def pairs(effects: Sequence[Effect], depth: int, most: int) -> list[tuple[Effect, Effect]]:
    """Every two effects on one fluent that may both take place, and each one with itself unless its
    instances certainly differ in their arguments, in the order of the first.

    ``depth`` is the number of the action's parameters; of more than ``most`` there is one more than that.
    """
    fixed = [_fixed(effect, depth) for effect in effects]
    groups: dict[str, list[int]] = {}
    for number, effect in enumerate(effects):
        groups.setdefault(effect.fluent, []).append(number)
    own = ((number, number) for number, effect in enumerate(effects) if not is_injective(effect))
    found = chain(own, *[_together(group, fixed) for group in groups.values()])
    return [(effects[first], effects[second]) for first, second in sorted(islice(found, most + 1))]


def _together(
    group: Sequence[int], fixed: Sequence[Fixed], told: frozenset[object] = frozenset()
) -> Iterator[tuple[int, int]]:
    """Those pairs of a group in which nothing has two values; ``told`` are what all have the same value of."""
    common = Counter(key for number in group for key in fixed[number] if key not in told)
    key, times = max(common.items(), key=lambda item: item[1], default=(None, 0))
    if times < 2:
        yield from ((first, second) for place, first in enumerate(group) for second in group[place + 1 :])
        return
    open_ = [number for number in group if key not in fixed[number]]
    buckets: dict[Value, list[int]] = {}
    for number in group:
        if key in fixed[number]:
            buckets.setdefault(fixed[number][key], []).append(number)
    for bucket in buckets.values():
        yield from _together(bucket, fixed, told | {key})
        yield from ((min(one, other), max(one, other)) for one in bucket for other in open_)
    yield from _together(open_, fixed, told)


def _fixed(effect: Effect, depth: int) -> Fixed:
    """The arguments that are constants, and the parameters and fluents of which ``when`` says that they equal one."""
    found: dict[object, Value] = {}
    for place, arg in enumerate(effect.args):
        if isinstance(arg, Literal):
            found[place] = arg.value
    stack = [] if effect.condition is None else [effect.condition]
    while stack:
        match stack.pop():
            case Operation(op=Operator.AND, args=args):
                stack.extend(args)
            case Operation(op=Operator.EQUAL, args=(left, Literal(value=value))):
                key = _key(left, depth)
                if key is not None:
                    found[key] = value
    return found


def _key(term: Term, depth: int) -> object:
    """What stands for a parameter or a fluent, the same for the same one; none for other terms."""
    match term:
        case Variable(level=level) if level < depth:
            return "variable", level
        case FluentTerm(fluent=name, args=args):
            keys = tuple([("constant", arg.value) if isinstance(arg, Literal) else _key(arg, depth) for arg in args])
            return None if None in keys else (name, keys)
    return None
