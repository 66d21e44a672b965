"""The options of ``golc sim`` that go together: those of the port, of the line, and of byte code."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from golc.cli.options import Quantity, address, grouped

if TYPE_CHECKING:
    from golc.runtime.rcxsim.line import LineOptions
    from golc.runtime.rcxsim.ports import Port

F = TypeVar("F", bound=Callable[..., Any])


@dataclass(frozen=True)
class Plug:
    """Where the tower is to be plugged in: at a terminal, with a link to it or without, or at an address of TCP."""

    link: Path | None
    tcp: tuple[str, int] | None

    @property
    def given(self) -> dict[str, bool]:
        """The options, and whether they are given."""
        return {"--pty": self.link is not None, "--tcp": self.tcp is not None}

    def opened(self) -> Port:
        """The port; raises ``DeviceError`` if there cannot be such."""
        from golc.runtime.rcxsim.ports import PtyPort, TcpPort

        return PtyPort(self.link) if self.tcp is None else TcpPort(*self.tcp)


def plug_options(command: F) -> F:
    """Where the brick can be reached: the command gets a ``plug``."""
    path = click.Path(path_type=Path)
    return grouped(
        "plug",
        Plug,
        click.option("--pty", "link", type=path, metavar="PATH", help="Make a link to the terminal here."),
        click.option(
            "--tcp", metavar="HOST:PORT", callback=address, help="Listen here instead; port 0 is any free one."
        ),
    )(command)


Outages = tuple[tuple[float, float], ...]


def _outages(context: click.Context, parameter: click.Parameter, values: tuple[str, ...]) -> Outages:
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


def _chance(name: str, help_: str) -> Callable[[F], F]:
    return click.option(name, type=Quantity(0, 1), default=0.0, metavar="P", help=help_)


def _line(sleep: bool, **options: Any) -> LineOptions:
    from golc.runtime.rcxsim.line import TOWER_SLEEPS_AFTER, LineOptions

    return LineOptions(sleep=TOWER_SLEEPS_AFTER if sleep else None, **options)


def line_options(command: F) -> F:
    """What goes wrong between host and brick: the command gets ``line``, of ``LineOptions``."""
    return grouped(
        "line",
        _line,
        click.option(
            "--air-time",
            type=Quantity(0, 10),
            default=1.0,
            show_default=True,
            help="Factor on the air time of 2400 baud; 0: messages take no time.",
        ),
        _chance("--loss", "Chance that a message is lost."),
        _chance("--garble", "Chance that it is damaged."),
        _chance("--repeat", "Chance that it arrives twice."),
        _chance("--late", "Chance that it is late, by up to 0.5 s."),
        _chance("--noise", "Chance of noise before it."),
        click.option(
            "--off",
            "outages",
            multiple=True,
            metavar="FROM-TO",
            callback=_outages,
            help="Switch the brick off and on again at these seconds; may be repeated.",
        ),
        click.option(
            "--echo/--no-echo", default=True, help="Whether the tower echoes what the host sends, as serial ones do."
        ),
        click.option(
            "--sleep/--no-sleep", default=True, help="Whether the tower falls asleep after 4 s of the host's silence."
        ),
    )(command)


@dataclass(frozen=True)
class ByteCode:
    """What is asked for of a brick with a machine: ``seconds`` and ``steps`` let it run at once, without a port.

    ``target`` is ``rcx``, ``rcx2`` or not said; ``firmware`` has fields of the machine's options by name.
    """

    target: str | None
    firmware: Mapping[str, Any]
    seconds: float | None
    steps: int | None
    listing: bool

    @property
    def alone(self) -> dict[str, bool]:
        """The options for which no port is opened, and whether they are given."""
        return {"--for": self.seconds is not None, "--steps": self.steps is not None, "--listing": self.listing}

    @property
    def given(self) -> dict[str, bool]:
        """All of the options, and whether they are given."""
        return {"--target": self.target is not None, "--brick": bool(self.firmware), **self.alone}


def _firmware(context: click.Context, parameter: click.Parameter, values: tuple[str, ...]) -> dict[str, Any]:
    """What ``NAME=VALUE`` says of the fields of the machine's options."""
    from golc.runtime.rcxsim.machine.options import Options

    fields = {field.name: field for field in dataclasses.fields(Options) if field.name != "seed"}
    found: dict[str, Any] = {}
    for value in values:
        name, _, text = value.partition("=")
        if name not in fields:
            raise click.BadParameter(f"there is no {name!r}; there is {', '.join(fields)}")
        try:
            found[name] = _setting(text, fields[name].default)
        except ValueError as error:
            raise click.BadParameter(f"{value!r}: {error}") from None
    try:
        Options(**found)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None
    return found


def _setting(text: str, default: object) -> object:
    """A value of the kind that the default is of."""
    match default:
        case bool():
            if text not in ("yes", "no"):
                raise ValueError("it is yes or no")
            return text == "yes"
        case Enum():
            kinds = {kind.value: kind for kind in type(default)}
            if text not in kinds:
                raise ValueError(f"it is one of {', '.join(kinds)}")
            return kinds[text]
        case tuple():
            first, _, second = text.partition(",")
            return _number(first), _number(second)
        case _:
            return _number(text)


def _number(text: str) -> int:
    if not (text.isascii() and text.isdecimal()) or len(text) > 9:
        raise ValueError("it is a whole number from 0")
    return int(text)


def byte_code_options(command: F) -> F:
    """How a program is executed: the command gets ``byte_code``, a ``ByteCode``."""
    return grouped(
        "byte_code",
        ByteCode,
        click.option(
            "--target",
            type=click.Choice(["rcx", "rcx2"]),
            help="Byte code: firmware 1.0, or 2.0, of the empty brick, or for which FILE.nqc is compiled "
            "(default: rcx2).",
        ),
        click.option(
            "--brick",
            "firmware",
            multiple=True,
            metavar="NAME=VALUE",
            callback=_firmware,
            help="Byte code: how the firmware is, where that is not known; may be repeated.",
        ),
        click.option(
            "--for",
            "seconds",
            type=Quantity(0, 1e6),
            metavar="SECONDS",
            help="Byte code: let so many simulated seconds pass at once, without a port, and show how the brick "
            "stands.",
        ),
        click.option(
            "--steps",
            type=click.IntRange(1),
            metavar="N",
            help="Byte code: the same until the program has ended; after N op codes it is an error that it has not.",
        ),
        click.option("--listing", is_flag=True, help="Byte code: print the op codes as `nqc -L` does, and end."),
    )(command)
