"""``golc gen-nqc``: the NQC program of a brick."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from golc.cli.console import Console
from golc.cli.options import console_options, constants_option

if TYPE_CHECKING:
    from golc.nqc.actionmap import Entry
    from golc.nqc.build import BrickProgram
    from golc.nqc.generate import Generated
    from golc.nqc.toolchain import Usage


@click.command(name="gen-nqc", short_help="Generate the NQC program of a brick.")
@click.argument("file", type=click.Path())
@click.option(
    "-o", "--output", type=click.Path(file_okay=False), metavar="DIR", help="Where to write; else `build/` beside FILE."
)
@click.option("--device", "name", metavar="NAME", help="Only this brick, where FILE has several.")
@click.option(
    "--target", "option", type=click.Choice(["rcx", "rcx2"]), default="rcx2", help="Firmware 1.0, or 2.0 (default)."
)
@click.option(
    "--link",
    type=click.Choice(["classic"]),
    default="classic",
    expose_value=False,  # there is no other protocol yet
    help="The protocol: that of Legolog 2000.",
)
@click.option("--compile", "compile_", is_flag=True, help="Compile it with nqc and say how much of the brick it takes.")
@click.option("--download", is_flag=True, help="Compile it and send it to the brick.")
@click.option("--port", metavar="P", help="With --download: the tower, a tty or usb:/dev/usb/legousbtower0.")
@click.option(
    "--slot", type=click.IntRange(1, 5), metavar="N", help="With --download: the program slot; else the selected one."
)
@click.option("--debug-tones", is_flag=True, help="Let the brick be heard when it hears and says something.")
@constants_option
@console_options
def command(
    console: Console,
    file: str,
    output: str | None,
    name: str | None,
    option: str,
    compile_: bool,
    download: bool,
    port: str | None,
    slot: int | None,
    debug_tones: bool,
    constants: Mapping[str, str],
) -> int:
    """Write the NQC program of each brick of FILE: event loop, action numbers, and stubs for missing behaviours.

    The behaviours are in the NQC file that the device names. A file that you have edited is never overwritten.

    \b
    golc gen-nqc examples/delivery/delivery.gl --compile
    golc gen-nqc robot.gl --target rcx --download --port /dev/ttyS0 --slot 3
    """
    from golc.api.loading import load

    if download and port is None:
        raise click.UsageError("--download needs --port")
    if not download and (port is not None or slot is not None):
        raise click.UsageError("--port and --slot belong to --download")
    theory = load(file, constants)
    names = [brick.name for brick in theory.elaborated.bricks if name in (None, brick.name)]
    if download and len(names) > 1:
        raise click.UsageError(f"--download sends to one brick: choose with --device one of {', '.join(names)}")
    try:
        programs = theory.gen_nqc(output, device=name, target=option, tones=debug_tones)
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint="--device") from None
    for program in programs:
        _say_written(console, program.generated)
        console.findings(program.warnings)
        if compile_ or download:
            _say_compiled(console, program)
        if download and port is not None:
            _download(console, program, port, slot)
    return 0


def _say_written(console: Console, generated: Generated) -> None:
    from golc.nqc.files import Outcome

    if console.verbosity < 0:
        return
    entries = generated.actions.entries
    hooks = generated.program.own_hooks
    rows = [(_numbers(entry), _signature(entry), _behaviour(entry, hooks)) for entry in entries]
    widths = [max((len(row[column]) for row in rows), default=0) for column in (0, 1)]
    console.out(f"{_brick(generated)}\n")
    for number, signature, behaviour in rows:
        console.out(f"  {number:>{widths[0]}}  {signature:<{widths[1]}}  {behaviour}")
    console.out("")
    purposes = {".nqh": "the event loop", ".json": "the action map for programs"}
    for written in generated.written:
        path = _short(written.path)
        if written.outcome is Outcome.KEPT and written.kept is not None:
            console.out(f"kept  {_short(written.kept)}, which somebody has edited; the new text is in {path}")
        else:
            console.out(f"wrote {path}  ({_purpose(written.path, generated, purposes)})")
    for gone in generated.removed:
        console.out(f"removed {_short(gone)}, which is not needed any more")


def _purpose(path: Path, generated: Generated, purposes: Mapping[str, str]) -> str:
    if path == generated.path:
        return "the program"
    if path.suffix in purposes:
        return purposes[path.suffix]
    names = ", ".join(stub.name for stub in generated.stubs)
    return f"stubs, to be filled in: {names}"


def _brick(generated: Generated) -> str:
    device = generated.actions.device
    name = "brick" if device.name == device.kind else f"brick {device.name}"
    if not generated.user.sources:
        missing = f", {device.file} is not there" if device.file else ""
        return f"{name}: no behaviours yet{missing}"
    files = ", ".join(_short(Path(source.name)) for source in generated.user.sources)
    return f"{name}: {'hooks and behaviours' if generated.program.own_hooks else 'behaviours'} in {files}"


def _numbers(entry: Entry) -> str:
    return str(entry.first) if entry.count == 1 else f"{entry.first}..{entry.last}"


def _signature(entry: Entry) -> str:
    from golc.theory.theory import Fixed
    from golc.theory.types import show

    slots = [show(slot.value) if isinstance(slot, Fixed) else f"{slot.name}: {slot.type}" for slot in entry.args]
    return f"{entry.action}({', '.join(slots)})" if slots else entry.action


def _behaviour(entry: Entry, hooks: bool) -> str:
    from golc.nqc.behaviours import behaviour_name
    from golc.theory.theory import ByStart

    if entry.behaviour is None:
        return "reported by the brick"
    if hooks:
        return "by your startBehaviour"
    return f"{'starts' if isinstance(entry.behaviour, ByStart) else 'calls'} {behaviour_name(entry)}"


def _say_compiled(console: Console, program: BrickProgram) -> None:
    compiled, target = program.compiled, program.target
    if console.verbosity >= 0:
        console.out(f"\ncompiled {_short(compiled.path)} for firmware {target.firmware} ({target.option})\n")
        for line in compiled.usage:
            console.out(_usage(line))


def _usage(line: Usage) -> str:
    width = 20
    filled = min(width, -(-line.used * width // line.of))
    bar = "#" * filled + "." * (width - filled)
    return f"  {line.what:<9} {line.used:>5} of {line.of:>4}  {bar}  {line.remark}".rstrip()


def _download(console: Console, program: BrickProgram, port: str, slot: int | None) -> None:
    import sys

    progress = console.verbosity >= 0 and sys.stderr.isatty()
    console.note(f"\nsending it through {port}")

    def heard(text: str) -> None:
        if progress:
            print(text, end="", file=sys.stderr, flush=True)

    program.download(port, slot, heard)
    console.out(f"the brick has the program{'' if slot is None else f' in slot {slot}'}; press its green Run button")


def _short(path: Path) -> str:
    """A path as a person would write it."""
    relative = os.path.relpath(path)
    return relative if len(relative) < len(str(path)) or not path.is_absolute() else str(path)
