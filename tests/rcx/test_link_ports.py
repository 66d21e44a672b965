"""Real ports: ptys and sockets with another process at the far end, and everything that is no port at all."""

import os
import select
import socket
import stat
import threading
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import serial
from serial import rfc2217

from golc.runtime.devices.rcx import (
    Brick,
    InterruptedLinkError,
    LinkError,
    NonsenseError,
    NotATowerError,
    PanicError,
    PortBusyError,
    PortFailedError,
    PortForbiddenError,
    PortGoneError,
    PortMissingError,
    SilentBrickError,
    open_tower,
)
from golc.runtime.devices.rcx.chardev import CharacterDevice
from golc.runtime.devices.rcx.transport import Clock

SmallBrick = Callable[..., Any]
FAST = 30.0
"""Simulated seconds in a real one, where only silence is waited for."""


def poll_until_answered(brick: Brick) -> int:
    """Poll as a program does; a busy machine may miss the time of a poll."""
    for _ in range(200):
        if (number := brick.poll()) is not None:
            return number
    raise AssertionError("no event came")


@pytest.fixture
def pty_pair() -> Iterator[tuple[int, str]]:
    """Both ends of a raw pty: a descriptor, and a path for the link."""
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    yield ours, os.ttyname(theirs)
    for descriptor in (ours, theirs):
        os.close(descriptor)


@pytest.mark.parametrize("echo", [[], ["echo"]])
@pytest.mark.parametrize(("kind", "prefix"), [("pty", ""), ("pty", "usb:"), ("tcp", ""), ("pty", "spy://")])
def test_a_brick_behind_a_port(small_brick: SmallBrick, kind: str, prefix: str, echo: list[str]) -> None:
    answers = {"36": [[64]], "49": [[82]], "37": [[74]], "82": [[36], [65]], "83": [[53], [84]], "81": [[]]}
    far = small_brick(kind, answers, *echo)
    port = f"{prefix}{far.port}{'?file=/dev/null' if prefix == 'spy://' else ''}"
    with Brick(open_tower(port)) as brick:
        assert brick.perform(4) == 0
        assert poll_until_answered(brick) == 69
        assert brick.perform(5) == 10
        brick.abort()
        assert bool(brick.tower.statistics.echoes) == bool(echo)
    heard = far.heard()
    assert heard[0] == 36
    assert [number for number in heard if number != 83][:4] == [36, 82, 37, 82]
    assert 81 in heard


@pytest.mark.filterwarnings("ignore:set:DeprecationWarning")
def test_a_brick_behind_a_serial_port_of_another_machine() -> None:
    answers = {bytes.fromhex("55ff00f70824db1be4"): bytes.fromhex("55ff00f70840bf37c8")}
    server = socket.create_server(("127.0.0.1", 0))

    def serve() -> None:
        connection, _ = server.accept()
        line: Any = serial.serial_for_url("loop://", timeout=0.01)
        client: Any = connection.makefile("wb", buffering=0)
        manager = rfc2217.PortManager(line, client)
        while data := connection.recv(1000):
            said = b"".join(manager.filter(data))
            for frame, answer in answers.items():
                if frame in said:
                    connection.sendall(b"".join(manager.escape(answer)))
        connection.close()

    thread = threading.Thread(target=serve)
    thread.start()
    with server, Brick(open_tower(f"rfc2217://127.0.0.1:{server.getsockname()[1]}")) as brick:
        assert brick.perform(4) == 0
    thread.join()


@pytest.mark.parametrize(("kind", "prefix"), [("pty", ""), ("pty", "usb:"), ("tcp", "")])
def test_a_far_end_that_closes_in_the_middle_is_gone(small_brick: SmallBrick, kind: str, prefix: str) -> None:
    far = small_brick(kind, {"36": [[64], "close"], "83": [[84]]})
    with Brick(open_tower(prefix + far.port)) as brick:
        assert brick.perform(4) == 0
        with pytest.raises(PortGoneError, match="has gone away") as caught:
            brick.perform(4)
        assert caught.value.help == "was the tower unplugged, or the simulated brick ended?"
        with pytest.raises(PortGoneError):
            brick.poll()
        with pytest.raises(PortGoneError):
            brick.abort()


def test_a_silent_brick_behind_a_pty(small_brick: SmallBrick) -> None:
    far = small_brick("pty", {}, "echo")
    with Brick(open_tower(far.port, FAST)) as brick, pytest.raises(SilentBrickError):
        brick.perform(4)
    assert far.heard().count(36) >= 4


def test_a_panicking_brick_behind_a_pty(small_brick: SmallBrick) -> None:
    far = small_brick("pty", {"36": [[80]], "83": [[84]], "81": [[]]})
    with Brick(open_tower(far.port)) as brick, pytest.raises(PanicError):
        brick.perform(4)
    assert far.heard()[:2] == [36, 81]


def test_nonsense_behind_a_pty(small_brick: SmallBrick) -> None:
    far = small_brick("pty", {"36": [[100] * 9]})
    with Brick(open_tower(far.port)) as brick, pytest.raises(NonsenseError):
        brick.perform(4)


def test_more_time_behind_a_pty(small_brick: SmallBrick) -> None:
    far = small_brick("pty", {"36": [[85]], "82": [[85], [85], [65]]})
    with Brick(open_tower(far.port)) as brick:
        assert brick.perform(4) == 1
    assert far.heard() == [36, 82, 82, 82]


@pytest.mark.parametrize("prefix", ["", "usb:"])
def test_a_port_in_use_is_busy(pty_pair: tuple[int, str], prefix: str) -> None:
    _, path = pty_pair
    with open_tower(prefix + path), pytest.raises(PortBusyError, match=f"{path} is in use") as caught:
        open_tower(prefix + path)
    assert caught.value.help is not None
    assert path in caught.value.help
    open_tower(prefix + path).close()


@pytest.mark.parametrize("prefix", ["", "usb:", "spy://"])
def test_a_missing_port(tmp_path: Path, prefix: str) -> None:
    with pytest.raises(PortMissingError, match="does not exist") as caught:
        open_tower(f"{prefix}{tmp_path}/ttyUSB0")
    assert caught.value.exit_code == 4


@pytest.mark.parametrize("prefix", ["", "usb:"])
def test_files_and_directories_are_no_towers(tmp_path: Path, prefix: str) -> None:
    file = tmp_path / "file"
    file.write_text("precious")
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for path, what in ((file, "a regular file"), (tmp_path, "a directory"), (pipe, "no serial device")):
        with pytest.raises(NotATowerError, match=what):
            open_tower(f"{prefix}{path}")
    assert file.read_text() == "precious"


def test_a_device_that_is_no_tty_needs_the_usb_prefix() -> None:
    with pytest.raises(NotATowerError, match="/dev/null is not a serial port") as caught:
        open_tower("/dev/null")
    assert caught.value.help == "a USB tower is named with `usb:` in front, as in usb:/dev/usb/legousbtower0"


@pytest.mark.parametrize("prefix", ["", "usb:"])
def test_a_port_of_another_user_is_forbidden(pty_pair: tuple[int, str], prefix: str) -> None:
    _, path = pty_pair
    open_tower(path).close()  # loads what the link needs while its files can be read
    with ordinary_user(), no_permission(path), pytest.raises(PortForbiddenError, match="may not be opened") as caught:
        open_tower(prefix + path)
    assert caught.value.help is not None
    assert "dialout" in caught.value.help


@contextmanager
def no_permission(path: str) -> Iterator[None]:
    allowed = stat.S_IMODE(Path(path).stat().st_mode)
    if os.geteuid() == Path(path).stat().st_uid:
        os.chmod(path, 0)  # noqa: PTH101 - of a pty, by its path
    yield
    if os.geteuid() == Path(path).stat().st_uid:
        os.chmod(path, allowed)  # noqa: PTH101


@contextmanager
def ordinary_user() -> Iterator[None]:
    """Root may open everything, so for root the test is done as nobody."""
    if os.geteuid() != 0:
        yield
        return
    groups = os.getgroups()
    os.setgroups([])
    os.seteuid(65534)
    try:
        yield
    finally:
        os.seteuid(0)
        os.setgroups(groups)


@pytest.mark.parametrize(
    "port", ["", "usb:", "\0", "usb:\0", "/dev/" + "x" * 5000, "~", "nothing", "spy://", "usb:socket://localhost:1"]
)
def test_names_of_nothing(port: str) -> None:
    with pytest.raises(LinkError):
        open_tower(port)


@pytest.mark.parametrize(
    "port", ["foo://bar", "socket://", "socket://localhost", "socket://localhost:99999", "rfc2217://127.0.0.1:x", "://"]
)
def test_urls_that_make_no_sense(port: str) -> None:
    with pytest.raises(PortFailedError, match="cannot be opened") as caught:
        open_tower(port)
    assert caught.value.help == "URLs are those of pySerial, such as socket://localhost:7000"


def test_a_socket_that_nobody_listens_on() -> None:
    with pytest.raises(PortMissingError) as caught:
        open_tower("socket://127.0.0.1:1")
    assert str(caught.value) == "the port socket://127.0.0.1:1 cannot be reached: nobody listens there"
    assert caught.value.help == "start the simulated brick: `golc sim FILE --tcp HOST:NUMBER`"


def test_a_device_whose_far_end_has_closed_has_nothing_to_read() -> None:
    ours, theirs = os.openpty()
    device = CharacterDevice(os.ttyname(theirs), Clock())
    device.open()
    os.close(theirs)
    os.close(ours)
    with pytest.raises(PortGoneError, match="has gone away"):
        device.read(device.now() + 5.0)
    device.close()


def test_a_device_that_babbles(pty_pair: tuple[int, str]) -> None:
    far, path = pty_pair
    babbling, heard = threading.Event(), bytearray()
    babbling.set()

    def babble() -> None:
        while babbling.is_set():
            if select.select([], [far], [], 0.05)[1]:
                os.write(far, bytes(100))
            if select.select([far], [], [], 0.0)[0]:
                heard.extend(os.read(far, 1000))

    thread = threading.Thread(target=babble)
    thread.start()
    try:
        with Brick(open_tower(f"usb:{path}", FAST)) as brick, pytest.raises(SilentBrickError):
            brick.perform(4)
        assert heard.count(bytes.fromhex("f70824db1be4")) >= 4
    finally:
        babbling.clear()
        thread.join()


def test_a_port_that_cannot_be_waited_on_is_looked_at() -> None:
    with Brick(open_tower("loop://", FAST)) as brick:
        assert brick.poll() is None
        assert brick.tower.statistics.echoes == 2
        assert brick.tower.statistics.heard == 0


def test_a_closed_port_is_gone(pty_pair: tuple[int, str]) -> None:
    tower = open_tower(f"usb:{pty_pair[1]}")
    tower.close()
    tower.close()
    with pytest.raises(PortGoneError, match="is not open"):
        tower.send(36)


def test_a_wait_can_be_ended_from_another_thread(small_brick: SmallBrick) -> None:
    far = small_brick("pty", {"83": [[84]]})
    enough = threading.Event()
    with Brick(open_tower(far.port, interrupted=enough.is_set)) as brick:
        timer = threading.Timer(0.2, enough.set)
        timer.start()
        with pytest.raises(InterruptedLinkError):
            brick.perform(4)
        timer.join()
        enough.clear()
        brick.abort()
    assert far.heard()[:2] == [36, 81]
