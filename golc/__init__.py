"""golc: Golog for robots.

The names below are the public Python API, the same that the command line uses; each is imported when it is first used.

>>> import golc
>>> theory = golc.load("examples/elevator/elevator.gl")
>>> plans = golc.Planning(golc.executable(theory, "control"), golc.Limits())
>>> [str(action) for action in next(iter(plans)).actions][:3]
['up', 'up', 'open']
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from golc.diagnostics import DeviceError, Diagnostic, GolcError, LimitError, ProgramError, UserError
    from golc.loading import examine, load
    from golc.planning.limits import Limits
    from golc.planning.planner import Executable, Planning, executable
    from golc.planning.plans import Case, Outcome, Plan
    from golc.rendering import render
    from golc.situation.dynamics import Dynamics
    from golc.theory.statements import Strategy
    from golc.theory.theory import BasicActionTheory

__all__ = [
    "BasicActionTheory",
    "Case",
    "DeviceError",
    "Diagnostic",
    "Dynamics",
    "Executable",
    "GolcError",
    "LimitError",
    "Limits",
    "Outcome",
    "Plan",
    "Planning",
    "ProgramError",
    "Strategy",
    "UserError",
    "examine",
    "executable",
    "load",
    "render",
]

_ROOMS = {
    "golc.diagnostics": ("DeviceError", "Diagnostic", "GolcError", "LimitError", "ProgramError", "UserError"),
    "golc.loading": ("examine", "load"),
    "golc.planning.limits": ("Limits",),
    "golc.planning.planner": ("Executable", "Planning", "executable"),
    "golc.planning.plans": ("Case", "Outcome", "Plan"),
    "golc.rendering": ("render",),
    "golc.situation.dynamics": ("Dynamics",),
    "golc.theory.statements": ("Strategy",),
    "golc.theory.theory": ("BasicActionTheory",),
}
_HOMES = {name: room for room, names in _ROOMS.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'golc' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return __all__
