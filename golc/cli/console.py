"""Where a command writes: results to stdout, everything else to stderr."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TextIO

from golc.diagnostics import DeviceError, Diagnostic, GolcError, ProgramError, UserError


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
