"""What the operator is asked by the run itself."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from golc.diagnostics import NOWHERE, DeviceError
from golc.program.labels import Act
from golc.runtime.devices.desk import Desk
from golc.runtime.devices.rcx.errors import PortGoneError
from golc.runtime.loop.asking import AskAboutFailure, AskBeforeActions, always
from golc.runtime.loop.happenings import Remedy

TURN = Act("turn", (1,), NOWHERE)
FAILURE = DeviceError("it is stuck")

Desks = Callable[..., Desk]


@pytest.fixture
def said() -> list[str]:
    return []


@pytest.fixture
def desk(said: list[str]) -> Desks:
    """A desk at which these lines were piped ahead, and nobody comes any more."""

    def make(*lines: str) -> Desk:
        made = Desk(said.append, interactive=False, open_=True, plausible=lambda line: True)
        for line in lines:
            made.offer(line, report=False)
        return made

    return make


@pytest.mark.parametrize(
    ("answer", "remedy"),
    [("retry", Remedy.RETRY), ("R", Remedy.RETRY), ("next", Remedy.NEXT), ("skip", Remedy.NEXT), ("stop", Remedy.STOP)],
)
def test_the_operator_decides_about_a_failure(desk: Desks, said: list[str], answer: str, remedy: Remedy) -> None:
    ask = AskAboutFailure(desk(answer), str)

    assert ask(TURN, FAILURE) is remedy
    assert said == ["turn(1) has failed: retry, next (take another way) or stop? Also: state, history"]


def test_before_the_decision_the_operator_can_look_at_the_state(desk: Desks, said: list[str]) -> None:
    ask = AskAboutFailure(desk("state", "history", "what?", "stop"), lambda what: f"the {what}")

    assert ask(TURN, FAILURE) is Remedy.STOP
    assert said[1:] == ["the state", "the history", "type retry, next or stop"]


def test_when_nobody_answers_the_run_stops(desk: Desks) -> None:
    closed = desk()
    closed.close()

    assert AskAboutFailure(closed, str)(TURN, FAILURE) is Remedy.STOP


def test_when_the_port_has_gone_nobody_is_asked(desk: Desks, said: list[str]) -> None:
    gone = PortGoneError("the port has gone away")

    assert AskAboutFailure(desk("retry"), str)(TURN, gone) is Remedy.STOP
    assert said == []
    assert always(Remedy.RETRY)(TURN, gone) is Remedy.STOP
    assert always(Remedy.RETRY)(TURN, FAILURE) is Remedy.RETRY


def test_each_action_is_confirmed_until_the_operator_has_had_enough(desk: Desks, said: list[str]) -> None:
    ask = AskBeforeActions(desk("", "no", "all"))
    for _ in range(4):
        ask(TURN)

    question = "next is turn(1): press Enter, or type all to go on by itself"
    assert said == [question, question, "press Enter, or type all; !stop ends the run"]
