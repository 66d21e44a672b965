"""Typed terms to Python source over tuple states.

A term becomes one Python expression in which ``s`` is the state. What the types prove costs nothing at run time; where
they do not, the expression calls a *check* that knows its place in the golc file and raises the error that the language
defines. Small quantifiers are written out, so that most ground fluents become plain ``s[7]``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from math import prod
from typing import Any, NamedTuple

from golc.diagnostics import Span
from golc.situation import collections, guards
from golc.situation.collections import known_value, listed
from golc.situation.happened import before
from golc.situation.layout import Layout, Place
from golc.situation.operators import in_one_form, operation
from golc.situation.worlds import ASK
from golc.theory.border import PythonFunction
from golc.theory.fitting import includes, strip_optional
from golc.theory.terms import (
    Before,
    Binder,
    Choice,
    Comprehension,
    DefinedTerm,
    Display,
    Epistemic,
    FluentTerm,
    Literal,
    Membership,
    Operation,
    PossTerm,
    Quantified,
    StaticTerm,
    Term,
    Text,
    Variable,
    subterms,
)
from golc.theory.theory import BasicActionTheory, Definition, Parameter, Static
from golc.theory.types import Interval, Type, Value

FORMULA = "a formula"
"""What a formula is called where it is `none`."""

DEEPEST = 24
"""Expressions nested deeper go into functions of their own: CPython refuses more than about 200 nested brackets."""

LARGEST_UNROLLED = 200
"""A quantifier is written out if its bindings times the subterms of its body are no more than this."""


class Cell(NamedTuple):
    """What stands for a variable: a Python name or expression, or a value that is known while compiling."""

    text: str
    known: bool = False
    value: Value = None


Cells = tuple[Cell, ...]
"""One for each variable in scope, by level."""


class Compiler:
    """Makes Python functions of the terms of one theory; statics, definitions and preconditions are made once.

    ``ask`` has the functions behind ``knows(φ)``, ``possible(φ)`` and ``known(e)``: of the function that evaluates what
    stands inside, and of what that is to be given.
    """

    def __init__(self, theory: BasicActionTheory, layout: Layout, ask: Mapping[str, Callable[..., bool]] = ASK) -> None:
        self.theory = theory
        self._ask = ask
        self.layout = layout
        self.namespace: dict[str, Any] = {"__builtins__": __builtins__}
        self.uncertain = leaves_open(theory)
        self._made: dict[tuple[str, str], str] = {}
        self._depth = guards.Depth()

    def function(self, parameters: str, lines: list[str]) -> Callable[..., Any]:
        """A Python function of generated lines."""
        function: Callable[..., Any] = self.namespace[self._define(parameters, lines)]
        return function

    def term(self, term: Term, depth: int, what: str | None = None) -> Callable[..., Any]:
        """A function of a state and an environment of ``depth`` variables that evaluates a term.

        If the value must not be ``none``, ``what`` says what the term is.
        """
        cells = environment(depth)
        text = self.expression(term, cells) if what is None else self.some(term, cells, 0, what)
        return self.function("s, e", [f"return {text}"])

    def argument_values(
        self, what: str, parameters: tuple[Parameter, ...], args: tuple[Term, ...], depth: int
    ) -> Callable[..., Any]:
        """A function of a state and an environment that evaluates the arguments of something."""
        texts = self.arguments(what, parameters, args, environment(depth))
        return self.function("s, e", [f"return ({''.join(f'{text}, ' for text in texts)})"])

    def environments(self, binders: tuple[Binder, ...], where: Term | None, depth: int) -> Callable[..., Any]:
        """A function of a state and an environment that yields the longer ones which binders and ``where`` make."""
        if not binders:
            condition = "True" if where is None else self.formula(where, environment(depth))
            return self.function("s, e", [f"return iter((e,) if {condition} else ())"])
        cells, clauses = self.loops(binders, where, environment(depth))
        added = "".join(f"{cell.text}, " for cell in cells[depth:])
        return self.function("s, e", [f"return (e + ({added}) {clauses})"])

    def loops(self, binders: tuple[Binder, ...], where: Term | None, cells: Cells, depth: int = 0) -> tuple[Cells, str]:
        """``for … if …`` of a comprehension, and the cells inside it."""
        clauses = []
        for binder in binders:
            name = f"v{len(cells)}"
            clauses.append(f"for {name} in {collections.run_through(self, binder, cells, depth)}")
            cells = (*cells, Cell(name))
        if where is not None:
            clauses.append(f"if {self.formula(where, cells, depth)}")
        return cells, " ".join(clauses)

    def bind(self, prefix: str, value: object) -> str:
        """A name for a Python object in the generated code."""
        name = f"{prefix}_{len(self.namespace)}"
        self.namespace[name] = value
        return name

    def expression(self, term: Term, cells: Cells, depth: int = 0) -> str:
        """A Python expression, bracketed where it needs to be."""
        if depth > DEEPEST and not isinstance(term, Literal | Variable):
            return self._hoisted(term, cells)
        match term:
            case Literal(value=value):
                return self.constant(value)
            case Variable(level=level):
                return cells[level].text
            case FluentTerm(fluent=name, args=args):
                return f"s[{self.slot(self.layout.places[name], args, cells, depth + 1)}]"
            case StaticTerm(static=name, args=args):
                return self._static(self.theory.statics[name], args, cells, depth + 1, term.span)
            case DefinedTerm(definition=name, args=args):
                definition = self.theory.definitions[name]
                return self._call(self._definition(definition), name, definition.parameters, args, cells, depth + 1)
            case PossTerm(action=name, args=args):
                parameters = self.theory.actions[name].parameters
                return self._call(self.precondition(name), name, parameters, args, cells, depth + 1)
            case Membership(element=element, within=within):
                return self._membership(self.expression(element, cells, depth + 1), element.type, within)
            case Quantified():
                return self._quantified(term, cells, depth + 1)
            case Operation():
                return operation(self, term, cells, depth + 1)
            case Display() | Comprehension() | Text():
                return collections.made(self, term, cells, depth + 1)
            case Epistemic(kind=kind, body=body):
                function, names = self._function_of(body, cells)
                return f"{self.bind('ask', self._ask[kind])}({', '.join([function, *names])})"
            case Before(body=body):
                function, names = self._function_of(body, cells)
                return f"{self.bind('before', before)}({', '.join([function, *names])})"
            case _:
                raise AssertionError(term)

    def slot(self, place: Place, args: tuple[Term, ...], cells: Cells, depth: int = 0) -> str:
        """An expression for the slot of a fluent's arguments."""
        constant, parts = place.base, []
        for index, (arg, type_, stride) in enumerate(zip(args, place.types, place.strides, strict=True)):
            known, value = known_value(arg, cells)
            if known and value in type_:
                constant += stride * place.positions[index][value]
                continue
            text = self.expression(arg, cells, depth)
            if isinstance(type_, Interval):
                if not includes(type_, arg.type):
                    failure = guards.argument_failure(arg, place.fluent.name, type_)
                    text = f"{self.bind('check', guards.check(type_, failure))}({text})"
                constant -= stride * type_.low
            elif not includes(type_, arg.type):
                check = guards.Positions(place.positions[index], arg, place.fluent.name, type_)
                text = f"{self.bind('position', check)}[{text}]"
            else:
                text = f"{self.bind('position', place.positions[index])}[{text}]"
            parts.append(text if stride == 1 else f"{text}*{stride}")
        if not parts:
            return str(constant)
        return "+".join(parts) + (f"{constant:+d}" if constant else "")

    def checked(
        self, term: Term, type_: Type, cells: Cells, failure: Callable[[Value], Exception], depth: int = 0
    ) -> str:
        """An expression for a term that fails unless its value belongs to a type."""
        text = self.expression(term, cells, depth)
        known, value = known_value(term, cells)
        if includes(type_, term.type) or (known and value in type_):
            return text
        return f"{self.bind('check', guards.check(type_, failure))}({text})"

    def arguments(
        self, what: str, parameters: tuple[Parameter, ...], args: tuple[Term, ...], cells: Cells, depth: int = 0
    ) -> list[str]:
        """Expressions for the arguments of something, each checked against its parameter's type."""
        return [
            self.checked(arg, parameter.type, cells, guards.argument_failure(arg, what, parameter.type), depth)
            for parameter, arg in zip(parameters, args, strict=True)
        ]

    def precondition(self, name: str) -> str:
        """The name of the function of an action's precondition: state and arguments to truth value."""
        action = self.theory.actions[name]

        def body(cells: Cells) -> str:
            return " and ".join(self.formula(condition, cells) for condition in action.preconditions) or "True"

        return self._once("poss", name, len(action.parameters), body)

    def _definition(self, definition: Definition) -> str:
        return self._once(
            "define", definition.name, len(definition.parameters), lambda cells: self.expression(definition.body, cells)
        )

    def _once(self, kind: str, name: str, parameters: int, body: Callable[[Cells], str]) -> str:
        if (kind, name) not in self._made:
            cells = variables(parameters)
            self._made[kind, name] = self._define(", ".join(["s", *(c.text for c in cells)]), [f"return {body(cells)}"])
        return self._made[kind, name]

    def _define(self, parameters: str, lines: list[str]) -> str:
        name = f"f_{len(self.namespace)}"
        self.namespace[name] = None
        text = "\n    ".join([f"def {name}({parameters}):", *lines])
        exec(compile(text, f"<golc {self.theory.name}>", "exec"), self.namespace)
        return name

    def _hoisted(self, term: Term, cells: Cells) -> str:
        function, names = self._function_of(term, cells)
        return f"{function}({', '.join(names)})"

    def _function_of(self, term: Term, cells: Cells) -> tuple[str, list[str]]:
        """The name of a function that evaluates a term, and the names of what it is to be given."""
        names = [*dict.fromkeys(["s", *(cell.text.partition("[")[0] for cell in cells if not cell.known)])]
        return self._define(", ".join(names), [f"return {self.expression(term, cells)}"]), names

    def constant(self, value: Value) -> str:
        """An expression for a value."""
        return repr(value) if value is None or isinstance(value, int | str) else self.bind("constant", value)

    def _call(
        self,
        function: str,
        what: str,
        parameters: tuple[Parameter, ...],
        args: tuple[Term, ...],
        cells: Cells,
        depth: int,
    ) -> str:
        return f"{function}({', '.join(['s', *self.arguments(what, parameters, args, cells, depth)])})"

    def _static(self, static: Static, args: tuple[Term, ...], cells: Cells, depth: int, span: Span) -> str:
        texts = self.arguments(static.name, static.parameters, args, cells, depth)
        if isinstance(static.body, PythonFunction):
            return f"{self.bind('extern', guards.extern(static, span))}({', '.join(texts)})"
        if ("static", static.name) not in self._made:
            self._made["static", static.name] = self._made_static(static)
        name = self._made["static", static.name]
        if static.reads:
            return f"{name}({', '.join(['s', *texts])})"
        return f"{name}[{''.join(f'{text}, ' for text in texts)}]" if texts else f"{name}[()]"

    def _made_static(self, static: Static) -> str:
        """The name of a mapping from argument tuples, which for an expression is filled when it is asked; of a function
        of state and arguments if the expression reads fluents."""
        if isinstance(static.body, Mapping):
            return self.bind("table", static.body)
        calls = guards.Calls(static, self._depth)
        # Before its body, which may be recursive.
        name = self._made["static", static.name] = self.bind("static", calls if static.reads else guards.Memo(calls))
        cells = variables(len(static.parameters))
        body = static.body
        assert not isinstance(body, PythonFunction)
        signature = ", ".join(["s", *(cell.text for cell in cells)])
        calls.function = self.function(signature, [f"return {self.expression(body, cells)}"])
        return name

    def _membership(self, element: str, type_: Type, within: Type) -> str:
        if isinstance(within, Interval) and type_.kinds == {"int"}:
            return f"({within.low} <= {element} <= {within.high})"
        listed = within.finite and not isinstance(strip_optional(within), Interval)  # which may be too long to list
        return f"({element} in {self.bind('set', frozenset(within.values) if listed else within)})"

    def some(self, term: Term, cells: Cells, depth: int, what: str = "an operand") -> str:
        """An expression for a term that fails if its value is ``none``; ``what`` says what the term is."""
        text = self.expression(term, cells, depth)
        return f"{self.bind('some', guards.some(term, what))}({text})" if "none" in term.type.kinds else text

    def formula(self, term: Term, cells: Cells, depth: int = 0) -> str:
        """An expression for a formula, which must not be ``none``."""
        return self.some(term, cells, depth, FORMULA)

    def _quantified(self, term: Quantified, cells: Cells, depth: int) -> str:
        if term.kind in ("exists", "forall"):
            ranges = [listed(binder, cells) for binder in term.binders]
            known = [values for values in ranges if values is not None]
            bindings = prod(map(len, known))
            if len(known) == len(ranges) and bindings * sum(1 for _ in subterms(term)) <= LARGEST_UNROLLED:
                return self._unrolled(term, known, cells, depth)
        inner, clauses = self.loops(term.binders, term.where, cells, depth)
        if term.kind in ("exists", "forall", "count"):
            body = self.formula(term.body, inner, depth)
        else:
            body = self.some(term.body, inner, depth)
        match term.kind:
            case "exists":
                return f"any({body} {clauses})"
            case "forall":
                return f"all({body} {clauses})"
            case "count":
                return f"sum(1 {clauses} {'if' if term.where is None else 'and'} {body})"
            case "sum":
                return in_one_form(self, f"sum({body} {clauses})", term)
            case _:
                return f"{self.bind('extremum', guards.extremum(term))}([{body} {clauses}])"

    def _unrolled(self, term: Quantified, ranges: list[Sequence[Value]], cells: Cells, depth: int) -> str:
        cases = []
        for values in product(*ranges):
            inner = (*cells, *(Cell(self.constant(value), True, value) for value in values))
            body = self.formula(term.body, inner, depth)
            if term.where is not None:
                where = self.formula(term.where, inner, depth)
                body = f"({where} and {body})" if term.kind == "exists" else f"(not {where} or {body})"
            cases.append(body)
        return f"({' or '.join(cases) or False})" if term.kind == "exists" else f"({' and '.join(cases) or True})"


def environment(depth: int) -> Cells:
    """The cells of a program's variables: elements of the tuple ``e``."""
    return tuple(Cell(f"e[{level}]") for level in range(depth))


def variables(count: int) -> Cells:
    """The cells of parameters: Python variables of their own."""
    return tuple(Cell(f"v{level}") for level in range(count))


def leaves_open(theory: BasicActionTheory) -> bool:
    """Whether there may ever be several possible worlds."""
    effects = (effect for action in theory.actions.values() for effect in action.effects)
    return any(isinstance(fluent.initial, Choice) for fluent in theory.fluents.values()) or any(
        isinstance(effect.value, Choice) for effect in effects
    )
