"""Ways to the end of a program, as look-ahead finds them and execution follows them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol, TypeAlias, TypeVar

from golc.program.blame import Blocked
from golc.program.labels import Act, Foreseen
from golc.program.lookahead import ANY, Request
from golc.program.nodes import Node
from golc.situation.worlds import State
from golc.theory.types import Value

if TYPE_CHECKING:
    from golc.program.ahead import Ahead

Key = TypeVar("Key", bound=Hashable)
T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Path:
    """A way to the end of a program: ``programs`` and ``states`` have one element more than ``labels``.

    If there are ``branches``, the last label is a sensing action with several outcomes, and the last state the one
    before its results are known. ``request``: what the way answers; ``done``: how many actions came before, under it.
    """

    programs: tuple[Node, ...]
    labels: tuple[Foreseen, ...]
    states: tuple[State, ...]
    branches: tuple[Branch, ...] = ()
    request: Request = ANY
    done: int = 0

    def actions(self, index: int) -> int:
        """How many actions have been done under the request when so many steps of the way have been taken."""
        return self.done + sum(isinstance(label, Act) for label in self.labels[:index])

    def rest(self, index: int) -> Request:
        """What is wanted of a way from the place that so many steps have led to."""
        return self.request.after(self.actions(index))

    @property
    def ways(self) -> list[Path]:
        """How it may go on."""
        return [branch.path for branch in self.branches]

    def continued(self, way: Path) -> Path:
        """A branch of this way, for the same request."""
        return replace(way, request=self.request, done=self.actions(len(self.labels)))


@dataclass(frozen=True, eq=False)
class Branch:
    """The way on after some results of sensing; it may have no step."""

    results: tuple[Value, ...]
    path: Path


@dataclass(frozen=True)
class NoPath:
    """There is no way; if a limit kept it from being found, ``limit`` says which.

    ``deepest`` are the actions of the longest way, ``reasons`` what failed at its end.
    """

    limit: str | None = None
    deepest: tuple[str, ...] = ()
    reasons: tuple[Blocked, ...] = ()


class Planner(Protocol):
    """Finds a way from a program and a state to a final program, with at least one step."""

    def __call__(self, machine: Ahead, node: Node, state: State, request: Request) -> Path | NoPath: ...


Run: TypeAlias = tuple[Path, tuple[tuple[tuple[Value, ...], Key], ...]]
"""A way up to where it branches, and how it goes on: results of sensing, each with the key of another run."""


def joined(start: Key, run: Callable[[Key], Run[Key] | None]) -> Path | None:
    """The way that begins with the run of a key, every branch in its place; none if there is no run for one of them.

    A key that several branches lead to gives them one path. Keys must not lead back to themselves.
    """
    runs: dict[Key, Run[Key]] = {}
    paths: dict[Key, Path] = {}
    stack = [start]
    while stack:
        key = stack[-1]
        if key not in runs:
            found = run(key)
            if found is None:
                return None
            runs[key] = found
        path, branches = runs[key]
        missing = [after for _, after in branches if after not in paths]
        stack.extend(reversed(missing))
        if not missing:
            stack.pop()
            ways = tuple([Branch(results, paths[after]) for results, after in branches])
            paths.setdefault(key, replace(path, branches=ways) if ways else path)
    return paths[start]


def bottom_up(top: T, parts: Callable[[T], Sequence[T]]) -> Iterator[T]:
    """Everything that something consists of, each object once, after its parts; no recursion, for plans are deep."""
    stack, seen = [top], set[int]()
    while stack:
        last = stack[-1]
        missing = [part for part in parts(last) if id(part) not in seen]
        stack.extend(reversed(missing))
        if not missing:
            stack.pop()
            if id(last) not in seen:
                seen.add(id(last))
                yield last
