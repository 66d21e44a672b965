"""``golc run``: online execution."""

from __future__ import annotations

import errno
import re
import sys
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Unpack, get_args

import click

from golc.cli.console import Console
from golc.cli.options import Quantity, address, console_options, constants_option, speed_option
from golc.runtime.settings import SIMULATED, OnFailure, OnImpossible, OnSurprise, Options

if TYPE_CHECKING:
    from golc.runtime.conversation import Voice

COMMANDS = re.compile(r"\x1b(?!\[[0-9;]*m)|[\x00-\x08\x0b-\x1a\x1c-\x1f\x7f-\x9f]")
"""What could command a terminal, besides colors: a text may have been reported over a network."""


def _at_a_failure() -> OnFailure:
    """Somebody at a terminal can be asked."""
    return "ask" if sys.stdin is not None and sys.stdin.isatty() else "stop"


@click.command(name="run", short_help="Run a program online, on a brick or a simulated one.")
@click.argument("file", type=click.Path())
@click.argument("procedure", metavar="[PROC]", default="control")
@click.option("--port", metavar="P", help="A tty, a pty, a pySerial URL, usb:PATH, or `sim`, which is the default.")
@click.option(
    "--link",
    type=click.Choice(["auto", "classic"]),
    default="auto",
    show_default=True,
    expose_value=False,  # there is no other protocol yet
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
    type=click.Choice(get_args(OnImpossible)),
    default="apply",
    show_default=True,
    help="What to do about an exogenous action that the theory thinks impossible.",
)
@click.option(
    "--on-surprising-sensing",
    "on_surprise",
    type=click.Choice(get_args(OnSurprise)),
    default="apply",
    show_default=True,
    help="What to do when a device senses what the theory thinks impossible.",
)
@click.option(
    "--on-failure",
    type=click.Choice(get_args(OnFailure)),
    default=_at_a_failure,
    show_default=False,
    help="What to do about an action that its device cannot do: ask (the default at a terminal), or stop.",
)
@click.option(
    "--check-invariants", is_flag=True, help="End the run as failed when an action or event has broken an invariant."
)
@click.option("--step", is_flag=True, help="Ask before each action.")
@speed_option("a simulated brick needs the same")
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
    constants: Mapping[str, str],
    **options: Unpack[Options],
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
    if port not in (None, SIMULATED) and (options["world"] is not None or options["picture"] is not None):
        raise click.UsageError("--world and --picture are for a simulated brick, not for one at a port")
    from golc.api.loading import load
    from golc.runtime.running import run

    try:  # a run may go on for weeks, and who wants a record of it has the journal
        run(load(file, constants), procedure, port, voice=_voice(console), remember=0, **options)
    except FileExistsError as error:
        problem = f"the journal {error} exists already; name another file, or remove that one first"
        raise click.UsageError(problem) from None
    return 0


def _voice(console: Console) -> Voice:
    """What the run says goes to stdout, what is wrong to stderr."""
    from golc.runtime.conversation import Voice
    from golc.runtime.observers.trace import Style

    encoding = (sys.stdout.encoding or "").lower().replace("-", "")
    style = Style(console.colored(sys.stdout), unicode=encoding.startswith("utf"))

    return Voice(_write, partial(console.findings, gap=False), style, console.verbosity, stdin=True)


def _write(line: str) -> None:
    """A line to stdout; where nobody can read it any more, the run is to end."""
    from golc.diagnostics import DeviceError
    from golc.rendering import visible

    try:
        print(COMMANDS.sub(lambda found: visible(found.group()), line), flush=True)
    except OSError as error:
        if error.errno in (errno.EPIPE, errno.EIO):
            raise BrokenPipeError("nobody reads the output any more") from None
        raise DeviceError(f"cannot write to standard output: {error.strerror}") from error
