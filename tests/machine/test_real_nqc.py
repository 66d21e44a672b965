"""The real nqc as a host, on a pseudo terminal: what it downloads, asks and orders, and what it says of failures."""

from __future__ import annotations

import os
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from golc.bytecode.image import Image, read_image
from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.machine.brick import MachineBrick
from golc.runtime.rcxsim.machine.options import Firmware, Options
from golc.runtime.rcxsim.machine.simulator import build
from golc.runtime.rcxsim.ports import PtyPort
from golc.runtime.rcxsim.serve import serve
from golc.runtime.rcxsim.surroundings import Bench
from golc.runtime.rcxsim.trace import Trace

Compile = Callable[[str, Target], bytes]
TARGETS = {Firmware.V1: Target.RCX, Firmware.V2: Target.RCX2}
BOTH = pytest.mark.parametrize("firmware", list(Firmware))


@dataclass
class Desk:
    """A brick behind a pseudo terminal, and nqc beside it."""

    brick: MachineBrick
    path: str
    folder: Path
    records: list[dict[str, Any]] = field(default_factory=list)

    def nqc(self, *arguments: str, target: Target = Target.RCX) -> subprocess.CompletedProcess[str]:
        command = ["nqc", f"-T{target.nqc}", f"-S{self.path}", *arguments]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)

    def raw(self, request: str) -> str:
        """The answer to a request, in nqc's words."""
        done = self.nqc("-raw", request)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    def until(self, holds: Callable[[], bool]) -> None:
        """Wait for something to happen on the brick, for 20 seconds at most."""
        deadline = time.monotonic() + 20
        while not holds():
            assert time.monotonic() < deadline
            time.sleep(0.01)


Start = Callable[..., Desk]


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Start]:
    """Starts bricks with short air times behind pseudo terminals; all are gone after the test."""
    running: list[tuple[threading.Thread, int, int, PtyPort]] = []

    def start(firmware: Firmware = Firmware.V1, seed: int = 0, **line: Any) -> Desk:
        records: list[dict[str, Any]] = []
        trace = Trace(lambda record: records.append(dict(record)))
        options = LineOptions(**{"air_time": 0.02, **line})
        tower, brick = build(firmware, None, Bench(), Options(seed=seed), options, trace)
        port = PtyPort()
        reader, writer = os.pipe()
        thread = threading.Thread(target=serve, args=(tower, port, [reader], 1.0, 0.0005))
        thread.start()
        running.append((thread, reader, writer, port))
        return Desk(brick, port.description.split()[1], tmp_path, records)

    yield start
    for thread, reader, writer, port in running:
        os.close(writer)
        thread.join()
        os.close(reader)
        port.close()


PROGRAM = """
int x, y;
sub help() { x += 10; }
task other() { while (true) { y += 1; Wait(1); } }
task main()
{
    x = 5;
    help();
    start other;
    OnFwd(OUT_A);
    repeat (20) { PlaySound(1); SetSensor(SENSOR_1, SENSOR_TOUCH); SetSensor(SENSOR_2, SENSOR_LIGHT); Wait(1); }
}
"""


def stored(desk: Desk, slot: int) -> dict[tuple[int, int], bytes]:
    return {(code.type, code.number): code.bytes for code in desk.brick.machine.memory.chunks(slot)}


def chunks(image: Image) -> dict[tuple[int, int], bytes]:
    return {(chunk.type, chunk.number): chunk.code for chunk in image.chunks}


@BOTH
@pytest.mark.parametrize("slot", [None, 4])
def test_what_is_downloaded_is_the_image(desk: Start, nqc: Compile, firmware: Firmware, slot: int | None) -> None:
    there, target = desk(firmware), TARGETS[firmware]
    image = read_image(nqc(PROGRAM, target))
    (there.folder / "program.nqc").write_text(PROGRAM)
    done = there.nqc("-d", *([] if slot is None else ["-pgm", str(slot)]), "program.nqc", target=target)
    assert done.returncode == 0
    assert "complete" in done.stderr
    assert "Battery Level = 8.7 V" in done.stderr
    assert stored(there, 0 if slot is None else slot - 1) == chunks(image)


@BOTH
def test_a_program_is_downloaded_and_run(desk: Start, firmware: Firmware) -> None:
    there = desk(firmware)
    (there.folder / "program.nqc").write_text(PROGRAM)
    assert there.nqc("-d", "program.nqc", "-run", target=TARGETS[firmware]).returncode == 0
    variables = there.brick.machine.variables
    there.until(lambda: variables[1] > 10)
    assert there.raw("120000") == "0f 00"
    assert [r["motor"] for r in there.records if r["what"] == "motor" and r["mode"] == "on"] == ["A"]


def test_a_large_program_comes_whole_over_a_bad_line(desk: Start, nqc: Compile) -> None:
    text = "task main() { " + "OnFwd(OUT_A); Wait(7); PlaySound(2); " * 60 + "}"
    there = desk(seed=5, loss=0.03, garble=0.02, noise=0.1)
    (there.folder / "large.nqc").write_text(text)
    assert there.nqc("-d", "large.nqc").returncode == 0
    assert stored(there, 0) == chunks(read_image(nqc(text, Target.RCX)))
    assert [record for record in there.records if record["what"] in ("lost", "garbled")]


def test_messages_reach_the_program(desk: Start) -> None:
    there = desk()
    assert there.nqc("-msg", "33").returncode == 0
    assert there.raw("120f00") == "21 00"


def test_the_watch_the_range_and_the_sleep_time(desk: Start) -> None:
    there = desk()
    for arguments in (("-watch", "0905"), ("-near",), ("-far",), ("-sleep", "0")):
        assert there.nqc(*arguments).returncode == 0
    assert there.raw("120e00") == "21 02"
    assert [r["payload"] for r in there.records if r["what"] == "request" and r["payload"][:2] in ("31", "b1")] == [
        "31 00",
        "31 01",
        "b1 00",
    ]


def test_selecting_a_program_and_clearing_everything(desk: Start, nqc: Compile) -> None:
    there = desk()
    machine = there.brick.machine
    for slot in range(5):
        machine.load(read_image(nqc(PROGRAM, Target.RCX)), slot)
    machine.resize_log(10)
    assert there.nqc("-pgm", "3").returncode == 0
    assert machine.slot == 2
    assert there.nqc("-clear").returncode == 0
    assert [stored(there, slot) for slot in range(5)] == [{}] * 5
    assert machine.memory.used == 0


def test_the_datalog_is_uploaded(desk: Start) -> None:
    there = desk()
    text = "int a; task main() { CreateDatalog(60); repeat (50) { a += 3; AddToDatalog(a); } AddToDatalog(Watch()); }"
    (there.folder / "log.nqc").write_text(text)
    assert there.nqc("-d", "log.nqc", "-run").returncode == 0
    there.until(lambda: not there.brick.machine.processor.running)
    done = there.nqc("-datalog")
    assert done.returncode == 0
    assert done.stdout.split() == [str(3 * number) for number in range(1, 51)] + ["0"]


def test_raw_requests(desk: Start) -> None:
    there = desk(Firmware.V2)
    assert there.raw("1501030507" + "0b") == "00 03 00 01 00 03 03 02"
    assert there.raw("30") == "fc 21"
    assert there.raw("140502d007") == ""
    assert there.raw("120005") == "d0 07"


def test_the_remote_control(desk: Start) -> None:
    there = desk()
    assert there.nqc("-remote", "0200", "1").returncode == 0
    assert there.raw("120f00") == "02 00"


def test_a_tower_without_echo_and_a_brick_that_is_off(desk: Start) -> None:
    assert desk(echo=False, outages=((0.0, 1e6),)).nqc("-raw", "10").returncode == 254


def test_a_program_without_room_is_refused(desk: Start) -> None:
    there = desk()
    (there.folder / "huge.nqc").write_text("task main() { " + "SetSensor(SENSOR_1, SENSOR_TOUCH); " * 1001 + "}")
    done = there.nqc("-d", "huge.nqc")
    assert done.returncode not in (0, 253, 254)
    assert stored(there, 0) == {}
