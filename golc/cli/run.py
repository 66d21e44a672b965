"""``golc run``: online execution."""

from __future__ import annotations

import errno
from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal

import click

from golc.cli.common import Console, Quantity, address, console_options, constants_option

if TYPE_CHECKING:
    from golc.diagnostics import Diagnostic
    from golc.runtime.session import Voice


@click.command(name="run", short_help="Run a program online, on a brick or a simulated one.")
@click.argument("file", type=click.Path())
@click.argument("procedure", metavar="[PROC]", default="control")
@click.option("--port", metavar="P", help="A tty, a pty, a pySerial URL, usb:PATH, or `sim`, which is the default.")
@click.option(
    "--link",
    type=click.Choice(["auto", "classic"]),
    default="auto",
    show_default=True,
    help="How to talk to the brick; auto is classic, the protocol of Legolog.",
)
@click.option("--events", type=click.Path(), metavar="FILE", help="A timed script of exogenous actions.")
@click.option("--listen", metavar="HOST:PORT", callback=address, help="Take exogenous actions over TCP too.")
@click.option("--journal", type=click.Path(), metavar="FILE", help="Write everything that happens to a new file.")
@click.option(
    "--stop-when-idle",
    type=Quantity(min=0),
    metavar="S",
    help="End with success when the program has waited for S seconds.",
)
@click.option(
    "--on-impossible-exog",
    "on_impossible",
    type=click.Choice(["apply", "drop", "stop"]),
    default="apply",
    show_default=True,
    help="What to do about an exogenous action that the theory thinks impossible.",
)
@click.option(
    "--on-surprising-sensing",
    "on_surprise",
    type=click.Choice(["apply", "stop"]),
    default="apply",
    show_default=True,
    help="What to do when a device senses what the theory thinks impossible.",
)
@click.option(
    "--on-failure",
    type=click.Choice(["ask", "retry", "next", "stop"]),
    help="What to do about an action that its device cannot do: ask (the default at a terminal), or stop.",
)
@click.option(
    "--check-invariants", is_flag=True, help="End the run as failed when an action or event has broken an invariant."
)
@click.option("--step", is_flag=True, help="Ask before each action.")
@click.option(
    "--speed",
    type=Quantity(0.01, 1000),
    default=1.0,
    show_default=True,
    help="How many simulated seconds pass in one; a simulated brick needs the same.",
)
@click.option("--seed", type=int, default=0, show_default=True, help="Of what the simulated brick leaves to chance.")
@click.option(
    "--world",
    type=click.Path(),
    metavar="FILE",
    help="The world of the simulated brick; none: only the theory. Default: FILE.toml beside the domain.",
)
@click.option("--picture", type=click.Path(), metavar="FILE", help="Draw that world in the end, from above, as SVG.")
@constants_option
@console_options
def command(
    console: Console,
    file: str,
    procedure: str,
    port: str | None,
    link: str,
    events: str | None,
    listen: tuple[str, int] | None,
    journal: str | None,
    stop_when_idle: float | None,
    on_impossible: Literal["apply", "drop", "stop"],
    on_surprise: Literal["apply", "stop"],
    on_failure: Literal["ask", "retry", "next", "stop"] | None,
    check_invariants: bool,
    step: bool,
    speed: float,
    seed: int,
    world: str | None,
    picture: str | None,
    constants: Mapping[str, str],
) -> int:
    """Run a program of FILE online: decide, have the devices act, and listen to the world.

    PROC is a procedure, with arguments where it takes some; the default is `control`. Without a port golc simulates the
    brick. Exogenous actions may be typed while it runs, one a line, such as `request_delivery(2, 5)`, and so may the
    commands !state, !history, !abort (stop what the devices do and go on) and !stop. However the run ends, the brick is
    told to stop first.

    \b
    golc run examples/delivery/delivery.gl
    golc run examples/delivery/delivery.gl --port /dev/ttyUSB0 --journal today.jsonl
    """
    if port not in (None, "sim") and (world is not None or picture is not None):
        raise click.UsageError("--world and --picture are for a simulated brick, not for one at a port")
    import sys

    from golc.api.loading import load
    from golc.runtime.running import run

    if on_failure is None:
        on_failure = "ask" if sys.stdin is not None and sys.stdin.isatty() else "stop"
    try:
        run(
            load(file, constants),
            procedure,
            port,
            voice=_voice(console),
            events=events,
            listen=listen,
            journal=journal,
            stop_when_idle=stop_when_idle,
            on_impossible=on_impossible,
            on_surprise=on_surprise,
            on_failure=on_failure,
            check_invariants=check_invariants,
            step=step,
            speed=speed,
            seed=seed,
            world=world,
            picture=picture,
        )
    except FileExistsError as error:
        problem = f"the journal {error} exists already; name another file, or remove that one first"
        raise click.UsageError(problem) from None
    return 0


def _voice(console: Console) -> Voice:
    """What the run says goes to stdout, what is wrong to stderr."""
    import sys

    from golc.rendering import render
    from golc.runtime.observers.trace import Style
    from golc.runtime.session import Voice

    encoding = (sys.stdout.encoding or "").lower().replace("-", "")
    style = Style(console.colored(sys.stdout), unicode=encoding.startswith("utf"))

    def complain(diagnostics: tuple[Diagnostic, ...]) -> None:
        for diagnostic in diagnostics:
            console.err(render(diagnostic, color=console.colored(sys.stderr)))

    return Voice(_write, complain, style, console.verbosity, stdin=True)


def _write(line: str) -> None:
    """A line to stdout; where nobody can read it any more, the run is to end."""
    from golc.diagnostics import DeviceError

    try:
        print(line, flush=True)
    except OSError as error:
        if error.errno in (errno.EPIPE, errno.EIO):
            raise BrokenPipeError("nobody reads the output any more") from None
        raise DeviceError(f"cannot write to standard output: {error.strerror}") from error
