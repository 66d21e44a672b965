"""What a Python file defines, read off its text: nothing is executed."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterator
from dataclasses import dataclass

from golc.diagnostics import counted
from golc.theory.python_file import PythonError, PythonFile


@dataclass(frozen=True)
class Takes:
    """How many arguments a function takes: ``most`` is none if there is no limit. ``line`` defines it.

    ``named`` is a parameter that has to be given by name, which no call of golc does.
    """

    least: int
    most: int | None
    line: int
    named: str | None = None

    @property
    def said(self) -> str:
        """The number of arguments in words."""
        if self.most is None:
            return f"at least {counted(self.least, 'argument')}"
        return counted(self.most, "argument") if self.least == self.most else f"{self.least} to {self.most} arguments"


def unreadable(file: PythonFile) -> PythonError | None:
    """Why a file cannot be read as Python; none if it can."""
    try:
        _parsed(file)
    except PythonError as error:
        return error
    return None


def misfit(file: PythonFile, name: str, count: int) -> PythonError | None:
    """Why a function of a file cannot be called with a number of arguments; none as far as its text shows no reason."""
    try:
        definitions = _definitions(file)
    except PythonError as error:
        return error
    found = definitions.get(name)
    if not found:
        anything = "*" in definitions or "__getattr__" in definitions
        return None if anything else file.without(name, [*definitions])
    for definition in found:
        problem = _misfit(file, name, definition, count)
        if problem is None:
            return None
    return problem


def _misfit(file: PythonFile, name: str, node: ast.AST | None, count: int) -> PythonError | None:
    """Why what a name is bound to cannot be called so; of what is no plain function nothing is known."""
    match node:
        case ast.Constant() | ast.List() | ast.Dict() | ast.Set() | ast.Tuple() | ast.JoinedStr():
            return PythonError(f"`{name}` in {file.path} is not a function", file.line(node.lineno))
        case ast.AsyncFunctionDef(decorator_list=[]):
            reason = f"`{name}` in {file.path} is a coroutine, which has no value when it is called"
            return PythonError(reason, file.line(node.lineno), "define it with `def`")
        case ast.FunctionDef(decorator_list=[]) | ast.Lambda():
            takes = _takes(node)
        case _:
            return None
    place = file.line(takes.line)
    if takes.named is not None:
        reason = f"`{name}` in {file.path} needs `{takes.named}` by name, but arguments are given by place"
        return PythonError(reason, place, "leave out the `*` before it, or give it a default")
    if takes.least <= count and (takes.most is None or count <= takes.most):
        return None
    return PythonError(f"`{name}` in {file.path} takes {takes.said}, not {count}", place)


def _takes(node: ast.FunctionDef | ast.Lambda) -> Takes:
    args = node.args
    by_place = len(args.posonlyargs) + len(args.args)
    pairs = zip(args.kwonlyargs, args.kw_defaults, strict=True)
    named = next((parameter.arg for parameter, default in pairs if default is None), None)
    return Takes(by_place - len(args.defaults), None if args.vararg else by_place, node.lineno, named)


def _definitions(file: PythonFile) -> dict[str, list[ast.AST | None]]:
    """What each name of a module may be bound to; ``*`` if it has names that its text does not show."""
    found: dict[str, list[ast.AST | None]] = {}
    for statement in _statements(_parsed(file)):
        for name, node in _bound(statement):
            found.setdefault(name, []).append(node)
    return found


def _parsed(file: PythonFile) -> ast.Module:
    text = file.source.text
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # they are said when it is executed
            return ast.parse(text)
    except SyntaxError as error:
        place = None if error.lineno is None else file.line(error.lineno)
        raise PythonError(f"{file.path} is not Python: {error.msg}", place) from None
    except (ValueError, RecursionError, MemoryError):
        raise PythonError(f"{file.path} is not Python that can be read") from None


def _statements(module: ast.Module) -> Iterator[ast.stmt]:
    """The statements of a module outside of functions and classes, those inside `if`, `try` and the like too."""
    stack: list[ast.AST] = [module]
    while stack:
        node = stack.pop()
        if isinstance(node, ast.stmt):
            yield node
        if not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.expr)):
            stack.extend(reversed([*ast.iter_child_nodes(node)]))


def _bound(node: ast.stmt) -> Iterator[tuple[str, ast.AST | None]]:
    """The names that a statement binds, each with what defines it, as far as that shows."""
    match node:
        case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
            yield name, node
        case ast.Import(names=names) | ast.ImportFrom(names=names):
            for alias in names:
                yield alias.asname or alias.name.partition(".")[0], None
        case ast.Assign(targets=targets, value=value):
            for target in targets:
                yield from _targets(target, value)
        case ast.AnnAssign(target=target, value=ast.expr() as value):
            yield from _targets(target, value)
        case ast.For(target=target) | ast.AsyncFor(target=target):
            yield from _targets(target, None)


def _targets(target: ast.expr, value: ast.expr | None) -> Iterator[tuple[str, ast.AST | None]]:
    if isinstance(target, ast.Name):
        yield target.id, value
    else:
        yield from ((part.id, None) for part in ast.walk(target) if isinstance(part, ast.Name))
