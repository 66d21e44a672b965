"""Ground actions as people write them: ``request_delivery(2, 5)`` on a line of text, checked against the theory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import cast

from golc.diagnostics import NOWHERE, Code, Diagnostic, Findings, Source, Span, UserError
from golc.syntax import tree
from golc.syntax.parse import parse_expression
from golc.theory.fitting import collection, may_be, size, strip_optional
from golc.theory.suggest import did_you_mean
from golc.theory.theory import Action, BasicActionTheory, Parameter, Procedure
from golc.theory.types import (
    Collection,
    Enumeration,
    Interval,
    Number,
    Optional,
    Primitive,
    Type,
    Value,
    number,
    show_call,
)

LONGEST = 100_000
"""How many values a type may have whose name stands for their list."""


@dataclass(frozen=True)
class Call:
    """A ground action: its name and the values of its arguments."""

    action: str
    args: tuple[Value, ...] = ()
    span: Span = field(default=NOWHERE, compare=False, repr=False)

    def __str__(self) -> str:
        return show_call(self.action, self.args)


def read_exogenous(theory: BasicActionTheory, where: Span, findings: Findings) -> Call | None:
    """The exogenous action that the text at ``where`` names; None if the text is wrong, which is then a finding."""
    target = _target(where, findings, "an exogenous action, as in `" + example(theory, exogenous=True) + "`")
    if target is None or (action := _action(theory, target, True, findings)) is None:
        return None
    return _call(theory, action, target, findings)


def read_primitive(theory: BasicActionTheory, where: Span, findings: Findings) -> tuple[str, Call | None] | None:
    """The primitive action that the text at ``where`` names: (name, call), the call None if it has no argument list.

    A name alone stands for all the action's instances, even if it has parameters. None if the text is wrong.
    """
    target = _target(where, findings, "an action, as in `" + example(theory, exogenous=False) + "`")
    if target is None or (action := _action(theory, target, False, findings)) is None:
        return None
    if not target.args:
        return action.name, None
    call = _call(theory, action, target, findings)
    return None if call is None else (action.name, call)


def read_action(theory: BasicActionTheory, text: str) -> Call:
    """The action, primitive or exogenous, that a text names, with its arguments; raises ``UserError``."""
    findings = Findings()
    where = Span(Source("<action>", text), 0, len(text))
    target = _target(where, findings, "an action, as in `" + example(theory, exogenous=False) + "`")
    action = None if target is None else _action(theory, target, None, findings)
    call = None if target is None or action is None else _call(theory, action, target, findings)
    if call is None:
        raise UserError(*findings.diagnostics)
    return call


def read_procedure(theory: BasicActionTheory, text: str) -> Call:
    """The procedure that a text names, with its arguments, as ``control`` or ``serve(3)``; raises ``UserError``."""
    findings = Findings()
    where = Span(Source("<procedure>", text), 0, len(text))
    target = _target(where, findings, "a procedure, as in `control` or `serve(3)`")
    procedure = theory.procedures.get(target.name) if target is not None else None
    if target is not None and procedure is None:
        names = list(theory.procedures)
        help_ = did_you_mean(target.name, names) or (
            f"the domain declares {', '.join(names)}" if names else "the domain declares no procedure"
        )
        findings.error(Code.EVENT, f"unknown procedure `{target.name}`", target.span, "not declared", help_)
    call = _call(theory, procedure, target, findings) if procedure is not None and target is not None else None
    if call is None:
        raise UserError(*findings.diagnostics)
    return call


def read_value(theory: BasicActionTheory, type_: Type, where: Span, findings: Findings) -> tuple[Value] | None:
    """The value of a type that the text at ``where`` names, in a tuple of its own; None if it is wrong."""
    expression = parse_at(where, findings)
    return None if expression is None else _Reader(theory, where, findings).value(expression, type_, "the value")


def example(theory: BasicActionTheory, exogenous: bool) -> str:
    """A ground action of the theory to show in a message; an invented one if it has none."""
    return one_of([action for action in theory.actions.values() if action.exogenous == exogenous]) or "press(1)"


def one_of(candidates: Sequence[Action]) -> str | None:
    """A ground action to show in a message, with arguments if any of them has some; None if there is none."""
    if not candidates:
        return None
    action = max(candidates, key=lambda a: bool(a.parameters))
    return show_call(action.name, [_sample(p.type) for p in action.parameters])


def describe(type_: Type) -> str:
    """The values of a type in a few words: ``station (1..6)``."""
    match type_:
        case Interval(name=str(name)):
            return f"{name} ({type_.low}..{type_.high})"
        case Enumeration(name=str(name)):
            return f"{name} ({', '.join(map(str, type_.values))})"
        case Optional(base=base):
            return f"{describe(base)} or none"
        case _:
            return str(type_)


def parse_at(where: Span, findings: Findings) -> tree.Expr | None:
    """Parse the text of a span as an expression; spans and findings speak of the place where the text stands."""
    local = Source(where.source.name, where.text)
    own = Findings()
    expression = parse_expression(local, own)
    for diagnostic in own.diagnostics:
        findings.add(_moved(diagnostic, where))
    return None if own.has_errors else expression


def _moved(diagnostic: Diagnostic, where: Span) -> Diagnostic:
    labels = tuple(replace(label, span=_shift(label.span, where)) for label in diagnostic.labels)
    return replace(diagnostic, span=_shift(diagnostic.span, where), labels=labels)


def _shift(span: Span, where: Span) -> Span:
    """A span of the text of ``where`` as a span of the source of ``where``."""
    start, end = (min(where.start + offset, where.end) for offset in (span.start, span.end))
    return Span(where.source, start, end)


@dataclass(frozen=True)
class _Target:
    name: str
    args: tuple[tree.Expr, ...]
    span: Span
    where: Span


def _target(where: Span, findings: Findings, wanted: str) -> _Target | None:
    expression = parse_at(where, findings)
    match expression:
        case None:
            return None
        case tree.Apply(name=name, args=args):
            return _Target(name.text, args, _shift(name.span, where), where)
        case _:
            findings.error(Code.EVENT, f"`{where.text.strip()}` is not an action", where, help=f"write {wanted}")
            return None


def _action(theory: BasicActionTheory, target: _Target, exogenous: bool | None, findings: Findings) -> Action | None:
    """The action that is named; ``exogenous`` says of which kind it has to be, None: of any."""
    action = theory.actions.get(target.name)
    kind = "exogenous action" if exogenous else "action"
    if action is None:
        names = [a.name for a in theory.actions.values() if exogenous in (None, a.exogenous)]
        if (help_ := did_you_mean(target.name, names)) is None:
            help_ = f"the domain declares {', '.join(names)}" if names else f"the domain declares no {kind}"
        findings.error(Code.EVENT, f"unknown {kind} `{target.name}`", target.span, "not declared", help_)
        return None
    if exogenous not in (None, action.exogenous):
        message = (
            "is exogenous: the robot never performs it" if action.exogenous else "is the robot's own, not exogenous"
        )
        findings.error(Code.EVENT, f"`{action.name}` {message}", target.span)
        return None
    return action


def _call(theory: BasicActionTheory, action: Action | Procedure, target: _Target, findings: Findings) -> Call | None:
    if len(target.args) != len(action.parameters):
        findings.error(
            Code.EVENT,
            f"`{action.name}` takes {_count(action.parameters)}, not {len(target.args)}",
            target.where,
            help=f"write for example `{show_call(action.name, [_sample(p.type) for p in action.parameters])}`",
        )
        return None
    values: list[Value] = []
    reader = _Reader(theory, target.where, findings)
    for parameter, arg in zip(action.parameters, target.args, strict=True):
        value = reader.value(arg, parameter.type, f"`{parameter.name}` of `{action.name}`")
        if value is None:
            return None
        values.extend(value)
    return Call(action.name, tuple(values), target.where)


def _count(parameters: Sequence[Parameter]) -> str:
    if not parameters:
        return "no arguments"
    named = ", ".join(f"{p.name}: {p.type}" for p in parameters)
    return f"{len(parameters)} argument{'s' if len(parameters) > 1 else ''} ({named})"


def _sample(type_: Type) -> Value:
    """Some value of a type, for an example: the last one, which is never ``none``."""
    match strip_optional(type_):
        case Collection(kind=kind, element=element):
            return frozenset({_sample(element)}) if kind == "set" else (_sample(element),)
        case Primitive(name="string"):
            return "some text"
        case Primitive(name="real"):
            return Fraction(1, 2)
        case _:
            return type_.values[-1] if type_.finite else 1


@dataclass(frozen=True)
class _Reader:
    """Reads the values that the text at ``where`` names; what is wrong becomes a finding."""

    theory: BasicActionTheory
    where: Span
    findings: Findings

    def value(self, node: tree.Expr, type_: Type, what: str) -> tuple[Value] | None:
        """The value of a type that an expression denotes, in a tuple of its own; ``what`` says what it is for."""
        match node:
            case tree.Number() | tree.Real():
                value: Value = _number(node)
            case tree.Unary(op="-", operand=tree.Number() | tree.Real() as operand):
                value = -_number(operand)
            case tree.Truth(value=truth):
                value = truth
            case tree.Nothing():
                value = None
            case tree.Message(parts=parts) if all(isinstance(part, str) for part in parts):
                if "string" not in type_.kinds:
                    return self._unfit(node, type_, what)
                value = "".join([part for part in parts if isinstance(part, str)])
            case tree.SetLiteral() | tree.ListLiteral():
                return self._collection(node, type_, what)
            case tree.Apply(name=tree.Ident(text=name), args=()):
                return self._named(node, name, type_, what)
            case _:
                help_ = f"a value of {describe(type_)}"
                self._error("a value is needed, not an expression", node, help=help_)
                return None
        return (value,) if value in type_ else self._unfit(node, type_, what)

    def _named(self, node: tree.Apply, name: str, type_: Type, what: str) -> tuple[Value] | None:
        """A symbol, a const, or the list of the values of a type."""
        if name in self.theory.symbols:
            is_one = any(kind.startswith("symbol:") for kind in type_.kinds) and name in type_
            return (name,) if is_one else self._unfit(node, type_, what)
        constant, listed = self.theory.constants.get(name), self.theory.types.get(name)
        if constant is not None and may_be(constant.type, type_) and constant.value in type_:
            return (constant.value,)
        if listed is not None and collection(type_) and listed.finite and size(listed) <= LONGEST:
            values = tuple(listed.values)
            return (values,) if values in type_ else self._unfit(node, type_, what)
        if constant is not None or listed is not None:
            return self._unfit(node, type_, what)
        help_ = did_you_mean(name, _names(type_)) or f"{what} is of type {describe(type_)}"
        self._error(f"unknown value `{name}`", node, "not a value", help_)
        return None

    def _collection(self, node: tree.SetLiteral | tree.ListLiteral, type_: Type, what: str) -> tuple[Value] | None:
        whole = collection(type_)
        if whole is None or (whole.kind == "set") != isinstance(node, tree.SetLiteral):
            return self._unfit(node, type_, what)
        values: list[Value] = []
        for element in node.elements:
            value = self.value(element, whole.element, f"an element of {what}")
            if value is None:
                return None
            values.extend(value)
        return (frozenset(values) if whole.kind == "set" else tuple(values),)

    def _unfit(self, node: tree.Expr, type_: Type, what: str) -> tuple[Value] | None:
        self._error(f"{what} is of type {describe(type_)}, not `{node.span.text.strip()}`", node)
        return None

    def _error(self, message: str, node: tree.Expr, marker: str = "", help: str | None = None) -> None:
        self.findings.error(Code.EVENT, message, _shift(node.span, self.where), marker, help)


def _number(node: tree.Number | tree.Real) -> int | Fraction:
    return node.value if isinstance(node, tree.Number) else cast(Number, number(Fraction(node.value)))


def _names(type_: Type) -> list[str]:
    """The symbols that a value of a type may be, or have as elements."""
    whole = collection(type_)
    if whole is not None:
        return _names(whole.element)
    return [value for value in type_.values if isinstance(value, str)] if type_.finite else []
