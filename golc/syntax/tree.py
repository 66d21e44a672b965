"""The abstract syntax tree of a golc file, the same for text and for Python.

Every node is a frozen dataclass that ends in the ``span`` it came from. Spans take no part in comparison: two trees are
equal if they say the same. Sequences are tuples. Nothing here is resolved: a ``Name`` may be a constant, a symbol, a
variable or a fluent, and a ``Call`` an action or a procedure.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from decimal import Decimal
from typing import Literal, TypeAlias

from golc.diagnostics import NOWHERE, Span


@dataclass(frozen=True)
class Node:
    """The base of every node of the tree."""

    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class Ident(Node):
    """A name with its place."""

    text: str


@dataclass(frozen=True)
class Number(Node):
    value: int


@dataclass(frozen=True)
class Real(Node):
    """``0.25``, kept as written."""

    value: Decimal


@dataclass(frozen=True)
class Message(Node):
    """``"…{e}…"``: pieces of text (escapes resolved) and expressions in turn; a plain string is one piece or none."""

    parts: tuple[str | Expr, ...]


@dataclass(frozen=True)
class Truth(Node):
    value: bool


@dataclass(frozen=True)
class Nothing(Node):
    """``none``."""


@dataclass(frozen=True)
class Apply(Node):
    """``f`` or ``f(e, …)``; also the functions ``abs len first rest poss before``."""

    name: Ident
    args: tuple[Expr, ...] = ()


@dataclass(frozen=True)
class Index(Node):
    """``l[i]``."""

    base: Expr
    index: Expr


UnaryOp: TypeAlias = Literal["-", "not"]
BinaryOp: TypeAlias = Literal[
    "+", "-", "*", "//", "%", "=", "!=", "<", "<=", ">", ">=", "in", "not in", "and", "or", "implies", "iff"
]


@dataclass(frozen=True)
class Unary(Node):
    op: UnaryOp
    operand: Expr


@dataclass(frozen=True)
class Binary(Node):
    """An infix operation. The right side of ``in`` and ``not in`` may also be an ``IntervalType``."""

    op: BinaryOp
    left: Expr
    right: Expr | IntervalType


@dataclass(frozen=True)
class IfElse(Node):
    """``then if condition else otherwise``."""

    then: Expr
    condition: Expr
    otherwise: Expr


@dataclass(frozen=True)
class Binder(Node):
    """``name: type``, or ``name in collection``: exactly one of ``type`` and ``collection`` is given."""

    name: Ident
    type: Type | None = None
    collection: Expr | None = None


QuantifierKind: TypeAlias = Literal["exists", "forall", "count", "sum", "min", "max"]


@dataclass(frozen=True)
class Quantifier(Node):
    """``exists x: t where φ. ψ`` and the aggregates ``count sum min max`` of the same form."""

    kind: QuantifierKind
    binders: tuple[Binder, ...]
    where: Expr | None
    body: Expr


@dataclass(frozen=True)
class Extremum(Node):
    """``min(a, b, …)`` or ``max(a, b, …)``."""

    kind: Literal["min", "max"]
    args: tuple[Expr, ...]


@dataclass(frozen=True)
class Epistemic(Node):
    """``known(t)``, ``knows(φ)``, ``possible(φ)``."""

    kind: Literal["known", "knows", "possible"]
    body: Expr


@dataclass(frozen=True)
class SetLiteral(Node):
    elements: tuple[Expr, ...]


@dataclass(frozen=True)
class ListLiteral(Node):
    elements: tuple[Expr, ...]


@dataclass(frozen=True)
class Comprehension(Node):
    """``{e for x: t where φ}`` or ``[e for x: t where φ]``."""

    kind: Literal["set", "list"]
    element: Expr
    binders: tuple[Binder, ...]
    where: Expr | None


@dataclass(frozen=True)
class Unknown(Node):
    """``unknown`` as a value: any of the fluent's type."""


@dataclass(frozen=True)
class OneOf(Node):
    """``one of e`` as a value."""

    choices: Expr


Expr: TypeAlias = (
    Number
    | Real
    | Message
    | Truth
    | Nothing
    | Apply
    | Index
    | Unary
    | Binary
    | IfElse
    | Quantifier
    | Extremum
    | Epistemic
    | SetLiteral
    | ListLiteral
    | Comprehension
)
ValueExpr: TypeAlias = Expr | Unknown | OneOf


@dataclass(frozen=True)
class TypeName(Node):
    """A declared type, or ``bool int real string``."""

    name: Ident


@dataclass(frozen=True)
class IntervalType(Node):
    """``low .. high``."""

    low: Expr
    high: Expr


@dataclass(frozen=True)
class EnumType(Node):
    """``{a, b}`` or ``{-1, 1}``: names or integers in declared order."""

    elements: tuple[Ident | Number, ...]


@dataclass(frozen=True)
class UnionType(Node):
    """``a + b + …``, at least two pieces."""

    pieces: tuple[TypeName | IntervalType | EnumType, ...]


@dataclass(frozen=True)
class OptionalType(Node):
    """``t?``."""

    base: Type


@dataclass(frozen=True)
class CollectionType(Node):
    """``set[t]`` or ``list[t]``."""

    kind: Literal["set", "list"]
    element: Type


Type: TypeAlias = TypeName | IntervalType | EnumType | UnionType | OptionalType | CollectionType


@dataclass(frozen=True)
class Parameter(Node):
    name: Ident
    type: Type


@dataclass(frozen=True)
class Import(Node):
    path: str


@dataclass(frozen=True)
class Const(Node):
    name: Ident
    value: Expr


@dataclass(frozen=True)
class TypeDecl(Node):
    name: Ident
    type: Type


@dataclass(frozen=True)
class TableEntry(Node):
    """``key: value``; a key of several arguments has several elements."""

    key: tuple[Expr, ...]
    value: Expr


@dataclass(frozen=True)
class Table(Node):
    entries: tuple[TableEntry, ...]


@dataclass(frozen=True)
class Static(Node):
    name: Ident
    parameters: tuple[Parameter, ...]
    type: Type | None
    value: Expr | Table


@dataclass(frozen=True)
class Extern(Node):
    """A function of the Python file ``path``; without a type it is a relation (``bool``)."""

    name: Ident
    parameters: tuple[Parameter, ...]
    type: Type | None
    path: str


@dataclass(frozen=True)
class Fluent(Node):
    """Without a type it is relational (``bool``); a missing initial value is a finding of the checker."""

    name: Ident
    parameters: tuple[Parameter, ...]
    type: Type | None
    initial: ValueExpr | None


@dataclass(frozen=True)
class Initially(Node):
    condition: Expr


@dataclass(frozen=True)
class Define(Node):
    name: Ident
    parameters: tuple[Parameter, ...]
    body: Expr


@dataclass(frozen=True)
class Effect(Node):
    """``causes [forall binders [where φ].] fluent(args) := value [when condition]``."""

    binders: tuple[Binder, ...]
    where: Expr | None
    target: Apply
    value: ValueExpr
    condition: Expr | None


@dataclass(frozen=True)
class Precondition(Node):
    condition: Expr


@dataclass(frozen=True)
class Senses(Node):
    value: Expr


@dataclass(frozen=True)
class Cost(Node):
    value: Expr


Clause: TypeAlias = Precondition | Effect | Senses | Cost


@dataclass(frozen=True)
class Action(Node):
    name: Ident
    parameters: tuple[Parameter, ...]
    clauses: tuple[Clause, ...]


@dataclass(frozen=True)
class Exog(Node):
    name: Ident
    parameters: tuple[Parameter, ...]
    expected: bool
    sources: tuple[Ident, ...]
    clauses: tuple[Clause, ...]


@dataclass(frozen=True)
class Pattern(Node):
    """``a(x, 3)`` in an ``after``: names are constants, parameters of the head, or bound here."""

    action: Ident
    args: tuple[Ident | Number | Truth | Nothing, ...]


@dataclass(frozen=True)
class After(Node):
    pattern: Pattern
    value: ValueExpr
    condition: Expr | None


@dataclass(frozen=True)
class Axiom(Node):
    """A *successor state axiom*; ``otherwise unchanged`` is always its last line."""

    fluent: Ident
    parameters: tuple[Ident, ...]
    cases: tuple[After, ...]


@dataclass(frozen=True)
class Invariant(Node):
    name: Ident
    condition: Expr


@dataclass(frozen=True)
class Goal(Node):
    name: Ident
    condition: Expr


@dataclass(frozen=True)
class Prune(Node):
    name: Ident
    condition: Expr


@dataclass(frozen=True)
class PruneAfter(Node):
    name: Ident
    pattern: Pattern
    condition: Expr | None


@dataclass(frozen=True)
class Given(Node):
    condition: Expr


@dataclass(frozen=True)
class Run(Node):
    program: Apply


@dataclass(frozen=True)
class OnEvents(Node):
    """``on events after n``, ``on events when φ`` or ``on events when waiting``."""

    events: tuple[Apply, ...]
    trigger: Literal["after", "when", "waiting"]
    argument: Expr | None


@dataclass(frozen=True)
class Until(Node):
    condition: Expr


@dataclass(frozen=True)
class ExpectCount(Node):
    action: Apply
    relation: Literal["at least", "at most", "exactly"]
    count: Expr


@dataclass(frozen=True)
class ExpectActions(Node):
    actions: tuple[Apply, ...]


@dataclass(frozen=True)
class ExpectFormula(Node):
    condition: Expr


ScenarioItem: TypeAlias = Given | Run | OnEvents | Until | ExpectCount | ExpectActions | ExpectFormula


@dataclass(frozen=True)
class Scenario(Node):
    name: Ident
    items: tuple[ScenarioItem, ...]


@dataclass(frozen=True)
class Proc(Node):
    name: Ident
    parameters: tuple[Parameter, ...]
    body: Block


@dataclass(frozen=True)
class ByCall(Node):
    function: Ident


@dataclass(frozen=True)
class ByStart(Node):
    task: Ident


@dataclass(frozen=True)
class ByPrompt(Node):
    message: Message


@dataclass(frozen=True)
class Binding(Node):
    """One line of a device block: ``8 .. look(s: station) by call look timeout 9 s {1: a}``."""

    action: Ident
    args: tuple[Parameter | Ident | Number | Truth | Nothing, ...] | None
    number: int | None
    ranged: bool
    behaviour: ByCall | ByStart | ByPrompt | None
    table: Table | None
    timeout: Expr | None


@dataclass(frozen=True)
class Setting(Node):
    """``set name value [s]``."""

    name: Ident
    value: Expr
    seconds: bool


@dataclass(frozen=True)
class Device(Node):
    """``device kind [name] ["file"]`` with its bindings and settings."""

    kind: Ident
    name: Ident | None
    file: str | None
    items: tuple[Binding | Setting, ...]


Declaration: TypeAlias = (
    Import
    | Const
    | TypeDecl
    | Static
    | Extern
    | Fluent
    | Initially
    | Define
    | Action
    | Exog
    | Axiom
    | Invariant
    | Goal
    | Prune
    | PruneAfter
    | Scenario
    | Proc
    | Device
)


STAND_IN = "unread"
"""The name that stands for a part which could not be read, with underscores behind it if the text has this name."""


@dataclass(frozen=True)
class File(Node):
    """A whole file: its domain's name and its declarations in order; ``unread`` is what could not be read of it."""

    domain: Ident
    declarations: tuple[Declaration, ...]
    unread: tuple[Span, ...] = field(default=(), compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class Call(Node):
    """A primitive action or a procedure with its arguments."""

    target: Apply


@dataclass(frozen=True)
class Test(Node):
    condition: Expr


@dataclass(frozen=True)
class Skip(Node):
    pass


@dataclass(frozen=True)
class If(Node):
    """``branches`` are the ``if`` and each ``elif``: condition and block."""

    branches: tuple[tuple[Expr, Block], ...]
    otherwise: Block | None


@dataclass(frozen=True)
class While(Node):
    condition: Expr
    body: Block


@dataclass(frozen=True)
class Choose(Node):
    branches: tuple[Block, ...]


@dataclass(frozen=True)
class Pick(Node):
    binders: tuple[Binder, ...]
    where: Expr | None
    body: Block


@dataclass(frozen=True)
class Star(Node):
    limit: Expr | None
    body: Block


@dataclass(frozen=True)
class For(Node):
    binders: tuple[Binder, ...]
    where: Expr | None
    body: Block


@dataclass(frozen=True)
class Let(Node):
    name: Ident
    value: Expr
    body: Block


@dataclass(frozen=True)
class Together(Node):
    branches: tuple[Block, ...]


@dataclass(frozen=True)
class TogetherStar(Node):
    body: Block


@dataclass(frozen=True)
class Prefer(Node):
    """Highest first."""

    branches: tuple[Block, ...]


@dataclass(frozen=True)
class On(Node):
    """``on φ:`` (no binders) or ``on some binders where φ:``."""

    binders: tuple[Binder, ...]
    condition: Expr
    body: Block


@dataclass(frozen=True)
class Interrupts(Node):
    handlers: tuple[On, ...]


@dataclass(frozen=True)
class Guard(Node):
    condition: Expr
    body: Block


@dataclass(frozen=True)
class Search(Node):
    mode: Literal["first", "shortest", "cheapest"] | None
    at_most: Expr | None
    within: Expr | None
    body: Block


@dataclass(frozen=True)
class Wait(Node):
    pass


@dataclass(frozen=True)
class WaitUntil(Node):
    condition: Expr


@dataclass(frozen=True)
class WaitTime(Node):
    """``wait e s``: seconds."""

    duration: Expr


@dataclass(frozen=True)
class Within(Node):
    """``within e s``: seconds."""

    duration: Expr
    body: Block
    otherwise: Block | None


@dataclass(frozen=True)
class Say(Node):
    message: Message


@dataclass(frozen=True)
class Abort(Node):
    message: Message


Statement: TypeAlias = (
    Call
    | Test
    | Skip
    | If
    | While
    | Choose
    | Pick
    | Star
    | For
    | Let
    | Together
    | TogetherStar
    | Prefer
    | Interrupts
    | Guard
    | Search
    | Wait
    | WaitUntil
    | WaitTime
    | Within
    | Say
    | Abort
)


@dataclass(frozen=True)
class Block(Node):
    """Statements one below the other, at least one."""

    statements: tuple[Statement, ...]
