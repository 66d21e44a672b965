"""Runs a Python file that holds a theory, and finds the theory in it."""

from __future__ import annotations

import contextlib
import linecache
import os
import sys
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import ModuleType

from golc.diagnostics import Code, Diagnostic, Source, Span, UserError
from golc.embed.errors import refused
from golc.embed.failures import raised, syntax_error
from golc.embed.parts import Written
from golc.embed.places import source_of
from golc.embed.theory import Theory
from golc.theory.python_file import logger


def read_theory(path: str | Path) -> Written:
    """The tree of the theory in a Python file, which is run.

    What it prints goes to the standard error stream. Raises ``UserError`` if the file cannot be read or run, or does
    not hold exactly one theory; what is wrong with translated functions is among the findings of what is returned.
    """
    name = str(path)
    linecache.checkcache()
    source = _checked(name)
    logger.info("executes %s", name)
    module = ModuleType(f"golc_theory_{Path(path).stem}")
    module.__file__ = name
    with _running(module, Path(path).parent):
        try:
            exec(compile(source.text, name, "exec"), vars(module))
        except (KeyboardInterrupt, MemoryError):
            raise
        except BaseException as error:
            raise UserError(*raised(error, source), *_found_so_far(vars(module))) from None
        # Plain functions that translated ones call run only now; they, too, may print and import what lies beside.
        return _only_theory(vars(module), source).written()


def _checked(name: str) -> Source:
    """The source of a file that Python can compile."""
    from golc.syntax.text import read_source

    read = read_source(name, empty="a theory in Python begins with `from golc.embed import Theory`")
    source = source_of(name)
    try:
        with warnings.catch_warnings():
            # Python warns when it is compiled to be run.
            warnings.simplefilter("ignore")
            # Python keeps no lines of a file that says it is in an encoding that Python does not know.
            compile(source.text or read.text.encode(), name, "exec")
    except SyntaxError as error:
        raise UserError(syntax_error(error, source if source.text else read)) from None
    except (ValueError, RecursionError, MemoryError) as error:
        raise refused(Code.PYTHON_SYNTAX, f"Python cannot read this: {error}", Span(source, 0, 0)) from None
    return source


@contextlib.contextmanager
def _running(module: ModuleType, folder: Path) -> Iterator[None]:
    """The module can be found by its name and imports what lies beside it; the standard output is left to results.

    What it changes of the path and the current folder holds for itself alone.
    """
    path, modules, here = list(sys.path), dict(sys.modules), _current_folder()
    sys.modules[module.__name__] = module
    sys.path.insert(0, str(folder.resolve()))
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield
    finally:
        sys.path[:] = path
        if here is not None:
            os.chdir(here)
        # What lies beside one theory is not meant by the next, and may have changed when this one is read again.
        for name in _beside(folder.resolve(), [each for each in sys.modules if each.partition(".")[0] not in modules]):
            del sys.modules[name]
        sys.modules.pop(module.__name__, None)
        if module.__name__ in modules:
            sys.modules[module.__name__] = modules[module.__name__]


def _current_folder() -> str | None:
    """Where paths begin, which a theory may change for itself; none if that folder is gone."""
    try:
        return os.getcwd()  # noqa: PTH109
    except FileNotFoundError:
        return None


def _beside(folder: Path, names: list[str]) -> list[str]:
    """Those modules that come from a file of a folder, or from a package in it."""
    found = []
    for name in names:
        top = sys.modules.get(name.partition(".")[0])
        paths = [getattr(top, "__file__", None), *getattr(top, "__path__", ())]
        if any(isinstance(path, str) and folder in Path(path).parents[:2] for path in paths):
            found.append(name)
    return found


def _theories(names: Mapping[str, object]) -> list[Theory]:
    found: list[Theory] = []
    for value in names.values():
        if isinstance(value, Theory) and not any(value is each for each in found):
            found.append(value)
    return found


def _found_so_far(names: Mapping[str, object]) -> tuple[Diagnostic, ...]:
    """What is wrong with the functions of theories that a failing file has begun, as far as names are not to blame."""
    found = [diagnostic for theory in _theories(names) for diagnostic in theory.written().findings.diagnostics]
    return tuple(each for each in found if each.code not in (Code.UNKNOWN_NAME, Code.UNKNOWN_ACTION))


def _only_theory(names: Mapping[str, object], source: Source) -> Theory:
    theories = _theories(names)
    main = names.get("theory")
    if isinstance(main, Theory):
        return main
    if len(theories) == 1:
        return theories[0]
    start = Span(source, 0, 0)
    if not theories:
        help_ = 'begin it with `from golc.embed import Theory` and `theory = Theory("delivery")`'
        # Asked by identity, for terms have no `==` of Python's.
        if any(value is Theory for value in names.values()):
            help_ = "call the function that makes it where every import runs it: `theory = delivery(6)`"
        raise refused(Code.NO_THEORY, "the file makes no theory", start, help_)
    several = ", ".join(f"`{theory.name}`" for theory in theories)
    help_ = "name the one that is meant `theory`"
    raise refused(Code.NO_THEORY, f"the file makes several theories: {several}", start, help_)
