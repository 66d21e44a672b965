"""``golc sim --world`` and ``golc run`` without a port, as commands."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from golc.cli import invoke
from golc.diagnostics import DeviceError, Findings
from golc.loading import load
from golc.nqc.numbering import number_device
from golc.runtime import standin
from golc.runtime.rcxsim.trace import Trace

DELIVERY = Path(__file__).parent.parent.parent / "examples/delivery"
DOMAIN, WORLD = DELIVERY / "delivery.gl", DELIVERY / "delivery.toml"
PATIENCE = 120.0
STRAIGHT = """\
task main()
{
    On(OUT_A + OUT_C);
    Wait(100);
    Off(OUT_A + OUT_C);
}
"""
ROOM = """\
[floor]
light = 50
[robot]
left = "A"
right = "C"
start = { at = [0, 0], facing = 90 }
"""


@pytest.fixture
def room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a program that drives for a second, and a world for it."""
    (tmp_path / "straight.nqc").write_text(STRAIGHT)
    (tmp_path / "room.toml").write_text(ROOM)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def golc(*arguments: object, typed: str = "") -> tuple[int, str, str]:
    """Exit code and output of a command that is a process of its own."""
    command = [sys.executable, "-m", "golc", *map(str, arguments)]
    done = subprocess.run(command, input=typed, capture_output=True, text=True, timeout=PATIENCE, check=False)
    return done.returncode, done.stdout, done.stderr


def test_a_program_drives_in_a_world_at_once(room: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["sim", "straight.nqc", "--world", "room.toml", "--for", "3", "--picture", "way.svg"]) == 0
    # A second at full power, and what the op codes take, to the north.
    assert re.search(r"the robot is at \(0, 20[0-4]\)$", capsys.readouterr().out.strip())
    svg = ElementTree.parse(room / "way.svg").getroot()
    assert svg.tag == "{http://www.w3.org/2000/svg}svg"


def test_the_behaviours_of_a_domain_in_a_world(capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["sim", str(DOMAIN), "--world", str(WORLD), "--for", "1"]) == 0
    out = capsys.readouterr().out
    assert "main" in out
    assert "the robot is at station 3" in out


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["straight.nqc", "--picture", "p.svg"], "--picture is for a world"),
        (["straight.nqc", "--world", "room.toml", "--events", "e"], "--events is for a domain without --world"),
    ],
)
def test_options_that_do_not_go_together(
    room: Path, arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert invoke(["sim", *arguments]) == 2
    assert complaint in capsys.readouterr().err


def test_a_world_that_is_none(room: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (room / "bad.toml").write_text(ROOM.replace("light", "ligth"))
    assert invoke(["sim", "straight.nqc", "--world", "bad.toml", "--for", "1"]) == 1
    assert "bad.toml:2:1" in capsys.readouterr().err
    assert invoke(["sim", "straight.nqc", "--world", "nowhere.toml", "--for", "1"]) == 1
    assert "cannot read `nowhere.toml`: there is no such file" in capsys.readouterr().err


def test_without_a_port_the_robot_drives_in_the_world_beside_the_domain(tmp_path: Path) -> None:
    picture = tmp_path / "way.svg"
    code, out, err = golc("run", DOMAIN, "--speed", 100, "--stop-when-idle", 40, "--picture", picture)
    assert (code, err) == (0, "")
    assert f"on a simulated brick in {WORLD}, 100 times as fast as a real one (no --port was given)" in out
    assert re.findall(r"→ (\w+)", out).count("start_to_next_station") == 8
    assert re.findall(r"the robot is at station (\d)", out) == [*"456543211"]
    assert "11 actions and 10 exogenous actions" in out
    assert len(picture.read_text()) > 5000


def test_people_and_a_script_for_the_host_in_a_world(tmp_path: Path) -> None:
    events = tmp_path / "requests.events"
    events.write_text("on 1st signal_arrival after 0 s: request_delivery(4, 3)\n")
    code, out, err = golc(
        "run", DOMAIN, "--world", WORLD, "--events", events, "--speed", 100, "--stop-when-idle", 40, typed="!state\n"
    )
    assert (code, err) == (0, "")
    assert "← request_delivery(4, 3)" in out
    assert "the robot is at station 1" in out


def test_a_script_that_speaks_for_the_brick_is_warned_of(tmp_path: Path) -> None:
    events = tmp_path / "all.events"
    events.write_text("at 900 s: request_delivery(4, 3)\nat 900 s: push_go_button\nat 901 s: push_go_button\n")
    code, _, err = golc("run", DOMAIN, "--world", WORLD, "--events", events, "--speed", 50, typed="!stop\n")
    assert code == 0
    assert re.findall(r"^warning\[(GL\d+)\].*\n +--> .*all\.events:(\d)", err, re.MULTILINE) == [("GL122", "2")]
    code, _, err = golc("run", DOMAIN, "--world", "none", "--events", events, "--speed", 50, typed="!stop\n")
    assert (code, err) == (0, "")


def test_no_world_where_none_is_wanted() -> None:
    code, out, _ = golc("run", DOMAIN, "--world", "none", "--speed", 20, typed="!stop\n")
    assert code == 0
    assert "on a simulated brick, 20 times" in out
    assert "the robot is" not in out


def test_without_nqc_the_theory_stands_in_and_says_how_to_get_more(monkeypatch: pytest.MonkeyPatch) -> None:
    theory = load(DOMAIN)
    bricks = {"rcx": number_device(theory, theory.devices[0], Findings())}
    assert standin.place(theory, bricks, None, scripted=False) == standin.Place(WORLD)
    assert standin.place(theory, bricks, None, scripted=True) == standin.Place(None)
    monkeypatch.setenv("PATH", "/nowhere")
    found = standin.place(theory, bricks, None, scripted=False)
    assert found.world is None
    assert "install it (on Debian and Ubuntu: apt-get install nqc)" in found.hint
    with pytest.raises(DeviceError, match="not installed"):
        standin.RobotInWorld(theory, bricks["rcx"], WORLD, 1.0, 0, Trace())


@pytest.mark.parametrize("option", ["--picture", "--journal"])
def test_a_file_that_cannot_be_written_is_told_before_anything_happens(
    capfd: pytest.CaptureFixture[str], option: str
) -> None:
    assert invoke(["run", str(DOMAIN), "--speed", "50", option, "/nowhere/file"]) == 1
    out, err = capfd.readouterr()
    assert err.startswith("error[GL001]: cannot write `/nowhere/file`: No such file or directory")
    assert "→" not in out


@pytest.mark.parametrize(
    ("arguments", "code", "complaint"),
    [
        (["--picture", "/nowhere/way.svg", "--for", "1"], 1, "cannot write `/nowhere/way.svg`: No such file"),
        (["--trace", "/nowhere/trace", "--for", "1"], 1, "cannot write `/nowhere/trace`: No such file"),
        (["--pty", "/nowhere/brick"], 4, "cannot make the link /nowhere/brick"),
    ],
)
def test_where_nothing_has_begun_the_robot_is_nowhere(
    room: Path, arguments: list[str], code: int, complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert invoke(["sim", "straight.nqc", "--world", "room.toml", *arguments]) == code
    out, err = capsys.readouterr()
    assert complaint in err
    assert out == ""


def test_a_disk_that_is_full_before_the_picture_is_drawn(room: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["sim", "straight.nqc", "--world", "room.toml", "--for", "3", "--picture", "/dev/full"]) == 4
    out, err = capsys.readouterr()
    assert "the robot is at (0, 20" in out
    assert "cannot write the picture /dev/full: No space left on device" in err


@pytest.mark.parametrize(
    ("arguments", "code", "complaint"),
    [
        (["--port", "/dev/ttyS0", "--world", "w.toml"], 2, "--world and --picture are for a simulated brick"),
        (["--world", "none", "--picture", "p.svg"], 4, "there is no world of which a picture could be drawn"),
    ],
)
def test_there_must_be_a_world_to_draw(
    room: Path, arguments: list[str], code: int, complaint: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert invoke(["run", str(DOMAIN), *arguments]) == code
    assert complaint in capfd.readouterr().err


def test_there_is_one_brick_in_a_world(room: Path, capfd: pytest.CaptureFixture[str]) -> None:
    two = "domain d\naction go\naction come\nproc control:\n    go\n    come\n"
    two += "device rcx left:\n    0 go by call f\ndevice rcx right:\n    0 come by call f\n"
    two += "    set range 1\n"
    (room / "d.gl").write_text(two)
    assert invoke(["run", "d.gl", "--world", "room.toml"]) == 4
    assert "there is one brick in a world, but the domain has left, right" in capfd.readouterr().err


def test_stubs_that_somebody_has_edited_are_what_drives(room: Path) -> None:
    domain = 'domain d\naction go\nproc control:\n    go\ndevice rcx "d.nqc":\n    0 go by call straight\n'
    (room / "d.gl").write_text(domain)
    assert golc("gen-nqc", "d.gl")[0] == 0
    stubs = room / "build/d-rcx-stubs.nqc"
    text = re.sub(
        r"void straight\(\)\s*\{.*?\}", STRAIGHT.replace("task main", "void straight"), stubs.read_text(), flags=re.S
    )
    stubs.write_text(text)
    code, out, err = golc("run", "d.gl", "--world", "room.toml", "--speed", 50)
    assert (code, err) == (0, "")
    assert re.search(r"the robot is at \(0, 20[0-4]\)", out)


def test_a_program_that_nqc_refuses_is_told_at_its_place(room: Path) -> None:
    (room / "d.gl").write_text('domain d\naction go\nproc control:\n    go\ndevice rcx "d.nqc":\n    0 go by call f\n')
    (room / "d.nqc").write_text("void f() { Wait(speed); }\n")
    code, _, err = golc("run", "d.gl", "--world", "room.toml")
    assert code == 1
    assert "nqc: undefined variable 'speed'" in err
    assert "d.nqc:1:17" in err


def test_the_sorter_sees_the_bricks_that_lie_in_its_world(tmp_path: Path) -> None:
    sorter = DELIVERY.parent / "sorter"
    bricks = re.findall(r"^size.*\nlight = (\d+)", (sorter / "sorter.toml").read_text(), re.MULTILINE)
    code, out, err = golc("run", sorter / "sorter.gl", "--speed", 50)
    assert (code, err) == (0, "")
    assert re.findall(r"answered (\w+)", out) == ["light" if int(light) > 50 else "dark" for light in bricks]
    other = tmp_path / "other.toml"
    other.write_text((sorter / "sorter.toml").read_text().replace("light = 60", "light = 30"))
    code, out, err = golc("run", sorter / "sorter.gl", "--speed", 50, "--world", other)
    assert re.findall(r"answered (\w+)", out) == ["dark"] * 5
