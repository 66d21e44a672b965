"""Counterexamples against an enumeration of small domains that knows nothing of golc: how small they are, and whether
the way there leads there."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator
from os import environ
from pathlib import Path
from typing import TypeAlias

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from golc.diagnostics import Diagnostic
from golc.loading import examine

State: TypeAlias = dict[str, int]
"""The place of each value in its type, of the argument `n` too."""
Formula: TypeAlias = tuple[str, Callable[[State], bool]]
Term: TypeAlias = tuple[str, Callable[[State], int]]

FLUENTS = {"a": 3, "b": 3, "lit": 2, "gate": 3}
"""How many values each fluent has."""
NAMES = {"lit": ["false", "true"], "gate": ["open", "closed", "locked"]}
HEAD = """\
domain trial
type small = 0..2
type door = {open, closed, locked}
fluent a: small = 0
fluent b: small = 1
fluent lit: bool = false
fluent gate: door = closed
"""
FIRST = {"a": 0, "b": 1, "lit": 0, "gate": 1}

ATOMS: list[Formula] = [
    ("a = 1", lambda s: s["a"] == 1),
    ("a < b", lambda s: s["a"] < s["b"]),
    ("b != 0", lambda s: s["b"] != 0),
    ("lit", lambda s: s["lit"] == 1),
    ("gate = locked", lambda s: s["gate"] == 2),
    ("gate <= closed", lambda s: s["gate"] <= 1),
    ("a = n", lambda s: s["a"] == s["n"]),
    ("n > 0", lambda s: s["n"] > 0),
    ("(lit iff gate = open)", lambda s: (s["lit"] == 1) == (s["gate"] == 0)),
    ("(exists m: small. m > a and m < b + n)", lambda s: any(s["a"] < m < s["b"] + s["n"] for m in range(3))),
    ("(b = 1 if lit else gate = closed)", lambda s: s["b"] == 1 if s["lit"] else s["gate"] == 1),
]
TERMS: list[Term] = [
    ("a + 1", lambda s: s["a"] + 1),
    ("b + n", lambda s: s["b"] + s["n"]),
    ("a - b", lambda s: s["a"] - s["b"]),
    ("b", lambda s: s["b"]),
    ("2 - n", lambda s: 2 - s["n"]),
    ("(a if lit else b + 1)", lambda s: s["a"] if s["lit"] else s["b"] + 1),
    ("max(a, b)", lambda s: max(s["a"], s["b"])),
]
CHANGES: list[tuple[str, str, Callable[[State], int]]] = [
    ("lit", "not lit", lambda s: 1 - s["lit"]),
    ("lit", "true", lambda s: 1),
    ("gate", "open", lambda s: 0),
    ("gate", "locked if lit else closed", lambda s: 2 if s["lit"] else 1),
]


def joined(parts: tuple[Formula, str, Formula]) -> Formula:
    (left, one), word, (right, other) = parts
    if word == "and":
        return f"({left} and {right})", lambda s: one(s) and other(s)
    return f"({left} or {right})", lambda s: one(s) or other(s)


formulas = st.recursive(
    st.sampled_from(ATOMS),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["and", "or"]), inner).map(joined),
        inner.map(lambda part: (f"not {part[0]}", lambda s: not part[1](s))),
    ),
    max_leaves=3,
)
changes = st.one_of(
    st.tuples(st.sampled_from(["a", "b"]), st.sampled_from(TERMS)).map(lambda each: (each[0], *each[1])),
    st.sampled_from(CHANGES),
)
Action: TypeAlias = tuple[Formula, tuple[str, str, Callable[[State], int]]]
actions: st.SearchStrategy[Action] = st.tuples(formulas, changes)


def declared(name: str, action: Action) -> str:
    (poss, _), (fluent, value, _) = action
    return f"action {name}(n: small):\n    poss {poss}\n    causes {fluent} := {value}\n"


def states() -> Iterator[State]:
    for values in itertools.product(*map(range, FLUENTS.values())):
        yield dict(zip(FLUENTS, values, strict=True))


def wrong(action: Action, state: State) -> int | None:
    """The value outside its type that an action gives its fluent, if it is possible and does."""
    (_, possible), (fluent, _, value) = action
    found = value(state)
    return found if possible(state) and not 0 <= found < FLUENTS[fluent] else None


def smallest(action: Action) -> tuple[int, int] | None:
    """How many fluents a smallest counterexample has, and the sum of the places of all its values."""
    for count in range(len(FLUENTS) + 1):
        sizes = []
        for names in itertools.combinations(FLUENTS, count):
            for values in itertools.product(*[range(FLUENTS[name]) for name in names]):
                for n in range(3):
                    fixed = dict(zip(names, values, strict=True)) | {"n": n}
                    outcomes = {wrong(action, state | fixed) for state in states()}
                    if len(outcomes) == 1 and outcomes != {None}:
                        sizes.append(sum(fixed.values()))
        if sizes:
            return count, min(sizes)
    return None


def place(name: str, value: str) -> int:
    return NAMES[name].index(value) if name in NAMES else int(value)


def read(finding: Diagnostic) -> tuple[State, int]:
    """The values of the fluents that a finding shows, and the argument."""
    shown = re.fullmatch(r"for example when (.* and )?`act\((\d)\)` is done(, in any situation)?", finding.notes[0])
    assert shown is not None and (shown[1] is None) is (shown[3] is not None), finding.notes
    pairs = re.findall(r"(\w+) = (\w+)", shown[1] or "")
    return {name: place(name, value) for name, value in pairs}, int(shown[2])


def found(folder: Path, text: str, reachable: bool = False) -> list[Diagnostic]:
    path = folder / "trial.gl"
    path.write_text(text)
    findings = examine(path, proofs=True, reachable=reachable).findings
    return [finding for finding in findings if finding.code.code == "GL041" and "`act`" in finding.message]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("domains")


@settings(max_examples=int(environ.get("GOLC_EXAMPLES", 60)), deadline=None)
@given(actions)
def test_no_counterexample_is_smaller_than_the_one_that_is_shown(folder: Path, action: Action) -> None:
    findings = found(folder, HEAD + declared("act", action))
    best = smallest(action)
    assert len(findings) == (best is not None)
    for finding in findings:
        values, n = read(finding)
        said = re.search(r"would be (-?\d+)", finding.message)
        assert said is not None
        assert {wrong(action, state | values | {"n": n}) for state in states()} == {int(said[1])}
        assert (len(values), sum(values.values()) + n) == best


def distances(every: dict[str, Action]) -> dict[tuple[int, ...], int]:
    """How many actions it takes to reach each state that can be reached."""
    found = {tuple(FIRST.values()): 0}
    for values in (queue := [*found]):
        for _, following in steps(every, dict(zip(FLUENTS, values, strict=True))):
            key = tuple(following.values())
            if key not in found:
                found[key] = found[values] + 1
                queue.append(key)
    return found


def steps(every: dict[str, Action], state: State) -> Iterator[tuple[str, State]]:
    """The ground actions that are possible and do not go wrong in a state, with the state after each."""
    for (name, action), n in itertools.product(every.items(), range(3)):
        (_, possible), (fluent, _, value) = action
        before = state | {"n": n}
        if possible(before) and wrong(action, before) is None:
            yield f"`{name}({n})`", state | {fluent: value(before)}


@pytest.fixture(autouse=True, scope="module")
def time_enough() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr("golc.proofs.among.SECONDS", 600)
        yield


def test_a_solver_shows_short_lists(folder: Path) -> None:
    text = """\
domain trial
fluent x: int = 2
fluent y: int = 3
fluent l: list[1..3] = []
invariant alike: x * y >= 0
action take:
    poss l != []
    causes x := first(l)
    causes l := rest(l)
"""
    path = folder / "lists.gl"
    path.write_text(text)
    (finding,) = examine(path, proofs=True).findings
    assert finding.notes == ("for example when y = -1, l = [1] and `take` is done",)


@settings(
    max_examples=int(environ.get("GOLC_EXAMPLES", 60)), deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
@given(actions, actions, actions)
def test_what_is_shown_is_reached_in_as_few_actions_as_possible(
    folder: Path, act: Action, one: Action, other: Action
) -> None:
    every = {"act": act, "move": one, "turn": other}
    reached = distances(every)
    wrong_ones = [
        far
        for values, far in reached.items()
        for n in range(3)
        if wrong(act, dict(zip(FLUENTS, values, strict=True)) | {"n": n}) is not None
    ]
    text = HEAD + "".join(declared(name, action) for name, action in every.items())
    findings = found(folder, text, reachable=True)
    assert len(findings) == bool(wrong_ones)
    for finding in findings:
        way = re.findall(r"`\w+\(\d\)`", finding.notes[1])
        assert len(way) == min(wrong_ones)
        state = FIRST
        for step in way:
            state = dict(steps(every, state))[step]
        values, n = read(finding)
        assert values.items() <= state.items()
        assert wrong(act, state | {"n": n}) is not None
