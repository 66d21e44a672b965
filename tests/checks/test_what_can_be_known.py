"""What a theory with incomplete knowledge leaves possible at first, and what its programs ask in vain."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.loading import examine

HEAD = """domain gates
type lane = 1..3
type door = {open, closed}
fluent gate: door = unknown
fluent pit(l: lane) = unknown
fluent load: 1..9 = one of {1, 2, 3}
fluent at: lane = 1
fluent ready = false
action go(l: lane):
    causes at := l
    causes ready := not ready
action carry(d: door)
"""


def found(tmp_path: Path, text: str) -> list[tuple[str, str, str]]:
    """Code, message and marked text of every finding that is about knowledge or the beginning."""
    path = tmp_path / "gates.gl"
    path.write_text(HEAD + text)
    return [
        (finding.code.code, finding.message, finding.span.text)
        for finding in examine(path).findings
        if finding.code.code not in ("GL027", "GL028")
    ]


def program(*lines: str) -> str:
    return "proc control:\n" + "".join(f"    {line}\n" for line in lines)


@pytest.mark.parametrize(
    ("text", "marked"),
    [
        ("initially at = 2\n", "at = 2"),
        ("initially load > 3\n", "load > 3"),
        ("initially gate = open\ninitially load = 1 and gate = closed\n", "gate = closed"),
        ("initially forall l: lane. pit(l)\ninitially not pit(2)\n", "not pit(2)"),
    ],
)
def test_constraints_that_leave_no_world(tmp_path: Path, text: str, marked: str) -> None:
    message = "no initial world is possible: this contradicts the initial values, or what is said before"
    assert found(tmp_path, text) == [("GL053", message, marked)]


@pytest.mark.parametrize("constraint", ["at = 1", "load < 4", "gate = open or gate = closed", "1 < 2"])
def test_a_constraint_that_rules_out_nothing(tmp_path: Path, constraint: str) -> None:
    message = "this constraint rules out no world: it holds in every one that is possible"
    assert found(tmp_path, f"initially {constraint}\n") == [("GL054", message, constraint)]


@pytest.mark.parametrize(
    "constraint",
    ["gate = open", "gate = open or load = 1", "exists l: lane. pit(l)", "pit(at)", "load != 2 and gate = closed"],
)
def test_a_constraint_that_rules_out_something_is_fine(tmp_path: Path, constraint: str) -> None:
    assert found(tmp_path, f"initially {constraint}\n") == []


def test_a_constraint_may_have_a_value_only_where_another_one_holds(tmp_path: Path) -> None:
    text = "fluent seen: lane? = unknown\ninitially seen != none\ninitially seen < 3\n"
    assert found(tmp_path, text) == []


def test_an_invariant_holds_in_every_initial_world(tmp_path: Path) -> None:
    assert found(tmp_path, "invariant light: load < 4\ninvariant near: not pit(at) or at < 3\n") == []
    assert found(tmp_path, "initially not pit(1)\ninvariant safe: not pit(at)\n") == []
    message = "invariant `safe` is false in a world that is possible at first"
    assert found(tmp_path, "invariant safe: not pit(at)\n") == [("GL052", message, "not pit(at)")]


def test_an_invariant_that_fails_shows_a_world(tmp_path: Path) -> None:
    path = tmp_path / "gates.gl"
    path.write_text(HEAD + "invariant safe: gate = open implies load = 1\n")
    (finding,) = [finding for finding in examine(path).findings if finding.code.code == "GL052"]
    assert finding.notes == ("for example where gate = open, load = 2",)


@pytest.mark.parametrize(
    ("also", "notes"),
    [("", "load = 1"), (" and spare", "load = 1, …")],
)
def test_of_a_world_five_values_are_shown(tmp_path: Path, also: str, notes: str) -> None:
    path = tmp_path / "gates.gl"
    every = f"gate = open and pit(1) and pit(2) and pit(3) and load = 1{also}"
    path.write_text(f"{HEAD}fluent spare: bool = unknown\ninvariant safe: not ({every})\n")
    (finding,) = [finding for finding in examine(path).findings if finding.code.code == "GL052"]
    known = "gate = open, pit(1) = true, pit(2) = true, pit(3) = true"
    assert finding.notes == (f"for example where {known}, {notes}",)


def test_what_is_known_at_first_may_be_an_invariant(tmp_path: Path) -> None:
    assert found(tmp_path, "invariant sure: known(at) and possible(gate = open)\n") == []
    message = "invariant `sure` is false in a world that is possible at first"
    assert found(tmp_path, "invariant sure: known(gate)\n") == [("GL052", message, "known(gate)")]


@pytest.mark.parametrize(
    ("lines", "what", "marked"),
    [
        (("if gate = open:", "    go(2)"), "whether `gate = open` is true", "gate = open"),
        (("while not pit(at):", "    go(2)"), "whether `not pit(at)` is true", "not pit(at)"),
        (
            ("if ready and gate = open:", "    go(2)"),
            "that `ready and gate = open` is true",
            "ready and gate = open",
        ),
        (("if ready or gate = open:", "    go(2)"), "that `ready or gate = open` is false", "ready or gate = open"),
        (("for l: lane where pit(l):", "    go(l)"), "whether `pit(l)` is true", "pit(l)"),
        (("carry(gate)",), "what `gate` is", "gate"),
        (("let n = load + 1:", "    test n > at"), "what `load + 1` is", "load + 1"),
        (("star at most load:", "    go(2)"), "what `load` is", "load"),
        (("test gate = open",), "that `gate = open` is true", "gate = open"),
        (("test ready and pit(2)",), "that `ready and pit(2)` is true", "ready and pit(2)"),
        (("wait until load = at",), "that `load = at` is true", "load = at"),
        (("pick l: lane where pit(l):", "    go(l)"), "that `pit(l)` is true", "pit(l)"),
        (
            ("interrupts:", "    on exists l: lane. pit(l):", "        go(1)"),
            "that `exists l: lane. pit(l)` is true",
            "exists l: lane. pit(l)",
        ),
    ],
)
def test_what_is_asked_in_vain(tmp_path: Path, lines: tuple[str, ...], what: str, marked: str) -> None:
    assert found(tmp_path, program(*lines)) == [("GL061", f"it can never be known {what}", marked)]


def test_a_precondition_that_is_never_known_to_hold(tmp_path: Path) -> None:
    text = "define way := gate = open\naction pass:\n    poss way and at = 2\n"
    assert found(tmp_path, text) == [("GL061", "it can never be known that `way and at = 2` is true", "way and at = 2")]


@pytest.mark.parametrize(
    "text",
    [
        "action look:\n    senses gate\n",
        "action look:\n    senses not exists l: lane. pit(l) and gate = open\n",
        "define way := gate = open\naction look:\n    senses way\n",
        # What is sensed is connected with the gate.
        "fluent light = unknown\ninitially light iff gate = open\naction look:\n    senses light\n",
        "fluent light = unknown\nfluent glow = unknown\ninitially glow iff gate = open\ninitially light iff glow\n"
        "action look:\n    senses light\n",
        "fluent light = false\naction push:\n    causes light := gate = open\n    senses light\n",
        "fluent light = false\naction push:\n    causes light := true when gate = open\n    senses light\n",
        # That it could happen tells something.
        "exog passes_by:\n    poss gate = open\n",
        # Afterwards it is known.
        "action push:\n    causes gate := closed\n",
        "exog wind:\n    causes gate := one of {closed}\n",
        "axiom gate:\n    after go(l) := open when l = 2\n    otherwise unchanged\n",
        # It is known in every world.
        "initially gate = closed\n",
    ],
)
def test_a_fluent_that_may_become_known_is_asked_for(tmp_path: Path, text: str) -> None:
    assert found(tmp_path, text + program("if gate = open:", "    go(2)", "carry(gate)")) == []


@pytest.mark.parametrize(
    "text", ["", "exog wind:\n    causes gate := unknown\n", "axiom gate:\n    otherwise unchanged\n"]
)
def test_one_that_only_gets_lost_is_not(tmp_path: Path, text: str) -> None:
    assert [code for code, _, _ in found(tmp_path, text + program("if gate = open:", "    go(2)"))] == ["GL061"]


@pytest.mark.parametrize(
    "condition",
    [
        "load < 4",
        "load = 7 or ready",
        "gate in door",
        "gate = open or gate = closed",
        "knows(gate = open)",
        "known(gate) and gate = open",
        "possible(pit(at))",
    ],
)
def test_what_can_be_known_without_knowing_the_fluent(tmp_path: Path, condition: str) -> None:
    assert found(tmp_path, program(f"if {condition}:", "    go(2)")) == []


def test_an_instance_that_is_known_may_be_meant(tmp_path: Path) -> None:
    text = "initially not pit(1)\n"
    assert found(tmp_path, text + program("if pit(at):", "    go(2)")) == []


def test_a_test_that_may_succeed_without_the_fluent_is_fine(tmp_path: Path) -> None:
    assert (
        found(tmp_path, program("test ready or gate = open", "pick l: lane where l = 2 or pit(l):", "    go(l)")) == []
    )


def test_effects_and_sensing_need_not_know(tmp_path: Path) -> None:
    text = "fluent copy: door = open\naction keep:\n    causes copy := gate when pit(at)\n    cost load\n"
    assert found(tmp_path, text + program("keep", 'say "{gate}"')) == []
