"""golc: Golog for robots.

The names below are the public Python API, the same that the command line uses; each is imported when it is first used.

>>> import golc
>>> lift = golc.load("examples/elevator/elevator.gl")
>>> print(lift.plan("go_to(5)"))
up
up
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from golc.api.loading import check, load
    from golc.api.report import Report
    from golc.api.state import Key, State
    from golc.api.theory import NoPlanError, Theory
    from golc.diagnostics import DeviceError, Diagnostic, GolcError, LimitError, ProgramError, UserError
    from golc.planning.plans import Case, Outcome, Plan
    from golc.program.blame import Blocked
    from golc.rendering import render
    from golc.runtime.conversation import Voice
    from golc.runtime.loop.happenings import End
    from golc.runtime.record import Occurrence, Run
    from golc.runtime.running import run
    from golc.runtime.settings import Options
    from golc.theory.ground import Call
    from golc.theory.types import Unknown

__all__ = [
    "Blocked",
    "Call",
    "Case",
    "DeviceError",
    "Diagnostic",
    "End",
    "GolcError",
    "Key",
    "LimitError",
    "NoPlanError",
    "Occurrence",
    "Options",
    "Outcome",
    "Plan",
    "ProgramError",
    "Report",
    "Run",
    "State",
    "Theory",
    "Unknown",
    "UserError",
    "Voice",
    "check",
    "load",
    "render",
    "run",
]

_ROOMS = {
    "golc.api.loading": ("check", "load"),
    "golc.api.report": ("Report",),
    "golc.api.state": ("Key", "State"),
    "golc.api.theory": ("NoPlanError", "Theory"),
    "golc.diagnostics": ("DeviceError", "Diagnostic", "GolcError", "LimitError", "ProgramError", "UserError"),
    "golc.planning.plans": ("Case", "Outcome", "Plan"),
    "golc.program.blame": ("Blocked",),
    "golc.rendering": ("render",),
    "golc.runtime.conversation": ("Voice",),
    "golc.runtime.loop.happenings": ("End",),
    "golc.runtime.record": ("Occurrence", "Run"),
    "golc.runtime.running": ("run",),
    "golc.runtime.settings": ("Options",),
    "golc.theory.ground": ("Call",),
    "golc.theory.types": ("Unknown",),
}
_HOMES = {name: room for room, names in _ROOMS.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'golc' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return __all__
