"""``golc sim``: the simulated brick as a process of its own."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from golc.cli.console import Console
from golc.cli.options import at_most_one, console_options, constants_option, speed_option
from golc.cli.sim_machine import REST, Simulation, is_byte_code
from golc.cli.sim_options import ByteCode, Plug, byte_code_options, line_options, plug_options
from golc.cli.sim_room import Room
from golc.cli.sim_trace import tracing

if TYPE_CHECKING:
    from golc.runtime.rcxsim.line import Line, LineOptions
    from golc.runtime.rcxsim.trace import Trace

EMPTY = "the brick is empty: nqc can send it a program"


@click.command(name="sim", short_help="Simulate a brick behind a serial port.")
@click.argument("file", type=click.Path(path_type=Path), required=False)
@plug_options
@speed_option("give the host the same")
@line_options
@click.option("--seed", type=int, default=0, show_default=True, help="Of everything that is left to chance.")
@click.option("--events", type=click.Path(path_type=Path), metavar="FILE", help="What happens, instead of chance.")
@click.option(
    "--trace", type=click.Path(path_type=Path), metavar="FILE", help="Write what the brick does, as JSON lines."
)
@byte_code_options
@click.option(
    "--world",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Byte code, also that of a domain's behaviours: the floor, the robot and the people around the brick.",
)
@click.option(
    "--picture", type=click.Path(path_type=Path), metavar="FILE", help="Draw the world in the end, from above, as SVG."
)
@constants_option
@console_options
def command(
    console: Console,
    file: Path | None,
    plug: Plug,
    speed: float,
    line: LineOptions,
    seed: int,
    events: Path | None,
    trace: Path | None,
    byte_code: ByteCode,
    world: Path | None,
    picture: Path | None,
    constants: Mapping[str, str],
) -> None:
    """Simulate a brick behind a serial port that `golc run --port` and `nqc` can use.

    FILE is a domain: the brick knows the theory only, never the program: it does what it is told, takes a while for
    it, senses, and reports exogenous actions, by the script of --events or by chance. Or FILE is a program, .nqc or
    .rcx: the brick executes its byte code. Without FILE the brick is empty and waits for `nqc -d`. With --world also a
    domain's behaviours are compiled, and their robot drives.

    Prints one line, `pty PATH` or `tcp HOST:PORT`, when it is ready, and ends on Ctrl-C.

    \b
    golc sim examples/delivery/delivery.gl --pty /tmp/brick --speed 5 &
    golc run examples/delivery/delivery.gl --port /tmp/brick --speed 5
    golc sim robot.nqc --world room.toml --for 10 --picture way.svg
    """
    at_most_one({**plug.given, **byte_code.alone})
    others = {"--events": events is not None, "--picture": picture is not None, "-D": bool(constants)}
    _refuse_misplaced(file, world is not None, byte_code, others)
    with contextlib.ExitStack() as stack:
        told = stack.enter_context(tracing(console, trace))
        room = None if world is None else Room(world, seed, told, console)
        if file is not None and room is None and not is_byte_code(file):
            brick = _Brick(_theory_line(file, constants, events, line, seed, told))
        else:
            machine = Simulation(file, byte_code, seed, None if room is None else room.world, told, constants)
            if room is not None and picture is not None:
                stack.enter_context(room.drawing(picture))
            if any(byte_code.alone.values()):
                _show(console, machine, byte_code, line, room)
                return
            brick = _Brick(machine.line(line), REST, EMPTY if file is None else "")
        _serve(console, brick, plug, room, speed)


class _Brick(NamedTuple):
    """What is at the end of a line; ``rest`` is as for ``serve``, ``hint`` is what can be done with it."""

    line: Line
    rest: float = 0.0
    hint: str = ""


def _refuse_misplaced(file: Path | None, in_a_world: bool, byte_code: ByteCode, given: Mapping[str, bool]) -> None:
    """Refuse the options that do not belong to what is simulated; ``given`` says which of the others are there."""
    at_most_one({"--listing": byte_code.listing, "--picture": given["--picture"]})
    if is_byte_code(file) or in_a_world:
        _refuse("a domain without --world", {"--events": given["--events"]})
        _refuse("a domain", {"-D": given["-D"] and is_byte_code(file)})
        _refuse("a program: give a FILE", byte_code.alone if file is None else {})
    else:
        _refuse("byte code, a FILE.nqc or FILE.rcx, or --world", byte_code.given)
    _refuse("a world: give one with --world", {"--picture": given["--picture"] and not in_a_world})


def _refuse(of: str, given: Mapping[str, bool]) -> None:
    """Refuse the options that are given and do not belong to what is simulated."""
    for name, is_given in given.items():
        if is_given:
            raise click.UsageError(f"{name} is for {of}")


def _show(console: Console, machine: Simulation, asked: ByteCode, line: LineOptions, room: Room | None) -> None:
    """What is asked for that needs no port, and then where the robot is that has moved."""
    try:
        console.out("\n".join(machine.shown(asked, line)))
    finally:
        if room is not None and not asked.listing:
            room.tell_place()


def _serve(console: Console, brick: _Brick, plug: Plug, room: Room | None, speed: float) -> None:
    """Simulate the brick behind a port until a signal ends it, and say where its robot is then."""
    from golc.runtime.rcxsim.serve import serve, stopped_by_signals

    with contextlib.ExitStack() as stack:
        stop = stack.enter_context(stopped_by_signals())
        port = stack.enter_context(contextlib.closing(plug.opened()))
        console.out(port.description)
        if room is not None:
            stack.callback(room.tell_place)
            port = room.attended(port)
        if brick.hint:
            console.note(brick.hint)
        serve(brick.line, port, [stop], speed, brick.rest)


def _theory_line(
    file: Path, constants: Mapping[str, str], events: Path | None, options: LineOptions, seed: int, trace: Trace
) -> Line:
    """The line to the bricks of a domain."""
    from golc.loading import load
    from golc.runtime.rcxsim.theory.simulator import build
    from golc.runtime.sources.schedule import read_schedule

    theory = load(file, constants)
    schedule = None if events is None else read_schedule(events, theory)
    return build(theory, options, schedule, seed, trace)
