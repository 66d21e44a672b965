"""Programs in the notation of ConGolog and IndiGolog; fluents are written without a situation in them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from golc.explain import signs
from golc.explain.document import Document, Group, Line, Nest, Text, join, separated
from golc.explain.formulas import Formulas
from golc.explain.logic import negated
from golc.explain.pieces import ATOM, SUM, infixed, listed, value_text
from golc.theory import statements as st
from golc.theory.terms import Base
from golc.theory.types import REAL

SPACE = Line(Text(" ", r"\ "))
CONCURRENT, SEQUENCE, UNIT = range(3)
"""How tightly the forms bind, the loosest first."""


def program(formulas: Formulas, statement: st.Statement, least: int = CONCURRENT) -> Document:
    """A program where something binding at least so tightly is needed."""
    level, body = _program(formulas, statement)
    return body if level >= least else _enclosed(body)


def _enclosed(body: Document) -> Document:
    return Group(join(signs.sign("("), Nest(body), signs.sign(")")))


def _program(formulas: Formulas, statement: st.Statement) -> tuple[int, Document]:
    match statement:
        case st.Sequence(parts=parts):
            units = [program(formulas, part, UNIT) for part in parts]
            return SEQUENCE, Group(separated(units, signs.sign(";"), Line()))
        case st.Choose(branches=branches):
            return CONCURRENT, _branches(formulas, signs.CHOOSE, branches)
        case st.Together(branches=branches):
            return CONCURRENT, _branches(formulas, signs.TOGETHER, branches)
        case st.Prefer(branches=branches):
            return CONCURRENT, _branches(formulas, signs.PREFER, branches)
        case st.Interrupts(handlers=handlers):
            return CONCURRENT, infixed(signs.PREFER, [_interrupt(formulas, handler) for handler in handlers])
        case _:
            return UNIT, _block(formulas, statement) or _simple(formulas, statement)


def _branches(formulas: Formulas, sign: Text, branches: Sequence[st.Statement]) -> Document:
    return infixed(sign, [program(formulas, branch, SEQUENCE) for branch in branches])


def _interrupt(formulas: Formulas, handler: st.Interrupt) -> Document:
    inner, binders = formulas.bound(handler.binders)
    head = [binders, signs.DOT] if handler.binders else []
    body = Nest(join(Line(), program(inner, handler.body)))
    parts = [*head, inner.term(handler.condition), Text(" →", r" \to ")]
    return Group(join(signs.BEGIN_INTERRUPT, *parts, body, signs.END_INTERRUPT))


def _block(formulas: Formulas, statement: st.Statement) -> Document | None:
    """A statement with a block inside."""
    match statement:
        case st.If(condition=condition, then=then, otherwise=otherwise):
            branches = [(formulas, " then", then)]
            if not isinstance(otherwise, st.Skip):
                branches.append((formulas, "else", otherwise))
            return _worded("if ", formulas.term(condition), branches, "endIf")
        case st.While(condition=condition, body=body):
            return _worded("while ", formulas.term(condition), [(formulas, " do", body)], "endWhile")
        case st.For(binders=binders, where=where, body=body):
            inner, head = formulas.bound(binders)
            if where is not None:
                head = join(head, signs.keyword(" where "), inner.term(where))
            return _worded("for ", head, [(inner, " do", body)], "endFor")
        case st.Let(variable=variable, value=value, body=body):
            inner = formulas.extended([variable.name])
            head = join(inner.names[-1], signs.sign(" = "), formulas.term(value))
            return _worded("let ", head, [(inner, " in", body)], "endLet")
        case st.Pick(binders=binders, where=where, body=body):
            inner, head = formulas.bound(binders)
            parts = body.parts if isinstance(body, st.Sequence) else (body,)
            tested = body if where is None else st.Sequence((st.Test(where), *parts))
            return Group(join(signs.PICK, head, signs.DOT, program(inner, tested, UNIT)))
        case st.Star(limit=None, body=body):
            return join(_enclosed(program(formulas, body)), signs.STAR)
        case st.Star(limit=Base() as limit, body=body):
            most = join(Text("^≤", r"^{\leq "), formulas.term(limit, ATOM), Text("", "}"))
            return join(_enclosed(program(formulas, body)), most)
        case st.TogetherStar(body=body):
            return join(_enclosed(program(formulas, body)), signs.TOGETHER_STAR)
        case st.Guard(condition=condition, body=body):
            return _function("gexec", formulas.term(condition), program(formulas, body))
        case st.Search(body=body):
            return join(signs.SEARCH, *_options(formulas, statement), _enclosed(program(formulas, body)))
        case st.Within(seconds=seconds, body=body, otherwise=otherwise):
            first, second = program(formulas, body), program(formulas, otherwise)
            return _function("within", _duration(formulas, seconds), first, second)
        case _:
            return None


def _function(name: str, *args: Document) -> Document:
    """``gexec(φ, δ)``."""
    inside = Nest(separated(args, signs.sign(","), Line()))
    return Group(join(signs.words(name), signs.sign("("), inside, signs.sign(")")))


def _worded(word: str, head: Document, branches: Sequence[tuple[Formulas, str, st.Statement]], end: str) -> Document:
    """``if φ then δ1 else δ2 endIf`` and what is built like it."""
    found: list[Document] = []
    for formulas, between, body in branches:
        found += [*([SPACE] if found else []), signs.keyword(between), Nest(join(SPACE, program(formulas, body)))]
    return Group(join(signs.keyword(word), head, *found, SPACE, signs.keyword(end)))


def _options(formulas: Formulas, search: st.Search) -> list[Document]:
    """``[shortest, ≤ 20, 5 s]``, if anything of it is said."""
    found: list[Document] = []
    if search.strategy is not st.Strategy.FIRST:
        found.append(signs.words(search.strategy.value))
    if search.steps is not None:
        found.append(join(Text("≤ ", r"\leq "), formulas.term(search.steps, SUM)))
    if search.seconds is not None:
        found.append(_duration(formulas, search.seconds))
    return [Group(listed("list", found))] if found else []


def _duration(formulas: Formulas, seconds: st.Duration) -> Document:
    number = value_text(seconds, REAL) if isinstance(seconds, Fraction) else formulas.term(seconds, SUM)
    return join(number, Text(" s", r"\,\mathrm{s}"))


def _simple(formulas: Formulas, statement: st.Statement) -> Document:
    """A statement without a block."""
    match statement:
        case st.Skip():
            return signs.words("nil")
        case st.Perform(action=name, args=args) | st.Invoke(procedure=name, args=args):
            return formulas.applied(signs.words(name), [formulas.term(arg) for arg in args])
        case st.Test(condition=condition):
            return join(formulas.term(condition, ATOM, False), signs.sign("?"))
        case st.Wait():
            return signs.words("wait")
        case st.WaitUntil(condition=condition):
            return program(formulas, st.While(negated(condition), st.Wait()))
        case st.WaitTime(seconds=seconds):
            return formulas.applied(signs.words("wait"), [_duration(formulas, seconds)])
        case st.Say(message=message):
            return formulas.applied(signs.words("say"), [formulas.message(message.parts)])
        case st.Abort(message=message):
            return formulas.applied(signs.words("abort"), [formulas.message(message.parts)])
        case _:
            raise TypeError(f"{statement!r} has no notation")
