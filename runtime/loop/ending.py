"""How a run ends: the devices are told to stop first, whatever the reason."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from golc.diagnostics import Code, DeviceError, GolcError, ProgramError, UserError
from golc.runtime.devices.base import Device
from golc.runtime.loop.happenings import End
from golc.runtime.loop.inbox import Source


def verdict_on(error: BaseException) -> tuple[End, str]:
    """Why a run that raised this has ended, and in which words."""
    match error:
        case ProgramError(diagnostic=diagnostic) if diagnostic.code is Code.ABORTED:
            return End.ABORTED, diagnostic.message
        case ProgramError(diagnostic=diagnostic):
            return End.FAILED, diagnostic.message
        case DeviceError():
            return End.DEVICE, str(error)
        case UserError(diagnostics=(first, *_)):
            return End.FAILED, first.message
        case GolcError():
            return End.FAILED, str(error)
        case KeyboardInterrupt():
            return End.INTERRUPTED, str(error) or "interrupted"
        case BrokenPipeError():
            return End.INTERRUPTED, "nobody reads the output any more"
        case _:
            return End.BUG, f"{type(error).__name__}: {error}"


def release(sources: Sequence[Source], devices: Sequence[Device]) -> tuple[tuple[str, str], ...]:
    """Tell every device to stop, silence the sources, let go of everything; the devices that could not be told."""
    attempts = [(device.name, _attempt(device.abort)) for device in devices]
    for source in sources:
        _attempt(source.close)
    for device in devices:
        _attempt(device.close)
    return tuple((name, failure) for name, failure in attempts if failure is not None)


def _attempt(action: Callable[[], None]) -> str | None:
    """Do something whose failure must not keep the rest from being done; what went wrong."""
    try:
        action()
    except Exception as error:
        return str(error) or type(error).__name__
    return None
