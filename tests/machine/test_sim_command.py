"""``golc sim`` with byte code: compiled, loaded, listed, run at once, served on a port, refused."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import fields
from pathlib import Path

import pytest

from golc.cli import invoke
from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.options import Options, WhileSending

Compile = Callable[[str, Target], bytes]
Golc = Callable[..., tuple[int, str, str]]
COUNT = """\
int sum;
task other() { while (true) { sum += 100; Wait(10); } }
task main() { repeat (4) { sum += 1; Wait(5); } OnFwd(OUT_B); Float(OUT_C); }
"""


@pytest.fixture
def golc(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Golc:
    """Runs a command in a folder of its own: the exit code, stdout and stderr."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments: str) -> tuple[int, str, str]:
        code = invoke(arguments)
        return code, *capfd.readouterr()

    return run


@pytest.fixture
def count(tmp_path: Path) -> str:
    (tmp_path / "count.nqc").write_text(COUNT)
    return "count.nqc"


def test_letting_time_pass_shows_how_the_brick_stands(golc: Golc, count: str) -> None:
    code, out, _ = golc("sim", count, "--for", "0.1")
    assert code == 0
    assert out.splitlines()[0].startswith("0.10")
    assert out.splitlines()[0].endswith("s, task 0 (main), address 23")
    assert out.splitlines()[1:] == ["motor A off", "motor B off", "motor C off", "sum = 2"]


def test_running_to_the_end(golc: Golc, count: str) -> None:
    code, out, _ = golc("sim", count, "--steps", "1000")
    assert code == 0
    assert out.splitlines()[1:] == ["motor A off", "motor B on, forward, power 7", "motor C float", "sum = 4"]
    assert out.splitlines()[0].endswith("s, no task is running")


def test_a_program_that_does_not_end_is_given_up(golc: Golc, tmp_path: Path) -> None:
    (tmp_path / "busy.nqc").write_text("int a; task main() { while (true) a += 1; }")
    code, out, complaint = golc("sim", "busy.nqc", "--steps", "500")
    assert (code, out) == (3, "")
    assert complaint.startswith("error: task 0 (main), address ")
    assert complaint.endswith(": the program has not ended after 500 steps\n")


def test_a_program_that_waits_for_ever_is_given_up(golc: Golc, tmp_path: Path) -> None:
    (tmp_path / "idle.nqc").write_text("task main() { while (true) Wait(32767); }")
    assert golc("sim", "idle.nqc", "--steps", "5000")[0] == 3


@pytest.mark.parametrize("how", [["--for", "1"], ["--steps", "99"]])
def test_a_program_that_cannot_be_executed(golc: Golc, tmp_path: Path, how: list[str]) -> None:
    (tmp_path / "bad.nqc").write_text("int a[3], i; task main() { i = 99; a[i] = 1; }")
    code, out, complaint = golc("sim", "bad.nqc", *how, "-q")
    assert (code, out) == (5, "")
    assert complaint == "error: task 0 (main), address 16: firmware 2.0 has no variable 99\n"


def test_the_listing_is_that_of_nqc(golc: Golc, count: str, tmp_path: Path) -> None:
    for target in ("RCX", "RCX2"):
        command = ["nqc", f"-T{target}", "-L", count]
        shown = subprocess.run(command, cwd=tmp_path, capture_output=True, check=True, text=True).stdout
        assert golc("sim", count, "--listing", "--target", target.lower()) == (0, shown, "")


def test_a_compiled_program_says_its_firmware(golc: Golc, nqc: Compile, tmp_path: Path) -> None:
    text = "int a, b; task main() { a = FirmwareVersion(); }"
    (tmp_path / "new.rcx").write_bytes(nqc(text, Target.RCX2))
    assert "a = 332" in golc("sim", "new.rcx", "--steps", "99")[1]
    code, _, complaint = golc("sim", "new.rcx", "--steps", "99", "--target", "rcx")
    assert code == 5
    assert "firmware 1.0 has no source 35" in complaint


def test_what_the_firmware_is_like_can_be_said(golc: Golc, tmp_path: Path) -> None:
    (tmp_path / "p.nqc").write_text("int a; task main() { a = BatteryLevel(); }")
    assert "a = 6500" in golc("sim", "p.nqc", "--steps", "99", "--brick", "battery=6500")[1]


WRONG = "speed=3 seed=3 battery battery=-1 battery=x memory=9999999999 op_time=0 light=3 light=1,0 select_starts=true"


@pytest.mark.parametrize("setting", [*WRONG.split(), "while_sending=wait"])
def test_what_the_firmware_cannot_be_like(golc: Golc, count: str, setting: str) -> None:
    code, _, complaint = golc("sim", count, "--for", "1", "--brick", setting)
    assert code == 2
    assert "--brick" in complaint


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--for", "1"], "--for is for a program"),
        (["--steps", "1"], "--steps is for a program"),
        (["--listing"], "--listing is for a program"),
        (["count.nqc", "-D", "a=1"], "-D is for a domain"),
        (["count.nqc", "--events", "x"], "--events is for a domain"),
        (["count.nqc", "--for", "1", "--steps", "9"], "--for and --steps exclude each other"),
        (["count.nqc", "--for", "1", "--pty", "p"], "--pty and --for exclude each other"),
        (["count.nqc", "--world", "w", "--listing", "--picture", "p"], "--listing and --picture exclude each other"),
        (["robot.gl", "--target", "rcx"], "--target is for byte code"),
        (["robot.gl", "--brick", "battery=1"], "--brick is for byte code"),
        (["robot.gl", "--for", "1"], "--for is for byte code"),
        (["robot.gl", "--listing"], "--listing is for byte code"),
    ],
)
def test_options_that_do_not_fit_are_refused(golc: Golc, count: str, arguments: list[str], reason: str) -> None:
    code, _, complaint = golc("sim", *arguments)
    assert code == 2
    assert reason in complaint


@pytest.mark.parametrize(
    ("name", "data", "reason"),
    [
        ("p.rcx", b"garbage", "the compiled file is cut off"),
        ("p.rcx", None, "No such file or directory"),
        ("p.nqc", None, "No such file or directory"),
        ("p.rcx", b"RCXI\x02\x01\x01\x00\x00\x00\x03\x00\x00\x00\x01\x00\x07\x00\x00\x00", "unknown op code 07"),
        ("p.rcx", b"RCXI\x02\x01\x01\x00\x00\x00\x03\x00\x00\x63\x01\x00\x10\x00\x00\x00", "has a task 99"),
    ],
)
def test_what_cannot_be_loaded(golc: Golc, tmp_path: Path, name: str, data: bytes | None, reason: str) -> None:
    if data is not None:
        (tmp_path / name).write_bytes(data)
    code, _, complaint = golc("sim", name, "--for", "1")
    assert code == 1
    assert "error[GL090]: cannot load `p" in complaint
    assert reason in complaint


def test_an_nqc_program_with_errors(golc: Golc, tmp_path: Path) -> None:
    (tmp_path / "p.nqc").write_text("task main() { x = 1; }")
    code, _, complaint = golc("sim", "p.nqc")
    assert code == 1
    assert "error[GL094]: nqc: undefined variable 'x'\n --> p.nqc:1:15" in complaint
    assert not (tmp_path / "p.rcx").exists()


@pytest.fixture
def sim(tmp_path: Path) -> Iterator[Callable[..., tuple[str, subprocess.Popen[str]]]]:
    """Starts ``golc sim``: the path of its terminal and the process, which is ended after the test."""
    running: list[subprocess.Popen[str]] = []

    def start(*arguments: str) -> tuple[str, subprocess.Popen[str]]:
        command = [sys.executable, "-m", "golc", "sim", *arguments]
        child = subprocess.Popen(
            command, cwd=tmp_path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        running.append(child)
        assert child.stdout is not None
        return child.stdout.readline().split()[1], child

    yield start
    for child in running:
        child.terminate()
        child.communicate()


def test_an_empty_brick_takes_a_program_and_writes_a_trace(
    sim: Callable[..., tuple[str, subprocess.Popen[str]]], count: str, tmp_path: Path
) -> None:
    path, child = sim("--target", "rcx", "--air-time", "0.02", "--trace", "trace.jsonl")
    command = ["nqc", "-TRCX", f"-S{path}", "-d", count, "-run"]
    assert subprocess.run(command, cwd=tmp_path, capture_output=True, check=False, timeout=60).returncode == 0
    child.terminate()
    assert child.wait(20) == 0
    records = [json.loads(line) for line in (tmp_path / "trace.jsonl").read_text().splitlines()]
    parts = [
        (record["program"], record["part"], record["bytes"]) for record in records if record["what"] == "downloaded"
    ]
    assert parts == [(1, "task 0", 28), (1, "task 1", 11)]
    started = [record for record in records if record["what"] == "task"]
    assert (started[0]["task"], started[0]["how"]) == (0, "started")


def test_a_program_that_fails_is_told_and_the_brick_goes_on(
    sim: Callable[..., tuple[str, subprocess.Popen[str]]], tmp_path: Path
) -> None:
    (tmp_path / "bad.nqc").write_text("int a[3], i; task main() { i = 99; a[i] = 1; }")
    path, child = sim("bad.nqc", "--air-time", "0.02")
    assert child.stderr is not None
    complaint = "task 0 (main), address 16: firmware 2.0 has no variable 99; the program is stopped"
    assert complaint in child.stderr.readline()
    done = subprocess.run(["nqc", f"-S{path}", "-raw", "120000"], capture_output=True, check=False, timeout=60)
    assert done.returncode == 0


def test_the_manual_names_every_choice_with_its_default() -> None:
    page = (Path(__file__).parents[2] / "docs" / "simulator.md").read_text(encoding="utf-8")
    section = page[page.index("### What is known of the firmware") :]
    table = dict(re.findall(r"^\| `(\w+)` \| (.*?) \|", section[: section.index("Chosen, too")], re.MULTILINE))
    defaults = {field.name: field.default for field in fields(Options) if field.name not in ("seed", "op_time")}
    assert table.pop("op_time") == "2000, or 2800 with firmware 2.0"
    assert table == {name: shown(value) for name, value in defaults.items()}


def shown(value: object) -> str:
    match value:
        case bool():
            return "`yes`" if value else "`no`"
        case WhileSending():
            return f"`{value.value}`"
        case tuple():
            return ",".join(map(str, value))
        case _:
            return str(value)
