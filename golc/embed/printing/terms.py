"""Terms and types as Python expressions, of which Python's syntax tree is the tree they came from."""

from __future__ import annotations

from collections.abc import Iterable
from decimal import Decimal

from golc.embed.printing.layout import Brackets, Chain, Doc, Joined, one_line
from golc.embed.printing.names import Names
from golc.embed.printing.strings import message_text, quoted
from golc.syntax import tree as ast
from golc.syntax.python_names import python_name

CONDITIONAL, OR, AND, NOT, COMPARISON, UNION, SUM, PRODUCT, NEGATION, ATOM = range(10)
"""How tightly the forms of Python bind, the loosest first."""

BINARY: dict[ast.BinaryOp, tuple[str, int, int, int]] = {
    "or": ("or", OR, OR, AND),
    "and": ("and", AND, AND, NOT),
    "=": ("==", COMPARISON, SUM, SUM),
    "!=": ("!=", COMPARISON, SUM, SUM),
    "<": ("<", COMPARISON, SUM, SUM),
    "<=": ("<=", COMPARISON, SUM, SUM),
    ">": (">", COMPARISON, SUM, SUM),
    ">=": (">=", COMPARISON, SUM, SUM),
    "in": ("in", COMPARISON, SUM, SUM),
    "not in": ("not in", COMPARISON, SUM, SUM),
    "+": ("+", SUM, SUM, PRODUCT),
    "-": ("-", SUM, SUM, PRODUCT),
    "*": ("*", PRODUCT, PRODUCT, NEGATION),
    "//": ("//", PRODUCT, PRODUCT, NEGATION),
    "%": ("%", PRODUCT, PRODUCT, NEGATION),
}
"""How an operation is written, how tightly it binds, and what its left and its right operand need: Python would chain
comparisons."""

UNARY: dict[ast.UnaryOp, tuple[int, str]] = {"not": (NOT, "not "), "-": (NEGATION, "-")}

QUANTIFIERS = {"exists": "any", "forall": "all", "sum": "sum", "min": "min", "max": "max"}
"""The aggregates for which Python has a builtin."""

FUNCTIONS = {"abs": True, "len": True, "first": False, "rest": False, "poss": False, "before": False}
"""The functions of the language, and whether they are builtins of Python."""


def term_doc(names: Names, expr: ast.ValueExpr | ast.IntervalType, least: int = CONDITIONAL) -> Doc:
    """An expression or value where something that binds at least so tightly is needed."""
    level, doc = _leveled(names, expr)
    return doc if level >= least else Brackets("(", (doc,), ")")


def _leveled(names: Names, expr: ast.ValueExpr | ast.IntervalType) -> tuple[int, Doc]:
    match expr:
        case ast.Binary(op="implies" | "iff" as word, left=left, right=right):
            return ATOM, call_doc(names.word(word), term_doc(names, left), term_doc(names, right))
        case ast.Binary():
            return _operation(names, expr)
        case ast.Unary(op=op, operand=operand):
            level, sign = UNARY[op]
            return level, Joined((sign, term_doc(names, operand, level)))
        case ast.IfElse(then=then, condition=condition, otherwise=otherwise):
            rest = (("if", term_doc(names, condition, OR)), ("else", term_doc(names, otherwise)))
            return CONDITIONAL, Chain(CONDITIONAL, term_doc(names, then, OR), rest)
        case _:
            return ATOM, _atom(names, expr)


def _operation(names: Names, expr: ast.Binary) -> tuple[int, Doc]:
    """An operation; operations of one level to its left join it, in a loop, for they may be many."""
    level, before = BINARY[expr.op][1:3]
    rest: list[tuple[str, Doc]] = []
    left: ast.Expr = expr
    while isinstance(left, ast.Binary) and left.op in BINARY and BINARY[left.op][1] == level:
        sign, _, _, behind = BINARY[left.op]
        rest.append((sign, term_doc(names, left.right, behind)))
        left = left.left
        if level == COMPARISON:
            break
    return level, Chain(level, term_doc(names, left, before), tuple(reversed(rest)))


def _atom(names: Names, expr: ast.ValueExpr | ast.IntervalType) -> Doc:
    match expr:
        case ast.Number(value=value):
            return str(value)
        case ast.Real(value=value):
            return real(value)
        case ast.Message():
            return message_text(expr, lambda part: one_line(term_doc(names, part)))
        case ast.Truth(value=value):
            return str(value)
        case ast.Nothing():
            return "None"
        case ast.Apply():
            return _apply(names, expr)
        case ast.Index(base=base, index=index):
            return Joined((_indexed(names, base), Brackets("[", (term_doc(names, index),), "]")))
        case ast.Extremum(kind=kind, args=args):
            return call_doc(kind, *term_docs(names, args))
        case ast.Epistemic(kind=kind, body=body):
            return call_doc(names.word(kind), term_doc(names, body))
        case ast.SetLiteral(elements=()):
            return "set()"
        case ast.SetLiteral(elements=elements):
            return collection(names, "{", elements, "}")
        case ast.ListLiteral(elements=elements):
            return collection(names, "[", elements, "]")
        case ast.Unknown():
            return names.word("unknown")
        case ast.OneOf(choices=choices):
            return call_doc(names.word("one_of"), term_doc(names, choices))
        case ast.IntervalType():
            return type_doc(names, expr)
        case _:
            return _generated(names, expr)


def _generated(names: Names, expr: ast.ValueExpr) -> Doc:
    match expr:
        case ast.Quantifier(kind=kind, binders=binders, where=where, body=body):
            word = QUANTIFIERS.get(kind) or names.word(kind)
            return Joined((word, _clauses(names, "(", body, binders, where, ")")))
        case ast.Comprehension(kind="set", element=element, binders=binders, where=where):
            return _clauses(names, "{", element, binders, where, "}")
        case ast.Comprehension(element=element, binders=binders, where=where):
            return _clauses(names, "[", element, binders, where, "]")
        case _:
            raise TypeError(f"{expr!r} is no expression")


def _clauses(
    names: Names, opening: str, element: ast.Expr, binders: Iterable[ast.Binder], where: ast.Expr | None, closing: str
) -> Doc:
    """``(ψ for x in t for y in l if φ)``."""
    with names.bound():
        parts: list[Doc] = []
        for binder in binders:
            source = source_doc(names, binder, OR)
            names.bind(binder.name.text)
            parts.append(Joined((f"for {python_name(binder.name.text)} in ", source)))
        if where is not None:
            parts.append(Joined(("if ", term_doc(names, where, OR))))
        return Brackets(opening, (term_doc(names, element), *parts), closing, separator="")


def source_doc(names: Names, binder: ast.Binder, least: int = CONDITIONAL) -> Doc:
    """What a variable ranges over: a type, or the elements of a set or list."""
    match binder:
        case ast.Binder(type=None, collection=ast.Apply(name=name, args=())) if names.is_type(name.text):
            return call_doc(names.word("values"), names.term(name.text))
        case ast.Binder(collection=None, type=type_):
            assert type_ is not None, "a binder has a type or a collection"
            return type_doc(names, type_)
    assert binder.collection is not None, "a binder has a type or a collection"
    return term_doc(names, binder.collection, least)


def _apply(names: Names, expr: ast.Apply) -> Doc:
    name, args = expr.name.text, expr.args
    if not args:
        return names.term(name)
    if name not in FUNCTIONS:
        return call_doc(names.function(name), *term_docs(names, args))
    word = name if FUNCTIONS[name] else names.word(name)
    if name == "poss":
        return call_doc(word, *(_of_action(names, arg) for arg in args))
    return call_doc(word, *term_docs(names, args))


def _of_action(names: Names, expr: ast.Expr) -> Doc:
    match expr:
        case ast.Apply(name=name, args=()) if not names.is_local(name.text):
            return names.program(name.text)
        case ast.Apply(name=name, args=args) if args and (name.text in names.programs or name.text not in FUNCTIONS):
            return call_doc(names.program(name.text), *term_docs(names, args))
    return term_doc(names, expr)


def program_doc(names: Names, target: ast.Apply) -> Doc:
    """A call of an action or a procedure: with parentheses even without arguments."""
    return call_doc(names.program(target.name.text), *term_docs(names, target.args))


def term_docs(names: Names, expressions: Iterable[ast.Expr]) -> tuple[Doc, ...]:
    return tuple(term_doc(names, expression) for expression in expressions)


def call_doc(function: Doc, *args: Doc) -> Doc:
    """``f(a, b)``."""
    return Joined((function, Brackets("(", args, ")")))


def collection(names: Names, opening: str, elements: Iterable[ast.Expr], closing: str) -> Doc:
    return Brackets(opening, term_docs(names, elements), closing, packed=False)


def type_doc(names: Names, type_: ast.Type, strings: bool = False) -> Doc:
    """A type; with ``strings`` the symbols of an enumeration are strings, otherwise their variables."""
    match type_:
        case ast.TypeName(name=name):
            return names.type(name.text)
        case ast.IntervalType(low=low, high=high):
            bounds = (term_doc(names, low), term_doc(names, high))
            return Joined((names.word("interval"), Brackets("(", bounds, ")")))
        case ast.EnumType(elements=elements):
            found = tuple(_element(names, element, strings) for element in elements)
            return Joined((names.word("enum"), Brackets("(", found, ")")))
        case ast.UnionType(pieces=pieces):
            return _alternatives([type_doc(names, piece, strings) for piece in pieces])
        case ast.OptionalType(base=ast.UnionType(pieces=pieces)):
            return _alternatives([*(type_doc(names, piece, strings) for piece in pieces), "None"])
        case ast.OptionalType(base=base):
            return _alternatives([type_doc(names, base, strings), "None"])
        case ast.CollectionType(kind=kind, element=element):
            return Joined((kind, Brackets("[", (type_doc(names, element, strings),), "]")))
        case _:
            raise TypeError(f"{type_!r} is no type")


def _element(names: Names, element: ast.Ident | ast.Number, strings: bool) -> Doc:
    match element:
        case ast.Number(value=value):
            return str(value)
    return quoted(element.text) if strings else names.element(element.text)


def _alternatives(pieces: list[Doc]) -> Doc:
    return Chain(UNION, pieces[0], tuple(("|", piece) for piece in pieces[1:]))


def _indexed(names: Names, base: ast.Expr) -> Doc:
    doc = term_doc(names, base)
    return doc if isinstance(base, ast.Apply | ast.Index | ast.ListLiteral) else Brackets("(", (doc,), ")")


def real(value: Decimal) -> str:
    """A real as it is written in golc and in Python."""
    text = f"{value:f}"
    return text if "." in text else f"{text}.0"


def keyword(name: str, value: Doc) -> Doc:
    """``when=φ``."""
    return Joined((f"{name}=", value))


def optional(name: str, value: Doc | None) -> tuple[Doc, ...]:
    """A keyword argument, if there is one."""
    return () if value is None else (keyword(name, value),)


def maybe(names: Names, expr: ast.Expr | None) -> Doc | None:
    return None if expr is None else term_doc(names, expr)
