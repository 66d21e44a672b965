"""What Python itself makes of an expression in a translated function: constants, attributes, plain functions."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Callable, Iterator

from golc.diagnostics import Code, Label, UserError
from golc.embed.errors import refused
from golc.embed.functions import Function
from golc.embed.names import BUILTINS, golc_name
from golc.embed.places import code_span, frame_span
from golc.embed.terms import Term, variable
from golc.embed.types import TypeForm, enum, interval, optional, symbols, union
from golc.embed.words import Value, Word

NOT_PYTHON = object()
"""The answer for an expression that is one of the language."""

_OURS = (interval, enum, union, optional, symbols, *(getattr(builtins, name) for name in sorted(BUILTINS)))


def _is_ours(value: object) -> bool:
    """Whether a value is a function that means something in the language; terms have no ``==`` of Python's."""
    return any(value is each for each in _OURS)


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
            case ast.Attribute(value=owner) | ast.Subscript(value=owner):
                base = self(owner)
                return NOT_PYTHON if base is NOT_PYTHON or isinstance(base, (Term, Word)) else self._run(node)
            case ast.Call(func=function):
                called = self(function)
                ours = called is NOT_PYTHON or isinstance(called, (Term, Word, Value))
                if ours or (_is_ours(called) and not self._constant(node)):
                    return NOT_PYTHON
                return self._run(node)
            case ast.Constant() | ast.Lambda():
                return NOT_PYTHON
        return self._run(node) if self._constant(node) else NOT_PYTHON

    def _constant(self, node: ast.expr) -> bool:
        """Whether there are names from outside in an expression, and all stand for constants of Python."""
        found = [self.name(each) for each in free_names(node)]
        constants = [value for value in found if not _is_ours(value)]
        return bool(constants) and not any(isinstance(value, (Term, Word, Value, TypeForm)) for value in constants)

    def _run(self, node: ast.expr) -> object:
        names = {each.id: self.name(each) for each in free_names(node)}
        code = compile(ast.Expression(node), self.function.source.name, "eval")
        try:
            return eval(code, {"__name__": self.function.function.__module__, **names})
        except UserError:
            raise
        except Exception as error:
            place = self.function.place(node)
            labels = () if error.__traceback__ is None else _where(error)
            message = f"Python fails here with {type(error).__name__}: {error}"
            raise refused(Code.PYTHON_RAISED, message, place, labels=labels) from None


def _where(error: Exception) -> tuple[Label, ...]:
    """Where in a called function an error was raised."""
    traceback = error.__traceback__
    while traceback is not None and traceback.tb_next is not None:
        traceback = traceback.tb_next
    if traceback is None or traceback.tb_frame.f_code.co_name == "<module>":
        return ()
    frame = traceback.tb_frame
    if not frame_span(frame).source.text:
        return ()
    source = frame_span(frame).source
    return (Label(code_span(source, frame.f_code, traceback.tb_lasti, traceback.tb_lineno), "raised here"),)


def free_names(node: ast.expr) -> Iterator[ast.Name]:
    """The names of an expression that are not bound in it by a comprehension or a lambda."""
    bound = {arg.arg for each in ast.walk(node) if isinstance(each, ast.Lambda) for arg in each.args.args}
    for each in ast.walk(node):
        if isinstance(each, ast.comprehension):
            bound.update(target.id for target in ast.walk(each.target) if isinstance(target, ast.Name))
    for each in ast.walk(node):
        if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load) and each.id not in bound:
            yield each
