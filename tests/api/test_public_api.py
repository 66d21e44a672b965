"""The public Python API: what can be asked of a theory, and how wrong questions are answered."""

from __future__ import annotations

import doctest
import importlib
from fractions import Fraction
from pathlib import Path

import pytest

import golc

ROOT = Path(__file__).parents[2]

LIFT = """domain lift

const top = 3

type floor = 1..top

fluent at: floor = 1
fluent lit(n: floor) = n > 1
fluent weight: real = one of {0.5, 1, 2.5}
fluent mood: {calm, angry} = unknown
fluent news: string? = none

action up:
    poss at + 1 in floor
    causes at := at + 1

action off(n: floor):
    poss at = n and lit(n)
    poss n != 3 or mood = calm
    causes lit(n) := false

action jump(by: int):
    poss at + by in floor
    causes at := at + by

action weigh:
    senses weight

action look:
    senses mood
    senses at

exog call(n: floor):
    poss not lit(n)
    causes lit(n) := true

exog calms_down:
    poss mood = angry
    causes mood := calm

exog hear(what: string):
    causes news := what

define heavy := weight > 2

goal dark: not exists n: floor. lit(n)

proc control:
    while at < top:
        up

proc climb(n: floor):
    while at < n:
        up

proc any:
    choose:
        up
    or:
        jump(1)
    test at = 3
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("lift") / "lift.gl"
    path.write_text(LIFT)
    return path


@pytest.fixture(scope="module")
def lift(path: Path) -> golc.Theory:
    return golc.load(path)


def said(error: pytest.ExceptionInfo[golc.UserError]) -> str:
    """The only message of an error."""
    (diagnostic,) = error.value.diagnostics
    return diagnostic.message


@pytest.mark.parametrize("name", ["golc", "golc.api.theory", "golc.api.state", "golc.api.loading"])
def test_the_examples_of_the_docstrings_are_so(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    results = doctest.testmod(importlib.import_module(name))
    assert results.attempted > 0
    assert results.failed == 0


def test_every_public_name_is_there_and_says_what_it_is() -> None:
    assert [name for name in golc.__all__ if not getattr(golc, name).__doc__] == []
    assert dir(golc) == sorted(golc.__all__)


def test_constants_are_replaced_by_load(path: Path) -> None:
    theory = golc.load(path, {"top": "5"})
    assert theory.constants["top"].value == 5
    assert theory.overrides == {"top": "5"}
    assert theory.value(theory.initial(), "count n: floor. lit(n)") == 4


def test_a_theory_says_what_it_declares(lift: golc.Theory, path: Path) -> None:
    assert (lift.name, lift.path) == ("lift", str(path))
    assert [*lift.actions] == ["up", "off", "jump", "weigh", "look", "call", "calms_down", "hear"]
    assert [name for name, action in lift.actions.items() if action.exogenous] == ["call", "calms_down", "hear"]
    assert [(p.name, list(p.type.values)) for p in lift.actions["off"].parameters] == [("n", [1, 2, 3])]
    assert [*lift.procedures] == ["control", "climb", "any"]
    assert lift.goals == ("dark",)
    assert repr(lift) == "<Theory lift: 5 fluents, 8 actions, 3 procedures, 0 devices>"


def test_load_raises_all_errors_and_check_returns_them(tmp_path: Path) -> None:
    path = tmp_path / "slip.gl"
    path.write_text("domain slip\nfluent a = b\nfluent c = d\n")
    with pytest.raises(golc.UserError) as caught:
        golc.load(path)
    report = golc.check(path)
    for found in (caught.value.diagnostics, report.errors):
        assert [error.message for error in found] == ["unknown name `b`", "unknown name `d`"]
    assert report.theory is None
    assert "2 errors" in repr(report)


def test_the_check_of_a_theory_is_that_of_its_file(tmp_path: Path) -> None:
    path = tmp_path / "idle.gl"
    path.write_text("domain idle\nfluent a = true\nfluent b = true  # golc: ignore[GL027]\n")
    theory = golc.load(path)
    assert [finding.message for finding in theory.check().findings] == ["fluent `a` is not used"]
    assert theory.check().theory is theory
    assert [finding.message for finding in golc.check(path).findings] == ["fluent `a` is not used"]
    assert str(theory.check()).startswith("warning[GL027]")
    assert theory.check(proofs=False).asked == 0


def test_a_state_is_a_mapping_from_ground_fluents(lift: golc.Theory) -> None:
    state = lift.initial()
    assert (state["at"], state["lit", 2], state["lit(2)"], state["lit( 3 )"]) == (1, True, True, True)
    assert [*state] == ["at", "lit(1)", "lit(2)", "lit(3)", "weight", "mood", "news"]
    assert len(state) == 7
    assert dict(state)["lit(1)"] is False
    assert ("lit", 4) not in state
    assert state.get("lit", "none such") == "none such"


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("ta", "unknown fluent `ta`: did you mean `at`?"),
        ("lit", "the fluent is `lit(n: floor)`"),
        (("lit", 4), "the fluent is `lit(n: floor)`"),
        (("lit", 2, 3), "the fluent is `lit(n: floor)`"),
        (("at", 1), "the fluent `at` has no arguments"),
        ((), "unknown fluent ``"),
    ],
)
def test_what_is_no_ground_fluent_is_a_key_error_that_helps(lift: golc.Theory, key: golc.Key, message: str) -> None:
    with pytest.raises(KeyError) as caught:
        lift.initial()[key]
    assert caught.value.args == (message,)


def test_what_is_not_known_has_its_possible_values(lift: golc.Theory) -> None:
    state = lift.initial()
    assert state["weight"] == golc.Unknown((Fraction(1, 2), 1, Fraction(5, 2)))
    assert state.worlds == 6
    assert "weight = 0.5, 1 or 2.5" in str(state)
    assert lift.do(lift.do(state, "weigh", 1), "look", "calm", 1).worlds == 1


def test_states_are_values(lift: golc.Theory, path: Path) -> None:
    up, jump = lift.do(lift.initial(), "up"), lift.do(lift.initial(), "jump(1)")
    assert up == jump
    assert {up, jump, lift.initial()} == {up, lift.initial()}
    assert up != lift.initial()
    assert golc.load(path).initial() != lift.initial()


def test_a_state_of_another_theory_is_refused(lift: golc.Theory, path: Path) -> None:
    with pytest.raises(ValueError, match="one of another theory"):
        lift.possible(golc.load(path).initial())


def test_what_is_possible_is_listed_and_what_may_happen_apart(lift: golc.Theory) -> None:
    state = lift.initial()
    # Neither jump nor hear, whose instances have no end; calms_down may happen, for the mood may be angry.
    assert [str(call) for call in lift.possible(state)] == ["up", "weigh", "look"]
    assert [str(call) for call in lift.possible(state, exogenous=True)] == ["call(1)", "calms_down"]


def test_all_that_is_possible_can_be_done(lift: golc.Theory) -> None:
    state = lift.do(lift.initial(), "up")
    assert golc.Call("off", (2,)) in lift.possible(state)
    assert lift.do(state, golc.Call("off", (2,)))["lit", 2] is False


def test_each_part_that_keeps_an_action_from_being_possible(lift: golc.Theory) -> None:
    state = lift.do(lift.initial(), "up")
    assert lift.why_not(state, "off(2)") == ()
    assert [(part.text, part.values) for part in lift.why_not(state, "off(3)")] == [
        ("`at = n` is false", (("at", 2), ("n", 3))),
        (
            "`n != 3 or mood = calm` is not known (`look` senses it)",
            (("n", 3), ("mood", golc.Unknown(("calm", "angry")))),
        ),
    ]
    assert [part.span.text for part in lift.why_not(state, "jump(9)")] == ["at + by in floor"]
    # A person who prints them does not want the text of the file.
    assert "domain" not in repr(lift.why_not(state, "jump(9)"))


def test_an_impossible_action_cannot_be_done_and_the_error_says_why(lift: golc.Theory) -> None:
    with pytest.raises(golc.ProgramError) as caught:
        lift.do(lift.initial(), "off(2)")
    diagnostic = caught.value.diagnostic
    assert (diagnostic.code.code, diagnostic.message) == ("GL111", "`off(2)` is not possible in this state")
    assert [label.text for label in diagnostic.labels] == ["`at = n` is false (at = 1, n = 2)"]


def test_an_event_that_cannot_happen_is_an_error_and_one_that_may_tells_something(lift: golc.Theory) -> None:
    with pytest.raises(golc.ProgramError) as caught:
        lift.do(lift.initial(), "call(2)")
    assert caught.value.diagnostic.code.code == "GL112"
    assert lift.do(lift.initial(), "calms_down")["mood"] == "calm"


def test_an_action_senses_what_it_is_told(lift: golc.Theory) -> None:
    state = lift.initial()
    assert lift.do(state, "weigh", 2.5)["weight"] == Fraction(5, 2)
    assert lift.do(state, "look", "angry", 1)["mood"] == "angry"
    known = lift.do(state, "weigh", 1)
    assert lift.do(known, "weigh") == known
    with pytest.raises(golc.ProgramError) as caught:
        lift.do(known, "weigh", 0.5)
    assert caught.value.diagnostic.message == "`weigh` cannot sense 0.5 here, only 1"


@pytest.mark.parametrize(
    ("action", "sensed", "message"),
    [
        ("weigh", (), "`weigh` senses `weight`: `real`, and the value is not known"),
        ("look", ("calm",), "`look` senses `mood`: `{calm, angry}`, `at`: `floor` (1..3); 1 value given"),
        ("weigh", ("much",), "the sensed value 'much' is outside `real`"),
        ("up", (1,), "`up` senses nothing; 1 value given"),
        ("upp", (), "unknown action `upp`"),
        ("off", (), "`off` takes 1 argument (n: floor), not 0"),
        ("off(4)", (), "`n` of `off` is of type floor (1..3), not `4`"),
        (golc.Call("off", (4,)), (), "4 in `off(4)` is outside `floor` (1..3)"),
        (golc.Call("off"), (), "`off` takes 1 argument, not 0"),
        (golc.Call("upp"), (), "unknown action `upp`"),
        ("up; up", (), "`;` does not join or end statements"),
    ],
)
def test_an_action_that_has_no_meaning_is_a_user_error(
    lift: golc.Theory, action: str | golc.Call, sensed: tuple[object, ...], message: str
) -> None:
    with pytest.raises(golc.UserError) as caught:
        lift.do(lift.initial(), action, *sensed)
    assert said(caught) == message


def test_strings_and_lists_of_python_are_arguments(lift: golc.Theory) -> None:
    assert lift.do(lift.initial(), golc.Call("hear", ("bread & butter",)))["news"] == "bread & butter"
    assert lift.do(lift.initial(), 'hear("bread")')["news"] == "bread"


def test_formulas_hold_if_they_are_known_to_be_true(lift: golc.Theory) -> None:
    state = lift.initial()
    assert lift.holds(state, "exists n: floor. lit(n) and n > at")
    assert not lift.holds(state, "heavy")
    assert not lift.holds(state, "not heavy")
    assert lift.holds(state, "not known(heavy)")
    assert lift.value(state, "heavy") == golc.Unknown((False, True))
    assert lift.holds(lift.do(state, "weigh", 2.5), "heavy")


@pytest.mark.parametrize(
    ("term", "value"),
    [
        ("at + top", 4),
        ("0.25 + 0.25", Fraction(1, 2)),
        ("{n for n: floor where lit(n)}", frozenset({2, 3})),
        ("[top, at]", (3, 1)),
        ("news", None),
        ("calm", "calm"),
        ("poss(up)", True),
        ("weight", golc.Unknown((Fraction(1, 2), 1, Fraction(5, 2)))),
    ],
)
def test_terms_have_values_of_python(lift: golc.Theory, term: str, value: object) -> None:
    assert lift.value(lift.initial(), term) == value


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("lit(1) and litt(2)", "<formula>:1:12", "unknown fluent `litt`"),
        ("at + 1", "<formula>:1:1", "`at + 1` is of type `int`, but a formula needs `bool`"),
        ("at =", "<formula>:1:5", "an expression is missing after `=`"),
    ],
)
def test_a_formula_that_has_no_meaning_is_a_user_error_at_its_place(
    lift: golc.Theory, text: str, place: str, message: str
) -> None:
    with pytest.raises(golc.UserError) as caught:
        lift.holds(lift.initial(), text)
    assert (str(caught.value.diagnostics[0].span), said(caught)) == (place, message)


def test_an_error_of_evaluation_is_a_program_error(lift: golc.Theory) -> None:
    with pytest.raises(golc.ProgramError, match="division by zero"):
        lift.value(lift.initial(), "1 // (at - 1)")


def test_errors_look_as_on_the_command_line(lift: golc.Theory, path: Path) -> None:
    with pytest.raises(golc.ProgramError) as caught:
        lift.do(lift.initial(), "off(2)")
    assert str(caught.value).splitlines()[:4] == [
        "error[GL111]: `off(2)` is not possible in this state",
        f"  --> {path}:17:8",
        "   |",
        "17 | action off(n: floor):",
    ]
    with pytest.raises(golc.UserError) as several:
        lift.holds(lift.initial(), "a or b")
    assert [line for line in str(several.value).splitlines() if "error" in line] == [
        "error[GL012]: unknown name `a`",
        "error[GL012]: unknown name `b`",
    ]


def test_a_plan_can_be_carried_out_step_by_step(lift: golc.Theory) -> None:
    plan = lift.plan("climb(3)")
    state = lift.initial()
    for action in plan.actions:
        state = lift.do(state, action)
    assert (str(plan), repr(plan), state["at"]) == ("up\nup", "<Plan: up, up>", 3)


def test_a_plan_begins_in_any_state(lift: golc.Theory) -> None:
    state = lift.do(lift.initial(), "up")
    assert [str(action) for action in lift.plan(state=state).actions] == ["up"]
    assert lift.plan("climb(2)", state=state).actions == ()


def test_a_goal_is_a_formula_and_may_begin_in_any_state(tmp_path: Path) -> None:
    path = tmp_path / "walk.gl"
    path.write_text(
        "domain walk\nfluent at: 1..9 = 1\naction on:\n    causes at := at + 1\ngoal far: at = 4\n"
        "action back:\n    poss at > 1\n    causes at := at - 1\n"
    )
    walk = golc.load(path)
    assert str(walk.plan(goal="at = 3")) == "on\non"
    there = walk.do(walk.do(walk.initial(), "on"), "on")
    assert str(walk.plan(goal="far", state=there)) == "on"
    assert str(walk.plan(goal="at = 2", state=there)) == "back"


def test_where_there_is_no_plan_the_error_says_why(lift: golc.Theory) -> None:
    with pytest.raises(golc.NoPlanError) as caught:
        lift.plan("any")
    assert str(caught.value).startswith("no plan for `any`: proven: it cannot be executed to its end\n")
    assert "`at = 3` is false (at = 2)" in str(caught.value)
    assert caught.value.outcome.plans == 0


def test_a_search_that_gives_up_proves_nothing(lift: golc.Theory) -> None:
    with pytest.raises(golc.LimitError, match="no plan of more than 1 steps was considered"):
        lift.plan(steps=1)


def test_every_plan_is_found_and_their_search_has_an_outcome(lift: golc.Theory) -> None:
    planning = lift.planning("climb(2)", every=True, conformant=True)
    assert [str(plan) for plan in planning] == ["up"]
    assert planning.outcome.plans == 1
    with pytest.raises(ValueError, match="sensed"):
        lift.planning(every=True)


def test_a_goal_and_a_program_exclude_each_other(lift: golc.Theory) -> None:
    with pytest.raises(ValueError, match="leave out `program`"):
        lift.plan("climb(2)", goal="at = 2")


def test_a_plan_that_branches_is_a_tree(tmp_path: Path) -> None:
    gates = golc.load(ROOT / "examples" / "gates" / "gates.gl")
    plan = gates.plan(goal="inside")
    assert "\ngate(middle) = open:\n    drive_in\n" in str(plan)
    assert repr(plan) == "<Plan: look, 2 cases>"


ROBOT = 'domain robot\naction go\nproc control:\n    go\ndevice rcx "robot.nqc":\n    0 go by call go\n'


def test_the_program_of_a_brick_is_written_and_compiled(tmp_path: Path) -> None:
    path = tmp_path / "robot.gl"
    path.write_text(ROBOT)
    (tmp_path / "robot.nqc").write_text("void go()\n{\n  OnFwd(OUT_A);\n}\n")
    (program,) = golc.load(path).gen_nqc()
    assert program.path == tmp_path / "build" / "robot-rcx.nqc"
    assert program.path.exists()
    assert program.warnings == ()
    (elsewhere,) = golc.load(path).gen_nqc(tmp_path / "other", target="rcx")
    assert elsewhere.path == tmp_path / "other" / "robot-rcx.nqc"


def test_wrong_bricks_and_targets(lift: golc.Theory, tmp_path: Path) -> None:
    path = tmp_path / "robot.gl"
    path.write_text(ROBOT)
    with pytest.raises(ValueError, match="there is no brick 'other'; there is rcx"):
        golc.load(path).gen_nqc(device="other")
    with pytest.raises(ValueError, match="there is no target 'rcx3'; there is rcx, rcx2"):
        golc.load(path).gen_nqc(target="rcx3")
    with pytest.raises(golc.UserError, match="no device of kind `rcx`"):
        lift.gen_nqc()
    assert not (tmp_path / "build").exists()
