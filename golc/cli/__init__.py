"""The command line: one command a module, loaded when it is called."""

from __future__ import annotations

import importlib
import io
import sys
from collections.abc import Sequence

import click

from golc.diagnostics import DeviceError, Diagnostic, GolcError, ProgramError, UserError
from golc.theory.recursion import EVALUATION

COMMANDS = {
    "check": "golc.cli.check",
    "plan": "golc.cli.plan",
    "test": "golc.cli.test",
    "gen-nqc": "golc.cli.gen_nqc",
    "run": "golc.cli.run",
    "sim": "golc.cli.sim",
}
"""Each command's module, which has a click command named ``command``."""


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
    """Run a command and return its exit code; every error that golc raises on purpose is said in one place."""
    sys.setrecursionlimit(EVALUATION)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # as stderr does with what its encoding cannot say
    try:
        code = cli.main(args=None if arguments is None else list(arguments), prog_name="golc", standalone_mode=False)
        return code if isinstance(code, int) else 0
    except click.exceptions.Exit as exit_:
        return exit_.exit_code
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (click.Abort, KeyboardInterrupt):
        print("interrupted", file=sys.stderr)
        return 130
    except GolcError as error:
        _say(error)
        return error.exit_code
    except BrokenPipeError:
        return _broken_pipe()
    except Exception:
        import traceback

        traceback.print_exc()
        print(
            "\nThis is a bug in golc. Please report it with the text above and the input that led to it.",
            file=sys.stderr,
        )
        return 70


def _say(error: GolcError) -> None:
    match error:
        case UserError(diagnostics=diagnostics):
            _render(*diagnostics)
        case ProgramError(diagnostic=diagnostic):
            _render(diagnostic)
        case _:
            print(f"error: {error}", file=sys.stderr)
            if isinstance(error, DeviceError) and error.help:
                print(f"  = help: {error.help}", file=sys.stderr)


def _render(*diagnostics: Diagnostic) -> None:
    from golc.cli.common import Console
    from golc.rendering import render

    for diagnostic in diagnostics:
        print(render(diagnostic, color=Console().colored(sys.stderr)), file=sys.stderr)


def _broken_pipe() -> int:
    """The reader of our output went away: end quietly, as other tools do."""
    import os

    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 141
