from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Code, DeviceError, Findings, Source
from golc.nqc.numbering import number_device
from golc.theory.terms import Literal
from golc.theory.theory import Action, BasicActionTheory, Binding, Device, Fixed, Parameter
from golc.theory.types import BOOL, INT, REAL, STRING, Collection, Enumeration, Interval, Type, Value

if TYPE_CHECKING:
    from tests.nqc.conftest import Workshop

ROOMS = """\
domain rooms
type side = {left, right}
type room = 1..3
fluent light: int = 0
fluent seen: side = left
fluent open: bool = false
fluent bright: -1..1 = 0
action go(s: side, r: room)
action halt
action look(r: room):
    senses seen
action peek:
    senses open
action measure:
    senses light
action judge:
    senses bright
exog arrived(r: room)
exog bumped
"""


def test_a_range_takes_base_and_index_with_the_last_argument_fastest(workshop: Workshop) -> None:
    actions = workshop.numbers(ROOMS + "device rcx:\n    8 .. go(s: side, r: room)\n" + OTHERS)
    assert actions.encode("go", ("left", 1)) == 8
    assert actions.encode("go", ("left", 3)) == 10
    assert actions.encode("go", ("right", 1)) == 11
    assert actions.decode(13) == ("go", ("right", 3))
    assert actions.decode(14) is None


OTHERS = """\
    0 halt
    1 .. look(r: room)
    4 peek
    5 measure
    6 judge {2: -1, 3: 0, 4: 1}
"""


def test_a_constant_in_a_binding_takes_no_number(workshop: Workshop) -> None:
    text = ROOMS + "device rcx:\n    20 .. go(left, r: room)\n    30 .. go(right, r: room)\n" + OTHERS
    actions = workshop.numbers(text)
    assert actions.encode("go", ("left", 2)) == 21
    assert actions.encode("go", ("right", 2)) == 31
    assert actions.decode(32) == ("go", ("right", 3))


def test_numbers_left_out_are_the_smallest_free_ones_in_the_order_of_the_lines(workshop: Workshop) -> None:
    text = ROOMS + "device rcx:\n    go(s: side, r: room)\n" + OTHERS + "    bumped\n    8 .. arrived(r: room)\n"
    actions = workshop.numbers(text)
    assert actions.encode("bumped") == 7
    assert actions.encode("go", ("left", 1)) == 11


def test_without_bindings_numbers_follow_the_declarations(workshop: Workshop) -> None:
    actions = workshop.numbers(
        "domain d\naction a\naction ask\nexog e from operator\naction b(n: 1..2)\nexog f(n: 1..2)\nexog g(n: int)\n"
        'exog h from rcx\ndevice rcx "d.nqc"\ndevice operator:\n    ask by prompt "?"\n'
    )
    found = [(entry.action, entry.first, entry.last) for entry in actions.entries]
    assert found == [("a", 0, 0), ("b", 1, 2), ("f", 3, 4), ("h", 5, 5)]


def test_actions_of_another_device_are_not_handled(workshop: Workshop) -> None:
    actions = workshop.numbers(
        ROOMS
        + "device rcx:\n    20 .. go(left, r: room)\n    30 .. go(right, r: 2..3)\n"
        + OTHERS
        + "device self:\n    go(right, 1)\n"
    )
    assert actions.handles("go", ("left", 1))
    assert not actions.handles("go", ("right", 1))
    assert not actions.handles("arrived", (1,))
    with pytest.raises(DeviceError, match=r"no number for go\(right, 1\)"):
        actions.encode("go", ("right", 1))


@pytest.mark.parametrize(
    ("action", "number", "value"),
    [("look", 0, "left"), ("look", 1, "right"), ("peek", 1, True), ("measure", 300, 300), ("judge", 2, -1)],
)
def test_sensing_numbers_and_values(workshop: Workshop, action: str, number: int, value: Value) -> None:
    actions = workshop.numbers(ROOMS + "device rcx:\n    20 .. go(s: side, r: room)\n" + OTHERS)
    assert actions.sensed(action, number) == value
    assert type(actions.sensed(action, number)) is type(value)
    assert actions.sensing_number(action, value) == number


def test_a_number_that_means_nothing_is_a_device_error(workshop: Workshop) -> None:
    actions = workshop.numbers(ROOMS + "device rcx:\n    20 .. go(s: side, r: room)\n" + OTHERS)
    with pytest.raises(DeviceError, match="answered 2 to look"):
        actions.sensed("look", 2)
    with pytest.raises(DeviceError) as raised:
        actions.sensed("judge", 0)
    assert raised.value.help is not None and "2, 3, 4" in raised.value.help


def test_an_action_that_senses_nothing_answers_0(workshop: Workshop) -> None:
    actions = workshop.numbers(ROOMS + "device rcx:\n    20 .. go(s: side, r: room)\n" + OTHERS)
    assert actions.sensing_number("halt", None) == 0
    assert actions.sensed("halt", 0) is None


def test_timeouts_are_those_of_the_bindings_or_fifteen_seconds(workshop: Workshop) -> None:
    actions = workshop.numbers("domain d\naction a\naction b\ndevice rcx:\n    0 a timeout 2.5 s\n    1 b\n")
    assert (actions.timeout("a"), actions.timeout("b")) == (2.5, 15.0)


def test_the_fingerprint_changes_with_what_the_host_and_the_brick_must_agree_on(workshop: Workshop) -> None:
    base = "domain d\nfluent f: bool = false\naction a(n: 1..2):\n    senses f\nexog e\ndevice rcx:\n"
    lines = "    0 .. a(n: 1..2)\n    2 e\n"
    same = workshop.numbers(base.replace("(n: 1..2)", "(m: 1..2)") + lines.replace("(n:", "(m:"))
    prints = {
        workshop.numbers(base + lines).fingerprint,
        workshop.numbers(base + lines.replace("2 e", "3 e")).fingerprint,
        workshop.numbers(base + lines + "    set range 1\n").fingerprint,
        workshop.numbers(base.replace("bool = false", "0..5 = 0") + lines).fingerprint,
        workshop.numbers(base.replace("exog e", "exog e2") + lines.replace("2 e", "2 e2")).fingerprint,
    }
    assert len(prints) == 5
    assert same.fingerprint in prints
    assert all(0 <= number < 2**15 for number in prints)


def test_set_range_moves_every_message(workshop: Workshop) -> None:
    wire = workshop.numbers("domain d\naction a\ndevice rcx:\n    0 a\n    set range 2\n").wire
    assert (wire.action_base, wire.value_base, wire.panic, wire.more_time) == (160, 192, 208, 213)


VALUES = st.one_of(
    st.builds(lambda low, size: Interval(low, low + size), st.integers(-50, 50), st.integers(0, 8)),
    st.just(BOOL),
    st.lists(st.sampled_from("abcdef"), unique=True, min_size=1).map(
        lambda names: Enumeration(tuple((name, "letter") for name in names))
    ),
)


@st.composite
def maps(draw: st.DrawFn) -> tuple[BasicActionTheory, Device]:
    """A theory of some actions with finite parameters, of which some numbers are left out and some arguments fixed."""
    actions = []
    bindings = []
    first = 0
    for name in draw(st.lists(st.sampled_from("uvwxyz"), unique=True, min_size=1)):
        parameters = tuple(
            Parameter(f"p{place}", type_) for place, type_ in enumerate(draw(st.lists(VALUES, max_size=3)))
        )
        actions.append(Action(name, parameters, draw(st.booleans()), (), (), (), None))
        args = tuple(
            Fixed(draw(st.sampled_from(list(p.type.values)))) if draw(st.integers(0, 3)) == 0 else p for p in parameters
        )
        number = None if draw(st.booleans()) else first + draw(st.integers(0, 5))
        count = 1
        for arg in args:
            count *= len(arg.type.values) if isinstance(arg, Parameter) else 1
        first = first if number is None else number + count
        bindings.append(Binding(name, args, number, None, None, None))
    device = Device("rcx", "rcx", None, tuple(bindings), {})
    named = {action.name: action for action in actions}
    return BasicActionTheory("d", Source("d.gl", ""), {}, {}, {}, {}, {}, named, {}, (device,)), device


@given(maps())
def test_decode_is_the_inverse_of_encode_and_no_number_is_taken_twice(made: tuple[BasicActionTheory, Device]) -> None:
    findings = Findings()
    actions = number_device(*made, findings)
    assert not findings.diagnostics
    seen: set[int] = set()
    for entry in actions.entries:
        for number, args in entry.ground():
            assert number not in seen
            seen.add(number)
            assert actions.decode(number) == (entry.action, args)
            assert actions.encode(entry.action, args) == number
            assert actions.handles(entry.action, args)


def brick(*bindings: Binding, senses: Type | None = None) -> list[Code]:
    terms = () if senses is None else (Literal(0, type=senses),)
    actions = {
        "a": Action("a", (), False, (), (), terms, None),
        "b": Action("b", (Parameter("n", Interval(1, 6)),), False, (), (), (), None),
        "c": Action("c", (Parameter("n", INT),), False, (), (), (), None),
        "d": Action("d", (Parameter("n", Interval(1, 70000)),), False, (), (), (), None),
    }
    device = Device("rcx", "rcx", None, bindings, {})
    theory = BasicActionTheory("t", Source("t.gl", ""), {}, {}, {}, {}, {}, actions, {}, (device,))
    findings = Findings()
    number_device(theory, device, findings)
    return [diagnostic.code for diagnostic in findings.diagnostics]


def bind(action: str, number: int | None, *args: Parameter | Fixed, table: dict[int, Value] | None = None) -> Binding:
    return Binding(action, args, number, None, table, None)


SIX = Parameter("n", Interval(1, 6))


def test_overlapping_numbers_are_found() -> None:
    assert brick(bind("b", 8, SIX), bind("a", 13)) == [Code.NUMBER_CLASH]
    assert brick(bind("b", 8, SIX), bind("a", 14)) == []


def test_numbers_beyond_the_brick_are_found() -> None:
    assert brick(bind("b", 32763, SIX)) == [Code.NUMBER_RANGE]
    assert brick(bind("b", 32762, SIX)) == []


def test_infinite_arguments_are_found() -> None:
    assert brick(bind("c", 0, Parameter("n", INT))) == [Code.BINDING_UNBOUNDED]
    assert brick(bind("c", 0, SIX)) == []


def test_arguments_that_do_not_fit_sixteen_bits_are_found() -> None:
    assert brick(bind("d", 0, Parameter("n", Interval(32767, 32768)))) == [Code.ARGUMENT_NUMBER]
    assert brick(bind("d", 0, Parameter("n", Interval(32766, 32767)))) == []


def test_more_arguments_than_there_are_numbers_are_one_finding_with_all_that_follows() -> None:
    many = bind("d", None, Parameter("n", Interval(1, 70000)))
    assert brick(many, bind("a", None), bind("b", None, SIX)) == [Code.NUMBER_RANGE]
    assert brick(many, bind("a", 80000)) == [Code.NUMBER_RANGE] * 2
    assert brick(bind("a", 40000), bind("b", 50000, SIX)) == [Code.NUMBER_RANGE] * 2


@pytest.mark.parametrize(
    ("senses", "codes"),
    [
        (Interval(-1, 1), [Code.SENSING_NUMBER]),
        (Interval(0, 40000), [Code.SENSING_NUMBER]),
        (Enumeration((("x", "e"), (0, ""))), [Code.SENSING_NUMBER]),
        (Enumeration((("x", "e"), (1, ""))), []),
        (INT, []),
        (REAL, []),
        (STRING, [Code.SENSING_NUMBER]),
        (Collection("list", INT), [Code.SENSING_NUMBER]),
        (BOOL, []),
    ],
)
def test_sensing_values_that_a_brick_cannot_answer_are_found(senses: Type, codes: list[Code]) -> None:
    found = brick(bind("a", 0), senses=senses)
    assert found == codes


def test_tables_are_checked() -> None:
    assert brick(bind("a", 0, table={0: -1, 1: 1}), senses=Interval(-1, 1)) == []
    assert brick(bind("a", 0, table={-1: -1}), senses=Interval(-1, 1)) == [Code.SENSING_NUMBER]
    assert brick(bind("a", 0, table={0: 5}), senses=Interval(-1, 1)) == [Code.SENSING_NUMBER]
    assert brick(bind("a", 0, table={0: 5})) == [Code.SENSING_NUMBER]
