"""The machine: a processor, memory, and everything that tasks share, on one clock."""

from __future__ import annotations

import random
from collections.abc import Sequence

from golc.bytecode.image import ChunkType, Image
from golc.bytecode.listing import describe
from golc.bytecode.opcodes import Operand, decode
from golc.runtime.rcxsim.machine import events
from golc.runtime.rcxsim.machine.clocks import MINUTE, TENTH, Timer, Watch
from golc.runtime.rcxsim.machine.datalog import Datalog
from golc.runtime.rcxsim.machine.display import USER, Display
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.execute import build
from golc.runtime.rcxsim.machine.inputs import Input
from golc.runtime.rcxsim.machine.loading import load, no_instruction
from golc.runtime.rcxsim.machine.memory import SLOTS, Code, Memory, Step
from golc.runtime.rcxsim.machine.messages import Messages, Radio
from golc.runtime.rcxsim.machine.options import Firmware, Options
from golc.runtime.rcxsim.machine.outputs import NAMES, Outputs
from golc.runtime.rcxsim.machine.processor import Processor
from golc.runtime.rcxsim.machine.sounds import Sounds
from golc.runtime.rcxsim.machine.tasks import Handler, Task
from golc.runtime.rcxsim.machine.values import VARIABLES
from golc.runtime.rcxsim.surroundings import INPUTS, Button, Output, Surroundings, Tone
from golc.runtime.rcxsim.trace import Trace

TARGETS = (Operand.NEAR, Operand.FAR, Operand.AHEAD, Operand.FAR_AHEAD, Operand.OFFSET)
"""Operands that are a place in the code."""
UPLOADED = 0x5B
"""The op code of an answer that carries entries of the datalog."""
TIMERS = 4
UART_BYTES = 16
PACKET, COMMUNICATION = 16, 17
"""Places in the serial buffer that say how its bytes are sent; this way they are a packet of the brick's own kind."""
OWN_PACKET, OWN_COMMUNICATION = 3, 0


class Machine:
    """A brick with its firmware, its programs and its clock, ``now``, in microseconds.

    ``looks`` counts those at the surroundings.
    """

    def __init__(
        self, firmware: Firmware, surroundings: Surroundings, radio: Radio, trace: Trace, options: Options | None = None
    ) -> None:
        self.firmware = firmware
        self.options = options = options or Options()
        self.now = 0
        self.looks = 0
        self.on = True
        self.slot = 0
        self.variables = [0] * VARIABLES
        self.random = random.Random(options.seed)
        self.timers = [Timer(options.timers_tick_together) for _ in range(TIMERS)]
        self.watch = Watch()
        self.datalog = Datalog()
        self.uart = [0] * (UART_BYTES + 2)
        self.host = Task(-1)
        self.inputs = [Input(options.light) for _ in range(INPUTS)]
        self.outputs = Outputs(self._drive)
        self.sounds = Sounds(options.sounds, self._play, self._lose)
        self.messages = Messages(radio, options.while_sending, self._lose)
        views = USER if firmware is Firmware.V1 else USER + 1
        self.display = Display(lambda: self.watch.read(self.now), self.inputs, self.outputs, views)
        self.memory = Memory(options.memory, lambda: self.datalog.taken)
        self.processor = Processor(self._prepare, self._tell_task)
        self.events = events.Events(self._read_for_event, self.happen, options.fast_change)
        self._op_time = options.op_time or firmware.op_time
        self._surroundings = surroundings
        self._trace = trace
        self._seen: list[int | None] = [None] * INPUTS
        self._look_at = 0
        self._busy_at = 0
        self._minutes = options.power_down

    def load(self, image: Image, slot: int = 0) -> None:
        """Put a program into a slot; raises DeviceError if it is none that fits."""
        self.stop_all()
        load(self.memory, image, slot)

    def run(self, until: int) -> None:
        """Let time pass; raises MachineError, after stopping the program, when an op code cannot be executed.

        The last op code may take longer: then the clock stands a little after ``until``.
        """
        processor = self.processor
        while self.now < until:
            if self.now >= self._look_at:
                self._look(self._look_at)
                self._look_at += self.options.look
            task = processor.ready(self.now)
            if task is None:
                self.now = min(until, self._look_at, processor.wake())
                continue
            try:
                self.now += processor.step(task)
            except MachineError as fault:
                self._trace.tell(self.seconds, "fault", task=fault.task, address=fault.address, problem=fault.reason)
                self.stop_all()
                raise

    def due(self) -> int:
        """Until when to let time pass so that something happens."""
        return max(self.now, min(self._look_at, self.processor.wake())) + 1

    @property
    def steps(self) -> int:
        """How many op codes its tasks have executed."""
        return self.processor.steps

    @property
    def seconds(self) -> float:
        """The clock, for a trace."""
        return self.now / 1e6

    def start(self, number: int) -> None:
        """Start a task from the top; one that is not there is not started."""
        if self.options.start_clears_variables and not self.processor.running:
            self.variables[:] = [0] * VARIABLES
        code = self.memory.find(self.slot, ChunkType.TASK, number)
        if code is not None:
            self.processor.start(code, self.now)

    def stop(self, number: int) -> None:
        """Stop a task, if there is one."""
        if number < len(self.processor.tasks):
            self.processor.stop(self.processor.tasks[number])

    def stop_all(self) -> None:
        """Stop every task; the motors go on."""
        self.processor.stop_all()

    def call(self, task: Task, number: int) -> None:
        """Call a sub; one that is not there is not called."""
        code = self.memory.find(self.slot, ChunkType.SUB, number)
        if code is not None:
            self.processor.call(task, code)

    def happen(self, mask: int) -> None:
        """Events happen, a bit for each."""
        self.processor.happen(mask, self.now)

    def acquire(self, task: Task, handler: Handler) -> None:
        """A task asks for resources."""
        self.processor.acquire(task, handler, self.now)

    def select(self, slot: int, by_program: bool = False) -> None:
        """Stop the program and take another slot."""
        if slot >= SLOTS:
            raise MachineError(f"there is no program {slot}")
        self.stop_all()
        self.slot = slot
        self._trace.tell(self.seconds, "program", slot=slot)
        if by_program and self.options.select_starts:
            self.start(0)

    def heard(self) -> None:
        """A packet has come: the brick has something to do."""
        self._busy_at = self.now

    def hear(self, message: int) -> None:
        """A message has come: it takes the place of the one before."""
        self.heard()
        self.set_message(message)

    def set_message(self, message: int) -> None:
        """Change the message buffer; putting the same message into it again is an event, too, clearing it is none."""
        self.messages.buffer = message
        if message:
            self.events.heard()

    def send_serial(self, first: int, count: int) -> None:
        """Send bytes of the serial buffer; only a packet of the brick's own kind is understood by the tower."""
        data = bytes(self.uart[first : first + count])
        if self.uart[PACKET] == OWN_PACKET and self.uart[COMMUNICATION] == OWN_COMMUNICATION:
            self.messages.transmit(data, self.now)
        self._trace.tell(self.seconds, "serial", bytes=data.hex(" "))

    def upload(self, first: int, count: int) -> None:
        """Send entries of the datalog, as an answer to the host that has not asked."""
        self.messages.transmit(bytes((UPLOADED,)) + self.datalog.upload(first, count), self.now)

    def resize_log(self, size: int) -> bool:
        """Begin a new datalog, if there is room for it."""
        self.datalog.resize(0)
        self.datalog.resize(size)
        if self.memory.used <= self.memory.room:
            return True
        self.datalog.resize(0)
        return False

    def set_power_down(self, minutes: int) -> None:
        """After so many minutes without anything to do the brick switches itself off; 0: never."""
        self._minutes = minutes

    def power_off(self) -> None:
        """Switch off, unless the brick is to stay on for ever."""
        if self._minutes:
            self.switch(False)

    def switch(self, on: bool) -> None:
        """Switch off, or on; programs and variables are kept, outputs and sensors are as new."""
        if on == self.on:
            return
        self.on = on
        self._busy_at = self.now
        self._trace.tell(self.seconds, "switched", on=on)
        self.stop_all()
        self.outputs.reset()
        self.messages.forget()
        self.sounds.clear()
        for sensor in self.inputs:
            sensor.set_type(0)

    def press(self, button: Button) -> None:
        """Somebody presses a button of the brick."""
        self._busy_at = self.now
        if button is Button.POWER:
            self.switch(not self.on)
        elif self.on:
            self._trace.tell(self.seconds, "button", button=button.value)
            self._press(button)

    def _press(self, button: Button) -> None:
        match button:
            case Button.RUN if self.processor.running:
                self.stop_all()
                if self.options.run_stops_motors:
                    self.outputs.off()
            case Button.RUN:
                self.start(0)
            case Button.PROGRAM:
                self.select((self.slot + 1) % SLOTS)
            case Button.VIEW:
                self.display.next()

    def _look(self, at: int) -> None:
        self.looks += 1
        raws = self._surroundings.sense([sensor.powered for sensor in self.inputs], at)
        for sensor, raw in zip(self.inputs, raws, strict=True):
            sensor.look(raw)
        if self._trace.read:
            self._tell_sensors(at)
        for button in self._surroundings.pressed(at):
            self.press(button)
        self.events.look(self.now)
        self.messages.catch_up(self.now)
        if self.processor.running or not self.on:
            self._busy_at = self.now
        elif self._minutes and self.now - self._busy_at >= self._minutes * MINUTE:
            self.switch(False)

    def _tell_sensors(self, at: int) -> None:
        for number, sensor in enumerate(self.inputs):
            value = sensor.value
            if value != self._seen[number]:
                self._seen[number] = value
                self._trace.tell(at / 1e6, "sensor", input=number + 1, value=value, raw=sensor.raw)

    def _read_for_event(self, source: int) -> events.Reading:
        if source in events.SENSORS:
            sensor = self.inputs[source]
            return events.Reading(sensor.value, sensor.boolean, sensor.raw)
        if source in events.TIMERS:
            return events.Reading(self.timers[source - events.TIMERS.start].read(self.now, TENTH))
        if source == events.MESSAGE:
            return events.Reading(self.messages.buffer)
        return events.Reading(self.variables[source - events.COUNTERS.start])

    def _prepare(self, code: Code, place: int) -> Step:
        """Make the instruction at a place of some code ready."""
        instruction = decode(code.bytes, place)
        if instruction is None:
            raise MachineError(no_instruction(code.bytes, place))
        try:
            for operand, decoded in zip(instruction.op.operands, instruction.operands, strict=True):
                if operand in TARGETS and isinstance(decoded, int) and not 0 <= decoded <= len(code.bytes):
                    raise MachineError(f"it leads to {decoded}, outside the code")
            run = build(self, instruction)
        except MachineError as fault:
            raise MachineError(f"`{' '.join(describe(instruction, code.bytes).split())}`: {fault.reason}") from None
        return run, instruction.end, round(self._op_time * instruction.op.time)

    def _tell_task(self, task: Task, code: Code, how: str) -> None:
        self._trace.tell(self.seconds, "task", task=task.number, name=code.name, how=how)

    def _drive(self, before: Sequence[Output], outputs: Sequence[Output]) -> None:
        self._surroundings.drive(outputs, self.now)
        for name, old, output in zip(NAMES, before, outputs, strict=True):
            if output == old:
                continue
            direction = "forward" if output.forward else "reverse"
            self._trace.tell(
                self.seconds, "motor", motor=name, mode=output.mode.value, direction=direction, power=output.power
            )

    def _play(self, tones: Sequence[Tone]) -> None:
        self._surroundings.hear(tones, self.now)
        self._trace.tell(self.seconds, "sound", tones=[[tone.frequency, tone.duration] for tone in tones])

    def _lose(self, what: str) -> None:
        self._trace.tell(self.seconds, "dropped", why=what)
