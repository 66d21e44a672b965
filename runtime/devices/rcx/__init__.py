"""The serial link to a LEGO RCX brick: numbers in, numbers out, usable from any Python program."""

from golc.runtime.devices.rcx.brick import DEFAULT_TIMEOUT, Brick
from golc.runtime.devices.rcx.errors import (
    InterruptedLinkError,
    LinkError,
    NonsenseError,
    NotATowerError,
    OverdueError,
    PanicError,
    ParameterError,
    PortBusyError,
    PortFailedError,
    PortForbiddenError,
    PortGoneError,
    PortMissingError,
    SilentBrickError,
)
from golc.runtime.devices.rcx.numbers import ClassicParameters
from golc.runtime.devices.rcx.timing import BrickStatistics, Timing
from golc.runtime.devices.rcx.tower import Tower, TowerStatistics, open_tower
from golc.runtime.devices.rcx.transport import Transport

__all__ = [
    "DEFAULT_TIMEOUT",
    "Brick",
    "BrickStatistics",
    "ClassicParameters",
    "InterruptedLinkError",
    "LinkError",
    "NonsenseError",
    "NotATowerError",
    "OverdueError",
    "PanicError",
    "ParameterError",
    "PortBusyError",
    "PortFailedError",
    "PortForbiddenError",
    "PortGoneError",
    "PortMissingError",
    "SilentBrickError",
    "Timing",
    "Tower",
    "TowerStatistics",
    "Transport",
    "open_tower",
]
