"""``golc sim`` as a process: a real pty, real TCP, signals, bad input."""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import subprocess
import termios
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from golc.runtime.rcxsim.ports import _make_link

Sim = Callable[..., "subprocess.Popen[str]"]
POLL = bytes.fromhex("55 ff 00 f7 08 53 ac 4a b5")
NONE = bytes.fromhex("55 ff 00 f7 08 54 ab 4b b4")
GO = bytes.fromhex("55 ff 00 f7 08 21 de 18 e7")
ZERO = bytes.fromhex("55 ff 00 f7 08 40 bf 37 c8")


def ready(child: subprocess.Popen[str]) -> list[str]:
    """The words of the line that a simulator prints when it is ready."""
    assert child.stdout is not None
    return child.stdout.readline().split()


def ask(descriptor: int, data: bytes, count: int) -> bytes:
    """Write bytes and read so many back, within 20 seconds."""
    os.write(descriptor, data)
    received, deadline = b"", time.monotonic() + 20
    while len(received) < count and (left := deadline - time.monotonic()) > 0:
        if select.select([descriptor], [], [], left)[0]:
            received += os.read(descriptor, count - len(received))
    return received


def ended(child: subprocess.Popen[str]) -> tuple[int, str]:
    """Exit code and what was said on stderr."""
    _, complaints = child.communicate(timeout=20)
    return child.returncode, complaints


def test_pty_with_echo(sim: Sim, lift_file: Path) -> None:
    kind, path = ready(sim(lift_file, "--air-time", 0))
    assert kind == "pty"
    tower = os.open(path, os.O_RDWR | os.O_NOCTTY)
    try:
        assert ask(tower, POLL, 18) == POLL + NONE
        assert ask(tower, GO, 18) == GO + ZERO
    finally:
        os.close(tower)


def test_pty_is_raw(sim: Sim, lift_file: Path) -> None:
    _, path = ready(sim(lift_file))
    tower = os.open(path, os.O_RDWR | os.O_NOCTTY)
    try:
        iflag, oflag, _, lflag, *_ = termios.tcgetattr(tower)
        assert not lflag & (termios.ECHO | termios.ICANON | termios.ISIG)
        assert not iflag & (termios.ICRNL | termios.IXON)
        assert not oflag & termios.OPOST
    finally:
        os.close(tower)


def test_clients_come_and_go(sim: Sim, lift_file: Path) -> None:
    _, path = ready(sim(lift_file, "--air-time", 0, "--no-echo"))
    for _ in range(3):
        tower = os.open(path, os.O_RDWR | os.O_NOCTTY)
        try:
            assert ask(tower, POLL, 9) == NONE
        finally:
            os.close(tower)


def test_tcp_serves_one_client_after_the_other(sim: Sim, lift_file: Path) -> None:
    kind, address = ready(sim(lift_file, "--tcp", "127.0.0.1:0", "--air-time", 0, "--no-echo"))
    assert kind == "tcp"
    host, _, port = address.rpartition(":")
    for _ in range(2):
        with socket.create_connection((host, int(port)), 20) as first:
            assert ask(first.fileno(), POLL, 9) == NONE
            with socket.create_connection((host, int(port)), 20) as second:
                second.settimeout(20)
                assert second.recv(1) == b""
            assert ask(first.fileno(), POLL, 9) == NONE


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_ends_cleanly_on_a_signal_and_removes_its_link(
    sim: Sim, lift_file: Path, tmp_path: Path, number: signal.Signals
) -> None:
    link = tmp_path / "brick"
    child = sim(lift_file, "--pty", link)
    assert ready(child) == ["pty", str(link)]
    assert link.is_char_device()
    child.send_signal(number)
    assert ended(child) == (0, "")
    assert not link.is_symlink()


def test_link_left_behind_is_replaced(sim: Sim, lift_file: Path, tmp_path: Path) -> None:
    link = tmp_path / "brick"
    link.symlink_to("/dev/pts/no-such-terminal")
    ready(sim(lift_file, "--pty", link))
    assert link.is_char_device()


def test_trace_is_json_lines(sim: Sim, lift_file: Path, tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    child = sim(lift_file, "--air-time", 0, "--no-echo", "--trace", trace)
    tower = os.open(ready(child)[1], os.O_RDWR | os.O_NOCTTY)
    try:
        ask(tower, GO, 9)
    finally:
        os.close(tower)
    records = [json.loads(line) for line in trace.read_text().splitlines()]
    # A slow reader finds what has happened since then, too.
    assert [record["what"] for record in records[:4]] == ["heard", "began", "started", "sent"]
    assert records[1]["action"] == "go"
    assert records[3]["message"] == 64


def test_a_brick_that_is_switched_off_does_not_answer(sim: Sim, lift_file: Path) -> None:
    _, path = ready(sim(lift_file, "--air-time", 0, "--off", "0-100000", "--echo"))
    tower = os.open(path, os.O_RDWR | os.O_NOCTTY)
    try:
        assert ask(tower, POLL, 9) == POLL
        assert not select.select([tower], [], [], 0.3)[0]
    finally:
        os.close(tower)


@pytest.mark.parametrize("outages", [["5"], ["5-x"], ["5-4"], ["5-9", "7-12"], ["-1-3"], ["5-inf"], ["nan-5"]])
def test_outages_that_make_no_sense_are_refused(sim: Sim, lift_file: Path, outages: list[str]) -> None:
    code, complaint = ended(sim(lift_file, *[f"--off={outage}" for outage in outages]))
    assert code == 2
    assert "--off" in complaint


def test_trouble_is_told_on_stderr(sim: Sim, lift_file: Path) -> None:
    child = sim(lift_file, "--air-time", 0, "--no-echo")
    tower = os.open(ready(child)[1], os.O_RDWR | os.O_NOCTTY)
    try:
        assert ask(tower, bytes.fromhex("55 ff 00 f7 08 27 d8 1e e1"), 9) == ZERO
    finally:
        os.close(tower)
    child.send_signal(signal.SIGTERM)
    assert "number 7, which the brick has no action for" in ended(child)[1]


def test_speed_shortens_everything(sim: Sim, lift_file: Path, tmp_path: Path) -> None:
    events, trace = tmp_path / "lift.events", tmp_path / "trace.jsonl"
    events.write_text("at 600 s: bell\n")
    _, path = ready(sim(lift_file, "--speed", 1000, "--no-echo", "--events", events, "--trace", trace))
    tower = os.open(path, os.O_RDWR | os.O_NOCTTY)
    try:
        ask(tower, POLL, 9)
        deadline = time.monotonic() + 60
        while "happened" not in trace.read_text() and time.monotonic() < deadline:
            time.sleep(0.02)
    finally:
        os.close(tower)
    happened = json.loads(trace.read_text().splitlines()[-1])
    assert (happened["what"], happened["action"]) == ("happened", "bell")
    assert happened["t"] >= 600


@pytest.mark.parametrize(
    ("arguments", "code", "complaint"),
    [
        (["no-such-file.gl"], 1, "no-such-file.gl"),
        (["{lift}", "--pty", "/proc/brick"], 4, "cannot make the link /proc/brick"),
        (["{lift}", "--pty", "{lift}"], 4, "File exists"),
        (["{lift}", "--tcp", "127.0.0.1"], 2, "HOST:PORT"),
        (["{lift}", "--tcp", "127.0.0.1:70000"], 2, "HOST:PORT"),
        (["{lift}", "--tcp", "no-such-host.invalid:0"], 4, "cannot listen on no-such-host.invalid:0"),
        (["{lift}", "--tcp", "127.0.0.1:{port}"], 4, "Address already in use"),
        (["{lift}", "--tcp", "127.0.0.1:0", "--pty", "x"], 2, "exclude each other"),
        (["{lift}", "--loss", "1.5"], 2, "--loss"),
        (["{lift}", "--speed", "0"], 2, "--speed"),
        (["{lift}", "--events", "/no/such/script"], 1, "/no/such/script"),
        (["{lift}", "--trace", "/no/such/trace"], 1, "/no/such/trace"),
        (["{lift}", "--what"], 2, "--what"),
    ],
)
def test_bad_input(sim: Sim, lift_file: Path, arguments: list[str], code: int, complaint: str) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        result = ended(sim(*(text.format(lift=lift_file, port=port) for text in arguments)))
    assert result[0] == code
    assert complaint in result[1]
    assert "Traceback" not in result[1]


def test_file_with_errors(sim: Sim, tmp_path: Path) -> None:
    file = tmp_path / "wrong.gl"
    file.write_text("domain wrong\n\nfluent f: nothing = 1\n")
    code, complaint = ended(sim(file))
    assert code == 1
    assert "nothing" in complaint


def test_file_without_a_brick(sim: Sim, tmp_path: Path) -> None:
    file = tmp_path / "none.gl"
    file.write_text("domain idle\n\naction nod\n\ndevice self:\n    nod\n")
    code, complaint = ended(sim(file))
    assert code == 1
    assert "no brick to simulate" in complaint


def test_a_link_left_behind_to_the_terminal_that_is_given_out_again_is_replaced(tmp_path: Path) -> None:
    link = tmp_path / "brick"
    master, slave = os.openpty()
    name = os.ttyname(slave)
    link.symlink_to(name)

    _make_link(link, name)

    assert str(link.readlink()) == name
    os.close(master)
    os.close(slave)


def test_a_link_to_something_else_stays(tmp_path: Path) -> None:
    link, target = tmp_path / "brick", tmp_path / "target"
    target.touch()
    link.symlink_to(target)

    with pytest.raises(FileExistsError):
        _make_link(link, "/dev/pts/no-such-terminal")

    assert link.readlink() == target
