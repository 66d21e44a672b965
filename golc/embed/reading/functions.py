"""A Python function that is translated: its source, its parameters, and what its names mean where it stands."""

from __future__ import annotations

import ast
import builtins
import inspect
import re
import reprlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from types import CodeType, FrameType, FunctionType
from typing import Any

from golc.diagnostics import Code, Label, Source, Span
from golc.embed.errors import meaningless, refused
from golc.embed.places import caller, calling_frame, offset, source_of, span_of, tree_of
from golc.embed.values import Meaningful
from golc.syntax.python_names import golc_name
from golc.theory.suggest import did_you_mean

ABSENT = object()
_SHORT = reprlib.Repr()
_SHORT.maxother = 100
MUTABLE = (list, dict, set, bytearray)
_DEFINED = re.compile(r"def[\s\\]+(\w+)")


@dataclass(frozen=True)
class Function:
    """A function under a decorator, with what its names stood for at that moment.

    ``frame`` is where it was declared: annotations may name its local variables. ``fixed`` are the values of
    parameters with defaults.
    """

    function: FunctionType
    source: Source
    node: ast.FunctionDef
    frame: FrameType
    seen: dict[str, object] = field(default_factory=dict)
    fixed: dict[str, object] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The name in the language that the function's own name stands for."""
        return golc_name(self.function.__name__)

    @property
    def name_span(self) -> Span:
        """Where the name is written, behind ``def``."""
        # Python's tree has letters of a name in their normal form, the source as they were typed.
        found = _DEFINED.match(self.source.text, offset(self.source, self.node.lineno, self.node.col_offset))
        assert found is not None, "a definition"
        return Span(self.source, *found.span(1))

    @property
    def span(self) -> Span:
        """All of it, decorators included."""
        whole = span_of(self.source, self.node)
        first = self.node.decorator_list[0]
        # The sign @ stands before the decorator.
        return Span(self.source, self.source.text.rindex("@", 0, span_of(self.source, first).start), whole.end)

    def place(self, node: Any) -> Span:
        """The place of a node of Python's tree in this function."""
        return span_of(self.source, node)

    def parameters(self) -> list[ast.arg]:
        """The parameters without defaults, which are those of the language."""
        args = self.node.args
        every = [*args.posonlyargs, *args.args, *args.kwonlyargs]
        return [arg for arg in every if arg.arg not in self.fixed]

    def body(self) -> list[ast.stmt]:
        """The statements, without a docstring and without ``...``."""
        return [node for node in self.node.body if not _says_nothing(node)]

    def value_of(self, name: ast.Name) -> object:
        """What a name of Python stands for where the function is. Raises ``Refused`` if for nothing."""
        value = self.lookup(name.id)
        if value is ABSENT:
            known = [each for each in self._visible() if not each.startswith("_")]
            help_ = (
                did_you_mean(name.id, known) or "assign it, declare it with the theory, or import it from `golc.embed`"
            )
            message = f"`{name.id}` is neither a Python constant nor declared"
            raise refused(Code.UNKNOWN_NAME, message, self.place(name), help_)
        then = self.seen.get(name.id, ABSENT)
        fresh = then is ABSENT or then is vars(builtins).get(name.id)
        if not fresh and then is not value and not _alike(then, value):
            raise self._changed(name, then, value)
        return value

    def lookup(self, name: str) -> object:
        """What a name is bound to in Python; ``ABSENT`` if to nothing."""
        if name in self.fixed:
            return self.fixed[name]
        cells = dict(zip(self.function.__code__.co_freevars, self.function.__closure__ or (), strict=True))
        if name in cells:
            try:
                return cells[name].cell_contents
            except ValueError:
                return ABSENT
        scopes = [self.function.__globals__, vars(builtins)]
        # What is bound around the function is meant by annotations; for Python itself its body does not see a class.
        scopes.insert(len(scopes) if name in self.seen else 0, self.frame.f_locals)
        for scope in scopes:
            if name in scope:
                return scope[name]
        return ABSENT

    def _visible(self) -> Iterator[str]:
        yield from self.function.__code__.co_freevars
        yield from self.frame.f_locals
        yield from self.function.__globals__

    def _changed(self, name: ast.Name, then: object, now: object) -> Exception:
        was, is_now = _shown(then), _shown(now)
        return refused(
            Code.PYTHON_CHANGED,
            f"`{name.id}` was {was} when the function was declared and is {'another' if is_now == was else is_now} now",
            self.place(name),
            f"give it to the function as a default: `def {self.node.name}(…, {name.id}={name.id}):`",
            (Label(self.name_span, "the function is translated when the theory is complete"),),
        )


def _alike(then: object, now: object) -> bool:
    """Whether one constant took the place of an equal one."""
    if isinstance(then, tuple) and isinstance(now, tuple):
        return len(then) == len(now) and all(x is y or _alike(x, y) for x, y in zip(then, now, strict=True))
    return type(then) is type(now) and isinstance(then, (int, str, float, bool)) and then == now


def _shown(value: object) -> str:
    """A Python value for a message; of one that cannot be shown its type."""
    try:
        return re.sub(" at 0x[0-9a-f]+", "", _SHORT.repr(value))
    except Exception:
        return f"a `{type(value).__name__}`"


def _says_nothing(node: ast.stmt) -> bool:
    return (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str | type(...))
    )


def translated(function: object) -> Function:
    """The function that a decorator has been given, with its source. Raises ``Refused`` if it cannot be translated."""
    span = caller()
    if isinstance(function, str):
        message = "the name of what is declared is that of its function, or given by `name=`"
        raise meaningless(message, span, f'write `name="{function}"`')
    if not isinstance(function, FunctionType):
        help_ = "write the decorator with `@` right above the `def` of what it declares"
        if isinstance(function, Meaningful):
            help_ = "of two decorators the upper one gets what the lower one makes, which is no function"
        raise meaningless("only a function written with `def` can be translated", span, help_)
    code = function.__code__
    source = source_of(code.co_filename)
    if not source.text:
        help_ = "keep the theory in a file or in a cell of a notebook"
        raise meaningless(f"the source of `{function.__name__}` is not to be found", span, help_)
    node = _definition(source, code)
    if node is None:
        help_ = "write the decorator with `@` right above the `def` of what it declares, without `async`"
        raise meaningless("only a function written with `def` can be translated", span, help_)
    made = Function(function, source, node, calling_frame())
    _check_head(made)
    made.fixed.update(_defaults(made))
    made.seen.update(dict.fromkeys(_names(code), ABSENT))
    made.seen.update({name: made.lookup(name) for name in made.seen})
    return made


def _definition(source: Source, code: CodeType) -> ast.FunctionDef | None:
    """The ``def`` of a function, whose code begins in the line of its first decorator."""
    return _definitions(source).get((code.co_name, code.co_firstlineno))


@cache
def _definitions(source: Source) -> dict[tuple[str, int], ast.FunctionDef]:
    """The decorated functions of a source by their name and the line of their first decorator."""
    functions = (node for node in ast.walk(tree_of(source)) if isinstance(node, ast.FunctionDef))
    return {(node.name, node.decorator_list[0].lineno): node for node in functions if node.decorator_list}


def _names(code: CodeType) -> set[str]:
    """Every name from outside that a function or a comprehension in it uses."""
    names = {*code.co_names, *code.co_freevars}
    return names.union(*(_names(inner) for inner in code.co_consts if isinstance(inner, CodeType)))


def _check_head(function: Function) -> None:
    args = function.node.args
    for arg, sign in ((args.vararg, "*"), (args.kwarg, "**")):
        if arg is not None:
            help_ = "give each parameter a name and a type"
            raise meaningless(f"`{sign}{arg.arg}` is no parameter of the language", function.place(arg), help_)
    if len(function.node.decorator_list) > 1:
        second = function.place(function.node.decorator_list[1])
        message = "a second decorator would not be seen: the function is translated, not run"
        raise meaningless(message, second, "leave one of them out")


def _defaults(function: Function) -> dict[str, object]:
    """The values of the parameters with defaults: constants of Python."""
    given = {
        name: parameter.default
        for name, parameter in inspect.signature(function.function).parameters.items()
        if parameter.default is not inspect.Parameter.empty
    }
    for arg in [*function.node.args.posonlyargs, *function.node.args.args, *function.node.args.kwonlyargs]:
        if isinstance(given.get(arg.arg), MUTABLE):
            kind = type(given[arg.arg]).__name__
            help_ = "use a tuple or a frozenset, or a name of the module"
            message = f"the default of `{arg.arg}` is a {kind}, which may change after the function was declared"
            raise meaningless(message, function.place(arg), help_)
    return given
