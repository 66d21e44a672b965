"""Numbers of the classic protocol as digits."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.runtime.devices.rcx import ClassicParameters, ParameterError
from golc.runtime.devices.rcx.numbers import Digits

ACTIONS, VALUES = ClassicParameters().actions, ClassicParameters().values


@pytest.mark.parametrize(
    ("number", "messages"),
    [(0, [32]), (15, [47]), (16, [48, 33]), (65, [49, 36]), (255, [63, 47]), (256, [48, 48, 33])],
)
def test_actions_are_in_base_16_least_significant_digit_first(number: int, messages: list[int]) -> None:
    assert ACTIONS.split(number) == messages
    assert ACTIONS.join(messages) == number


@pytest.mark.parametrize(("number", "messages"), [(0, [64]), (7, [71]), (8, [72, 65]), (100, [76, 76, 65])])
def test_values_are_in_base_8(number: int, messages: list[int]) -> None:
    assert VALUES.split(number) == messages
    assert VALUES.join(messages) == number


def test_a_number_may_have_leading_zeros() -> None:
    assert ACTIONS.join([52, 32]) == 4


def test_the_control_messages_of_legolog() -> None:
    numbers = ClassicParameters()
    assert (numbers.panic, numbers.abort, numbers.proceed) == (80, 81, 82)
    assert (numbers.request, numbers.none, numbers.more_time) == (83, 84, 85)


@given(number=st.integers(0, 32767), base=st.integers(1, 100), radix=st.integers(2, 64))
def test_every_number_comes_back(number: int, base: int, radix: int) -> None:
    digits = Digits(base, radix)
    messages = digits.split(number)
    assert digits.join(messages) == number
    assert all(message in digits.more for message in messages[:-1])
    assert messages[-1] in digits.last


@pytest.mark.parametrize("number", [-1, 32768, 10**30])
def test_a_number_that_the_brick_cannot_hold_is_refused(number: int) -> None:
    with pytest.raises(ParameterError, match="cannot be sent") as caught:
        ACTIONS.split(number)
    assert caught.value.help == "the classic protocol carries 0 to 32767"


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"action_base": 60}, "message 64 is used for actions and for values"),
        ({"control_base": 70}, "message 70 is used for values and for control"),
        ({"control_base": 251}, "messages for control, 251..256"),
        ({"action_base": 0}, "messages for actions, 0..31"),
        ({"value_digits": 1}, "at least the digits 0 and 1"),
        ({"action_digits": 10**9}, "not all user messages"),
    ],
)
def test_ranges_that_cannot_work_are_refused(changed: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        ClassicParameters(**changed)
