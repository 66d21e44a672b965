"""From the device blocks of a theory to devices."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from golc.diagnostics import DeviceError
from golc.nqc.numbering import ActionMap, implied, number_bricks
from golc.runtime.devices.base import Device
from golc.runtime.devices.bricks import Link, RcxDevice
from golc.runtime.devices.desk import Desk
from golc.runtime.devices.host import Host
from golc.runtime.devices.itself import Itself
from golc.runtime.devices.operator import Operator, Speak
from golc.theory import theory as th
from golc.theory.theory import BasicActionTheory


@dataclass(frozen=True)
class Surroundings:
    """What devices need that the theory does not say: the operator, their words, and the port of the bricks."""

    desk: Desk
    speak: Speak
    link: Link | None


def build_devices(theory: BasicActionTheory, surroundings: Surroundings) -> list[Device]:
    """All devices of a theory, in the order of declaration, none of them open.

    Raises ``UserError`` if the numbers of a brick make no sense.
    """
    maps = number_bricks(theory)
    return [_build(theory, device, maps, surroundings) for device in theory.devices]


def _build(
    theory: BasicActionTheory, device: th.Device, maps: dict[str, ActionMap], surroundings: Surroundings
) -> Device:
    bindings = device.bindings or tuple(implied(theory, device))
    match device.kind:
        case "rcx":
            if surroundings.link is None:
                raise DeviceError(f"the brick {device.name} has no port", help="name one with --port")
            return RcxDevice(maps[device.name], surroundings.link)
        case "operator":
            return Operator(device.name, bindings, theory, surroundings.desk, surroundings.speak)
        case "host":
            return Host(device.name, Path(device.folder) / (device.file or ""), bindings, theory)
        case _:
            return Itself(device.name, bindings)
