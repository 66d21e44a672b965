"""What a program does that the byte code does not allow."""

from __future__ import annotations

from golc.diagnostics import DeviceError


class MachineError(DeviceError):
    """An op code that cannot be executed: unknown, cut off, outside the code, or with operands that mean nothing.

    Raised without a place where the reason is found, and with ``task`` and ``address`` where the machine knows them.
    What a brick does then is not known; the simulated one stops the program.
    """

    exit_code = 5

    def __init__(self, reason: str, task: str | None = None, address: int | None = None) -> None:
        super().__init__(reason if task is None else f"{task}, address {address}: {reason}")
        self.reason = reason
        self.task = task
        self.address = address

    def at(self, task: str, address: int) -> MachineError:
        """The same with its place."""
        return MachineError(self.reason, task, address)
