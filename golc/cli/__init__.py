"""The command line: one command a module, loaded when it is called."""

from __future__ import annotations

import contextlib
import errno
import importlib
import io
import os
import sys
from collections.abc import Sequence
from typing import TextIO

import click

from golc.diagnostics import DeviceError, LimitError
from golc.theory.recursion import EVALUATION

COMMANDS = {
    "check": "golc.cli.check",
    "plan": "golc.cli.plan",
    "test": "golc.cli.test",
    "fmt": "golc.cli.fmt",
    "convert": "golc.cli.convert",
    "explain": "golc.cli.explain",
    "gen-nqc": "golc.cli.gen_nqc",
    "run": "golc.cli.run",
    "sim": "golc.cli.sim",
}
"""Each command's module, which has a click command named ``command``."""

UNWRITABLE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""What it means that standard output takes no more: a full disk, a limit, a terminal that is gone."""


class LazyGroup(click.Group):
    """A group whose commands are imported when they are asked for, so that starting stays quick."""

    def list_commands(self, context: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, context: click.Context, name: str) -> click.Command | None:
        if name not in COMMANDS:
            return None
        command: click.Command = importlib.import_module(COMMANDS[name]).command
        return command


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="golc")
def cli() -> None:
    """Golog for robots: check a domain, plan with it, generate its NQC, run it on a brick.

    \b
    golc check examples/delivery/delivery.gl
    golc run examples/delivery/delivery.gl
    """


def main(arguments: Sequence[str] | None = None) -> None:
    """Run a command and exit with the documented code; a bug leaves its traceback and exits 70."""
    sys.exit(invoke(arguments))


def invoke(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code; what goes wrong outside of the input is said here."""
    sys.setrecursionlimit(EVALUATION)
    _open_streams()
    try:
        code = cli.main(args=None if arguments is None else list(arguments), prog_name="golc", standalone_mode=False)
        sys.stdout.flush()
        return code if isinstance(code, int) else 0
    except BaseException as error:
        return _code(error)
    finally:
        _let_go(sys.stdout)
        _let_go(sys.stderr)


def _code(error: BaseException) -> int:
    """Say what went wrong, and the exit code that stands for it."""
    match error:
        case click.exceptions.Exit():
            return error.exit_code
        case click.ClickException():
            with contextlib.suppress(OSError):
                error.show()
            return error.exit_code
        case click.Abort() | KeyboardInterrupt():
            _tell("interrupted")
            return 130
        case BrokenPipeError():
            return 141
        case SystemExit(code=1) if "_GOLC_COMPLETE" not in os.environ:  # so click ends where nobody reads
            return 141
        case OSError(__context__=KeyboardInterrupt()):  # of a terminal that was closed, which click could not tell so
            return 130
        case OSError(errno=number, filename=None) if number in UNWRITABLE:
            _tell(f"error: cannot write the output: {error.strerror}")
            return DeviceError.exit_code
        case MemoryError():
            _tell("error: gave up: there is no memory left")
            return LimitError.exit_code
        case Exception():
            import traceback

            _tell("".join(traceback.format_exception(error)))
            _tell("This is a bug in golc. Please report it with the text above and the input that led to it.")
            return 70
    raise error


def _open_streams() -> None:
    """Open the standard streams that the caller has closed, so that no other file is taken for one of them."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)  # the lowest that is free: this one
    if sys.stdout is None:
        sys.stdout = os.fdopen(1, "w", encoding="utf-8", closefd=False)
    if sys.stderr is None:
        sys.stderr = os.fdopen(2, "w", encoding="utf-8", closefd=False)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # as stderr does with what its encoding cannot say


def _let_go(stream: TextIO) -> None:
    """Where the last of the output cannot be written, Python is not to complain of it at its end."""
    try:
        stream.flush()
    except OSError:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, stream.fileno())
        os.close(null)


def _tell(text: str) -> None:
    """Say something on stderr, if anybody can hear it."""
    with contextlib.suppress(OSError):
        print(text, file=sys.stderr, flush=True)
