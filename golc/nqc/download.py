"""Sending a compiled program to the brick, which the real nqc does."""

from __future__ import annotations

import os
import select
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from golc.diagnostics import DeviceError
from golc.nqc.toolchain import Target, find_nqc

Heard: TypeAlias = Callable[[str], None]
"""Gets the progress of nqc as text."""

SECONDS = 300.0
"""Six thousand bytes take about a hundred seconds in the air."""

ADVICE = {
    255: ("the port {port} cannot be opened", "is the tower plugged in, and may you use it (group `dialout`)?"),
    254: ("nothing comes back from {port}", "is there an infra-red tower on this port, and is it connected firmly?"),
    253: ("no brick answers", "is the brick switched on, in sight of the tower, and has it firmware?"),
}
"""What nqc's exit codes mean, and what to do about them."""


def download(image: Path, target: Target, port: str, slot: int | None, heard: Heard) -> None:
    """Send a program to the brick, into a slot (1 to 5) or the one that is selected there.

    ``heard`` gets nqc's progress as it comes. Raises DeviceError if nqc is missing or the brick does not take it.
    """
    command = [find_nqc(), f"-T{target.nqc}", f"-S{nqc_port(port)}", "-b", "-d"]
    command += [] if slot is None else ["-pgm", str(slot)]
    command.append(str(image))
    try:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
    except OSError as error:
        raise DeviceError(f"nqc cannot be run: {error.strerror or error}") from error
    with process:
        said = _listen(process, heard)
        code = process.wait()
    if code != 0:
        message, help_ = ADVICE.get(
            code, ("nqc could not send the program: {said}", "try once more, closer to the brick")
        )
        raise DeviceError(message.format(port=port, said=said.strip() or f"exit code {code}"), help=help_)


def _listen(process: subprocess.Popen[bytes], heard: Heard) -> str:
    """What nqc says until it ends: a dot for each block, without a line end. One that hangs is ended."""
    assert process.stderr is not None
    descriptor, deadline, said = process.stderr.fileno(), time.monotonic() + SECONDS, ""
    while select.select([descriptor], [], [], max(0.0, deadline - time.monotonic()))[0]:
        if not (chunk := os.read(descriptor, 4096)):
            return said
        text = chunk.decode("latin-1")
        said += text
        heard(text)
    process.kill()
    raise DeviceError(f"nqc has not ended within {SECONDS:g} s", help="try once more, closer to the brick")


def nqc_port(port: str) -> str:
    """A port of golc in nqc's words: a path as it is, ``usb:`` and a path likewise."""
    if "://" in port:
        raise DeviceError(
            f"nqc cannot use the port {port}", help="give the path of a tty, or usb:/dev/usb/legousbtower0"
        )
    return port
