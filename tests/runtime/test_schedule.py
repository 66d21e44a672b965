"""Events files."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.diagnostics import Findings, Source, UserError
from golc.runtime.sources.schedule import At, On, Player, Schedule, parse_schedule, read_schedule
from golc.theory.ground import Call
from golc.theory.theory import BasicActionTheory


def parsed(theory: BasicActionTheory, text: str) -> Schedule:
    findings = Findings()
    schedule = parse_schedule(Source("demo.events", text), theory, findings)
    assert not findings.diagnostics
    return schedule


def said(theory: BasicActionTheory, text: str) -> list[tuple[int, int, str, str | None]]:
    """Line, column, message and help of each finding."""
    findings = Findings()
    parse_schedule(Source("demo.events", text), theory, findings)
    return [(d.span.line, d.span.column, d.message, d.help) for d in findings.diagnostics]


def test_every_form_of_a_line(delivery: BasicActionTheory) -> None:
    text = (
        "# a comment\n\n"
        "at 3 s: request_delivery(2, 5)   # another\n"
        "  at .5s : push_go_button\n"
        "on start_to_next_station after 2.5 s: arrive_at_station\n"
        "on signal_arrival once after 1 s: push_go_button\n"
        "on 3rd signal_arrival after 0 s: cancel_request(1, 4)"
    )

    assert parsed(delivery, text).entries == (
        At(3.0, Call("request_delivery", (2, 5)), None),  # type: ignore[arg-type]
        At(0.5, Call("push_go_button"), None),  # type: ignore[arg-type]
        On("start_to_next_station", None, None, 2.5, Call("arrive_at_station"), None),  # type: ignore[arg-type]
        On("signal_arrival", None, 1, 1.0, Call("push_go_button"), None),  # type: ignore[arg-type]
        On("signal_arrival", None, 3, 0.0, Call("cancel_request", (1, 4)), None),  # type: ignore[arg-type]
    )


def test_windows_line_ends_and_no_newline_at_the_end(delivery: BasicActionTheory) -> None:
    schedule = parsed(delivery, "at 1 s: push_go_button\r\nat 2 s: push_go_button")

    assert [entry.delay for entry in schedule.entries] == [1.0, 2.0]


def test_the_whole_file_is_read_and_every_wrong_line_is_told_at_its_place(delivery: BasicActionTheory) -> None:
    text = (
        "in 3 s: push_go_button\nat 3: push_go_button\nat 1 s: push_button\nat 1 s: request_delivery(2, 9)\nat 1 s:\n"
    )

    findings = said(delivery, text)

    assert [(line, column) for line, column, _, _ in findings] == [(1, 1), (2, 1), (3, 9), (4, 29), (5, 7)]
    assert findings[0][2:] == (
        "this is not a line of an events file",
        "write `at 3 s: EVENT` or `on ACTION after 2.5 s: EVENT`",
    )
    assert findings[2][2] == "unknown exogenous action `push_button`"
    assert findings[3][2] == "`to` of `request_delivery` is of type station (1..6), not `9`"
    assert findings[4][2] == "the exogenous action is missing after the colon"


@pytest.mark.parametrize(
    ("line", "message", "help_"),
    [
        (
            "on signal_arival after 1 s: push_go_button",
            "unknown action `signal_arival`",
            "did you mean `signal_arrival`?",
        ),
        (
            "on push_go_button after 1 s: push_go_button",
            "`push_go_button` is exogenous: the robot never performs it",
            None,
        ),
        ("at 1 s: turnaround", "`turnaround` is the robot's own, not exogenous", None),
        (
            "at 1 s: request_delivery(2)",
            "`request_delivery` takes 2 arguments (origin: station, to: station), not 1",
            "write for example `request_delivery(6, 6)`",
        ),
        ("at 1 s: request_delivery(2, 1 + 1)", "a value is needed, not an expression", "a value of station (1..6)"),
        (
            "at 1 s: request_delivery(two, 1)",
            "unknown value `two`",
            "`origin` of `request_delivery` is of type station (1..6)",
        ),
        (
            "on 2nd signal_arrival once after 1 s: push_go_button",
            "`once` and the count exclude each other, and counts begin with `1st`",
            None,
        ),
        ("at 1 s: 3", "`3` is not an action", "write an exogenous action, as in `request_delivery(6, 6)`"),
    ],
)
def test_what_can_be_wrong_with_a_line(delivery: BasicActionTheory, line: str, message: str, help_: str | None) -> None:
    assert [(text, told) for _, _, text, told in said(delivery, line)] == [(message, help_)]


def test_a_line_that_does_not_parse_is_told_at_its_place(delivery: BasicActionTheory) -> None:
    ((line, column, _, _),) = said(delivery, "\nat 1 s: request_delivery(2,")

    assert (line, column) == (2, 28)


def test_a_file_with_errors_is_refused(tmp_path: Path, delivery: BasicActionTheory) -> None:
    path = tmp_path / "wrong.events"
    path.write_text("never: push_go_button\n")

    with pytest.raises(UserError) as failure:
        read_schedule(path, delivery)

    assert str(failure.value.diagnostics[0].span) == f"{path}:1:1"


def test_events_at_fixed_times_come_in_order(delivery: BasicActionTheory) -> None:
    player = Player(parsed(delivery, "at 2 s: push_go_button\nat 1 s: stop_abnormally\nat 2 s: arrive_at_station"))

    assert player.next == 1.0
    assert player.pending == 3
    assert [str(call) for call in player.due(1.5)] == ["stop_abnormally"]
    assert [str(call) for call in player.due(2.0)] == ["push_go_button", "arrive_at_station"]
    assert player.next is None


def test_a_reaction_counts_from_the_beginning_of_each_execution(delivery: BasicActionTheory) -> None:
    player = Player(parsed(delivery, "on start_to_next_station after 2.5 s: arrive_at_station"))
    player.performed("start_to_next_station", (), 1.0)
    player.performed("turnaround", (), 1.0)

    assert player.due(3.4) == []
    assert [str(call) for call in player.due(3.5)] == ["arrive_at_station"]

    player.performed("start_to_next_station", (), 10.0)
    assert player.next == 12.5


def test_once_and_a_count_choose_the_execution(delivery: BasicActionTheory) -> None:
    text = "on signal_arrival once after 0 s: push_go_button\non 3rd signal_arrival after 0 s: stop_abnormally"
    player = Player(parsed(delivery, text))
    heard = []
    for _ in range(4):
        player.performed("signal_arrival", (), 0.0)
        heard.append([str(call) for call in player.due(0.0)])

    assert heard == [["push_go_button"], [], ["stop_abnormally"], []]


LOOKING = """
domain looking
type side = {left, right}
action look(s: side)
exog seen(s: side)
"""


def test_arguments_choose_the_instances_of_an_action(tmp_path: Path) -> None:
    from golc.loading import load

    path = tmp_path / "looking.gl"
    path.write_text(LOOKING + "device self:\n    look(s: side)\n")
    text = "on look(left) after 1 s: seen(left)\non look after 2 s: seen(right)"
    player = Player(parsed(load(path), text))
    player.performed("look", ("right",), 0.0)
    player.performed("look", ("left",), 0.0)

    assert [(call.args, player.next) for call in player.due(1.0)] == [(("left",), 2.0)]
    assert len(player.due(2.0)) == 2


def test_only_some_lines(delivery: BasicActionTheory) -> None:
    schedule = parsed(delivery, "at 1 s: push_go_button\nat 1 s: request_delivery(1, 2)")

    assert [str(e.event) for e in schedule.only(lambda call: not call.args).entries] == ["push_go_button"]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("at {} s: push_go_button", "this is not a line of an events file"),
        ("on signal_arrival after {} s: push_go_button", "this is not a line of an events file"),
        ("on {}th signal_arrival after 1 s: push_go_button", "nothing happens that often"),
    ],
)
def test_a_number_without_sense_is_a_wrong_line(delivery: BasicActionTheory, line: str, expected: str) -> None:
    ((_, _, message, _),) = said(delivery, line.format("9" * 5000))
    assert message == expected
