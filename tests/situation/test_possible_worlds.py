"""The possible worlds, kept as factors, against the plain set of worlds that each operation leaves.

The domain's effects, sensing and formulas are written a second time by hand, over dictionaries.
"""

from __future__ import annotations

import itertools
import tracemalloc
from collections.abc import Callable, Hashable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import ProgramError
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State, TooManyCasesError, Worlds, choices, rebuilt, survey
from golc.theory.types import Unknown
from tests.theories import theory_of

DOMAIN = """\
domain house
type room = 1..3
type level = 0..2
fluent at: room = unknown
fluent lit(r: room): bool = unknown
fluent heat(r: room): level = 1
fluent spare: level = unknown
initially at != 2 or lit(2)
define bright := exists r: room. lit(r) and r = at
action toggle(r: room):
    causes lit(r) := not lit(r)
action toggle_all:
    causes forall r: room. lit(r) := not lit(r)
action walk:
    poss at < 3
    causes at := at + 1 when at < 3
action shine:
    causes lit(at) := true
action warm:
    causes heat(at) := 2
action swap:
    causes lit(1) := lit(2)
    causes lit(2) := lit(1)
action settle:
    causes spare := heat(at)
    causes at := 1 when bright
action forget(r: room):
    causes lit(r) := unknown when at = r
    causes heat(r) := unknown when lit(r)
action shuffle:
    causes forall r: room. heat(r) := unknown
action look(r: room):
    senses lit(r)
action feel:
    senses heat(at)
action both:
    senses at
    senses bright
exog blown(r: room):
    poss lit(r)
    causes lit(r) := false
"""


ROOMS = (1, 2, 3)

House = dict[str, Any]
"""A world by hand: ``at``, ``spare``, ``lit`` and ``heat`` with their rooms."""


def toggle(w: House, r: int) -> None:
    w[f"lit{r}"] = not w[f"lit{r}"]


def toggle_all(w: House) -> None:
    for r in ROOMS:
        toggle(w, r)


def walk(w: House) -> None:
    w["at"] = min(3, w["at"] + 1)


def shine(w: House) -> None:
    w[f"lit{w['at']}"] = True


def warm(w: House) -> None:
    w[f"heat{w['at']}"] = 2


def swap(w: House) -> None:
    w["lit1"], w["lit2"] = w["lit2"], w["lit1"]


def settle(w: House) -> None:
    w["spare"], w["at"] = w[f"heat{w['at']}"], 1 if w[f"lit{w['at']}"] else w["at"]


def forget(w: House, r: int) -> None:
    dark, cold = w["at"] == r, w[f"lit{r}"]
    if dark:
        w[f"lit{r}"] = {False, True}
    if cold:
        w[f"heat{r}"] = {0, 1, 2}


def shuffle(w: House) -> None:
    w.update({f"heat{r}": {0, 1, 2} for r in ROOMS})


def blown(w: House, r: int) -> None:
    w[f"lit{r}"] = False


def nothing(w: House, *args: int) -> None:
    pass


EFFECTS: dict[str, Callable[..., None]] = {
    "toggle": toggle, "toggle_all": toggle_all, "walk": walk, "shine": shine, "warm": warm, "swap": swap,
    "settle": settle, "forget": forget, "shuffle": shuffle, "blown": blown, "look": nothing, "feel": nothing,
    "both": nothing,
}  # fmt: skip
SENSES: dict[str, Callable[..., tuple[Hashable, ...]]] = {
    "look": lambda w, r: (w[f"lit{r}"],),
    "feel": lambda w: (w[f"heat{w['at']}"],),
    "both": lambda w: (w["at"], w[f"lit{w['at']}"]),
}
ACTIONS = [
    *[(name, (r,)) for name in ("toggle", "forget", "look", "blown") for r in ROOMS],
    *[(name, ()) for name in ("toggle_all", "walk", "shine", "warm", "swap", "settle", "shuffle", "feel", "both")],
]
Formula = Callable[[House, dict[str, bool]], bool]
FORMULAS: dict[str, Formula] = {
    "bright": lambda w, known: w[f"lit{w['at']}"],
    "at = 1": lambda w, known: w["at"] == 1,
    "forall r: room. lit(r)": lambda w, known: w["lit1"] and w["lit2"] and w["lit3"],
    "heat(at) = spare": lambda w, known: w[f"heat{w['at']}"] == w["spare"],
    "knows(at = 1) or lit(1)": lambda w, known: known["at = 1"] or w["lit1"],
    "known(lit(2)) and possible(lit(1))": lambda w, known: known["whether lit(2)"] and known["possible(lit(1))"],
    "exists r: room. knows(lit(r)) and at = r": lambda w, known: known[f"lit({w['at']})"],
    "knows(possible(lit(at)))": lambda w, known: known["possible(lit(at))"],
}


def knowledge(worlds: list[House]) -> dict[str, bool]:
    """What the formulas ask about all worlds."""
    return {
        "at = 1": all(world["at"] == 1 for world in worlds),
        "whether lit(2)": len({world["lit2"] for world in worlds}) == 1,
        "possible(lit(1))": any(world["lit1"] for world in worlds),
        "possible(lit(at))": any(world[f"lit{world['at']}"] for world in worlds),
        **{f"lit({room})": all(world[f"lit{room}"] for world in worlds) for room in ROOMS},
    }


DEFINED = "".join(f"define formula{number} := {formula}\n" for number, formula in enumerate(FORMULAS))
DYNAMICS = Dynamics(theory_of(DOMAIN + DEFINED))
KNOWING = DYNAMICS.knowing
BODIES = [DYNAMICS.theory.definitions[f"formula{number}"].body for number in range(len(FORMULAS))]
COMPILED = [(KNOWING.condition(body, 0), KNOWING.refuted(body, 0)) for body in BODIES]
COLUMNS = [name + "".join(map(str, args)) for name, args in DYNAMICS.layout.ground_fluents]


def first_worlds() -> list[House]:
    every = itertools.product(ROOMS, (False, True), (False, True), (False, True), (0, 1, 2))
    return [
        {"at": at, "lit1": a, "lit2": b, "lit3": c, "heat1": 1, "heat2": 1, "heat3": 1, "spare": spare}
        for at, a, b, c, spare in every
        if at != 2 or b
    ]


def after(world: House, action: str, args: tuple[int, ...]) -> list[House]:
    """Every world that an action may lead to."""
    world = dict(world)
    EFFECTS[action](world, *args)
    each = [value if isinstance(value, set) else {value} for value in world.values()]
    return [dict(zip(world, values, strict=True)) for values in itertools.product(*each)]


def rows(worlds: list[House]) -> set[tuple[Hashable, ...]]:
    return {tuple(world[column] for column in COLUMNS) for world in worlds}


def distinct(worlds: list[House]) -> list[House]:
    return [dict(zip(COLUMNS, row, strict=True)) for row in rows(worlds)]


def worlds_of(state: State) -> set[tuple[Hashable, ...]]:
    return set(state) if isinstance(state, Worlds) else {state}


def test_the_first_worlds_are_those_that_the_constraint_leaves() -> None:
    assert worlds_of(DYNAMICS.initial()) == rows(first_worlds())


@given(st.lists(st.tuples(st.sampled_from(ACTIONS), st.integers(0, 100)), max_size=6))
def test_every_operation_leaves_the_right_worlds(steps: list[tuple[tuple[str, tuple[int, ...]], int]]) -> None:
    state, worlds = DYNAMICS.initial(), first_worlds()
    for (action, args), chance in steps:
        if action == "blown":
            could = [world for world in worlds if world[f"lit{args[0]}"]]
            witnessed = DYNAMICS.witness(state, action, args)
            assert (witnessed is None) == (not could)
            state, worlds = (state, worlds) if witnessed is None else (witnessed, could)
        if action == "walk":
            assert DYNAMICS.possible(state, action, args) == all(world["at"] < 3 for world in worlds)
        state = DYNAMICS.progress(state, action, args)
        worlds = distinct([world for before in worlds for world in after(before, action, args)])
        assert worlds_of(state) == rows(worlds)
        if action in SENSES:
            outcomes = DYNAMICS.outcomes(state, action, args)
            assert {outcome.results for outcome in outcomes} == {SENSES[action](world, *args) for world in worlds}
            chosen = outcomes[chance % len(outcomes)]
            worlds = [world for world in worlds if SENSES[action](world, *args) == chosen.results]
            assert worlds_of(chosen.state) == rows(worlds)
            state, surprises = DYNAMICS.assimilate(state, action, args, chosen.results)
            assert not surprises
            assert state == chosen.state
        table = [(range(DYNAMICS.layout.size), sorted(worlds_of(state), key=str))]
        assert state == rebuilt((None,) * DYNAMICS.layout.size, (), set(), table), "equal sets are equal states"
        check_answers(state, worlds)


def check_answers(state: State, worlds: list[House]) -> None:
    """Compiled and interpreted answers to every formula, in all worlds at once."""
    known = knowledge(worlds)
    for formula, body, (condition, refuted) in zip(FORMULAS.values(), BODIES, COMPILED, strict=True):
        truths = {bool(formula(world, known)) for world in worlds}
        expected = truths.pop() if len(truths) == 1 else None
        assert KNOWING.verdict(body, state, ()) is expected
        assert condition(state, ()) is (expected is True)
        assert refuted(state, ()) is (expected is False)


def test_what_is_unknown_independently_is_kept_independently() -> None:
    text = "domain d\ntype n = 1..40\nfluent f(x: n): bool = unknown\naction a(x: n):\n    senses f(x)\n"
    dynamics = Dynamics(theory_of(text))
    state = dynamics.initial()
    assert isinstance(state, Worlds)
    assert len(state) == 2**40
    state, _ = dynamics.assimilate(state, "a", (7,), (True,))
    assert isinstance(state, Worlds)
    assert len(state) == 2**39
    assert dynamics.value(state, "f", (7,)) is True
    assert dynamics.value(state, "f", (8,)) == Unknown((False, True))


def test_a_question_that_asks_too_much_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("golc.situation.worlds.MOST_CASES", 1_000)
    text = "domain d\ntype n = 1..10\nfluent f(x: n): bool = unknown\naction a:\n    senses (count x: n. f(x)) > 3\n"
    dynamics = Dynamics(theory_of(text))
    with pytest.raises(ProgramError, match="more than 1000 cases") as caught:
        dynamics.outcomes(dynamics.initial(), "a", ())
    assert caught.value.diagnostic.span.line == 5


def test_a_surprise_gives_a_sensed_fluent_the_value_in_every_world() -> None:
    text = """\
domain d
type n = 1..4
fluent f: n = unknown
fluent g: bool = unknown
initially f < 3
action a:
    senses f
"""
    dynamics = Dynamics(theory_of(text))
    state, surprises = dynamics.assimilate(dynamics.initial(), "a", (), (4,))
    assert dynamics.show(state) == {"f": 4, "g": Unknown((False, True))}
    assert [(surprise.sensed, surprise.expected, surprise.fluent) for surprise in surprises] == [
        (4, Unknown((1, 2)), "f")
    ]


def test_a_constraint_for_many_is_asked_one_by_one() -> None:
    text = """\
domain d
type n = 1..40
fluent lit(x: n) = unknown
initially forall x: n, y: n where y = x + 20. lit(x) iff lit(y)
"""
    state = Dynamics(theory_of(text)).initial()
    assert isinstance(state, Worlds)
    assert len(state) == 2**20
    assert {len(factor.rows) for factor in state.factors} == {2}


def test_values_that_are_all_different_are_the_permutations() -> None:
    text = """\
domain d
type n = 1..3
fluent f(x: n): n = unknown
initially forall x: n, y: n where x != y. f(x) != f(y)
"""
    state = Dynamics(theory_of(text)).initial()
    assert isinstance(state, Worlds)
    assert set(state) == set(itertools.permutations((1, 2, 3)))


def test_possible_values_are_shown_in_the_order_of_their_type() -> None:
    text = "domain d\ntype side = {left, right, top}\nfluent f: side = one of [top, left]\nfluent g: side? = unknown\n"
    dynamics = Dynamics(theory_of(text))
    state = dynamics.initial()
    assert dynamics.show(state) == {"f": Unknown(("left", "top")), "g": Unknown((None, "left", "right", "top"))}
    assert dynamics.value(state, "f") == Unknown(("left", "top"))


def test_a_constraint_that_leaves_nothing_is_named() -> None:
    text = "domain d\nfluent f: 1..3 = unknown\ninitially f > 1\ninitially f < 2\n"
    with pytest.raises(ProgramError, match="no initial world is possible") as caught:
        Dynamics(theory_of(text)).initial()
    assert caught.value.diagnostic.span.line == 4


def test_only_the_cases_that_matter_are_gone_through() -> None:
    state = DYNAMICS.initial()
    asked = [case for case, _ in survey(state, lambda world: world[DYNAMICS.layout.places["spare"].base])]
    assert len(asked) == 3


def test_cases_that_are_given_by_many_fluents_count_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("golc.situation.worlds.MOST_CASES", 100)
    state = choices((0,) * 160, dict.fromkeys(range(160), (0, 1)))
    answers = survey(state, lambda world: [world[slot] for slot in range(160)])
    assert len(list(itertools.islice(answers, 10))) == 10
    with pytest.raises(TooManyCasesError):  # of 160 fluents, each case counts eleven times
        next(answers)


def test_a_case_that_is_given_by_very_many_fluents_takes_no_more_memory_than_they() -> None:
    state = choices((0,) * 20_000, dict.fromkeys(range(20_000), (0, 1)))
    tracemalloc.start()
    try:
        case, answer = next(survey(state, lambda world: any(map(world.__getitem__, range(20_000)))))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert (len(case), answer) == (20_000, False)
    assert peak < 100 * 2**20


@pytest.mark.parametrize(("most", "worlds"), [(41, 41), (40, None)])
def test_so_many_worlds_may_agree_with_what_was_sensed(
    monkeypatch: pytest.MonkeyPatch, most: int, worlds: int | None
) -> None:
    """Where ``f`` is 1 or 2, each of the 20 values of ``g``; where it is 3, one: 22 cases, 41 worlds."""
    monkeypatch.setattr("golc.situation.worlds.MOST_CASES", most)
    text = "domain d\nfluent f: 1..3 = unknown\nfluent g: 1..20 = unknown\naction a:\n    senses f != 3 or g = 1\n"
    dynamics = Dynamics(theory_of(text))
    if worlds is None:
        with pytest.raises(ProgramError, match="more than 40 cases"):
            dynamics.assimilate(dynamics.initial(), "a", (), (True,))
    else:
        state, _ = dynamics.assimilate(dynamics.initial(), "a", (), (True,))
        assert isinstance(state, Worlds) and len(state) == worlds
