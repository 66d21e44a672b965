"""The processor: which task's turn it is, and how tasks start, end, call subs and go on at handlers.

After every op code it is the next task's turn, in the order of their numbers; a task that waits is passed over.
"""

from __future__ import annotations

from collections.abc import Callable

from golc.bytecode.image import ChunkType
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.memory import MOST, Code, Step
from golc.runtime.rcxsim.machine.tasks import Handler, Task

Tell = Callable[[Task, Code, str], None]
"""Is told of a task, its code, and whether it has ``started``, ``ended``, was ``stopped``."""


class Processor:
    """``prepare`` makes the instruction at a place of some code ready to be executed; ``steps`` counts the op codes."""

    def __init__(self, prepare: Callable[[Code, int], Step], tell: Tell) -> None:
        self._prepare = prepare
        self._tell = tell
        self.tasks = [Task(number) for number in range(MOST[ChunkType.TASK])]
        self._turns = [self.tasks[number + 1 :] + self.tasks[: number + 1] for number in range(len(self.tasks))]
        self._last = len(self.tasks) - 1
        self.steps = 0

    @property
    def running(self) -> bool:
        """Whether any task is running, if only in a wait."""
        return any(task.running for task in self.tasks)

    def ready(self, now: int) -> Task | None:
        """The task whose turn it is."""
        for task in self._turns[self._last]:
            if task.wake <= now:
                self._last = task.number
                return task
        return None

    def wake(self) -> int:
        """When the next task has waited long enough."""
        return min([task.wake for task in self.tasks])

    def step(self, task: Task) -> int:
        """Execute one op code of a task; the microseconds that it takes, none at the end of its code.

        Raises MachineError, with the place, if it cannot be executed.
        """
        code, place = task.code, task.place
        assert code is not None
        try:
            step = code.steps.get(place)
            if step is None:
                if place == len(code.bytes):
                    self._end(task, code)
                    return 0
                step = code.steps[place] = self._prepare(code, place)
            run, task.place, time = step
            self.steps += 1
            run(task)
        except MachineError as fault:
            raise fault.at(str(code), place) from None
        return time

    def start(self, code: Code, now: int) -> None:
        """Start the task of some code, again if it is running."""
        task = self.tasks[code.number]
        if task.code is not None:
            self._tell(task, task.code, "stopped")
        task.start(code, now)
        self._tell(task, code, "started")

    def stop(self, task: Task, how: str = "stopped") -> None:
        """Stop a task, which may not be running."""
        if task.code is not None:
            self._tell(task, task.code, how)
        task.stop()

    def stop_all(self) -> None:
        for task in self.tasks:
            self.stop(task)

    def call(self, task: Task, sub: Code) -> None:
        """Go on in a sub."""
        assert task.code is not None
        task.back = task.code, task.place
        task.code, task.place = sub, 0

    def come_back(self, task: Task) -> None:
        """Return from a sub; one that has lost its return address to another stops everything."""
        if task.back is None:
            self.stop_all()
        else:
            (task.code, task.place), task.back = task.back, None

    def _end(self, task: Task, code: Code) -> None:
        if code.type is ChunkType.SUB:
            self.come_back(task)
        else:
            self.stop(task, "ended")

    def happen(self, events: int, now: int) -> None:
        """Let tasks that monitor one of some events go on at their handlers."""
        for task in self.tasks:
            if task.monitor is not None and task.monitor.what & events:
                task.triggered = task.monitor.what & events
                handler, task.monitor = task.monitor, None
                task.go(handler, now)

    def acquire(self, task: Task, handler: Handler, now: int) -> None:
        """Take resources from tasks that are no more important; refused, go on at the handler, as those who lose."""
        owners = [
            (other, other.access)
            for other in self.tasks
            if other is not task and other.access is not None and other.access.what & handler.what
        ]
        if any(owner.priority < task.priority for owner, _ in owners):
            task.go(handler, now)
            return
        for owner, access in owners:
            owner.access = None
            owner.go(access, now)
        task.access = handler
