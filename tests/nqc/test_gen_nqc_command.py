"""The command line, with the real nqc, and for the download with a brick's loader behind a pty."""

from __future__ import annotations

import os
import shutil
import threading
import tty
from collections.abc import Iterator
from pathlib import Path

import pytest

from golc.bytecode.image import read_image
from golc.cli import invoke
from golc.diagnostics import DeviceError
from golc.nqc.download import download
from golc.nqc.toolchain import Target

ROBOT = """\
domain robot
action go
action dance
exog arrived
proc control:
    go
    dance
device rcx "robot.nqc":
    0 go by start drive
    1 arrived
    2 dance by call dance
"""
NQC = "task drive() { Wait(100); golc_report(EXOG_arrived); }\nvoid dance() { Wait(5); }\n"


@pytest.fixture
def domain(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "robot.nqc").write_text(NQC)
    path = tmp_path / "robot.gl"
    path.write_text(ROBOT)
    return path


def test_it_says_what_it_wrote(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["gen-nqc", "robot.gl"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "brick: behaviours in robot.nqc"
    assert [line.split() for line in lines[2:5]] == [
        ["0", "go", "starts", "drive"],
        ["1", "arrived", "reported", "by", "the", "brick"],
        ["2", "dance", "calls", "dance"],
    ]
    assert lines[6:] == [
        "wrote build/robot-rcx.nqc  (the program)",
        "wrote build/control.nqh  (the event loop)",
        "wrote build/robot-rcx.json  (the action map for programs)",
    ]
    assert sorted(path.name for path in (domain.parent / "build").iterdir()) == [
        "control.nqh",
        "robot-rcx.json",
        "robot-rcx.nqc",
    ]


def test_the_build_folder_lies_beside_the_domain_and_output_is_another(
    domain: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert invoke(["gen-nqc", str(domain), "-q"]) == 0
    assert (tmp_path / "build" / "robot-rcx.nqc").exists()
    assert invoke(["gen-nqc", "../robot.gl", "-o", "here/too", "--compile", "-q"]) == 0
    assert (tmp_path / "elsewhere" / "here" / "too" / "robot-rcx.rcx").exists()


@pytest.mark.parametrize(("target", "firmware"), [("rcx", "1.0"), ("rcx2", "2.0")])
def test_the_size_table(domain: Path, capsys: pytest.CaptureFixture[str], target: str, firmware: str) -> None:
    assert invoke(["gen-nqc", "robot.gl", "--compile", "--target", target]) == 0
    out = capsys.readouterr().out
    assert f"compiled build/robot-rcx.rcx for firmware {firmware} ({target})" in out
    rows = [line.split() for line in out.splitlines() if " of " in line]
    assert [row[0] for row in rows][:4] == ["bytes", "tasks", "subs", "variables"]
    assert [(row[1], row[3]) for row in rows[1:3]] == [("3", "10"), ("0", "8")]


def test_missing_behaviours_are_said(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (domain.parent / "robot.nqc").unlink()
    assert invoke(["gen-nqc", "robot.gl"]) == 0
    out = capsys.readouterr().out
    assert "brick: no behaviours yet, robot.nqc is not there" in out
    assert "wrote build/robot-rcx-stubs.nqc  (stubs, to be filled in: drive, dance)" in out


def test_an_edited_file_is_named(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["gen-nqc", "robot.gl"]) == 0
    path = domain.parent / "build" / "robot-rcx.nqc"
    path.write_text(path.read_text() + "// mine\n")
    capsys.readouterr()
    assert invoke(["gen-nqc", "robot.gl"]) == 0
    captured = capsys.readouterr()
    assert (
        "kept  build/robot-rcx.nqc, which somebody has edited; the new text is in build/robot-rcx.nqc.new"
        in captured.out
    )
    assert "GL099" in captured.err
    assert path.read_text().endswith("// mine\n")


def test_an_error_of_nqc_ends_with_1_and_shows_its_place(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (domain.parent / "robot.nqc").write_text(NQC + "void f() { Wait(speed); }\n")
    assert invoke(["gen-nqc", "robot.gl", "--compile"]) == 1
    err = capsys.readouterr().err
    assert "error[GL094]: nqc: undefined variable 'speed'" in err
    assert "--> robot.nqc:3:17" in err


def test_a_domain_without_a_brick_is_one_message(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "d.gl").write_text("domain d\naction a\nproc control:\n    a\n")
    assert invoke(["gen-nqc", str(tmp_path / "d.gl")]) == 1
    assert "has no device of kind `rcx`" in capsys.readouterr().err


def test_a_missing_domain_ends_with_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["gen-nqc", "nowhere.gl"]) == 1
    assert "GL001" in capsys.readouterr().err


@pytest.mark.parametrize(
    "options",
    [
        ["--download"],
        ["--port", "/dev/null"],
        ["--slot", "1"],
        ["--download", "--port", "x", "--slot", "6"],
        ["--target", "scout"],
        ["--link", "reliable"],
        ["--device", "other"],
    ],
)
def test_wrong_usage_ends_with_2(domain: Path, options: list[str]) -> None:
    assert invoke(["gen-nqc", "robot.gl", *options]) == 2


def test_a_missing_compiler_ends_with_4(
    domain: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(domain.parent))
    assert invoke(["gen-nqc", "robot.gl", "--compile"]) == 4
    assert "nqc, the compiler for the brick, is not installed" in capsys.readouterr().err


def test_several_bricks_get_a_program_each_and_one_can_be_chosen(tmp_path: Path) -> None:
    (tmp_path / "two.gl").write_text(
        "domain two\naction a\naction b\nproc control:\n    a\n    b\n"
        "device rcx left:\n    0 a\ndevice rcx right:\n    0 b\n    set range 1\n"
    )
    assert invoke(["gen-nqc", str(tmp_path / "two.gl"), "--device", "right", "--compile", "-q"]) == 0
    assert not (tmp_path / "build" / "two-left.nqc").exists()
    assert "#define GOLC_ACTION_LOW 96" in (tmp_path / "build" / "two-right.nqc").read_text()
    assert invoke(["gen-nqc", str(tmp_path / "two.gl"), "--compile", "-q"]) == 0
    assert "#define GOLC_ACTION_LOW 32" in (tmp_path / "build" / "two-left.nqc").read_text()
    assert invoke(["gen-nqc", str(tmp_path / "two.gl"), "--download", "--port", "x", "-q"]) == 2


class Loader(threading.Thread):
    """What the firmware of a brick does while a program is loaded: it answers each packet and keeps the program."""

    def __init__(self) -> None:
        super().__init__(daemon=True)
        self.master, slave = os.openpty()
        tty.setraw(slave)
        self.port = os.ttyname(slave)
        self.slave = slave
        self.requests: list[bytes] = []

    def run(self) -> None:
        held = b""
        while True:
            try:
                data = os.read(self.master, 4096)
                os.write(self.master, data)  # a serial tower hears itself
            except OSError:
                return
            held = self.take(held + data)

    def take(self, held: bytes) -> bytes:
        """Answer the packets in what was received; what is left is the beginning of the next."""
        while (start := held.find(b"\x55\xff\x00")) >= 0:
            body = held[start + 3 :]
            size = self.size(body)
            if size is None or len(body) < size:
                return held[start:]
            packet = body[: size - 2 : 2]
            self.requests.append(packet)
            if packet[0] & 0xF7 != 0xF7:
                self.answer(packet)
            held = body[size:]
        return held[-2:]

    def size(self, body: bytes) -> int | None:
        """The bytes of a packet with their complements and the sum; None while that is not known."""
        if not body:
            return None
        if body[0] & 0xF7 == 0x45:
            return None if len(body) < 10 else 2 * (1 + 4 + body[6] + 256 * body[8] + 1) + 2
        count = body[0] & 7
        return 2 * (1 + (count - 6 if count > 5 else count)) + 2

    def answer(self, packet: bytes) -> None:
        data = {0x25: b"\0", 0x35: b"\0", 0x45: b"\0", 0x30: b"\x28\x23"}.get(packet[0] & 0xF7, b"")
        reply = bytes([packet[0] ^ 0xFF]) + data
        reply += bytes([sum(reply) & 0xFF])
        os.write(self.master, b"\x55\xff\x00" + b"".join(bytes([byte, byte ^ 0xFF]) for byte in reply))

    def program(self) -> bytes:
        """The code that has arrived, chunk after chunk."""
        blocks = [packet for packet in self.requests if packet[0] & 0xF7 == 0x45]
        return b"".join(packet[5 : 5 + packet[3] + 256 * packet[4]] for packet in blocks)

    def close(self) -> None:
        os.close(self.slave)
        os.close(self.master)


@pytest.fixture
def loader() -> Iterator[Loader]:
    brick = Loader()
    brick.start()
    yield brick
    brick.close()


def test_a_program_is_sent_into_a_slot(domain: Path, loader: Loader, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["gen-nqc", "robot.gl", "--download", "--port", loader.port, "--slot", "3"]) == 0
    assert "the brick has the program in slot 3" in capsys.readouterr().out
    image = read_image((domain.parent / "build" / "robot-rcx.rcx").read_bytes())
    assert loader.program() == b"".join(chunk.code for chunk in image.chunks)
    assert bytes([0x91, 2]) in [bytes([packet[0] & 0xF7, *packet[1:]]) for packet in loader.requests]


def test_a_port_that_is_not_there_ends_with_4(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["gen-nqc", "robot.gl", "--download", "--port", "/nowhere/tty", "-q"]) == 4
    err = capsys.readouterr().err
    assert "the port /nowhere/tty cannot be opened" in err
    assert "dialout" in err


def test_a_url_is_no_port_for_nqc(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["gen-nqc", "robot.gl", "--download", "--port", "socket://localhost:1", "-q"]) == 4
    assert "nqc cannot use the port" in capsys.readouterr().err


def test_a_brick_that_does_not_answer_ends_with_4(
    domain: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """nqc itself takes eight seconds to find out, so that here something else says that it has."""
    nqc = shutil.which("nqc")
    tools = domain.parent / "bin"
    tools.mkdir()
    (tools / "nqc").write_text(f'#!/bin/sh\ncase "$*" in *-d*) exit 253;; *) exec {nqc} "$@";; esac\n')
    (tools / "nqc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tools}:/bin:/usr/bin")
    assert invoke(["gen-nqc", "robot.gl", "--download", "--port", "/dev/null", "-q"]) == 4
    assert "no brick answers" in capsys.readouterr().err


def test_an_nqc_that_hangs_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A download may take minutes; here it may take no time."""
    (tmp_path / "nqc").write_text("#!/bin/sh\nexec sleep 600\n")
    (tmp_path / "nqc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin:/usr/bin")
    monkeypatch.setattr("golc.nqc.download.SECONDS", 0.0)
    with pytest.raises(DeviceError, match="nqc has not ended within 0 s"):
        download(tmp_path / "robot.rcx", Target.RCX2, "/dev/null", None, lambda text: None)


def test_a_pipe_in_the_place_of_a_generated_file_is_an_error(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pipe = domain.parent / "build" / "robot-rcx.nqc"
    pipe.parent.mkdir()
    os.mkfifo(pipe)
    assert invoke(["gen-nqc", "robot.gl", "-q"]) == 1
    assert "robot-rcx.nqc`: it is no file" in capsys.readouterr().err
    assert pipe.is_fifo()


def test_a_pipe_in_the_place_of_behaviours_is_an_error(domain: Path, capsys: pytest.CaptureFixture[str]) -> None:
    behaviours = domain.parent / "robot.nqc"
    behaviours.unlink()
    os.mkfifo(behaviours)
    assert invoke(["gen-nqc", "robot.gl", "-q"]) == 1
    assert "robot.nqc` cannot be read: it is no file" in capsys.readouterr().err
