"""The devices that are no bricks: a person, Python functions, nothing at all; and how device blocks become devices."""

from __future__ import annotations

import threading
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from golc.diagnostics import DeviceError, UserError
from golc.loading import load
from golc.runtime.devices.base import Device, Router
from golc.runtime.devices.bricks import Link
from golc.runtime.devices.build import Surroundings, build_devices
from golc.runtime.devices.desk import Desk
from golc.runtime.devices.host import Host
from golc.theory.python_file import PythonError, PythonFile
from golc.theory.theory import BasicActionTheory
from golc.theory.types import show

DOMAIN = """
domain trial
type colour = {red, green}
type side = {left, right}
fluent seen: colour = red
fluent total: int = 0
fluent wet: bool = false
action look(s: side):
    senses seen
action measure:
    senses total
    senses wet
action greet(s: side)
action remember
action fix
proc control:
    look(left)
    measure
    greet(left)
    remember
    fix
"""

Devices = Callable[..., list[Device]]


@pytest.fixture
def desk() -> Desk:
    return Desk(lambda text: None, interactive=False, open_=False, plausible=lambda line: False)


@pytest.fixture
def devices(tmp_path: Path, desk: Desk) -> Devices:
    """The devices of a domain with these device blocks; ``python`` is the file `helpers.py` beside it."""

    def make(blocks: str, python: str | None = None, asked: Desk | None = None) -> list[Device]:
        path = tmp_path / "trial.gl"
        path.write_text(DOMAIN + blocks)
        if python is not None:
            (tmp_path / "helpers.py").write_text(python)
        theory = load(path)

        def speak(message: Any, args: tuple[Any, ...]) -> str:
            return "".join(part if isinstance(part, str) else show(args[part.level]) for part in message.parts)

        return build_devices(theory, Surroundings(asked or desk, speak, None))

    return make


def answering(lines: list[str], said: list[str]) -> Desk:
    """A desk at which these lines were piped ahead."""
    desk = Desk(said.append, interactive=False, open_=True, plausible=lambda line: True)
    for line in lines:
        desk.offer(line, report=False)
    desk.close()
    return desk


OPERATOR = """
device operator:
    look(s: side) by prompt "What is on the {s}?"
    fix by prompt "Fix it, then press Enter"
    measure
device self:
    remember
    greet(s: side)
"""


def test_the_operator_answers_with_a_value(devices: Devices) -> None:
    said: list[str] = []
    operator, _ = devices(OPERATOR, asked=answering(["blue", "gren", "", "green"], said))

    assert operator.perform("look", ("left",)) == ("green",)
    assert said == [
        "What is on the left? [colour (red, green)]",
        "unknown value `blue`: the value is of type colour (red, green)",
        "unknown value `gren`: did you mean `green`?",
        "type a value of colour (red, green)",
    ]


def test_the_operator_answers_several_values_in_order(devices: Devices) -> None:
    said: list[str] = []
    operator, _ = devices(OPERATOR, asked=answering(["-3", "yes", "true"], said))

    assert operator.perform("measure", ()) == (-3, True)
    assert said[0] == "measure: what is it? [int, answer 1 of 2]"
    assert said[1] == "measure: what is it? [bool, answer 2 of 2]"


def test_the_operator_presses_enter(devices: Devices) -> None:
    said: list[str] = []
    operator, _ = devices(OPERATOR, asked=answering(["done", ""], said))

    assert operator.perform("fix", ()) == ()
    assert said == ["Fix it, then press Enter", "press Enter, with nothing before it, when it is done"]


def test_who_has_answered_ahead_can_be_asked_though_the_pipe_has_ended() -> None:
    desk = answering(["next"], [])

    assert desk.is_open
    assert desk.ask("Retry?", str) == "next"
    assert not desk.is_open


def test_without_an_operator_the_action_fails(devices: Devices) -> None:
    operator, _ = devices(OPERATOR)

    with pytest.raises(DeviceError, match="nobody is there to answer"):
        operator.perform("fix", ())


def test_a_question_to_the_operator_can_be_interrupted(devices: Devices) -> None:
    asked = threading.Event()
    desk = Desk(lambda text: asked.set(), interactive=True, open_=True, plausible=lambda line: False)
    operator, _ = devices(OPERATOR, asked=desk)

    def interrupt() -> None:
        asked.wait(20)
        operator.interrupt()

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(DeviceError, match="given up"):
        operator.perform("fix", ())
    thread.join()


def test_bookkeeping_does_nothing(devices: Devices) -> None:
    _, itself = devices(OPERATOR)

    assert itself.perform("remember", ()) == ()
    assert itself.handles("greet", ("left",))
    assert not itself.handles("fix", ())


HOST = """
device host "helpers.py":
    look(s: side) by call see
    measure
    greet(s: side) by call hello
device self:
    remember
    fix
"""
HELPERS = """
def see(side):
    return {"left": "green", "right": "purple"}[side]

def measure():
    return 7, True

def hello(side):
    raise ValueError(f"no {side}")
"""


def opened(devices: Devices, python: str = HELPERS, blocks: str = HOST) -> Device:
    host = devices(blocks, python)[0]
    host.open()
    return host


def test_a_function_is_called_with_values_and_returns_what_is_sensed(devices: Devices) -> None:
    host = opened(devices)

    assert host.perform("look", ("left",)) == ("green",)
    assert host.perform("measure", ()) == (7, True)
    assert host.label("look", ("left",)) == "host see"


def test_what_an_action_without_sensing_returns_does_not_matter(devices: Devices) -> None:
    host = opened(devices, HELPERS.replace("raise", "return"))

    assert host.perform("greet", ("left",)) == ()


@pytest.mark.parametrize(
    ("python", "message"),
    [
        ("return 'purple'", "returned 'purple', which is not of type colour (red, green)"),
        ("return None", "returned None, which is not of type colour (red, green)"),
        ("return object", "returned <class 'object'>, which is not of type colour"),
        ("return ['green']", "returned ['green'], which is not of type colour"),
    ],
)
def test_a_result_of_the_wrong_type_is_a_device_failure(devices: Devices, python: str, message: str) -> None:
    host = opened(devices, HELPERS.replace('return {"left": "green", "right": "purple"}[side]', python))

    with pytest.raises(DeviceError) as failure:
        host.perform("look", ("left",))

    assert message in str(failure.value)


def test_truth_values_and_integers_are_told_apart(devices: Devices) -> None:
    host = opened(devices, HELPERS.replace("7, True", "True, 1"))

    with pytest.raises(DeviceError, match="returned True, which is not of type int"):
        host.perform("measure", ())


@pytest.mark.parametrize(
    ("type_", "returned", "sensed"),
    [
        ("real", "0.1", Fraction(1, 10)),
        ("real", "2.0", 2),
        ("list[real]", "[1, 0.5]", (1, Fraction(1, 2))),
        ("set[colour]", "{'red'}", frozenset({"red"})),
        ("list[set[int]]", "None", None),
        ("string", "'two words'", "two words"),
    ],
)
def test_a_function_returns_real_numbers_lists_and_sets(
    tmp_path: Path, type_: str, returned: str, sensed: object
) -> None:
    assert sensing(tmp_path, type_, returned).perform("look", ()) == (sensed,)


@pytest.mark.parametrize(
    ("type_", "returned"),
    [
        ("int", "2.0"),
        ("real", "float('nan')"),
        ("list[colour]", "{'red'}"),
        ("list[colour]", "[['red']]"),
        ("set[colour]", "['red']"),
        ("list[int]", "[0.5]"),
        ("string", "3"),
    ],
)
def test_what_is_no_such_value_is_a_device_failure(tmp_path: Path, type_: str, returned: str) -> None:
    with pytest.raises(DeviceError, match="which is not of type"):
        sensing(tmp_path, type_, returned).perform("look", ())


def sensing(folder: Path, type_: str, returned: str) -> Device:
    """A host whose only action senses a value of a type or none; its function returns this expression."""
    path, helpers = folder / "trial.gl", folder / "helpers.py"
    path.write_text(
        f"domain trial\ntype colour = {{red, green}}\nfluent seen: {type_}? = none\naction look:\n    senses seen\n"
        'device host "helpers.py":\n    look\n'
    )
    helpers.write_text(f"def look():\n    return {returned}\n")
    theory = load(path)
    host = Host("host", helpers, theory.devices[0].bindings, theory)
    host.open()
    return host


def test_too_few_results_are_a_device_failure(devices: Devices) -> None:
    host = opened(devices, HELPERS.replace("7, True", "(7,)"))

    with pytest.raises(DeviceError, match=r"a tuple of 2 sensing results is needed"):
        host.perform("measure", ())


@pytest.mark.parametrize("fault", ["raise ValueError('no left')", "import sys; sys.exit('no left')"])
def test_whatever_a_function_raises_is_a_device_failure_with_its_line(devices: Devices, fault: str) -> None:
    host = opened(devices, HELPERS.replace('raise ValueError(f"no {side}")', fault))

    with pytest.raises(DeviceError) as failure:
        host.perform("greet", ("left",))

    assert "`hello` failed at" in str(failure.value)
    assert "helpers.py:9: " in str(failure.value)
    assert str(failure.value).endswith("no left")
    assert failure.value.__cause__ is not None


def test_a_failure_in_a_file_named_by_a_relative_path_has_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("broken.py").write_text("x = 1\nraise ValueError('no')\n")

    with pytest.raises(PythonError, match=r"broken\.py:2: ValueError: no"):
        PythonFile(Path("broken.py"), trusted=True).function("f")


def test_an_interrupt_of_the_run_passes_through_a_function(devices: Devices) -> None:
    host = opened(devices, HELPERS.replace('raise ValueError(f"no {side}")', "raise KeyboardInterrupt"))

    with pytest.raises(KeyboardInterrupt):
        host.perform("greet", ("left",))


@pytest.mark.parametrize(
    ("python", "message"),
    [
        (None, "there is no such file"),
        ("def see(:", "loading helpers.py failed at"),
        ("import nothing_of_this_name", "No module named 'nothing_of_this_name'"),
        (HELPERS.replace("def see", "def sees"), "has no function `see`"),
        (HELPERS.replace("def see", "measure = 3\ndef see").replace("def measure", "def m"), "`measure` in"),
    ],
)
def test_a_file_that_cannot_be_used_is_told_when_the_run_begins(
    devices: Devices, python: str | None, message: str
) -> None:
    host = devices(HOST, python)[0]

    with pytest.raises(DeviceError) as failure:
        host.open()

    assert message in str(failure.value)


def test_a_misspelt_function_is_proposed(devices: Devices) -> None:
    host = devices(HOST, HELPERS.replace("def see", "def sees"))[0]

    with pytest.raises(DeviceError) as failure:
        host.open()

    assert failure.value.help == "did you mean `sees`?"


def test_a_file_may_import_its_neighbours(devices: Devices, tmp_path: Path) -> None:
    (tmp_path / "golc_test_neighbour.py").write_text("COLOUR = 'green'\n")
    python = HELPERS.replace('{"left": "green", "right": "purple"}[side]', "golc_test_neighbour.COLOUR")
    host = opened(devices, "import golc_test_neighbour\n" + python)

    assert host.perform("look", ("left",)) == ("green",)


def test_a_device_without_bindings_takes_what_is_left(devices: Devices) -> None:
    host, itself = devices('device host "helpers.py"\ndevice self:\n    remember\n    greet(s: side)\n', "")

    assert [host.handles(action, ()) for action in ("measure", "fix", "remember")] == [True, True, False]
    assert itself.handles("remember", ())


def test_instances_of_one_action_may_belong_to_several_devices(devices: Devices, tmp_path: Path) -> None:
    blocks = """
device host "helpers.py":
    greet(left) by call hello
device self:
    greet(right)
    remember
    fix
device operator:
    look(s: side)
    measure
"""
    made = devices(blocks, HELPERS)
    router = Router(made, load(tmp_path / "trial.gl"))

    assert router.device("greet", ("left",)) is made[0]
    assert router.device("greet", ("right",)) is made[1]


def test_a_binding_of_a_part_of_a_type_covers_just_that(
    desk: Desk, unchecked: Callable[[str], BasicActionTheory]
) -> None:
    blocks = 'action go(n: 1..9)\ndevice self:\n    go(n: 1..3)\ndevice operator:\n    go(n: 4..9) by prompt "go"\n'
    theory = unchecked(DOMAIN + blocks)
    itself, operator = build_devices(theory, Surroundings(desk, lambda message, args: "", None))
    router = Router([itself, operator], theory)

    assert [router.device("go", (n,)) for n in (1, 3, 4, 9)] == [itself, itself, operator, operator]


def test_an_action_that_no_device_does_is_an_error(desk: Desk, unchecked: Callable[[str], BasicActionTheory]) -> None:
    theory = unchecked(DOMAIN + "device self:\n    remember\n    greet(left)\n")
    (itself,) = build_devices(theory, Surroundings(desk, lambda message, args: "", None))
    router = Router([itself], theory)

    assert router.device("greet", ("left",)) is itself
    with pytest.raises(UserError, match=r"no device performs `greet\(right\)`"):
        router.device("greet", ("right",))


def test_a_brick_needs_a_port(delivery: BasicActionTheory, desk: Desk) -> None:
    with pytest.raises(DeviceError, match="has no port"):
        build_devices(delivery, Surroundings(desk, lambda message, args: "", None))


def test_a_brick_is_named_with_the_number_of_the_action(delivery: BasicActionTheory, desk: Desk) -> None:
    rcx, operator = build_devices(delivery, Surroundings(desk, lambda message, args: "", Link("/nowhere")))

    assert rcx.label("start_to_next_station", ()) == "rcx 2"
    assert rcx.poll_interval == 0.25
    assert not rcx.handles("reposition_robot", ())
    assert operator.poll_interval is None
