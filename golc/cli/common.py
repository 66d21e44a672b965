"""What every command shares: options, loading a theory, and writing to the two streams."""

from __future__ import annotations

import contextlib
import functools
import math
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any, TextIO, TypeVar, cast

import click

from golc.diagnostics import DeviceError, Diagnostic, GolcError, ProgramError, UserError

F = TypeVar("F", bound=Callable[..., Any])


@dataclass(frozen=True)
class Console:
    """Where a command writes: results to stdout, diagnostics and progress to stderr.

    ``color`` is ``auto``, ``always`` or ``never``; ``verbosity`` is -1 with ``-q``, 0, or the number of ``-v``.
    """

    color: str = "auto"
    verbosity: int = 0

    def colored(self, stream: TextIO) -> bool:
        """Whether to color what goes to a stream: asked for, or a terminal and no ``NO_COLOR``."""
        if self.color == "auto":
            return stream.isatty() and not os.environ.get("NO_COLOR")
        return self.color == "always"

    def out(self, text: str) -> None:
        """A result."""
        print(text, file=sys.stdout, flush=True)

    def err(self, text: str) -> None:
        """A diagnostic; never silenced, but lost where nobody can read it."""
        with contextlib.suppress(OSError):
            print(text, file=sys.stderr, flush=True)

    def findings(self, findings: Iterable[Diagnostic], gap: bool = True) -> None:
        """Findings in full, each with an empty line behind it unless there is to be no ``gap``; never silenced."""
        for finding in findings:
            self.err(self._rendered(finding) + "\n" * gap)

    def _rendered(self, finding: Diagnostic) -> str:
        from golc.rendering import render

        return render(finding, self.colored(sys.stderr))

    def error(self, error: GolcError) -> None:
        """What has ended the command."""
        match error:
            case UserError(diagnostics=diagnostics):
                self.err("\n\n".join(map(self._rendered, diagnostics)))
            case ProgramError(diagnostic=diagnostic):
                self.err(self._rendered(diagnostic))
            case _:
                self.err(f"error: {error}")
                if isinstance(error, DeviceError) and error.help:
                    self.err(f"  = help: {error.help}")

    def note(self, text: str) -> None:
        """What is good to know; silent under ``-q``."""
        if self.verbosity >= 0:
            self.err(text)


class Quantity(click.FloatRange):
    """A real number within bounds; ``nan``, which is within any, and ``inf`` are none."""

    def convert(self, value: Any, parameter: click.Parameter | None, context: click.Context | None) -> float:
        number: float = super().convert(value, parameter, context)
        if not math.isfinite(number):
            self.fail(f"{value} is not a finite number.", parameter, context)
        return number


def _definitions(context: click.Context, parameter: click.Parameter, values: tuple[str, ...]) -> Mapping[str, str]:
    constants: dict[str, str] = {}
    for value in values:
        name, equals, text = value.partition("=")
        if not equals or not name.strip() or not text.strip():
            raise click.BadParameter(f"{value!r} is not of the form NAME=VALUE")
        constants[name.strip()] = text.strip()
    return constants


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
    import logging

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
        type=Quantity(0.01, 1000),
        default=1.0,
        show_default=True,
        help=f"How many simulated seconds pass in one; {advice}.",
    )


def address(context: click.Context, parameter: click.Parameter, value: str | None) -> tuple[str, int] | None:
    """A callback for an option ``HOST:PORT``; port 0 is any free one."""
    if value is None:
        return None
    host, colon, port = value.rpartition(":")
    if not colon or not host or not (port.isascii() and port.isdecimal()) or int(port) > 65535:
        raise click.BadParameter(f"{value!r} is not of the form HOST:PORT, with a port from 0 (any free one) to 65535")
    return host.strip("[]"), int(port)


def patch(name: str, before: str, after: str, how: str) -> Iterator[str]:
    """The lines of a patch that makes one text of a file another one; ``how`` tells the second one's name."""
    from difflib import unified_diff

    old, new = (list(StringIO(text, newline="\n")) for text in (before, after))
    for line in unified_diff(old, new, name, f"{name} ({how})"):
        yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


@contextlib.contextmanager
def completed(path: Path) -> Iterator[TextIO]:
    """A stream to a file that takes its place, with its permissions, at the end; a pipe or a device is written to and
    never replaced."""
    if path.exists() and not path.is_file():
        with path.open("w", encoding="utf-8", newline="") as stream:
            yield stream
        return
    partial = path.with_name(f".golc-{os.getpid()}.part")
    with partial.open("x", encoding="utf-8", newline="") as stream:
        try:
            yield stream
            stream.flush()
            if path.exists():
                partial.chmod(path.stat().st_mode & 0o7777)
            partial.replace(path)
        finally:
            partial.unlink(missing_ok=True)


def written(console: Console, name: str, text: str) -> bool:
    """Write the text of a file, all of it or nothing, where it really is; whether that has gone well, which is said."""
    try:
        with completed(Path(os.path.realpath(name))) as stream:
            stream.write(text)
    except OSError as error:
        console.err(f"error: `{name}` cannot be written: {error.strerror or error}")
        return False
    if console.verbosity >= 0:
        console.out(f"wrote {name}")
    return True
