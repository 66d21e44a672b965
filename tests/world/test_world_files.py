"""World files: what they may say, and what golc says about those that are wrong."""

from __future__ import annotations

import tomllib
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Code, Source, UserError
from golc.runtime.rcxsim.world.places import Places
from golc.runtime.rcxsim.world.robot import LightSensor, RotationSensor, TouchSensor
from golc.runtime.rcxsim.world.scene import Scene
from golc.runtime.rcxsim.world.worldfile import parse_world, read_world

if TYPE_CHECKING:
    from tests.world.conftest import MakeScene

DELIVERY = Path(__file__).parent.parent.parent / "examples/delivery/delivery.toml"
LEAST = """\
[floor]
light = 50
[robot]
left = "A"
right = "C"
start = { at = [0, 0] }
"""


def test_the_least_file_has_defaults_for_the_rest(scene: MakeScene) -> None:
    robot = scene(LEAST).robot
    assert (robot.radius, robot.wheel_base, robot.wheel_diameter) == (90, 120, 56)
    assert robot.speeds == (25, 50, 75, 100, 125, 150, 175, 200)
    assert robot.wheels == {"left": 0, "right": 2}
    assert robot.sensors == {}


def test_sensors_and_ports(scene: MakeScene) -> None:
    more = """\
    sensors.1 = { kind = "light", ahead = 60 }
    sensors.2 = { kind = "touch", name = "go", bumper = [[90, -20], [90, 20]] }
    sensors.3 = { kind = "rotation", wheel = "right", gear = 2.5 }
    """
    assert scene(more + LEAST).robot.sensors == {
        0: LightSensor(60, 0, 4, 0),
        1: TouchSensor("go", (90, -20, 90, 20)),
        2: RotationSensor("right", 2.5),
    }


def test_a_station_along_a_line_looks_as_the_line_goes(scene: MakeScene) -> None:
    track = "[lines.track]\npoints = [[0, 0], [300, 0], [300, 400]]\nwidth = 20\nlight = 30\n"
    station = "[stations.dock]\nalong = 500\naside = 30\nlength = 40\nlight = 70\n"
    mark = scene(LEAST + track + station).floor.stations["dock"].mark
    assert (mark.pose.x, mark.pose.y) == pytest.approx((270, 200))
    assert degrees(mark.pose.heading) == pytest.approx(90)
    assert (mark.length, mark.width) == (40, 40)


def test_the_robot_starts_at_a_station(scene: MakeScene) -> None:
    text = LEAST.replace("{ at = [0, 0] }", '{ station = 7, facing = "backward" }')
    start = scene(text + "[stations.7]\nat = [100, 50]\nfacing = 30\nlight = 70\n").robot.start
    assert (start.x, start.y, degrees(start.heading)) == pytest.approx((100, 50, 210))


def findings(text: str) -> list[tuple[str, str, str]]:
    """The line and column of each finding, what stands there, and what is said about it."""
    with pytest.raises(UserError) as caught:
        parse_world(Source("w.toml", text))
    found = caught.value.diagnostics
    assert all(finding.code in (Code.WORLD, Code.SYNTAX) for finding in found)
    return [(f"{finding.span.line}:{finding.span.column}", finding.span.text, finding.message) for finding in found]


@pytest.mark.parametrize(
    ("old", "new", "place", "marked", "message"),
    [
        ("light = 50", "ligth = 50", "1:1", "[floor]", "`light` is missing in `[floor]`"),
        ("light = 50", "light = 101", "2:9", "101", "`light` takes a number from 0 to 100, not `101`"),
        ("light = 50", "light = nan", "2:9", "nan", "`light` takes a number from 0 to 100, not `nan`"),
        ("light = 50", "light = true", "2:9", "true", "`light` takes a number from 0 to 100, not `true`"),
        ("light = 50", "light = 'fifty'", "2:9", "'fifty'", "`light` takes a number from 0 to 100, not `fifty`"),
        ("light = 50", "light = 9" + 400 * "0", "2:9", "9" + 400 * "0",
         "`light` takes a number from 0 to 100, not `a large number`"),
        ('left = "A"', 'left = "D"', "4:8", '"D"', "`left` cannot be `D`"),
        ('"A"', f"[0x{'f' * 5000}]", "4:8", f"[0x{'f' * 5000}]", "`left` cannot be `[…]`"),
        ("[0, 0]", "[0]", "6:16", "[0]", "`at` takes a point `[x, y]`, not `[…]`"),
        ("[0, 0]", "[0, '0']", "6:20", "'0'", "`at` takes a number from -100000 to 100000, not `0`"),
        ("at =", "att =", "6:1", "start", "`[robot.start]` must have `station` or `at`, and it has none"),
        ("{ at = [0, 0] }", "7", "6:9", "7", "`start` takes a table, not `7`"),
        ("[robot]", "[robt]", "1:1", "", "`robot` is missing in a world"),
        ("[robot]", "[robot]\nspeeds = [1]", "4:10", "[1]", "`speeds` takes an array of 8 numbers, not `[…]`"),
        ("[robot]", "[[walls]]\npoints = [[5, -9], [5, 9]]\n[robot]", "8:1", "start", "the robot starts in a wall"),
        ("[robot]", "walls = 3\n[robot]", "3:1", "walls", "`walls` means nothing in `[floor]`"),
        ("[floor]", "walls = 3\n[floor]", "1:9", "3", "`walls` takes an array of tables: `[[walls]]`, not `3`"),
        ("[floor]", "[sensors.4]\nkind = 'touch'\n[floor]", "1:1", "[sensors.4]", "there is no 4 in `[sensors.…]`"),
        ("[floor]", "[sensors.1]\nkind = 'tuch'\n[floor]", "2:8", "'tuch'", "`kind` cannot be `tuch`"),
        ("[floor]", "[sensors.1]\nkind = 'touch'\n[floor]", "1:1", "[sensors.1]",
         "nothing can press this touch sensor"),
        ("[floor]", "[sensors.1]\nkind = 'touch'\nname = 'run'\n[floor]", "3:8", "'run'",
         "there is a button `run` already"),
        ("[floor]", "[stations.a]\nalong = 3\nlight = 2\n[floor]", "1:1", "[stations.a]",
         "`on` is missing in `[stations.a]`"),
        ("[floor]", "[stations.'a b']\nat = [3, 3]\nlight = 2\n[floor]", "1:1", "[stations.'a b']",
         "`a b` is no name"),
        ("[floor]", "[lines.l]\npoints = [[1, 1], [1, 1]]\nwidth = 1\nlight = 2\n[floor]", "2:19", "[1, 1]",
         "a point of `points` is the same as the one before it"),
        ("[floor]", "[lines.l]\npoints = [[1, 1], [2, 1]]\nclosed = true\nwidth = 1\nlight = 2\n[floor]",
         "3:10", "true", "a closed line has three points at least"),
        ("[floor]", "[[patches]]\nat = [1, 1]\nsize = [1, 1]\nradius = 1\nlight = 2\n[floor]", "4:1", "radius",
         "`[patches]` must have `size` or `radius`, and it has several"),
        ("[floor]", "[people]\nscript = ['at 3 s press run']\n[floor]", "2:11", "'at 3 s press run'",
         "`at 3 s press run` does not say when people do what"),
        ("[floor]", "[people]\nscript = ['at 3 s: press go']\n[floor]", "2:11", "'at 3 s: press go'",
         "there is no button `go`"),
        ("[floor]", "[people]\nscript = ['at 3 s: sing']\n[floor]", "2:11", "'at 3 s: sing'",
         "`sing` is nothing that people can do here"),
        ("[floor]", "[people]\nscript = ['on stop after 1 s at station 8: lift']\n[floor]", "2:11",
         "'on stop after 1 s at station 8: lift'", "there is no station `8`"),
        ("[floor]", "[people]\nscript = ['on sound boo after 1 s: lift']\n[floor]", "2:11",
         "'on sound boo after 1 s: lift'", "the brick has no sound `boo`"),
        ("[floor]", "[people]\nscript = ['on 0th stop after 1 s: lift']\n[floor]", "2:11",
         "'on 0th stop after 1 s: lift'", "counts begin with `1st`"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_at_its_place(old: str, new: str, place: str, marked: str, message: str) -> None:
    assert findings(LEAST.replace(old, new, 1))[:1] == [(place, marked, message)]


def test_everything_that_is_wrong_is_told_in_the_order_of_the_file() -> None:
    text = LEAST.replace("light = 50", "ligth = 50").replace('"A"', '"X"').replace("start", "strat")
    assert [place for place, _, _ in findings(text)] == ["1:1", "2:1", "3:1", "4:8", "6:1"]


@pytest.mark.parametrize(
    ("text", "place", "problem"),
    [
        ("[floor\n", "1:7", "expected ']' at the end of a table declaration"),
        ("a = 1\na = 2\n", "2:6", "cannot overwrite a value"),
        ('[robot]\r\nleft = "A\r\n', "2:10", "illegal character"),
        ("light", "1:6", "expected '=' after a key"),
    ],
)
def test_what_is_not_toml(text: str, place: str, problem: str) -> None:
    [(where, _, message)] = findings(text)
    assert message.startswith(f"this is not TOML: {problem}")
    assert where == place


def test_a_number_of_thousands_of_digits() -> None:
    assert findings("a = 1" + "0" * 5000) == [("1:1", "", "a number has thousands of digits")]


def test_values_that_are_nested_too_deeply() -> None:
    with pytest.raises(UserError) as caught:
        parse_world(Source("deep.toml", "a = " + "[" * 100_000 + "]" * 100_000))
    assert caught.value.diagnostics[0].code in (Code.NESTING, Code.SYNTAX)


def test_an_empty_file(tmp_path: Path) -> None:
    empty = tmp_path / "empty.toml"
    empty.write_text("")
    with pytest.raises(UserError, match="it is empty") as caught:
        read_world(empty)
    assert "[robot]" in (caught.value.diagnostics[0].help or "")


def test_unknown_keys_get_a_proposal() -> None:
    with pytest.raises(UserError) as caught:
        parse_world(Source("w.toml", LEAST + "wheelbase = 100\n"))
    assert [finding.help for finding in caught.value.diagnostics] == ["did you mean `wheel_base`?"]


@given(st.data())
def test_no_change_of_a_file_makes_it_crash(data: st.DataObject) -> None:
    text = DELIVERY.read_text()
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(text)))
        gone = data.draw(st.integers(0, 12))
        text = text[:place] + data.draw(st.text("[]{}=\",.#\n 0-1aé\\'", max_size=6)) + text[place + gone :]
    try:
        assert isinstance(parse_world(Source("changed.toml", text)), Scene)
    except UserError as error:
        for finding in error.diagnostics:
            assert 0 <= finding.span.start <= finding.span.end <= len(text)


SCALARS = st.one_of(
    st.integers(-1000, 1000), st.booleans(), st.floats(allow_nan=False), st.text(max_size=8), st.just("'\"\\\n]}#,")
)
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3)
)


def written(value: Any) -> str:
    """A value in TOML, with strings of the kinds that can hold it."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return quoted(value)
        case list():
            return "[ # ]\n " + " , # [\n".join(map(written, value)) + " ]"
        case dict():
            return "{ " + ", ".join(f"{quoted(key)} = {written(item)}" for key, item in value.items()) + " }"
    return repr(value)


def quoted(text: str) -> str:
    if "'" not in text and text.isprintable():
        return f"'{text}'"
    return '"' + "".join(f"\\U{ord(character):08x}" for character in text) + '"'


@given(st.dictionaries(st.text(max_size=4), VALUES, max_size=4), st.dictionaries(st.text(max_size=4), VALUES))
def test_every_value_is_found_at_its_place(top: dict[str, Any], table: dict[str, Any]) -> None:
    def lines(pairs: dict[str, Any]) -> str:
        return "".join(f"  {quoted(key)}\t=\t{written(value)}  # = [\n" for key, value in pairs.items())

    text = lines(top) + "# [x]\n[ 'a table' . b ]\n" + lines(table) + "[[many]]\n[[many]]\n" + lines(table)
    top = {key: value for key, value in top.items() if key not in ("a table", "many")}
    if tomllib_refuses(text):
        return
    places = Places(Source("t.toml", text))

    def check(value: Any, path: tuple[str | int, ...]) -> None:
        assert tomllib.loads("x = " + places.value(path).text)["x"] == value
        items = enumerate(value) if isinstance(value, list) else value.items() if isinstance(value, dict) else ()
        for key, item in items:
            check(item, (*path, key))

    for pairs, path in ((top, ()), (table, ("a table", "b")), (table, ("many", 1))):
        for key, value in pairs.items():
            check(value, (*path, key))


def tomllib_refuses(text: str) -> bool:
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return True
    return False


def test_strings_of_every_kind_are_passed_over() -> None:
    text = 'a = """x"" \\""" ]\n"""\nb = \'\'\'\'it\'s\'\'\'\'\nc.d = [ 1, """]""", \'\', "\\"" ]\n'
    text += "e = 1979-05-27 07:32:00\n"
    places = Places(Source("t.toml", text))
    assert {key: places.key((key,)).line for key in "abce"} == {"a": 1, "b": 3, "c": 4, "e": 5}
    assert [places.value(("c", "d", place)).text for place in range(4)] == ["1", '"""]"""', "''", '"\\""']
    assert places.value(("e",)).text == "1979-05-27 07:32:00"
