"""Options that several commands share, and what options are made of."""

from __future__ import annotations

import contextlib
import functools
import logging
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar, cast

import click

from golc.cli.console import Console
from golc.diagnostics import GolcError
from golc.runtime.settings import FASTEST, SLOWEST

F = TypeVar("F", bound=Callable[..., Any])


class Quantity(click.FloatRange):
    """A real number within bounds; ``nan``, which is within any, and ``inf`` are none."""

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> float:
        number: float = super().convert(value, parameter, context)
        if not math.isfinite(number):
            self.fail(f"{value} is not a finite number.", parameter, context)
        return number


def grouped(name: str, build: Callable[..., object], *options: Callable[[F], F]) -> Callable[[F], F]:
    """Options that belong together: the command gets what ``build`` makes of them, as ``name``."""

    def decorate(command: F) -> F:
        @functools.wraps(command)
        def wrapper(**values: Any) -> Any:
            group = {option: values.pop(option) for option in names}
            return command(**values, **{name: build(**group)})

        parameters: list[click.Parameter] = wrapper.__dict__.setdefault("__click_params__", [])
        others = len(parameters)
        for option in reversed(options):
            option(wrapper)
        names = [parameter.name for parameter in parameters[others:]]
        return cast(F, wrapper)

    return decorate


def console_options(command: F) -> F:
    """``--color``, ``-q`` and ``-v``: the command gets a ``console``.

    That says what Python code is executed, and what error has ended the command.
    """

    @functools.wraps(command)
    def wrapper(**values: Any) -> Any:
        console: Console = values["console"]
        with _executing_said(console):
            try:
                return command(**values)
            except GolcError as error:
                console.error(error)
                return error.exit_code

    options = (
        click.option("-q", "--quiet", is_flag=True, help="Say only what went wrong."),
        click.option("-v", "--verbose", count=True, help="Say more."),
        click.option(
            "--color", type=click.Choice(["auto", "always", "never"]), default="auto", help="When to use color."
        ),
    )
    return cast(F, grouped("console", _console, *options)(wrapper))


def _console(color: str, quiet: bool, verbose: int) -> Console:
    return Console(color, -1 if quiet else verbose)


@contextlib.contextmanager
def _executing_said(console: Console) -> Iterator[None]:
    """Say of each Python file once that it is executed, before it is."""
    said: set[str] = set()

    def heard(record: logging.LogRecord) -> bool:
        if (text := record.getMessage()) not in said:
            said.add(text)
            console.note(text)
        return False

    logger = logging.getLogger("golc.python")
    level = logger.level
    logger.setLevel(logging.INFO)
    logger.addFilter(heard)
    try:
        yield
    finally:
        logger.removeFilter(heard)
        logger.setLevel(level)


def _definitions(context: click.Context, parameter: click.Parameter, values: tuple[str, ...]) -> Mapping[str, str]:
    constants: dict[str, str] = {}
    for value in values:
        name, equals, text = value.partition("=")
        if not equals or not name.strip() or not text.strip():
            raise click.BadParameter(f"{value!r} is not of the form NAME=VALUE")
        constants[name.strip()] = text.strip()
    return constants


constants_option = click.option(
    "-D",
    "constants",
    multiple=True,
    metavar="NAME=VALUE",
    callback=_definitions,
    help="Replace the value of a const; may be repeated.",
)
"""``-D NAME=VALUE``: the command gets ``constants``, a mapping from names to texts."""


def speed_option(advice: str) -> Callable[[F], F]:
    """``--speed X``, with a word about the other side: the command gets ``speed``."""
    return click.option(
        "--speed",
        type=Quantity(SLOWEST, FASTEST),
        default=1.0,
        show_default=True,
        help=f"How many simulated seconds pass in one; {advice}.",
    )


def at_most_one(given: Mapping[str, bool]) -> None:
    """A usage error if more than one of some options is given, each of which says by itself what is to be done."""
    if len(names := [name for name, is_given in given.items() if is_given]) > 1:
        raise click.UsageError(f"{' and '.join(names)} exclude each other")


def address(context: click.Context, parameter: click.Parameter, value: str | None) -> tuple[str, int] | None:
    """A callback for an option ``HOST:PORT``; port 0 is any free one."""
    if value is None:
        return None
    host, colon, port = value.rpartition(":")
    if not colon or not host or not (port.isascii() and port.isdecimal()) or int(port) > 65535:
        raise click.BadParameter(f"{value!r} is not of the form HOST:PORT, with a port from 0 (any free one) to 65535")
    return host.strip("[]"), int(port)
