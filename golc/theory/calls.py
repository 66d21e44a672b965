"""Who calls whom: which procedures are recursive, and which conditions go round in circles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from golc.theory import statements as typed
from golc.theory.statements import Statement


def substatements(statement: Statement) -> Iterator[Statement]:
    """The statement and every statement inside it; no recursion, for the depth is the input's."""
    stack = [statement]
    while stack:
        statement = stack.pop()
        yield statement
        stack.extend(reversed(parts(statement)))


def parts(statement: Statement) -> tuple[Statement, ...]:
    """The statements directly inside a statement, in the order in which they are written."""
    match statement:
        case typed.Sequence(parts=inside):
            return inside
        case typed.If(then=then, otherwise=otherwise):
            return (then, otherwise)
        case typed.Within(body=body, otherwise=otherwise):
            return (body, otherwise)
        case typed.Choose(branches=inside) | typed.Together(branches=inside) | typed.Prefer(branches=inside):
            return inside
        case (
            typed.While(body=body)
            | typed.Pick(body=body)
            | typed.Star(body=body)
            | typed.For(body=body)
            | typed.Let(body=body)
            | typed.TogetherStar(body=body)
            | typed.Guard(body=body)
            | typed.Search(body=body)
        ):
            return (body,)
        case typed.Interrupts(handlers=handlers):
            return tuple([handler.body for handler in handlers])
        case _:
            return ()


def circular(graph: Mapping[str, frozenset[str]]) -> list[list[str]]:
    """The strongly connected parts of a graph that have a circle, each in some order."""
    return [part for part in components(graph) if len(part) > 1 or part[0] in graph.get(part[0], frozenset())]


def components(graph: Mapping[str, frozenset[str]]) -> list[list[str]]:
    """The strongly connected parts of a graph, each in some order and behind those to which it leads.

    Tarjan's algorithm (1972) with a stack of its own instead of recursion.
    """
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    open_: dict[str, None] = {}
    found: list[list[str]] = []
    for root in graph:
        work = [(root, iter(sorted(graph[root])))] if root not in index else []
        if work:
            index[root] = low[root] = len(index)
            open_[root] = None
        while work:
            node, rest = work[-1]
            after = next(rest, None)
            if after is None:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    found.append(_close(open_, node))
            elif after not in index:
                index[after] = low[after] = len(index)
                open_[after] = None
                work.append((after, iter(sorted(graph.get(after, frozenset())))))
            elif after in open_:
                low[node] = min(low[node], index[after])
    return found


def _close(open_: dict[str, None], node: str) -> list[str]:
    part = [open_.popitem()[0]]
    while part[-1] != node:
        part.append(open_.popitem()[0])
    return part[::-1]
