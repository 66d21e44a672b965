"""Python files whose functions a theory calls: each is executed once, when it is first needed, if it is trusted.

What a file defines can be seen without that (``python_text``).
"""

from __future__ import annotations

import hashlib
import logging
import os
import sys
import traceback
from collections.abc import Callable
from functools import cached_property
from inspect import unwrap
from pathlib import Path
from types import CodeType, ModuleType
from typing import TypeAlias, TypeVar

from golc.diagnostics import Code, Diagnostic, Label, Source, Span, UserError
from golc.syntax.text import read_source
from golc.theory.suggest import did_you_mean

logger = logging.getLogger("golc.python")
"""Says at level INFO, before a file is executed, that it is."""

Function: TypeAlias = Callable[..., object]
T = TypeVar("T")


def failure(error: BaseException) -> str:
    """An exception in one line, its type and what it says."""
    said = traceback.TracebackException.from_exception(error)
    said.__notes__ = None
    return " ".join([*said.format_exception_only()][-1].split())


class PythonError(Exception):
    """Python code cannot be used, or has failed: why, the place in the file if there is one, and what helps."""

    def __init__(self, reason: str, place: Span | None = None, help: str | None = None) -> None:
        super().__init__(reason)
        self.place = place
        self.help = help

    @property
    def labels(self) -> tuple[Label, ...]:
        """The place in the file, for a finding."""
        return () if self.place is None else (Label(self.place, ""),)

    def finding(self, span: Span) -> Diagnostic:
        """What is to be said where a domain names the function."""
        return Diagnostic(Code.PYTHON, str(self), span, labels=self.labels, help=self.help)


class NotTrustedError(PythonError):
    """Nobody has said that a file may be executed."""


class PythonFile:
    """A file of Python functions. ``path`` is what messages call it. Methods raise ``PythonError``."""

    def __init__(self, path: Path, trusted: bool) -> None:
        self.path = path
        self.trusted = trusted
        self._module: ModuleType | None = None
        self._failure: PythonError | None = None

    @cached_property
    def source(self) -> Source:
        """Its text, as it was when it was first asked for; that is what is executed."""
        try:
            return read_source(self.path, empty="it is to define functions: `def f(x): …`")
        except UserError as error:
            (found,) = error.diagnostics
            place = found.span if found.span.source.text else None
            raise PythonError(found.message, place, found.help or self._other_name()) from None

    def _other_name(self) -> str | None:
        meant = f"{self.path}.py"
        return f"did you mean `{self.path.name}.py`?" if os.path.isfile(meant) else None  # noqa: PTH113

    def function(self, name: str) -> Function:
        """A function of the file, which is executed if it was not yet."""
        module = self._loaded()
        function = getattr(module, name, None)
        if callable(function):
            return function  # type: ignore[no-any-return]
        if function is not None:
            raise PythonError(f"`{name}` in {self.path} is not a function")
        raise self.without(name, [key for key, value in vars(module).items() if callable(value)])

    def without(self, name: str, names: list[str]) -> PythonError:
        """The error that a function is not there, only those with other names."""
        help_ = did_you_mean(name, names) or f"define it: `def {name}(…): …`"
        return PythonError(f"{self.path} has no function `{name}`", None, help_)

    def guarded(self, what: str, call: Callable[[], T]) -> T:
        """The result of foreign code; whatever it raises, but an interrupt of the run, is a ``PythonError``."""
        try:
            return call()
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            line = self._line(error)
            where = str(self.path) if line is None else f"{self.path}:{line}"
            place = None if line is None else self.line(line)
            raise PythonError(f"{what} failed at {where}: {failure(error)}", place) from error

    def definition(self, function: Function) -> Span | None:
        """The line of this file where a function is defined; none if it comes from elsewhere."""
        code = getattr(unwrap(function), "__code__", None)
        if isinstance(code, CodeType) and code.co_filename == self._name:
            return self.line(code.co_firstlineno)
        return None

    def line(self, number: int) -> Span:
        """A line of its text, without the blanks around it."""
        source = self.source
        start = source.line_starts[min(max(number, 1), len(source.line_starts)) - 1]
        text = source.text[start:].split("\n", 1)[0]
        begin = start + len(text) - len(text.lstrip())
        return Span(source, begin, max(begin, start + len(text.rstrip())))

    @cached_property
    def _name(self) -> str:
        return str(self.path.resolve())

    def _loaded(self) -> ModuleType:
        if not self.trusted:
            raise NotTrustedError(f"{self.path} is not executed")
        if self._failure is not None:
            raise self._failure.with_traceback(None)
        if self._module is None:
            try:
                self._module = self._executed()
            except PythonError as error:
                self._failure = error  # executing it again would not be what its writer expects
                raise
        return self._module

    def _executed(self) -> ModuleType:
        """The file as a module of its own; its folder is on the path for what it imports."""
        text = self.source.text
        logger.info("executes %s", self.path)
        module = ModuleType(f"golc_{self.path.stem}_{hashlib.sha256(self._name.encode()).hexdigest()[:8]}")
        module.__file__ = self._name
        folder = str(Path(self._name).parent)
        if folder not in sys.path:
            sys.path.insert(0, folder)
        sys.modules[module.__name__] = module  # what dataclasses and pickle look up
        self.guarded(f"loading {self.path.name}", lambda: exec(compile(text, self._name, "exec"), module.__dict__))
        return module

    def _line(self, error: BaseException) -> int | None:
        """The last line of the file that the exception went through."""
        if isinstance(error, SyntaxError) and error.filename == self._name:
            return error.lineno
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename == self._name]
        return frames[-1].lineno if frames else None


class PythonFiles:
    """The Python files of one theory: what is one file is executed once, whoever calls it."""

    def __init__(self, trusted: bool = False) -> None:
        self.trusted = trusted
        self._files: dict[Path, PythonFile] = {}

    def file(self, path: Path) -> PythonFile:
        """The file at a path."""
        try:
            return self._files.setdefault(path.resolve(), PythonFile(path, self.trusted))
        except (OSError, ValueError, RuntimeError):  # no file can have such a name, which reading it will say
            return PythonFile(path, self.trusted)
