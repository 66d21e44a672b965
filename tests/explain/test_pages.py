"""What the pages about the names of the examples say, written down from the files by hand."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from golc.diagnostics import UserError
from golc.explain.pages import explain
from golc.explain.rendering import as_text
from golc.loading import load
from golc.theory.theory import BasicActionTheory

EXAMPLES = Path(__file__).parents[2] / "examples"
Theory = Callable[[str], BasicActionTheory]


def sections(theory: BasicActionTheory, name: str) -> dict[str, list[str]]:
    """The lines below each heading of the only page about a name."""
    _, *lines = as_text(explain(theory, name)).splitlines()
    found: dict[str, list[str]] = {}
    for line in filter(None, lines):
        if line[:8].isspace():
            found[list(found)[-1]].append(line[8:])
        else:
            found[line.strip()] = []
    return found


@pytest.fixture(scope="module")
def elevator() -> BasicActionTheory:
    return load(EXAMPLES / "elevator" / "elevator.gl")


@pytest.fixture(scope="module")
def delivery() -> BasicActionTheory:
    return load(EXAMPLES / "delivery" / "delivery.gl")


@pytest.fixture(scope="module")
def sorter() -> BasicActionTheory:
    return load(EXAMPLES / "sorter" / "sorter.gl")


def test_a_relational_fluent_that_only_ends(elevator: BasicActionTheory) -> None:
    assert sections(elevator, "lit") == {
        "Initially": ["lit(n, S₀) ≡ n ∈ {2, 5, 9}"],
        "Successor state axiom": ["lit(n, do(a, s)) ≡ lit(n, s) ∧ ¬γ⁻(n, a, s)", "γ⁻(n, a, s) ≡ a = off(n)"],
    }


def test_a_functional_fluent(elevator: BasicActionTheory) -> None:
    assert sections(elevator, "at") == {
        "Initially": ["at(S₀) = 3"],
        "Successor state axiom": [
            "at(do(a, s)) = y ≡ γ(y, a, s) ∨ at(s) = y ∧ ¬∃y′. γ(y′, a, s)",
            "γ(y, a, s) ≡",
            "    a = up ∧ y = at(s) + 1",
            "    ∨ a = down ∧ y = at(s) - 1",
        ],
    }


def test_an_action(elevator: BasicActionTheory) -> None:
    assert sections(elevator, "off") == {
        "Action precondition axiom": ["Poss(off(n), s) ≡ at(s) = n ∧ lit(n, s)"],
        "Effects": ["¬lit(n, do(off(n), s))"],
    }
    assert sections(elevator, "up") == {
        "Action precondition axiom": ["Poss(up, s) ≡ at(s) + 1 ∈ floor"],
        "Effects": ["at(do(up, s)) = at(s) + 1"],
    }
    assert sections(elevator, "open") == {"Action precondition axiom": ["Poss(open, s) ≡ true"]}


def test_a_relational_fluent_with_an_effect_for_all(delivery: BasicActionTheory) -> None:
    assert sections(delivery, "holding_delivery_for") == {
        "Initially": ["holding_delivery_for(to, S₀) ≡ to ∈ {4, 6}"],
        "Successor state axiom": [
            "holding_delivery_for(to, do(a, s)) ≡",
            "    γ⁺(to, a, s) ∨ holding_delivery_for(to, s) ∧ ¬γ⁻(to, a, s)",
            "γ⁺(to, a, s) ≡",
            "    a = push_go_button ∧ to ≠ location(s) ∧ delivery_requested(location(s), s) = to",
            "γ⁻(to, a, s) ≡ a = push_go_button ∧ to = location(s)",
        ],
    }


def test_arguments_and_values_that_are_parameters_stand_in_the_action(delivery: BasicActionTheory) -> None:
    assert sections(delivery, "delivery_requested") == {
        "Initially": ["delivery_requested(origin, S₀) = none"],
        "Successor state axiom": [
            "delivery_requested(origin, do(a, s)) = y ≡",
            "    γ(origin, y, a, s) ∨ delivery_requested(origin, s) = y ∧ ¬∃y′. γ(origin, y′, a, s)",
            "γ(origin, y, a, s) ≡",
            "    a = push_go_button ∧ origin = location(s) ∧ y = none",
            "    ∨ a = request_delivery(origin, y)",
            "    ∨ (∃to. a = cancel_request(origin, to) ∧ y = none)",
        ],
    }


def test_a_fluent_that_three_actions_change(delivery: BasicActionTheory) -> None:
    assert sections(delivery, "motion") == {
        "Initially": ["motion(S₀) = stopped"],
        "Successor state axiom": [
            "motion(do(a, s)) = y ≡ γ(y, a, s) ∨ motion(s) = y ∧ ¬∃y′. γ(y′, a, s)",
            "γ(y, a, s) ≡",
            "    a = start_to_next_station ∧ y = moving",
            "    ∨ a = arrive_at_station ∧ y = stopped",
            "    ∨ a = stop_abnormally ∧ y = suspended",
        ],
    }


def test_an_exogenous_action_with_an_effect_for_all(delivery: BasicActionTheory) -> None:
    assert sections(delivery, "push_go_button") == {
        "Action precondition axiom": ["Poss(push_go_button, s) ≡ true"],
        "Effects": [
            "delivery_requested(location(s), do(push_go_button, s)) = none",
            "¬holding_delivery_for(location(s), do(push_go_button, s))",
            "∀m: station.",
            "    m ≠ location(s) ∧ delivery_requested(location(s), s) = m",
            "    ⊃ holding_delivery_for(m, do(push_go_button, s))",
        ],
    }


def test_a_precondition_of_several_parts(delivery: BasicActionTheory) -> None:
    assert sections(delivery, "start_to_next_station")["Action precondition axiom"] == [
        "Poss(start_to_next_station, s) ≡",
        "    motion(s) ∈ {stopped, suspended} ∧ location(s) + direction(s) ∈ station",
    ]


def test_definitions_are_named_where_they_are_used_and_have_their_own_page(delivery: BasicActionTheory) -> None:
    assert sections(delivery, "stop_requested") == {
        "Definition": ["stop_requested(n, s) ≡ delivery_requested(n, s) ≠ none ∨ holding_delivery_for(n, s)"]
    }


def test_interrupts(delivery: BasicActionTheory) -> None:
    assert sections(delivery, "control") == {
        "Program": [
            "proc control",
            "    ⟨motion = suspended → reposition_robot; start_to_next_station⟩",
            "    ⟩⟩ ⟨motion = moving → while motion = moving do wait endWhile⟩",
            "    ⟩⟩ ⟨stop_requested(location) →",
            "            signal_arrival; if stop_requested(location) then wait endIf⟩",
            "    ⟩⟩ ⟨n: station. stop_requested(n) → head_for(n)⟩",
            "    ⟩⟩ ⟨location > 1 → head(-1)⟩",
            "    ⟩⟩ ⟨true → wait⟩",
            "endProc",
        ]
    }


def test_a_parameter_that_is_called_as_the_situation_is_gets_a_number(sorter: BasicActionTheory) -> None:
    assert sections(sorter, "sorted") == {
        "Initially": ["sorted(c, S₀) = 0"],
        "Successor state axiom": [
            "sorted(c, do(a, s)) = y ≡ γ(c, y, a, s) ∨ sorted(c, s) = y ∧ ¬∃y′. γ(c, y′, a, s)",
            "γ(c, y, a, s) ≡ ∃s₁. a = push(s₁) ∧ c = colour_seen(s) ∧ y = sorted(colour_seen(s), s) + 1",
        ],
    }


def test_a_fluent_that_nothing_changes_and_one_that_is_gained_and_lost(sorter: BasicActionTheory) -> None:
    assert sections(sorter, "colour_seen")["Successor state axiom"] == ["colour_seen(do(a, s)) = colour_seen(s)"]
    assert sections(sorter, "hopper_empty") == {
        "Initially": ["¬hopper_empty(S₀)"],
        "Successor state axiom": [
            "hopper_empty(do(a, s)) ≡ γ⁺(a, s) ∨ hopper_empty(s) ∧ ¬γ⁻(a, s)",
            "γ⁺(a, s) ≡ a = hopper_runs_empty",
            "γ⁻(a, s) ≡ a = fill_hopper",
        ],
    }


def test_a_sensing_action(sorter: BasicActionTheory) -> None:
    assert sections(sorter, "look") == {
        "Action precondition axiom": ["Poss(look, s) ≡ brick_at(s) = belt"],
        "Effects": ["brick_at(do(look, s)) = sensor"],
        "Sensed fluent axiom": ["SR(look, s) = colour_seen(s)"],
    }


def test_a_table_and_names_of_values(sorter: BasicActionTheory) -> None:
    assert sections(sorter, "side_of") == {"Definition": ["side_of(dark) = left", "side_of(light) = right"]}
    assert sections(sorter, "bricks") == {"Definition": ["bricks = 5"]}
    assert sections(sorter, "side") == {"Definition": ["side = {left, right}"]}
    assert sections(sorter, "belt") == {"Definition": ["belt ∈ place"]}


def test_what_is_sensed_of_the_action_s_own_effects_is_sensed_after_it(theory: Theory) -> None:
    built = theory(
        "fluent lamp = false\nfluent n: 0..9 = 0\n"
        "action press:\n    causes lamp := not lamp\n    senses lamp\n    senses n\n"
    )
    assert sections(built, "press")["Sensed fluent axiom"] == [
        "SF₁(press, s) ≡ lamp(do(press, s))",
        "SR₂(press, s) = n(s)",
    ]
    assert sections(built, "lamp")["Successor state axiom"] == [
        "lamp(do(a, s)) ≡ γ⁺(a, s) ∨ lamp(s) ∧ ¬γ⁻(a, s)",
        "γ⁺(a, s) ≡ a = press ∧ ¬lamp(s)",
        "γ⁻(a, s) ≡ a = press ∧ lamp(s)",
    ]


KNOWLEDGE = """type door = {open, closed}
fluent gate(n: 1..2): door = unknown
fluent lit = one of {true}
fluent near: 1..2 = 1
initially gate(1) = open or near = 2
action shake(n: 1..2):
    poss knows(lit) and not known(gate(n)) and possible(gate(n) = open)
    causes gate(n) := unknown
    causes lit := one of {true, false} when near = n
action look(n: 1..2):
    senses gate(n)
exog shut(n: 1..2):
    poss near = n
    causes gate(n) := closed
"""


def test_what_is_unknown_at_first_and_after_an_action(theory: Theory) -> None:
    assert sections(theory(KNOWLEDGE), "gate") == {
        "Initially": ["K(s, S₀) ⊃ gate(n, s) ∈ door", "K(s, S₀) ⊃ gate(1, s) = open ∨ near(s) = 2"],
        "Successor state axiom, in each possible world": [
            "s′ ∈ Do(a, s) ∧ gate(n, s′) = y ⊃ γ(n, y, a, s) ∨ gate(n, s) = y ∧ ¬∃y′. γ(n, y′, a, s)",
            "γ(n, y, a, s) ≡",
            "    a = shake(n) ∧ y ∈ door",
            "    ∨ a = shut(n) ∧ y = closed",
        ],
        "Possible worlds": ["K(s″, do(shake(n), s)) ≡ ∃s′. K(s′, s) ∧ s″ ∈ Do(shake(n), s′)"],
    }
    assert sections(theory(KNOWLEDGE), "lit")["Successor state axiom, in each possible world"] == [
        "s′ ∈ Do(a, s) ∧ lit(s′) ⊃ γ⁺(a, s) ∨ lit(s) ∧ ¬γ⁻(a, s)",
        "s′ ∈ Do(a, s) ∧ ¬lit(s′) ⊃ γ⁻(a, s) ∨ ¬lit(s) ∧ ¬γ⁺(a, s)",
        "γ⁺(a, s) ≡ ∃n. a = shake(n) ∧ near(s) = n",
        "γ⁻(a, s) ≡ ∃n. a = shake(n) ∧ near(s) = n",
    ]


def test_actions_that_change_what_is_known(theory: Theory) -> None:
    built = theory(KNOWLEDGE)
    assert sections(built, "shake") == {
        "Action precondition axiom": [
            "Poss(shake(n), s) ≡ Knows(lit, s) ∧ ¬KRef(gate(n), s) ∧ ¬Knows(¬(gate(n) = open), s)"
        ],
        "Effects": [
            "s′ ∈ Do(shake(n), s) ⊃ gate(n, s′) ∈ door",
            "near(s) = n ∧ s′ ∈ Do(shake(n), s) ⊃ lit(s′) ∈ {true, false}",
        ],
        "Possible worlds": ["K(s″, do(shake(n), s)) ≡ ∃s′. K(s′, s) ∧ s″ ∈ Do(shake(n), s′)"],
    }
    assert sections(built, "look")["Possible worlds"] == [
        "K(s″, do(look(n), s)) ≡",
        "    ∃s′. K(s′, s) ∧ s″ = do(look(n), s′) ∧ gate(n, s″) = gate(n, do(look(n), s))",
    ]
    assert sections(built, "shut")["Possible worlds"] == [
        "K(s″, do(shut(n), s)) ≡ ∃s′. K(s′, s) ∧ Poss(shut(n), s′) ∧ s″ = do(shut(n), s′)"
    ]


def test_goals_invariants_prunes_and_costs(theory: Theory) -> None:
    built = theory(
        "const top = 3\nfluent at: 1..top = 1\ninvariant low: at < top\ngoal home: at = 1\n"
        "prune high: at > 2\nprune back: after go(n) when before(at) = n and at = n\n"
        "action go(n: 1..top):\n    causes at := n\n    cost abs(n - at) * 2\n"
    )
    assert sections(built, "low") == {"Definition": ["low(s) ≡ at(s) < 3"], "State constraint": ["S₀ ⊑ s ⊃ low(s)"]}
    assert sections(built, "home") == {"Definition": ["home(s) ≡ at(s) = 1"]}
    assert sections(built, "high") == {"Bad situations": ["at(s) > 2 ⊃ BadSituation(s)"]}
    assert sections(built, "back") == {
        "Bad situations": ["at(s) = n ∧ at(do(go(n), s)) = n ⊃ BadSituation(do(go(n), s))"]
    }
    assert sections(built, "go")["Cost"] == ["cost(go(n), s) = |n - at(s)| · 2"]


def test_terms_of_every_kind(theory: Theory) -> None:
    built = theory(
        "type t = {a, b}\nfluent f(x: t): int = 0\nfluent p(x: t) = true\nstatic g(x: t): int = 1 if x = a else 2\n"
        "define d1 := exists x: t where p(x). forall y: t. p(y) implies f(y) < 2 or not p(x) and x not in {b}\n"
        "define d2 := (count x: t where p(x). f(x) = 1) + sum x: t. f(x) * -2\n"
        "define d3(x: t) := (p(x) iff p(a)) iff p(b)\n"
        "define d4 := f(a) // 2 - (f(b) - 3) % 4 + abs(f(a)) + min(1, f(a)) + (max x: t where p(x). f(x) + 1)\n"
        "define d5(x: t) := (f(x) if p(x) else 3) >= g(x) and (exists y: t. p(y)) and 2 <= 3\n"
        "define d6(s: t, a: int) := not (f(s) > a) or a in 1..5 or poss(go(s)) and s != b\n"
        "action go(x: t)\n"
    )
    found = {name: sections(built, name)["Definition"] for name in ("d1", "d2", "d3", "d4", "d5", "d6", "g")}
    assert found == {
        "d1": ["d1(s) ≡ ∃x: t. p(x, s) ∧ ∀y: t. p(y, s) ⊃ f(y, s) < 2 ∨ ¬p(x, s) ∧ x ∉ {b}"],
        "d2": ["d2(s) = #{x: t | p(x, s) ∧ f(x, s) = 1} + ∑{f(x, s) · -2 | x: t}"],
        "d3": ["d3(x, s) ≡ ((p(x, s) ≡ p(a, s)) ≡ p(b, s))"],
        "d4": [
            "d4(s) =",
            "    ⌊f(a, s) / 2⌋ - (f(b, s) - 3) mod 4 + |f(a, s)| + min(1, f(a, s))",
            "    + max{f(x, s) + 1 | x: t, p(x, s)}",
        ],
        "d5": ["d5(x, s) ≡ (if p(x, s) then f(x, s) else 3) ≥ g(x) ∧ (∃y: t. p(y, s)) ∧ 2 ≤ 3"],
        "d6": ["d6(s₁, a, s) ≡ ¬(f(s₁, s) > a) ∨ a ∈ 1..5 ∨ Poss(go(s₁), s) ∧ s₁ ≠ b"],
        "g": ["g(x) = (if x = a then 1 else 2)"],
    }


def test_collections_strings_and_real_numbers(theory: Theory) -> None:
    built = theory(
        'type t = {a, b}\nfluent seen: set[t] = {}\nfluent route: list[t] = [a]\nfluent note: string = "a b"\n'
        "fluent speed: real = 0.5\naction go(x: t):\n"
        "    poss x in route and len(route) > 1 and route[0] != first(route)\n"
        "    causes seen := seen + {y for y: t where y != x} - {a}\n    causes route := rest(route) + [x]\n"
        '    causes note := "at {x}"\n    causes forall y in route. speed := 2.5 when y = x\n'
    )
    found = {name: sections(built, name)["Successor state axiom"][1] for name in ("seen", "route", "note", "speed")}
    assert found == {
        "seen": "γ(y, a, s) ≡ ∃x. a = go(x) ∧ y = seen(s) ∪ {y₁ | y₁: t, y₁ ≠ x} ∖ {a}",
        "route": "γ(y, a, s) ≡ ∃x. a = go(x) ∧ y = rest(route(s)) ⌢ [x]",
        "note": 'γ(y, a, s) ≡ ∃x. a = go(x) ∧ y = "at {x}"',
        "speed": "γ(y, a, s) ≡ ∃x, y₁: t. a = go(x) ∧ y₁ ∈ route(s) ∧ y₁ = x ∧ y = 2.5",
    }
    assert sections(built, "go")["Action precondition axiom"] == [
        "Poss(go(x), s) ≡ x ∈ route(s) ∧ len(route(s)) > 1 ∧ route(s)[0] ≠ first(route(s))"
    ]
    assert sections(built, "note")["Initially"] == ['note(S₀) = "a b"']


def test_programs_of_every_kind(theory: Theory) -> None:
    built = theory(
        """type t = {a, b}
fluent f(x: t) = false
fluent n: int = 0
action go(x: t)
action stay
proc p(k: int):
    star at most k + 1:
        stay
    star:
        choose:
            go(a)
            stay
        or:
            skip
    together:
        stay
    and:
        prefer:
            stay
        over:
            wait 5 s
    within 2.5 s:
        wait
    else:
        abort "no {k}"
    together star:
        stay
    guard not f(a):
        stay
    search shortest at most k steps within 3 s:
        stay
    for x: t where f(x):
        go(x)
    let m = k + n:
        say "{m} is {n}"
    if f(a):
        stay
    elif n > 0:
        p(k - 1)
    wait until n = 3 or f(b)
    pick x: t, j: 1..3 where f(x) and j > n:
        go(x)
        stay
    test n = 0
    search:
        while f(a):
            stay
"""
    )
    assert sections(built, "p")["Program"] == [
        "proc p(k)",
        "    (stay)^≤(k + 1);",
        "    (go(a); stay | nil)*;",
        "    (stay ∥ (stay ⟩⟩ wait(5 s)));",
        '    within(2.5 s, wait, abort("no {k}"));',
        "    (stay)^∥;",
        "    gexec(¬f(a), stay);",
        "    Σ[shortest, ≤ k, 3 s](stay);",
        "    for x: t where f(x) do go(x) endFor;",
        '    let m = k + n in say("{m} is {n}") endLet;',
        "    if f(a) then stay else if n > 0 then p(k - 1) endIf endIf;",
        "    while ¬(n = 3 ∨ f(b)) do wait endWhile;",
        "    πx: t, j: 1..3. ((f(x) ∧ j > n)?; go(x); stay);",
        "    (n = 0)?;",
        "    Σ(while f(a) do stay endWhile)",
        "endProc",
    ]


def test_what_two_namespaces_have_in_common_has_two_pages(theory: Theory) -> None:
    built = theory("fluent open = false\naction open:\n    causes open := true\nproc control:\n    open\n")
    assert [page.title for page in explain(built, "open")] == ["relational fluent open", "action open"]


def test_an_unknown_name_is_no_name_and_perhaps_another_one(theory: Theory) -> None:
    built = theory("fluent motion = false\n")
    with pytest.raises(UserError) as raised:
        explain(built, "motoin")
    (finding,) = raised.value.diagnostics
    assert (finding.code.code, finding.help) == ("GL012", "did you mean `motion`?")
    assert finding.message == "nothing in the domain `trial` has the name `motoin`"
