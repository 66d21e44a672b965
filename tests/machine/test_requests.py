"""The firmware's answers to packets, byte by byte, over a line without air time."""

from __future__ import annotations

import random
import struct
from collections.abc import Callable
from typing import Any

import pytest

from golc.bytecode.image import ChunkType, read_image
from golc.runtime.rcxsim.frames import HEADER, packet
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.machine.options import Firmware, Options
from golc.runtime.rcxsim.machine.simulator import build
from golc.runtime.rcxsim.surroundings import Bench, Mode
from golc.runtime.rcxsim.trace import Trace

MakeImage = Callable[..., bytes]
BOTH = pytest.mark.parametrize("firmware", list(Firmware))


class Host:
    """A host with a brick that is empty, or has a program that has just been started."""

    def __init__(self, firmware: Firmware = Firmware.V1, image: bytes | None = None, **options: Any) -> None:
        self.records: list[dict[str, Any]] = []
        trace = Trace(lambda record: self.records.append(dict(record)))
        program = None if image is None else read_image(image)
        line = LineOptions(air_time=0.0, echo=False, sleep=None)
        self.line, self.brick = build(firmware, program, Bench(), Options(**options), line, trace)
        self.machine = self.brick.machine
        self.now = 0.0
        self._toggle = 0

    def send(self, payload: bytes | str, seconds: float = 0.05) -> list[bytes]:
        """Send a packet as it is; the packets that come in the time after it."""
        payload = bytes.fromhex(payload) if isinstance(payload, str) else payload
        received = self.line.host_sent(packet(payload), self.now)
        self.now += seconds
        received += self.line.advance(self.now)
        return packets_in(received)

    def ask(self, request: str) -> str | None:
        """The data that answer a request in hexadecimal; each request is a new one."""
        payload = bytearray.fromhex(request)
        self._toggle ^= 8
        payload[0] ^= self._toggle
        answers = self.send(bytes(payload))
        if not answers:
            return None
        [answer] = answers
        assert answer[0] == payload[0] ^ 0xFF
        return answer[1:].hex(" ")

    def value(self, source: int, argument: int = 0) -> int:
        """What a source gives."""
        data = self.ask(f"12 {source:02x} {argument:02x}")
        assert data is not None
        number: int = struct.unpack("<h", bytes.fromhex(data))[0]
        return number


def packets_in(data: bytes) -> list[bytes]:
    """The payloads of packets that follow each other; an answer's length is not in its op code."""
    found = []
    while data:
        assert data.startswith(HEADER)
        ends = [place for place in range(7, len(data)) if data.startswith(HEADER, place)]
        end = next(end for end in [*ends, len(data)] if whole(data[3:end]))
        found.append(data[3 : end - 2 : 2])
        data = data[end:]
    return found


def whole(pairs: bytes) -> bool:
    values, complements = pairs[::2], pairs[1::2]
    return (
        len(pairs) % 2 == 0
        and all(value ^ complement == 0xFF for value, complement in zip(values, complements, strict=True))
        and sum(values[:-1]) & 0xFF == values[-1]
    )


@BOTH
def test_alive_battery_versions(firmware: Firmware) -> None:
    host = Host(firmware)
    assert host.ask("10") == ""
    assert host.ask("30") == "fc 21"
    assert (
        host.ask("15 01 03 05 07 0b")
        == {
            Firmware.V1: "00 03 00 01 00 03 00 09",
            Firmware.V2: "00 03 00 01 00 03 03 02",
        }[firmware]
    )
    assert host.ask("15 01 03 05 07 0c") is None


GOLDEN = [
    ("44", 7, 0, 7),
    ("44", -7, 2, -3),
    ("44", 7, -2, -3),
    ("44", -7, -2, 3),
    ("44", -32768, -1, -32768),
    ("44", 1, 3, 0),
    ("54", 300, 300, 24464),
    ("54", -300, 300, -24464),
    ("54", -32768, -1, -32768),
    ("24", 32767, 1, -32768),
    ("24", -32768, -1, 32767),
    ("34", -32768, 1, 32767),
    ("84", -1, 0x0FF0, 0x0FF0),
    ("94", 0x0F00, 0x00F0, 0x0FF0),
    ("74", 5, -32768, 32767),
    ("64", 5, -5, -1),
    ("64", 5, 0, 0),
    ("64", 5, 300, 1),
]


@BOTH
@pytest.mark.parametrize(("op", "before", "operand", "after"), GOLDEN)
def test_arithmetic_by_request_as_measured(firmware: Firmware, op: str, before: int, operand: int, after: int) -> None:
    host = Host(firmware)
    assert host.ask("14 05 02 " + struct.pack("<h", before).hex(" ")) == ""
    assert host.ask(f"{op} 05 02 " + struct.pack("<h", operand).hex(" ")) == ""
    assert host.value(0, 5) == after


@BOTH
def test_messages_by_request_as_measured(firmware: Firmware) -> None:
    host = Host(firmware)
    for value in (33, 0, 255):
        assert host.send(bytes([0xF7, value])) == []
        assert host.value(15) == value


@BOTH
def test_outputs_by_request_as_measured(firmware: Firmware) -> None:
    host = Host(firmware)
    assert [host.value(3, motor) for motor in range(3)] == [79, 95, 111]
    states = []
    for request in ("13 01 02 05", "21 81", "e1 01", "e1 41", "21 01", "21 41", "13 01 02 09"):
        assert host.ask(request) == ""
        states.append(host.value(3, 0))
    assert states[1:] == [141, 133, 141, 13, 77, 79]


def test_a_request_that_comes_again_is_answered_again_and_not_done_again() -> None:
    host = Host()
    add = bytes.fromhex("24 03 02 05 00")
    first = host.send(add)
    assert first == host.send(add) != []
    assert host.value(0, 3) == 5
    host.send(bytes([add[0] ^ 8]) + add[1:])
    assert host.value(0, 3) == 10


def test_whether_only_the_op_code_tells_a_repetition_is_an_option() -> None:
    for option, expected in ((False, 9), (True, 5)):
        host = Host(repeats_by_op_code=option)
        host.send("24 03 02 05 00")
        host.send("24 03 02 04 00")
        assert host.value(0, 3) == expected


@pytest.mark.parametrize(
    "request_",
    [
        "27 01",  # an op code of programs
        "43 02 05 00",
        "f6",
        "12 02 05",  # a constant cannot be asked for
        "12 05 00",  # an unknown source
        "12 00 20",  # no variable of the brick
        "91 05",
        "32 03 01",
        "63 00 00 05",  # the memory itself
        "75 00 80 78 c2 00",  # a firmware
        "05 00 00 02 00 00",  # of firmware 2.0
        "07 00",
    ],
)
def test_what_is_not_answered(request_: str) -> None:
    host = Host()
    assert host.ask(request_) is None
    assert "problem" in [record for record in host.records if record["what"] == "request"][-1]
    assert host.ask("10") == ""


def test_a_reply_takes_a_while() -> None:
    """Seven bytes each way at 4.58 ms, and the delay."""
    line, _ = build(Firmware.V1, None, Bench(), Options(reply_delay=20_000), LineOptions(echo=False), Trace())
    line.host_sent(packet(b"\x10"), 0.0)
    received = [line.advance(time) for time in (0.0565, 0.0568, 0.0841, 0.0844)]
    assert [len(data) for data in received] == [0, 1, 5, 1]


LOOP = bytes([0x24, 0, 2, 1, 0, 0x27, 0x86])
"""Adds one to variable 0 for ever."""


@BOTH
def test_tasks_are_started_and_stopped(firmware: Firmware, image_of: MakeImage) -> None:
    host = Host(firmware, image_of([(0, 0, b""), (0, 3, LOOP)]))
    assert host.ask("71 03") == ""
    assert host.ask("71 07") == ""
    assert host.value(0) > 0
    assert host.ask("81 03") == ""
    stopped = host.value(0)
    host.send("10", 1.0)
    assert host.value(0) == stopped
    host.ask("71 03")
    host.ask("50")
    assert not host.machine.processor.running


@BOTH
def test_selecting_a_program_stops_the_one_that_runs(firmware: Firmware, image_of: MakeImage) -> None:
    host = Host(firmware, image_of([(0, 0, LOOP)]))
    host.send("10")
    assert host.machine.processor.running
    assert host.ask("91 03") == ""
    assert not host.machine.processor.running
    assert host.value(8) == 3


def blocks(data: bytes, size: int = 20) -> list[str]:
    """The requests that carry some data."""
    parts = [data[place : place + size] for place in range(0, len(data), size)]
    numbers = [*range(1, len(parts)), 0]
    return [
        (b"\x45" + struct.pack("<HH", number, len(part)) + part + bytes([sum(part) & 0xFF])).hex(" ")
        for number, part in zip(numbers, parts, strict=True)
    ]


@BOTH
def test_downloading_a_task(firmware: Firmware) -> None:
    host = Host(firmware)
    data = random.Random(1).randbytes(150)
    assert host.ask("25 00 03 00 96 00") == "00"
    assert [host.ask(block) for block in blocks(data)] == ["00"] * 8
    code = host.machine.memory.find(0, ChunkType.TASK, 3)
    assert code is not None
    assert code.bytes == data


def test_downloading_a_sub_into_the_program_that_is_selected() -> None:
    host = Host()
    host.ask("91 02")
    assert host.ask("35 00 07 00 02 00") == "00"
    assert host.ask(blocks(b"\x51\x01")[0]) == "00"
    assert [len(list(host.machine.memory.chunks(slot))) for slot in range(5)] == [0, 0, 1, 0, 0]


@pytest.mark.parametrize(
    ("begin", "answer"),
    [
        ("25 00 0a 00 05 00", "02"),
        ("35 00 08 00 05 00", "02"),
        ("25 00 00 00 71 17", "01"),
        ("25 00 00 00 70 17", "00"),
        ("25 00 00 00 ff ff", "01"),
    ],
)
def test_a_download_needs_a_number_and_room(begin: str, answer: str) -> None:
    assert Host().ask(begin) == answer


def test_what_is_replaced_makes_room(image_of: MakeImage) -> None:
    host = Host(Firmware.V1, image_of([(0, 0, bytes([0x10]) * 4000)]))
    assert host.ask("25 00 01 00 d1 07") == "01"
    assert host.ask("25 00 00 00 70 17") == "00"


def test_blocks_that_are_damaged_out_of_order_or_not_announced() -> None:
    host = Host()
    assert host.ask(blocks(b"\x10")[0]) == "06"
    host.ask("25 00 00 00 28 00")
    first, last = blocks(bytes(range(40)))
    assert host.ask(first[:-2] + "00") == "03"
    assert host.ask(first.replace("45 01", "45 02", 1)) is None
    assert host.ask(first) == "00"
    assert host.ask(last) == "00"
    assert host.ask(last) == "06"


def test_a_download_that_brings_more_or_less_than_announced_is_told() -> None:
    for length, expected in ((1, b"\x10"), (5, b"\x10\x10\x10\0\0")):
        host = Host()
        host.ask(f"25 00 00 00 {length:02x} 00")
        assert host.ask(blocks(b"\x10\x10\x10")[0]) == "00"
        code = host.machine.memory.find(0, ChunkType.TASK, 0)
        assert code is not None
        assert code.bytes == expected
        assert [record["problem"] for record in host.records if record["what"] == "downloaded"] == ["3 bytes came"]


def test_a_download_stops_what_runs(image_of: MakeImage) -> None:
    host = Host(Firmware.V1, image_of([(0, 0, LOOP)]))
    host.send("10")
    host.ask("25 00 05 00 02 00")
    assert not host.machine.processor.running


def test_deleting_tasks_and_subs(image_of: MakeImage) -> None:
    wait = bytes([0x43, 2, 100, 0])
    image = image_of([(0, 0, bytes([0x17, 1]) + wait * 9), (0, 1, LOOP), (1, 1, wait * 9), (1, 2, wait)])
    host = Host(Firmware.V1, image)
    host.ask("71 01")
    assert host.ask("c1 02") == ""
    assert [task.running for task in host.machine.processor.tasks[:2]] == [True, True]
    assert host.ask("c1 01") == ""
    assert [task.running for task in host.machine.processor.tasks[:2]] == [False, True]
    assert host.ask("61 00") == ""
    assert host.machine.processor.running
    assert host.ask("61 01") == ""
    assert not host.machine.processor.running
    assert list(host.machine.memory.chunks(0)) == []


def test_deleting_everything(image_of: MakeImage) -> None:
    host = Host(Firmware.V1, image_of([(0, 0, LOOP), (1, 1, LOOP)]))
    host.send("10")
    assert host.ask("40") == ""
    assert not host.machine.processor.running
    assert [str(code) for code in host.machine.memory.chunks(0)] == ["sub 1"]
    assert host.ask("70") == ""
    assert host.machine.memory.used == 0


def test_the_memory_map(image_of: MakeImage) -> None:
    host = Host(Firmware.V1, image_of([(0, 0, LOOP), (0, 2, LOOP), (1, 1, bytes([0x10]) * 5)]))
    host.ask("52 09 00")
    data = host.ask("20")
    assert data is not None
    words = struct.unpack(">94H", bytes.fromhex(data))
    start = words[0]
    assert words[1:3] == (start, start + 5)
    assert words[40:44] == (start + 5, start + 12, start + 12, start + 19)
    assert words[90:] == (start + 19, start + 22, start + 49, start + 5999)


@BOTH
def test_the_datalog(firmware: Firmware) -> None:
    host = Host(firmware)
    assert host.ask("a4 00 00 01 00") == "ff 01 00"
    assert host.ask("52 03 00") == "00"
    host.ask("14 07 02 9c ff")
    assert [host.ask("62 00 07") for _ in range(4)] == ["00", "00", "00", "01"]
    assert host.ask("a4 00 00 04 00") == "ff 04 00 07 9c ff 07 9c ff 07 9c ff"
    assert host.ask("a4 03 00 02 00") == ""
    assert host.ask("52 ff ff") == "01"


def test_everything_that_a_program_does_can_be_asked_for() -> None:
    host = Host(Firmware.V2)
    requests = ["32 02 03", "42 02 e0", "d1 02", "a1 01", "22 05 06", "b1 00", "31 01", "51 02", "23 b8 01 05"]
    requests += [
        "33 02 04 00",
        "97 01",
        "67 41",
        "77 41",
        "a3 01 02 03",
        "93 01 00 00",
        "03 02 01 00",
        "06",
        "d0",
        "e0",
    ]
    assert [host.ask(request) for request in requests] == [""] * len(requests)
    assert host.value(14) == 306
    assert host.value(10, 2) == 3
    assert host.value(21, 1) == 1


def test_a_brick_that_is_off_does_not_answer(image_of: MakeImage) -> None:
    host = Host(Firmware.V1, image_of([(0, 0, LOOP)]))
    assert host.ask("60") == ""
    assert host.ask("10") is None


def test_a_program_sends_while_a_host_asks(image_of: MakeImage) -> None:
    send = bytes([0xB2, 2, 7, 0x43, 2, 5, 0, 0x27, 0x88])
    host = Host(Firmware.V1, image_of([(0, 0, send)]))
    assert b"\xf7\x07" in host.send("10", 1.0)


def test_the_remote_control() -> None:
    host = Host()
    host.send(bytes.fromhex("d2 00 48"))  # A forward, C... backward are other bits
    outputs = host.machine.outputs
    assert [output.mode for output in outputs.now] == [Mode.ON, Mode.OFF, Mode.OFF]
    host.send("d2 01 00")
    assert [output.mode for output in outputs.now] == [Mode.OFF, Mode.OFF, Mode.ON]
    assert not outputs.now[2].forward
    host.send("d2 00 00")
    assert [output.mode for output in outputs.now] == [Mode.OFF] * 3
    host.send("d2 00 02")
    assert host.value(15) == 2
    host.send("d2 08 00")
    assert host.value(8) == 2


def test_switched_off_and_on_the_program_runs_again(image_of: MakeImage) -> None:
    trace = Trace()
    image = read_image(image_of([(0, 0, LOOP)]))
    line, brick = build(Firmware.V1, image, Bench(), Options(), LineOptions(outages=((1.0, 2.0),)), trace)
    running = []
    for time in (0.5, 1.5, 2.5):
        line.advance(time)
        running.append((brick.machine.on, brick.machine.processor.running))
    assert running == [(True, True), (False, False), (True, True)]


@pytest.mark.parametrize("firmware", list(Firmware))
def test_random_packets_do_no_harm(firmware: Firmware) -> None:
    host = Host(firmware)
    for seed in range(600):
        chance = random.Random(seed)
        op = chance.randrange(256)
        payload = bytes([op]) + bytes(chance.choice([0, 1, 2, 3, chance.randrange(256)]) for _ in range(op & 7))
        if op & ~8 not in (0x60, 0x45):
            host.send(payload, 0.01)
    host.now += 1.0  # what is left of a packet that was too short is forgotten
    assert host.ask("10") == ""
