"""The real nqc: compiling a program, its errors as diagnostics, and how much of the brick the program takes."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from golc.bytecode.image import ChunkType, Image, read_image, variables_used
from golc.diagnostics import Code, DeviceError, Diagnostic, Label, Source, Span, UserError
from golc.nqc.userfiles import read_nqc

SECONDS = 30
"""nqc takes milliseconds; after this it hangs."""

BYTES = 6000
"""Bytes of program that a brick takes, in all slots together, about."""

MISSING_HELP = "install it (on Debian and Ubuntu: apt-get install nqc) or add its folder to PATH"


class Target(Enum):
    """The firmware of the brick: nqc's name for it, and what it has of variables for a task's own."""

    RCX = ("rcx", "RCX", "1.0", 0)
    RCX2 = ("rcx2", "RCX2", "2.0", 16)

    def __init__(self, option: str, nqc: str, firmware: str, locals_: int) -> None:
        self.option = option
        self.nqc = nqc
        self.firmware = firmware
        self.locals = locals_


TASKS, SUBS, VARIABLES = 10, 8, 32


@dataclass(frozen=True)
class Usage:
    """One line of the size table."""

    what: str
    used: int
    of: int
    remark: str = ""


@dataclass(frozen=True)
class Compiled:
    """A compiled program: its image and what it takes of the brick."""

    path: Path
    image: Image
    usage: tuple[Usage, ...]


def find_nqc() -> str:
    """The path of the compiler; raises DeviceError if it is not installed."""
    found = shutil.which("nqc")
    if found is None:
        raise DeviceError("nqc, the compiler for the brick, is not installed", help=MISSING_HELP)
    return found


def compile_program(
    program: Path, folders: Sequence[Path], target: Target, where: Span, image: Path | None = None
) -> Compiled:
    """Compile an NQC file; the image comes to lie beside it, if no other place is given.

    ``folders`` are searched for includes, ``where`` is the place of the device, to which an error without a place of
    its own is attached. Raises UserError with nqc's errors at their places, or if the program is too large; DeviceError
    if nqc is missing or fails in another way.
    """
    nqc = find_nqc()
    image = image or program.with_suffix(".rcx")
    includes = [f"-I{folder.resolve()}" for folder in folders]
    command = [nqc, f"-T{target.nqc}", f"-O{image.resolve()}", *includes, program.name]
    image.unlink(missing_ok=True)
    try:
        done = subprocess.run(command, cwd=program.parent, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise DeviceError(f"nqc has not ended within {SECONDS} s") from error
    except OSError as error:
        raise DeviceError(f"nqc cannot be run: {error.strerror or error}", help=MISSING_HELP) from error
    output = done.stderr.decode("utf-8", "replace")
    errors = list(parse_errors(output, [program.parent, *folders], where))
    if errors:
        raise UserError(*errors)
    if done.returncode < 0:
        too_large = "nqc crashed, as it does on very large programs"
        raise UserError(Diagnostic(Code.NQC_LIMIT, too_large, where, help="make the program smaller"))
    if done.returncode != 0 or not image.exists():
        raise DeviceError(f"nqc failed with exit code {done.returncode}: {output.strip() or 'no output'}")
    read = read_image(image.read_bytes())
    compiled = Compiled(image, read, usage_of(read, target))
    check_usage(compiled.usage, target, where)
    return compiled


_ERROR = re.compile(r"^# (Error|Warning): (.*)$")
_PLACE = re.compile(r'^File "(.*)" ; line (\d+)$')
_MARK = re.compile(r"^# ( *)(\^+)")


def parse_errors(output: str, folders: Sequence[Path], where: Span) -> Iterator[Diagnostic]:
    """The errors in nqc's output as diagnostics; warnings of nqc are left out.

    A file that is named is looked up in the folders; one that was not found, or an error without a file, is shown at
    ``where``.
    """
    lines = output.splitlines()
    for number, line in enumerate(lines):
        match = _ERROR.match(line)
        if match is None or match[1] != "Error":
            continue
        place = _PLACE.match(lines[number + 1]) if number + 1 < len(lines) else None
        mark = _MARK.match(lines[number + 3]) if place and number + 3 < len(lines) else None
        span = None if place is None else _span(place[1], int(place[2]), mark, folders)
        yield _diagnostic(match[2], span, where)


def _diagnostic(message: str, span: Span | None, where: Span) -> Diagnostic:
    if span is None:
        return Diagnostic(Code.NQC_REFUSED, f"nqc: {message}", where, help=_help(message))
    labels = (Label(where, "the device that has this program"),) if where.text else ()
    return Diagnostic(Code.NQC_REFUSED, f"nqc: {message}", span, labels=labels, help=_help(message))


def _span(name: str, line: int, mark: re.Match[str] | None, folders: Sequence[Path]) -> Span | None:
    """The place of an error: what nqc underlines, or the entire line."""
    source = next((found for folder in folders if (found := read_nqc(folder / name)) is not None), None)
    if source is None or not 1 <= line <= len(source.line_starts):
        return None
    source = Source(_short(source.name), source.text)
    start, text = source.line_starts[line - 1], source.line(line)
    if mark is not None and len(mark[1]) < len(text):
        first = start + len(mark[1])
        return Span(source, first, min(first + len(mark[2]), start + len(text)))
    return Span(source, start + len(text) - len(text.lstrip()), start + len(text))


def _short(name: str) -> str:
    """A path as a person would write it."""
    path = Path(name).resolve()
    here = Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else str(path)


def _help(message: str) -> str | None:
    if "storage" in message or "temporary variables" in message:
        return (
            "firmware 1.0 has 32 variables for all tasks, and none for a sub that two tasks call: "
            "make it a function (`void`), or use `--target rcx2`"
        )
    return None


def usage_of(image: Image, target: Target) -> tuple[Usage, ...]:
    """What a program takes, of what there is."""
    used = [variables_used(chunk) for chunk in image.chunks]
    shared = {number for numbers in used for number in numbers if number < VARIABLES}
    table = [
        Usage("bytes", image.size, BYTES, "about, all programs on the brick together"),
        Usage("tasks", image.count(ChunkType.TASK), TASKS),
        Usage("subs", image.count(ChunkType.SUB), SUBS),
        Usage("variables", len(shared), VARIABLES, "of the brick" if target.locals else ""),
    ]
    if target.locals:
        most = max((sum(number >= VARIABLES for number in numbers) for numbers in used), default=0)
        table.append(Usage("variables", most, target.locals, "of a task's own, at most"))
    return tuple(table)


def check_usage(usage: Sequence[Usage], target: Target, where: Span) -> None:
    """Raise UserError if a program takes more than there is; nqc itself does not look at its size."""
    too_much = [
        Diagnostic(
            Code.NQC_LIMIT,
            f"the program takes {line.used} {line.what}, but a brick with firmware {target.firmware} has {line.of}",
            where,
        )
        for line in usage
        if line.used > line.of
    ]
    if too_much:
        raise UserError(*too_much)
