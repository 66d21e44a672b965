"""The brick that a theory drives, through its line in virtual time; expected messages are spelt out."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from golc.diagnostics import UserError
from golc.loading import load
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.theory.simulator import build
from golc.runtime.rcxsim.trace import Trace

MakeWire = Callable[..., Any]
"""Makes the host's end of a line to a simulated lift; see the fixture."""


def test_call_takes_a_while_and_has_its_effects_at_the_end(wire: MakeWire) -> None:
    lift = wire()
    assert lift.say(32, 0.3) == []
    assert lift.told("done") == []
    assert lift.act(32) == [64]
    [done] = lift.told("done")
    assert done["action"] == "up"
    assert done["changed"] == {"at": "2"}
    assert done["t"] >= 0.4


def test_start_returns_at_once(wire: MakeWire) -> None:
    lift = wire()
    assert lift.say(33, 0.0) == [64]
    assert lift.told("started")[0]["changed"] == {"moving": "true"}


def test_sensing_a_fact_that_only_the_world_knows(wire: MakeWire) -> None:
    seen = {tuple(wire(seed=seed).act(35)) for seed in range(30)}
    assert seen == {(64,), (65,), (66,)}


def test_what_was_sensed_once_stays_so(wire: MakeWire) -> None:
    for seed in range(10):
        lift = wire(seed=seed)
        first = [lift.act(number) for number in (34, 35, 36)]
        lift.poll()
        assert [lift.act(number) for number in (34, 35, 36)] == first


def test_what_the_theory_leaves_open_is_settled_within_its_constraints(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "gates.gl"
    file.write_text(
        "domain gates\n\ntype lane = {left, right}\nfluent closed(l: lane) = unknown\n"
        "initially not closed(left) or not closed(right)\n\naction look(l: lane):\n    senses closed(l)\n\n"
        'device rcx "gates.nqc":\n    0 .. look(l: lane) by call look\n'
    )
    seen = set()
    for seed in range(30):
        gates = wire(seed=seed, theory=load(file))
        seen.add(tuple(gates.act(number)[0] for number in (32, 33)))
    assert seen == {(64, 64), (64, 65), (65, 64)}


def test_what_is_in_front_of_the_sensor_changes_when_something_else_is_done(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "belt.gl"
    file.write_text(
        "domain belt\n\ntype colour = {red, green}\nfluent seen: colour = red\n\n"
        "action feed\naction look:\n    senses seen\n\n"
        'device rcx "belt.nqc":\n    0 feed by call feed\n    1 look by call look\n'
    )
    belt = wire(theory=load(file))
    looks = []
    for _ in range(20):
        belt.act(32)
        first = belt.act(33)
        belt.poll()
        assert belt.act(33) == first
        belt.poll()
        looks.append(first[0])
    assert set(looks) == {64, 65}


def test_what_only_the_host_was_told_is_inferred(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "hopper.gl"
    file.write_text(
        "domain hopper\n\nfluent filled: bool = true\nfluent ready: bool = false\n\n"
        "action feed:\n    poss filled and ready\n    causes filled := false\n\n"
        "exog rest from operator:\n    causes ready := false\n"
        "exog prepare(n: 1..3) from operator:\n    causes ready := true when n = 2\n\n"
        'device rcx "hopper.nqc":\n    0 feed by call feed\n'
    )
    hopper = wire(theory=load(file))
    hopper.act(32)
    assert [record["action"] for record in hopper.told("inferred")] == ["prepare(2)"]
    assert "problem" not in hopper.told("done")[0]


def test_what_the_brick_itself_reports_is_not_inferred(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "hopper.gl"
    file.write_text(
        "domain hopper\n\nfluent filled: bool = false\n\n"
        "action feed:\n    poss filled\n    causes filled := false\n\n"
        "exog fill:\n    causes filled := true\n\n"
        'device rcx "hopper.nqc"\n'
    )
    hopper = wire(theory=load(file))
    hopper.act(32)
    assert hopper.told("inferred") == []
    assert hopper.told("done")[0]["problem"] == "it is not possible here"


def test_sensing_a_fluent_that_actions_change(wire: MakeWire) -> None:
    lift = wire()
    assert lift.act(37) == [73, 65]
    lift.act(38)
    lift.poll()
    assert lift.act(37) == [64]


def test_number_of_two_digits(wire: MakeWire) -> None:
    lift = wire()
    assert lift.act(49 + 2, 36) == [64]
    assert lift.told("done")[0]["action"] == "turn_off(3)"


def test_unknown_number_is_answered_with_0_and_told(wire: MakeWire) -> None:
    lift = wire()
    assert lift.say(39) == [64]
    assert [record["number"] for record in lift.told("unknown")] == [7]


def test_number_of_an_event_is_no_action(wire: MakeWire) -> None:
    lift = wire()
    assert lift.say(40) == [64]
    assert [record["number"] for record in lift.told("unknown")] == [8]


def test_impossible_action_is_told_and_its_effects_applied_if_they_can_be(wire: MakeWire) -> None:
    lift = wire()
    lift.say(33)
    lift.act(32)
    [done] = lift.told("done")
    assert done["problem"] == "it is not possible here"
    assert done["changed"] == {"at": "2"}


def test_effects_that_leave_a_type_are_told_and_not_applied(wire: MakeWire) -> None:
    lift = wire()
    for _ in range(3):
        lift.act(32)
        lift.poll()
    last = lift.told("done")[-1]
    assert "is outside" in last["problem"]
    assert last["changed"] == {}


def test_slow_behaviours_ask_for_more_time(wire: MakeWire) -> None:
    for seed in range(100):
        lift = wire(seed=seed)
        lift.act(32)
        if any(record["message"] == 85 for record in lift.told("sent")):
            assert lift.told("done")[0]["t"] > 3.4
            return
    raise AssertionError("no behaviour was slow")


def test_no_behaviour_outlasts_its_timeout(wire: MakeWire) -> None:
    for seed in range(60):
        lift = wire(seed=seed)
        lift.act(38)
        assert lift.told("done")[0]["t"] <= 1.6


def test_script_at_a_time_after_the_host_is_first_heard(wire: MakeWire) -> None:
    lift = wire("at 2 s: call(2)\nat 3 s: bell\n")
    lift.wait(100)
    assert lift.poll() == []
    heard = lift.events(5)
    assert [event for _, event in heard] == [[49, 33], [58, 32]]
    assert [time for time, _ in heard] == pytest.approx([102.2, 103.2], abs=0.4)


def test_script_in_answer_to_an_action(wire: MakeWire) -> None:
    lift = wire("on go after 2 s: arrived\non 2nd go after 1 s: stuck\n")
    lift.say(33)
    assert [event for _, event in lift.events(4)] == [[56, 32]]
    lift.say(33)
    assert [event for _, event in lift.events(4)] == [[57, 32], [56, 32]]


def test_event_during_a_behaviour_comes_after_it(wire: MakeWire) -> None:
    lift = wire("on up after 0.1 s: call(3)\n")
    lift.act(32)
    assert lift.poll() == [50, 33]
    assert [record["what"] for record in lift.records if record["what"] in ("done", "happened")] == ["done", "happened"]


def test_script_may_say_what_is_impossible(wire: MakeWire) -> None:
    lift = wire("at 1 s: arrived\n")
    assert [event for _, event in lift.events(2)] == [[56, 32]]
    assert lift.told("happened")[0]["problem"] == "it is not possible here"


def test_task_ends_by_chance_with_what_its_start_made_possible(wire: MakeWire) -> None:
    ends = []
    for seed in range(60):
        lift = wire(None, seed=seed)
        lift.say(33)
        ends += [record["action"] for record in lift.told("happened")]
        lift.events(4.5)
        happened = [r for r in lift.told("happened") if r["action"] in ("arrived", "stuck")]
        assert len(happened) == 1
        assert 1.5 <= happened[0]["t"] <= 4.4
        ends.append(happened[0]["action"])
    assert ends.count("arrived") > 50


def test_chance_reports_only_what_is_possible(wire: MakeWire) -> None:
    lift = wire(None)
    lift.events(300)
    assert lift.told("happened")
    assert not [record for record in lift.told("happened") if "problem" in record]


def test_chance_prefers_what_changes_something(wire: MakeWire) -> None:
    names = []
    for seed in range(40):
        lift = wire(None, seed=seed)
        lift.act(32)
        lift.events(6)
        names += [record["action"][:4] for record in lift.told("happened")]
    assert names.count("call") > 2 * names.count("bell") > 0


def test_time_never_goes_back(wire: MakeWire) -> None:
    lift = wire("at 1 s: bell\nat 2 s: call(1)\nat 3 s: call(2)\n", air_time=1.0)
    lift.poll()
    lift.wait(20)
    lift.poll()
    lift.poll()
    times = [record["t"] for record in lift.records]
    assert times == sorted(times)
    assert [record["action"] for record in lift.told("happened")] == ["bell", "call(1)", "call(2)"]


def test_nothing_happens_before_the_host_is_heard(wire: MakeWire) -> None:
    lift = wire(None)
    lift.wait(1000)
    assert lift.told("happened") == []


def test_chance_waits_for_the_host_to_take_an_event(wire: MakeWire) -> None:
    lift = wire(None)
    lift.act(32)
    lift.wait(1000)
    assert len(lift.told("happened")) == 1


def test_robot_that_stands_comes_to_rest(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "button.gl"
    file.write_text(
        'domain button\n\naction nod\nexog press\n\ndevice rcx "b.nqc":\n    0 nod by call nod\n    1 press\n'
    )
    button = wire(None, theory=load(file), sleep=None)
    button.act(32)
    presses = [time for time, _ in button.events(1000)]
    assert 4 <= len(presses) <= 6
    assert presses[3] - presses[2] > 100


def test_abort_ends_a_task(wire: MakeWire) -> None:
    lift = wire(None)
    lift.say(33)
    lift.say(81)
    lift.wait(5)
    assert lift.told("aborted")
    assert "arrived" not in [record["action"] for record in lift.told("happened")]


def test_abort_forgets_events_that_wait(wire: MakeWire) -> None:
    lift = wire("at 1 s: bell\n")
    lift.poll()
    lift.wait(2)
    lift.say(81)
    assert lift.told("forgot")[0]["events"] == ["bell"]
    assert lift.poll() == []


def test_same_seed_same_robot(wire: MakeWire) -> None:
    def run(seed: int) -> str:
        lift = wire(None, seed=seed, loss=0.1, garble=0.1)
        for message in (32, 35, 33, 83, 82, 32, 37, 82):
            lift.say(message, 5.0)
        return json.dumps(lift.records)

    assert run(7) == run(7)
    assert run(7) != run(8)


def test_noise_does_not_change_how_long_actions_take(wire: MakeWire) -> None:
    def done(**noise: float) -> float:
        lift = wire(seed=3, **noise)
        while not lift.told("done"):
            lift.say(32, 3.5)
        return float(lift.told("done")[0]["t"] - lift.told("began")[0]["t"])

    assert done() == pytest.approx(done(loss=0.5, garble=0.5), abs=1e-5)


def test_theory_without_a_brick(tmp_path: Path) -> None:
    file = tmp_path / "none.gl"
    file.write_text("domain idle\n\naction nod\n\ndevice self:\n    nod\n")
    with pytest.raises(UserError, match="no brick to simulate"):
        build(load(file), LineOptions(), None, 0, Trace())


def test_two_bricks_on_one_tower(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "two.gl"
    file.write_text(
        "domain two\n\nfluent lit: bool = false\n\naction light:\n    causes lit := true\naction dark:\n"
        "    causes lit := false\n\n"
        'device rcx left "left.nqc":\n    1 light by call light\n\n'
        'device rcx right "right.nqc":\n    set range 1\n    1 dark by call dark\n'
    )
    both = wire(theory=load(file))
    assert both.act(33) == [64]
    assert both.say(97, 3.0) == [128]
    assert both.say(147) == [148]
    assert [record["action"] for record in both.told("done")] == ["light", "dark"]


TABLE = """\
domain table

type colour = {red, yellow, blue}
fluent seen: colour = red
fluent worn: colour = blue

action look:
    senses seen
action dye:
    causes worn := red
action inspect:
    senses worn

device rcx "table.nqc":
    0 look by call look {3: yellow, 4: blue}
    1 dye by call dye
    2 inspect by call inspect {3: yellow, 4: blue}
"""


def test_world_settles_on_a_value_that_has_a_number(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "table.gl"
    file.write_text(TABLE)
    theory = load(file)
    assert {tuple(wire(theory=theory, seed=seed).act(32)) for seed in range(20)} == {(67,), (68,)}


def test_value_without_a_number_is_answered_with_0_and_told(wire: MakeWire, tmp_path: Path) -> None:
    file = tmp_path / "table.gl"
    file.write_text(TABLE)
    table = wire(theory=load(file))
    assert table.act(34) == [68]
    table.act(33)
    assert table.act(34) == [64]
    assert "no number" in table.told("senseless")[0]["problem"]
