"""``golc sim``: the simulated brick as a process of its own."""

from __future__ import annotations

import contextlib
import itertools
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from golc.cli import sim_machine
from golc.cli.common import Console, Quantity, address, console_options, constants_option, speed_option

if TYPE_CHECKING:
    from golc.runtime.rcxsim.line import Line, LineOptions
    from golc.runtime.rcxsim.ports import Port
    from golc.runtime.rcxsim.trace import Record, Trace
    from golc.runtime.rcxsim.world.world import World

TROUBLE = {
    "fault": "{task}, address {address}: {problem}; the program is stopped",
    "dropped": "{why}",
    "downloaded": "{part}: {problem}",
    "request": "a request is not answered ({payload}): {problem}",
    "unknown": "the host sent number {number}, which the brick has no action for; answered 0",
    "panicked": "{why}: the brick panics until it is aborted",
    "senseless": "{action} could not be sensed, answered 0: {problem}",
}
"""What is said on stderr of records that mean trouble; of some only if they have a ``problem``."""
ONLY_WITH_PROBLEM = ("downloaded", "request")


def _outages(
    context: click.Context, parameter: click.Parameter, values: tuple[str, ...]
) -> tuple[tuple[float, float], ...]:
    """Times of the form ``12-15.5``, in order and apart."""
    outages = []
    for value in values:
        start, _, end = value.partition("-")
        try:
            outages.append((float(start), float(end)))
        except ValueError:
            raise click.BadParameter(f"{value!r} is not of the form FROM-TO, in seconds") from None
    times = [time for outage in sorted(outages) for time in outage]
    if not all(0 <= a < b < float("inf") for a, b in itertools.pairwise(times)):
        raise click.BadParameter("an outage ends before it begins, or before another one ends")
    return tuple(sorted(outages))


@click.command(name="sim", short_help="Simulate a brick behind a serial port.")
@click.argument("file", type=click.Path(path_type=Path), required=False)
@click.option(
    "--pty", "link", type=click.Path(path_type=Path), metavar="PATH", help="Make a link to the terminal here."
)
@click.option("--tcp", metavar="HOST:PORT", callback=address, help="Listen here instead; port 0 is any free one.")
@speed_option("give the host the same")
@click.option(
    "--air-time",
    type=Quantity(0, 10),
    default=1.0,
    show_default=True,
    help="Factor on the air time of 2400 baud; 0: messages take no time.",
)
@click.option("--loss", type=Quantity(0, 1), default=0.0, metavar="P", help="Chance that a message is lost.")
@click.option("--garble", type=Quantity(0, 1), default=0.0, metavar="P", help="Chance that it is damaged.")
@click.option("--repeat", type=Quantity(0, 1), default=0.0, metavar="P", help="Chance that it arrives twice.")
@click.option("--late", type=Quantity(0, 1), default=0.0, metavar="P", help="Chance that it is late, by up to 0.5 s.")
@click.option("--noise", type=Quantity(0, 1), default=0.0, metavar="P", help="Chance of noise before it.")
@click.option(
    "--off",
    "outages",
    multiple=True,
    metavar="FROM-TO",
    callback=_outages,
    help="Switch the brick off and on again at these seconds; may be repeated.",
)
@click.option("--seed", type=int, default=0, show_default=True, help="Of everything that is left to chance.")
@click.option("--events", type=click.Path(path_type=Path), metavar="FILE", help="What happens, instead of chance.")
@click.option(
    "--trace", type=click.Path(path_type=Path), metavar="FILE", help="Write what the brick does, as JSON lines."
)
@click.option("--echo/--no-echo", default=True, help="Whether the tower echoes what the host sends, as serial ones do.")
@click.option(
    "--sleep/--no-sleep", default=True, help="Whether the tower falls asleep after 4 s of the host's silence."
)
@click.option(
    "--target",
    "option",
    type=click.Choice(["rcx", "rcx2"]),
    help="Byte code: firmware 1.0, or 2.0, of the empty brick, or for which FILE.nqc is compiled (default: rcx2).",
)
@click.option(
    "--brick",
    "settings",
    multiple=True,
    metavar="NAME=VALUE",
    callback=sim_machine.settings,
    help="Byte code: how the firmware is, where that is not known; may be repeated.",
)
@click.option(
    "--for",
    "seconds",
    type=Quantity(0, 1e6),
    metavar="SECONDS",
    help="Byte code: let so many simulated seconds pass at once, without a port, and show how the brick stands.",
)
@click.option(
    "--world",
    "scene",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Byte code, also that of a domain's behaviours: the floor, the robot and the people around the brick.",
)
@click.option(
    "--picture", type=click.Path(path_type=Path), metavar="FILE", help="Draw the world in the end, from above, as SVG."
)
@click.option(
    "--steps",
    type=click.IntRange(1),
    metavar="N",
    help="Byte code: the same until the program has ended; after N op codes it is an error that it has not.",
)
@click.option("--listing", is_flag=True, help="Byte code: print the op codes as `nqc -L` does, and end.")
@constants_option
@console_options
def command(
    file: Path | None,
    link: Path | None,
    tcp: tuple[str, int] | None,
    speed: float,
    air_time: float,
    loss: float,
    garble: float,
    repeat: float,
    late: float,
    noise: float,
    outages: tuple[tuple[float, float], ...],
    seed: int,
    events: Path | None,
    trace: Path | None,
    echo: bool,
    sleep: bool,
    option: str | None,
    settings: Mapping[str, Any],
    seconds: float | None,
    scene: Path | None,
    picture: Path | None,
    steps: int | None,
    listing: bool,
    constants: Mapping[str, str],
    console: Console,
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
    runs = {"--pty": link is not None, "--tcp": tcp is not None, "--for": seconds is not None}
    _refuse_together({**runs, "--steps": steps is not None, "--listing": listing})
    _refuse_together({"--listing": listing, "--picture": picture is not None})
    byte_code = sim_machine.is_byte_code(file) or scene is not None
    if byte_code:
        _refuse("a domain without --world", {"--events": events is not None})
        _refuse("a domain", {"-D": constants} if sim_machine.is_byte_code(file) else {})
        program: dict[str, object] = {"--for": seconds is not None, "--steps": steps, "--listing": listing}
        _refuse("a program: give a FILE", program if file is None else {})
    else:
        given: dict[str, object] = {"--target": option, "--brick": settings, "--for": seconds is not None}
        given |= {"--steps": steps, "--listing": listing}
        _refuse("byte code, a FILE.nqc or FILE.rcx, or --world", given)
    _refuse("a world: give one with --world", {"--picture": picture is not None and scene is None})
    from golc.runtime.rcxsim.line import TOWER_SLEEPS_AFTER, LineOptions
    from golc.runtime.rcxsim.serve import serve, stopped_by_signals
    from golc.runtime.rcxsim.surroundings import Bench
    from golc.runtime.rcxsim.trace import Trace, to_file

    sleeps = TOWER_SLEEPS_AFTER if sleep else None
    options = LineOptions(air_time, loss, garble, echo, sleeps, repeat, late, noise, outages)
    with contextlib.ExitStack() as stack:
        readers = [_teller(console)]
        if trace is not None:
            readers.append(to_file(stack.enter_context(_opened(trace))))
        told = Trace(*readers)
        if file is None or byte_code:
            world = None if scene is None else _world(scene, seed, told)
            made = {"seed": seed, **settings}
            machine = sim_machine.Simulation(file, option, made, world or Bench(), told, constants)
            if world is not None and picture is not None:
                stack.enter_context(_drawing(world, picture))
            if world is not None and (seconds is not None or steps is not None):
                stack.callback(_tell_place, world, console)
            if shown := machine.shown(listing, seconds, steps, options):
                console.out("\n".join(shown))
                return
            line, rest = machine.line(options), sim_machine.REST
        else:
            world = None
            line, rest = _theory_line(file, constants, events, options, seed, told), 0.0
        stops = [stack.enter_context(stopped_by_signals())]
        port = stack.enter_context(contextlib.closing(_port(link, tcp)))
        console.out(port.description)
        if world is not None:
            stack.callback(_tell_place, world, console)
            port = _attended(port, world, console)
        if file is None:
            console.note("the brick is empty: nqc can send it a program")
        serve(line, port, stops, speed, rest)


def _refuse(of: str, given: Mapping[str, object]) -> None:
    """Refuse the options that are given and do not belong to what is simulated."""
    for name, value in given.items():
        if value:
            raise click.UsageError(f"{name} is for {of}")


def _refuse_together(given: Mapping[str, bool]) -> None:
    """Refuse options of which each says by itself what is to be done."""
    if len(names := [name for name, is_given in given.items() if is_given]) > 1:
        raise click.UsageError(f"{' and '.join(names)} exclude each other")


def _world(path: Path, seed: int, trace: Trace) -> World:
    from golc.runtime.rcxsim.world.world import World
    from golc.runtime.rcxsim.world.worldfile import read_world

    return World(read_world(path), seed, trace)


def _drawing(world: World, picture: Path) -> contextlib.AbstractContextManager[None]:
    """Draw the world as it is in the end."""
    from golc.runtime.rcxsim.world.picture import draw, drawing

    return drawing(picture, lambda: draw(world.scene, world.record, world.pose))


def _attended(port: Port, world: World, console: Console) -> Port:
    """The port of a brick at which somebody may type what people do."""
    from golc.runtime.rcxsim.attended import AttendedPort

    try:
        descriptor = sys.stdin.fileno()
    except (AttributeError, OSError, ValueError):
        return port
    if os.isatty(descriptor):
        console.note("type what you do at the robot, such as `press run`, `lift`, `put back`")
    return AttendedPort(port, descriptor, lambda text: _do(text, world, console))


def _do(text: str, world: World, console: Console) -> None:
    """Do what somebody has typed, or say why not."""
    from golc.diagnostics import Findings, Source, Span
    from golc.rendering import render

    findings = Findings()
    told = world.act(text, Span(Source("<stdin>", text), 0, len(text)), findings)
    for finding in findings.diagnostics:
        console.err(render(finding, color=console.colored(sys.stderr)))
    if told:
        console.note(f"you: {told}")


def _tell_place(world: World, console: Console) -> None:
    console.out(f"the robot is {world.whereabouts}")


def _theory_line(
    file: Path, constants: Mapping[str, str], events: Path | None, options: LineOptions, seed: int, trace: Trace
) -> Line:
    from golc.loading import load
    from golc.runtime.rcxsim.theory.simulator import build
    from golc.runtime.sources.schedule import read_schedule

    theory = load(file, constants)
    schedule = None if events is None else read_schedule(events, theory)
    return build(theory, options, schedule, seed, trace)


def _port(link: Path | None, tcp: tuple[str, int] | None) -> Port:
    from golc.runtime.rcxsim.ports import PtyPort, TcpPort

    return PtyPort(link) if tcp is None else TcpPort(*tcp)


def _opened(path: Path) -> Any:
    from golc.syntax.text import unwritable

    try:
        return path.open("w", encoding="utf-8")
    except OSError as error:
        raise unwritable(path, error) from None


def _teller(console: Console) -> Any:
    """A reader of the trace that tells a person of trouble, and with ``-v`` of everything."""

    def tell(record: Record) -> None:
        problem = record.get("problem")
        text = TROUBLE.get(record["what"]) or ("{action}: {problem}" if problem else None)
        if record["what"] in ONLY_WITH_PROBLEM and not problem:
            text = None
        if text is not None and console.verbosity >= 0:
            console.err(f"{record['t']:9.3f} s  " + text.format(**record))
        elif console.verbosity > 0:
            details = [f"{key} {value}" for key, value in record.items() if key not in ("t", "what") and value != {}]
            console.err(f"{record['t']:9.3f} s  {record['what']:<10} " + "  ".join(details))

    return tell
