"""``golc check --reachable``: counterexamples in states that can be reached, with the way there."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from golc.cli.check import command
from golc.loading import Examined, examine

SWITCH = """\
domain trial

fluent x: 0..5 = 0
fluent lit: bool = false

action turn_on:
    poss not lit
    causes lit := true

exog tick:
    poss lit and x < 2
    causes x := x + 1
"""


@pytest.fixture(autouse=True)
def time_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("golc.proofs.among.SECONDS", 600)


def examined(tmp_path: Path, text: str) -> Examined:
    path = tmp_path / "trial.gl"
    path.write_text(text)
    return examine(path, proofs=True, reachable=True)


def found(tmp_path: Path, text: str) -> list[tuple[str, tuple[str, ...]]]:
    """Message and notes of each finding."""
    return [(finding.message, finding.notes) for finding in examined(tmp_path, text).findings]


def test_a_counterexample_is_shown_with_the_fewest_actions_that_lead_to_it(tmp_path: Path) -> None:
    text = f"{SWITCH}\naction jump(far: bool):\n    poss x > 0\n    causes x := x + (4 if far else 1)\n"
    assert found(tmp_path, text) == [
        (
            "`jump` can go wrong: `x` would be 6, which is outside `0..5`",
            (
                "for example when x = 2 and `jump(true)` is done",
                "this is reached by `turn_on`, `tick`, `tick`",
            ),
        )
    ]


def test_what_cannot_be_reached_is_no_counterexample(tmp_path: Path) -> None:
    text = f"{SWITCH}\naction jump:\n    causes x := x + 3\n    causes x := 5 when x = 5 and not lit\n"
    path = tmp_path / "trial.gl"
    path.write_text(text)
    assert [finding.code.code for finding in examine(path, proofs=True).findings] == ["GL041", "GL040"]
    assert [finding.code.code for finding in examine(path, proofs=True, reachable=True).findings] == ["GL041", "GL073"]


def test_an_effect_that_is_wrong_at_first(tmp_path: Path) -> None:
    assert found(tmp_path, f"{SWITCH}\naction drop:\n    causes x := x - 1\n") == [
        (
            "`drop` can go wrong: `x` would be -1, which is outside `0..5`",
            ("for example when x = 0 and `drop` is done", "this is so at first"),
        )
    ]


def test_effects_that_conflict_after_some_actions(tmp_path: Path) -> None:
    text = f"{SWITCH}\naction push:\n    causes x := 1\n    causes x := 2 when lit\n"
    assert found(tmp_path, text) == [
        (
            "`push` may give `x` two values at once",
            ("for example when lit = true and `push` is done", "this is reached by `turn_on`"),
        )
    ]


def test_an_invariant_is_broken_after_some_actions_and_nothing_follows(tmp_path: Path) -> None:
    text = f"{SWITCH}\ninvariant low: x < 2\n\naction jump:\n    poss x = 2\n    causes x := 7 - x\n"
    assert found(tmp_path, text) == [
        (
            "`tick` may break invariant `low`",
            ("for example when x = 1, lit = true and `tick` happens", "this is reached by `turn_on`, `tick`"),
        ),
        ("`jump` can never be possible", ()),
    ]


def test_an_action_that_no_state_allows_that_can_be_reached(tmp_path: Path) -> None:
    text = f"{SWITCH}\naction sleep:\n    poss x = 4\n"
    assert found(tmp_path, text) == [
        ("`sleep` can never be possible", ("in all 4 states that can be reached",)),
    ]


def test_several_initial_worlds_and_what_is_sensed(tmp_path: Path) -> None:
    text = (
        "domain trial\n\nfluent gate: 1..3 = unknown\ninitially gate != 3\n\naction look:\n    senses gate\n\n"
        "action close:\n    poss gate = 2\n    causes gate := gate + 2\n\naction open:\n    poss gate = 3\n"
    )
    assert found(tmp_path, text) == [
        (
            "`close` can go wrong: `gate` would be 4, which is outside `1..3`",
            ("for example when gate = 2 and `close` is done", "this is reached by `look` (senses 2)"),
        ),
        ("`open` can never be possible", ("in all 3 states that can be reached",)),
    ]


def test_an_unknown_outcome(tmp_path: Path) -> None:
    text = (
        "domain trial\n\nfluent coin: 0..2 = 0\n\nexog toss:\n    causes coin := one of {1, 2}\n\n"
        "exog take:\n    poss coin = 1\n    causes coin := coin - 2\n"
    )
    assert found(tmp_path, text) == [
        (
            "`take` can go wrong: `coin` would be -1, which is outside `0..2`",
            ("for example when coin = 1 and `take` happens", "this is reached by `toss`"),
        )
    ]


def test_what_an_agent_cannot_get_to_know_it_cannot_act_on(tmp_path: Path) -> None:
    text = "domain trial\n\nfluent gate: bool = unknown\nfluent x: 0..3 = 0\n"
    go = "\naction go:\n    poss gate\n    causes x := x + 4\n"
    assert ("`go` can never be possible", ("in the only state that can be reached",)) in found(tmp_path, text + go)
    happens = go.replace("action", "exog")
    assert [notes[1] for _, notes in found(tmp_path, text + happens)] == ["this is so at first"]


def test_what_is_known_is_told_apart(tmp_path: Path) -> None:
    text = (
        "domain trial\n\nfluent gate: bool = unknown\nfluent x: 0..3 = 0\n\naction look:\n    senses gate\n\n"
        "action go:\n    causes x := 1 when known(gate)\n    causes x := 2 when not known(gate)\n"
    )
    done = examined(tmp_path, text)
    assert done.findings == ()
    assert done.undecided == 0


@pytest.mark.parametrize(
    ("parameter", "effect", "scope"),
    [
        ("n: int", "x := 1 when n > 7", "in all 4 states that can be reached"),
        ("n: int", "x := n", "in all 12 states that can be reached"),
        ("n: 0..100000", "x := 3 when n = 70000", "in all 5 states that can be reached"),
        ("s: string", "x := 3", "in all 5 states that can be reached"),
    ],
)
def test_parameters_without_end_that_make_few_states(tmp_path: Path, parameter: str, effect: str, scope: str) -> None:
    poss = "0 <= n and n <= 5" if effect == "x := n" else "true"
    text = SWITCH.replace("x < 2", "x < 1") + f"\nexog far({parameter}):\n    poss {poss}\n    causes {effect}\n"
    assert str(examined(tmp_path, text).scope) == scope


def test_effects_that_contradict_each_other_lead_nowhere(tmp_path: Path) -> None:
    text = f"{SWITCH}\nexog far(n: int):\n    causes x := 5 when n > 3\n    causes x := 4 when n > 3\n"
    done = examined(tmp_path, text)
    assert str(done.scope) == "in all 4 states that can be reached"
    assert [finding.message for finding in done.findings] == ["`far` may give `x` two values at once"]


def test_an_integer_without_end_that_is_an_argument_of_a_fluent(tmp_path: Path) -> None:
    text = f"{SWITCH}\nfluent called(n: 4..6): bool = false\nexog call(n: int):\n    causes called(n) := true\n"
    done = examined(tmp_path, text)
    assert str(done.scope) == "in all 32 states that can be reached"
    assert [finding.notes for finding in done.findings] == [
        ("for example when `call(0)` happens, in any situation", "this is so at first")
    ]


def test_nothing_is_reached_through_a_state_in_which_an_invariant_is_false(tmp_path: Path) -> None:
    text = "domain trial\n\nfluent x: 0..9 = 0\n\ninvariant low: x < 3\n\naction inc:\n    causes x := x + 1\n"
    done = examined(tmp_path, text)
    assert str(done.scope) == "in all 3 states that can be reached"
    assert [(finding.message, finding.notes) for finding in done.findings] == [
        (
            "`inc` may break invariant `low`",
            ("for example when x = 2 and `inc` is done", "this is reached by `inc`, `inc`"),
        )
    ]


def test_a_few_of_many_arguments_are_tried(tmp_path: Path) -> None:
    text = "domain trial\n\nfluent y: 7..9000 = 8000\n\nexog put(n: 7..9000):\n    causes y := n\n"
    done = examined(tmp_path, f"{text}\naction drop:\n    causes y := y - 2\n")
    assert done.scope is not None and not done.scope.whole
    assert [finding.notes for finding in done.findings] == [
        ("for example when y = 7 and `drop` is done", "this is reached by `put(7)`")
    ]


@pytest.mark.parametrize(
    ("more", "reason"),
    [
        (
            "fluent y: int = 0\nexog put(n: int):\n    causes y := n\n",
            "`put` has more instances than can be gone through: an integer of a large type is counted with",
        ),
        ("fluent y: int = 0\nexog up:\n    causes y := y + 1\n", "more than 10000 states can be reached"),
        (
            "fluent t: real = 0\nexog put(n: real):\n    causes t := n\n",
            "`put` has more instances than can be gone through",
        ),
        (
            "fluent many(n: 1..20): bool = false\nexog flip(n: 1..20):\n    causes many(n) := not many(n)\n",
            "more than 10000 states can be reached",
        ),
    ],
)
def test_states_that_cannot_all_be_gone_through(tmp_path: Path, more: str, reason: str) -> None:
    done = examined(tmp_path, f"{SWITCH}\naction drop:\n    poss x = 1\n    causes x := x - 2\n\n{more}")
    assert done.scope is not None
    assert done.scope.reason == reason
    assert [finding.notes for finding in done.findings] == [
        ("for example when x = 1 and `drop` is done", "this is reached by `turn_on`, `tick`")
    ]


def test_whether_a_counterexample_can_be_reached_may_stay_open(tmp_path: Path) -> None:
    endless = "fluent y: int = 0\nexog up:\n    causes y := y + 1\n"
    text = f"{SWITCH}\n{endless}\naction a:\n    poss y < 0\n    causes x := x - 1\n"
    assert [finding.notes for finding in examined(tmp_path, text).findings] == [
        ("for example when x = 0, y = -1 and `a` is done", "whether this situation can be reached is not known")
    ]


def test_what_matters_may_be_little_enough_to_go_through(tmp_path: Path) -> None:
    many = "fluent many(n: 1..20): bool = false\nexog flip(n: 1..20):\n    causes many(n) := not many(n)\n"
    text = f"{SWITCH}\n{many}\naction jump:\n    causes x := x + 3\n    causes x := 5 when x = 5\n"
    done = examined(tmp_path, f"{text}\naction sleep:\n    poss x = 4\n")
    assert [(finding.code.code, finding.notes) for finding in done.findings] == [
        (
            "GL041",
            (
                "for example when x = 3 and `jump` is done",
                "this is reached by `jump`",
            ),
        ),
        (
            "GL040",
            ("for example when x = 5 and `jump` is done", "this is reached by `turn_on`, `tick`, `tick`, `jump`"),
        ),
    ]


def test_the_command_says_which_it_did(tmp_path: Path) -> None:
    path = tmp_path / "trial.gl"
    path.write_text(SWITCH)
    done = CliRunner().invoke(command, [str(path), "--reachable"])
    assert done.stderr == f"{path}: in all 4 states that can be reached\nchecked 1 file: nothing found\n"
    assert done.exit_code == 0


@pytest.mark.parametrize("form", ["json", "sarif"])
def test_programs_are_told_which_it_did(tmp_path: Path, form: str) -> None:
    path = tmp_path / "trial.gl"
    path.write_text(SWITCH)
    whole = json.loads(CliRunner().invoke(command, [str(path), "--format", form, "--reachable"]).stdout)
    found = whole if form == "json" else whole["runs"][0]["properties"]
    assert found["reachable"] == [{"file": str(path), "states": 4, "reason": None, "narrowed": 2}]
    whole = json.loads(CliRunner().invoke(command, [str(path), "--format", form]).stdout)
    assert "reachable" not in (whole if form == "json" else whole["runs"][0]["properties"])


def test_of_the_faults_of_the_original_delivery_robot_two_can_be_reached() -> None:
    found = examine(Path(__file__).parents[1] / "programs/legolog_delivery.gl", proofs=True, reachable=True).findings
    assert [
        (finding.code.code, finding.notes) for finding in found if finding.notes or finding.code.code == "GL072"
    ] == [
        (
            "GL040",
            (
                "for example when location = 3, delivery_requested(3) = 3 and `push_go_button` happens",
                "this is reached by `request_delivery(3, 3)`",
            ),
        ),
        ("GL072", ()),
    ]
