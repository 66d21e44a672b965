"""What Python itself makes of an expression in a translated function: constants, attributes, plain functions."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator
from types import BuiltinFunctionType

from golc.diagnostics import Code, Label, UserError
from golc.embed.asked import looked_up, translating
from golc.embed.cures import cure
from golc.embed.errors import meaningless, refused
from golc.embed.places import code_span, innermost, source_of
from golc.embed.reading.functions import Function
from golc.embed.terms import Term, variable
from golc.embed.types import TypeHandle, TypeObject, enum, interval, is_built_in, optional, symbols, symbols_of, union
from golc.embed.values import is_unsettled
from golc.embed.words import Value, Word
from golc.syntax.python_names import golc_name
from golc.theory.python_file import failure
from golc.theory.suggest import did_you_mean

NOT_PYTHON = object()
"""The answer for an expression that is one of the language."""

_OURS = (interval, enum, union, optional, symbols, abs, all, any, len, list, max, min, set, sum)
"""The functions that mean something in the language."""


def _is_ours(value: object) -> bool:
    """Whether a value is a function that means something in the language; terms have no ``==`` of Python's."""
    return any(value is each for each in _OURS)


def _holds_terms(value: object) -> bool:
    """Whether a value is one of the language, or a collection with one in it."""
    if isinstance(value, (list, tuple, set, frozenset)):
        return any(_holds_terms(each) for each in value)
    if isinstance(value, dict):
        return any(_holds_terms(each) for each in (*value.keys(), *value.values()))
    return isinstance(value, (Term, Word, Value, TypeObject)) or _is_ours(value) or is_built_in(value)


def _is_part_of_ours(base: object) -> bool:
    """Whether the language has a meaning for something, so that an attribute or element of it is not Python's."""
    return base is NOT_PYTHON or isinstance(base, (Term, Word, TypeHandle)) or is_built_in(base)


class Evaluator:
    """Evaluates what is Python's own in one function; ``bound`` tells which names are variables of the language."""

    def __init__(self, function: Function, bound: Callable[[str], bool]) -> None:
        self.function = function
        self.bound = bound

    def name(self, node: ast.Name) -> object:
        """What a name stands for: a variable of the language, or what it is bound to in Python."""
        return variable(golc_name(node.id)) if self.bound(node.id) else self.function.value_of(node)

    def __call__(self, node: ast.expr) -> object:
        """The value of an expression that Python can evaluate, else ``NOT_PYTHON``.

        Attributes, subscripts and calls are Python's if they are those of a Python object; other operations if every
        name in them stands for a constant of Python. Raises ``Refused`` where Python fails.
        """
        match node:
            case ast.Name():
                return self.name(node)
            case ast.Attribute():
                return self._attribute(node)
            case ast.Subscript():
                return self._subscript(node)
            case ast.Call():
                return self._called(node)
            case ast.Constant() | ast.Lambda():
                return NOT_PYTHON
        return self._run(node) if self._constant(node) else NOT_PYTHON

    def _attribute(self, node: ast.Attribute) -> object:
        base = self(node.value)
        if isinstance(base, TypeHandle):
            return self._symbol(base, node)
        return NOT_PYTHON if _is_part_of_ours(base) else self._run(node)

    def _symbol(self, base: TypeHandle, node: ast.Attribute) -> object:
        try:
            names = symbols_of(base)
        except UserError as error:
            (found,) = error.diagnostics
            raise refused(found.code, found.message, self.function.place(node), found.help) from None
        if node.attr not in names:
            message = f"the type `{base}` has no symbol `{node.attr}`"
            raise refused(Code.UNKNOWN_NAME, message, self.function.place(node), did_you_mean(node.attr, names))
        return names[node.attr]

    def _subscript(self, node: ast.Subscript) -> object:
        base = self(node.value)
        if isinstance(base, (list, tuple, dict)):
            self._check_index(node, base.values() if isinstance(base, dict) else base)
        return NOT_PYTHON if _is_part_of_ours(base) else self._run(node)

    def _check_index(self, node: ast.Subscript, values: Iterable[object]) -> None:
        """Raise ``Refused`` for the index of a Python list or dictionary that is not known yet."""
        if not any(is_unsettled(self.name(each)) for each in free_names(node.slice)):
            return
        help_ = "make it a static, whose value is a table: `start = theory.static(…)`"
        if any(map(is_unsettled, values)):
            help_ = "go through the list itself, `for x in …`, or declare one fluent with a parameter for all of it"
        raise looked_up(self.function.place(node), help_)

    def _called(self, node: ast.Call) -> object:
        called = self(node.func)
        ours = called is NOT_PYTHON or isinstance(called, (Term, Word, Value))
        if ours or (_is_ours(called) and not self._constant(node)):
            return NOT_PYTHON
        value = None if called is print else self._run(node)
        if value is None and isinstance(called, BuiltinFunctionType):
            message = f"`{called.__name__}` gives no value, and what it does is not a part of the theory"
            help_ = 'a program writes `say(f"…")`' if called is print else None
            raise meaningless(message, self.function.place(node), help_)
        return value

    def _constant(self, node: ast.expr) -> bool:
        """Whether there are names in an expression that mean nothing in the language, and all in it is Python's."""
        values = [self.name(each) for each in free_names(node)]
        return not all(_is_ours(value) or is_built_in(value) for value in values) and self._plain(node)

    def _plain(self, node: ast.expr) -> bool:
        match node:
            case ast.Constant():
                return True
            case ast.Await() | ast.Yield() | ast.YieldFrom() | ast.NamedExpr() | ast.Starred():
                return False
            case ast.BinOp(left=left, right=right):
                return self._plain(left) and self._plain(right)
            case ast.BoolOp(values=parts) | ast.List(elts=parts) | ast.Tuple(elts=parts) | ast.Set(elts=parts):
                return all(self._plain(part) for part in parts)
            case ast.Compare(left=left, comparators=others):
                return all(self._plain(part) for part in (left, *others))
            case ast.UnaryOp(operand=operand):
                return self._plain(operand)
            case ast.Name() | ast.Attribute() | ast.Subscript():
                value = self(node)
                return value is not NOT_PYTHON and not _holds_terms(value)
        values = [self.name(each) for each in free_names(node)]
        return not any(_holds_terms(value) for value in values if not _is_ours(value))

    def _run(self, node: ast.expr) -> object:
        names = {each.id: self.name(each) for each in free_names(node)}
        code = compile(ast.Expression(node), self.function.source.name, "eval")
        try:
            with translating():
                return eval(code, {"__name__": self.function.function.__module__, **names})
        except (UserError, KeyboardInterrupt, MemoryError):
            raise
        except BaseException as error:
            message = f"Python fails here with {failure(error)}"
            help_ = cure(error, self.function.source.name)
            raise refused(Code.PYTHON_RAISED, message, self.function.place(node), help_, _where(error)) from None


def _where(error: BaseException) -> tuple[Label, ...]:
    """Where in a called function an error was raised."""
    traceback = innermost(error)
    if traceback is None or traceback.tb_frame.f_code.co_name == "<module>":
        return ()
    code = traceback.tb_frame.f_code
    source = source_of(code.co_filename)
    place = code_span(source, code, traceback.tb_lasti, traceback.tb_lineno)
    return (Label(place, "raised here"),) if source.text else ()


def free_names(node: ast.expr) -> Iterator[ast.Name]:
    """The names of an expression that are not bound in it by a comprehension or a lambda."""
    bound = {arg.arg for each in ast.walk(node) if isinstance(each, ast.Lambda) for arg in each.args.args}
    for each in ast.walk(node):
        if isinstance(each, ast.comprehension):
            bound.update(target.id for target in ast.walk(each.target) if isinstance(target, ast.Name))
    for each in ast.walk(node):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load) and each.id not in bound:
            yield each
