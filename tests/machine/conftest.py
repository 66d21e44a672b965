"""The real nqc, images made by hand, and random NQC programs."""

from __future__ import annotations

import random
import struct
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from golc.bytecode.image import Image, read_image
from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.machine import Machine
from golc.runtime.rcxsim.machine.options import FIRMWARES, Options
from golc.runtime.rcxsim.surroundings import Bench
from golc.runtime.rcxsim.trace import Trace

Compile = Callable[[str, Target], bytes]
"""Compiles the text of a program to the bytes of its image."""
Chunks = Sequence[tuple[int, int, bytes]]
"""Type, number and code of each task or sub."""


@pytest.fixture
def nqc(tmp_path: Path) -> Compile:
    """The real compiler; a program that it refuses fails the test."""

    def compile_(text: str, target: Target) -> bytes:
        (tmp_path / "p.nqc").write_text(text)
        command = ["nqc", f"-T{target.nqc}", "-Op.rcx", "p.nqc"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
        assert done.returncode == 0, f"{done.stderr.decode()}\n{text}"
        return (tmp_path / "p.rcx").read_bytes()

    return compile_


@pytest.fixture
def nqc_listing(tmp_path: Path) -> Callable[[bytes], str]:
    """What nqc itself lists for an image."""

    def list_(image: bytes) -> str:
        (tmp_path / "l.rcx").write_bytes(image)
        done = subprocess.run(["nqc", "-L", "l.rcx"], cwd=tmp_path, capture_output=True, check=True)
        return done.stdout.decode("latin-1")

    return list_


def image_of(chunks: Chunks, target: int = 3, symbols: Sequence[tuple[int, int, str]] = ()) -> bytes:
    """The bytes of an image with some chunks and symbols."""
    data = struct.pack("<4sHHHBB", b"RCXI", 0x0102, len(chunks), len(symbols), target, 0)
    for type_, number, code in chunks:
        data += struct.pack("<BBH", type_, number, len(code)) + code + bytes(-len(code) % 4)
    for type_, number, name in symbols:
        data += struct.pack("<BBBB", type_, number, len(name) + 1, 0) + name.encode() + b"\0"
    return data


@pytest.fixture(name="image_of")
def image_of_fixture() -> Callable[..., bytes]:
    """Images made by hand."""
    return image_of


@dataclass
class Ears:
    """Hears what the brick sends: each packet with its time in seconds, and how long it is in the air."""

    packets: list[tuple[float, bytes]] = field(default_factory=list)

    def send(self, payload: bytes, now: int) -> int:
        self.packets.append((now / 1e6, payload))
        return now + 41_250

    @property
    def messages(self) -> list[int]:
        return [payload[1] for _, payload in self.packets if payload[0] == 0xF7]


@dataclass
class Robot:
    """A machine with a program on a table, and everything that it does."""

    machine: Machine
    bench: Bench
    ears: Ears
    records: list[dict[str, Any]]
    image: Image

    def run(self, seconds: float) -> Robot:
        """Let time pass."""
        self.machine.run(self.machine.now + round(seconds * 1e6))
        return self

    def finish(self, within: float = 60.0) -> Robot:
        """Let time pass until no task is running any more."""
        end = self.machine.now + within * 1e6
        while self.machine.processor.running:
            assert self.machine.now < end, "the program does not end"
            self.run(0.1)
        return self

    def variable(self, name: str) -> int:
        """The value of a variable of the program."""
        [number] = {symbol.number for symbol in self.image.symbols if (symbol.type, symbol.name) == (2, name)}
        return self.machine.variables[number]

    def told(self, what: str) -> list[dict[str, Any]]:
        """The records of one kind in the trace."""
        return [record for record in self.records if record["what"] == what]


@pytest.fixture
def robot(nqc: Compile) -> Callable[..., Robot]:
    """Compiles a program, or takes an image, and starts it on a machine with some options; no time has passed."""

    def make(program: str | bytes, target: Target = Target.RCX, start: bool = True, **options: Any) -> Robot:
        data = nqc(program, target) if isinstance(program, str) else program
        image = read_image(data)
        records: list[dict[str, Any]] = []
        bench, ears = Bench(), Ears()
        trace = Trace(lambda record: records.append(dict(record)))
        machine = Machine(FIRMWARES[image.target], bench, ears, trace, Options(**options))
        machine.load(image)
        if start:
            machine.start(0)
        return Robot(machine, bench, ears, records, image)

    return make


class Writer:
    """Writes random NQC programs of one target that nqc accepts.

    With ``tasks`` they have tasks, subs, messages and clocks, and need not end. Without, they are one task of loops
    that end, in which nothing depends on time: what they do is the same on every brick.
    """

    SENSORS = ("SENSOR_1", "SENSOR_2", "SENSOR_3")
    OUTPUTS = ("OUT_A", "OUT_B", "OUT_C", "OUT_A + OUT_C", "OUT_A + OUT_B + OUT_C")
    CLOCKS = ("Timer(0)", "Timer(3)", "Message()", "Watch()")
    SENSES = ("SensorValueRaw(S1)", "SensorValueBool(S2)", "SensorType(S3)", "OutputStatus(1)")
    OF_RCX2 = ("FastTimer(1)", "Counter(2)", "EventState(3)", "ActiveEvents(1)", "FirmwareVersion()", "UpperLimit(9)")

    def __init__(self, seed: int, target: Target, tasks: bool = True) -> None:
        self.random = random.Random(seed)
        self.rcx2 = target is Target.RCX2
        self.tasks = tasks
        self.guarding = False

    def pick(self, *choices: str) -> str:
        return self.random.choice(choices)

    def program(self) -> str:
        variables = "int a, b, c, d;\nint i0, i1, i2;\n" + ("int field[3];\n" if self.rcx2 and self.tasks else "")
        functions = f"void put(int x, int &y) {{ y = x {self.pick('+', '*', '&')} {self.number()}; a += x; }}\n"
        if not self.tasks:
            return variables + functions + f"task main()\n{{\n{self.block(2, 8)}}}\n"
        names = ("other", "third")
        subs = f"sub help()\n{{\n{self.block(0, 3)}}}\n"
        tasks = "".join(f"task {name}()\n{{\n{self.block(1, 4)}}}\n" for name in names)
        begin = "start other;\nstart third;\nhelp();\n"
        return variables + functions + subs + tasks + f"task main()\n{{\n{begin}{self.block(2, 6)}}}\n"

    def number(self) -> str:
        return str(
            self.random.choice((0, 1, 2, 3, 7, 100, 255, 1000, -1, -7, 32767, self.random.randint(-32768, 32767)))
        )

    def variable(self) -> str:
        return self.pick("a", "b", "c", "d")

    def atom(self) -> str:
        choices = [self.variable, self.variable, self.number]
        if self.tasks:
            sources = self.SENSORS + self.CLOCKS + self.SENSES + (self.OF_RCX2 if self.rcx2 else ())
            choices += [lambda: self.pick(*sources), lambda: f"Random({self.random.randint(1, 99)})"]
            choices += [lambda: f"field[{self.pick('0', '1', '2')}]"] if self.rcx2 else []
        return self.random.choice(choices)()

    def term(self, depth: int) -> str:
        if depth == 0:
            return self.atom()
        kind = self.random.randrange(8)
        left, right = self.term(depth - 1), self.term(depth - 1)
        if left.lstrip("(-").isdecimal() and kind > 2:
            left = self.variable()  # what nqc computes itself may leave the range, which it refuses
        match kind:
            case 0:
                return f"abs({left})"
            case 1:
                return f"sign({left})"
            case 2:
                return f"-{left}" if left[0] != "-" else f"({left})"
            case 3:
                return f"({left} {self.pick('/', '%')} {self.pick('a', 'b', '3', '-2', '17')})"
            case _:
                return f"({left} {self.pick('+', '-', '*', '&', '|')} {right})"

    def condition(self, depth: int = 1) -> str:
        if depth and self.random.random() < 0.25:
            return f"({self.condition(0)} {self.pick('&&', '||')} {self.condition(0)})"
        return f"{self.atom()} {self.pick('==', '!=', '<', '<=', '>', '>=')} {self.atom()}"

    def block(self, depth: int, count: int) -> str:
        return "".join(self.statement(depth) for _ in range(self.random.randint(1, count)))

    def statement(self, depth: int) -> str:
        kind = self.random.randrange(10)
        if kind < 3:
            sign = self.pick("=", "=", "+=", "-=", "*=", "/=", "&=", "|=", "||=", "+-=")
            return f"{self.variable()} {sign} {self.term(self.random.randint(0, 2))};\n"
        if kind < 6 or depth == 0:
            return self.command()
        return self.compound(depth - 1)

    def command(self) -> str:
        outputs, variable = self.pick(*self.OUTPUTS), self.variable()
        commands = [
            f"On({outputs});",
            f"Off({outputs});",
            f"Float({outputs});",
            f"Fwd({outputs});",
            f"Rev({outputs});",
            f"Toggle({outputs});",
            f"SetPower({outputs}, {self.pick('0', '5', '7', variable)});",
            f"PlayTone({self.random.randint(100, 2000)}, {self.random.randint(1, 50)});",
            f"PlaySound({self.random.randrange(6)});",
            f"SendMessage({self.pick(variable, '17', '255')});",
            f"put({variable}, {self.variable()});",
            f"{variable}++;",
            f"Wait({self.pick('1', '10', '50') if self.tasks else '2'});",
        ]
        if self.tasks:
            commands += [
                f"Wait({self.pick(variable, 'Random(20)')});",
                "ClearMessage();",
                f"ClearTimer({self.random.randrange(4)});",
                f"SetSensor(SENSOR_{self.random.randint(1, 3)}, SENSOR_{self.pick('TOUCH', 'LIGHT', 'ROTATION')});",
                f"ClearSensor(SENSOR_{self.random.randint(1, 3)});",
                f"SelectDisplay({self.random.randrange(7)});",
                f"CreateDatalog({self.random.randrange(50)});",
                f"AddToDatalog({self.pick(variable, 'SENSOR_1', 'Timer(2)')});",
                f"SetWatch({self.random.randrange(24)}, {self.random.randrange(60)});",
                self.pick("start other;", "stop third;", "stop other;"),
            ]
        if self.tasks and self.rcx2:
            commands += [
                f"field[{self.random.randrange(3)}] = {variable};",
                f"SetUserDisplay({self.pick('a', 'b')}, 1);",
                f"SetGlobalOutput({outputs}, OUT_OFF);",
                f"SetMaxPower({outputs}, 3);",
                "IncCounter(1);",
                "SetPriority(4);",
                f"PlayTone({variable}, 5);",
                f"SetEvent({self.random.randrange(16)}, SENSOR_2, EVENT_TYPE_PRESSED);",
                f"SetLowerLimit(3, {variable});",
                "Event(5);",
                f"SetTimer(2, {variable});",
            ]
        return self.random.choice(commands) + "\n"

    def compound(self, depth: int) -> str:
        body = self.block(depth, 3)
        match self.random.randrange(7 if self.tasks else 6):
            case 0:
                return f"if ({self.condition()}) {{\n{body}}}\n"
            case 1:
                return f"if ({self.condition()}) {{\n{body}}} else {{\n{self.block(depth, 3)}}}\n"
            case 2:
                return f"repeat ({self.random.randint(1, 4)}) {{\n{body}}}\n"
            case 3:
                # The nesting gives each loop a variable that nothing else changes.
                count = f"i{depth}"
                return f"for ({count} = 0; {count} < {self.random.randint(1, 4)}; {count}++) {{\n{body}}}\n"
            case 4:
                numbers = self.random.sample(range(-3, 9), 3)
                cases = "".join(f"case {n}:\n{self.block(0, 2)}{self.pick('break;', '')}\n" for n in numbers)
                return f"switch ({self.variable()}) {{\n{cases}default:\n{self.block(0, 2)}}}\n"
            case 5:
                count = f"i{depth}"
                return f"{count} = 3;\nwhile ({count} > 0) {{\n{body}{count}--;\n}}\n"
            case _ if self.rcx2 and not self.guarding and self.random.random() < 0.5:
                return self.guarded(depth)
            case _:
                return self.pick("while", "until") + f" ({self.condition()}) {{\n{body}Wait(1);\n}}\n"

    def guarded(self, depth: int) -> str:
        self.guarding = True  # nqc refuses one in another
        body, handler = self.block(depth, 2), self.block(0, 2)
        self.guarding = False
        if self.random.random() < 0.5:
            return f"monitor (EVENT_MASK({self.random.randrange(16)})) {{\n{body}}} catch {{\n{handler}}}\n"
        return f"acquire ({self.pick('ACQUIRE_OUT_A', 'ACQUIRE_USER_1')}) {{\n{body}}} catch {{\n{handler}}}\n"


@pytest.fixture
def random_program() -> Callable[..., str]:
    """A random NQC program for a seed and a target."""
    return lambda seed, target, tasks=True: Writer(seed, target, tasks).program()
