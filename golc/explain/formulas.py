"""Terms and formulas in the notation of the papers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from golc.explain import signs
from golc.explain.document import Document, Group, Line, Nest, Text, join, separated
from golc.explain.pieces import (
    AGGREGATES,
    AND,
    ATOM,
    BRACKETS,
    COMPARISON,
    IMPLICATION,
    INFIX,
    NEGATION,
    NOT,
    OPEN,
    OR,
    PRODUCT,
    SUM,
    infixed,
    listed,
    quantified,
    type_text,
    value_text,
)
from golc.theory.reading import reached
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
    Operator,
    PossTerm,
    Quantified,
    StaticTerm,
    Term,
    Variable,
)
from golc.theory.terms import Text as Message
from golc.theory.theory import BasicActionTheory
from golc.theory.types import BOOL, Collection


@dataclass(frozen=True)
class Formulas:
    """Writes the terms of a scope.

    ``names`` are those of the variables by level; ``taken`` are names that stand for something else. ``now`` is the
    situation that fluents are written with, none where it goes without saying; ``before`` is the one before it.
    """

    theory: BasicActionTheory
    names: tuple[Text, ...] = ()
    taken: frozenset[str] = frozenset()
    now: Document | None = None
    before: Document | None = None

    def at(self, now: Document | None, before: Document | None = None) -> Formulas:
        """The same in another situation."""
        return replace(self, now=now, before=before)

    def extended(self, names: Iterable[str]) -> Formulas:
        """With more variables in scope, each under a name that nothing else has."""
        known = list(self.names)
        for name in names:
            others = {other.plain for other in known} | self.taken
            index = next(index for index in range(len(others) + 1) if _name(name, index).plain not in others)
            known.append(_name(name, index))
        return replace(self, names=tuple(known))

    def bound(self, binders: Sequence[Binder]) -> tuple[Formulas, Document]:
        """With the variables of binders in scope; and the binders: ``x: t, y ∈ e``."""
        inner, parts = self, list[Document]()
        for binder in binders:
            within = None if binder.within is None else inner.term(binder.within)
            inner = inner.extended([binder.variable.name])
            name = inner.names[-1]
            of_type = join(name, signs.COLON, type_text(binder.variable.type))
            parts.append(of_type if within is None else join(name, signs.IN, within))
        return inner, separated(parts, signs.sign(", "))

    def applied(self, name: Text, args: Sequence[Document], situation: Document | None = None) -> Document:
        """``f(x, s)``; without arguments the name alone."""
        parts = [*args, *([] if situation is None else [situation])]
        return join(name, signs.sign("("), separated(parts, signs.sign(", ")), signs.sign(")")) if parts else name

    def term(self, term: Term, least: int = OPEN, last: bool = True) -> Document:
        """A term where something binding at least so tightly is needed; ``last`` if nothing follows that a quantifier,
        which takes everything to its right, could take."""
        level = self._level(term, last)
        body = self._body(term, last or level < least)
        return body if level >= least else join(signs.sign("("), body, signs.sign(")"))

    def among(self, choice: Choice) -> Document:
        """The values of which one is chosen; a type by its name."""
        return self._collection(choice.among)

    def _level(self, term: Term, last: bool) -> int:
        match term:
            case Quantified(kind="exists" | "forall"):
                return ATOM if last else OPEN
            case Membership():
                return COMPARISON
            case Operation(op=Operator.NOT, args=(Membership() | Operation(op=Operator.ELEMENT),)):
                return COMPARISON
            case Operation(op=Operator.CONDITIONAL):
                return OPEN
            case Operation(op=Operator.IMPLIES | Operator.IFF):
                return IMPLICATION
            case Operation(op=Operator.OR):
                return OR
            case Operation(op=Operator.AND):
                return AND
            case Operation(op=Operator.NOT):
                return NOT
            case Operation(op=Operator.NEGATE):
                return NEGATION
            case Operation(op=op):
                return INFIX[op][0] if op in INFIX else ATOM
            case Epistemic(kind="possible"):
                return NOT
            case _:
                return ATOM

    def _body(self, term: Term, last: bool) -> Document:
        match term:
            case Literal(value=value, type=type_):
                return value_text(value, type_)
            case Variable(level=level):
                return self.names[level]
            case FluentTerm(fluent=name, args=args):
                return self.applied(signs.words(name), self._terms(args), self.now)
            case StaticTerm(static=name, args=args):
                return self.applied(signs.words(name), self._terms(args))
            case DefinedTerm(definition=name, args=args):
                return self.applied(signs.words(name), self._terms(args), self.situation_of(name))
            case PossTerm(action=name, args=args):
                action = self.applied(signs.words(name), self._terms(args))
                return self.applied(signs.words("Poss"), [action], self.now)
            case Operation():
                return self._operation(term, last)
            case Membership(element=element, within=within):
                return join(self.term(element, SUM, False), signs.IN, type_text(within))
            case Quantified():
                return self._quantified(term)
            case Display(elements=elements, type=Collection(kind=kind)):
                return Group(listed(kind, self._terms(elements)))
            case Comprehension(binders=binders, where=where, element=element, type=Collection(kind=kind)):
                opening, closing = BRACKETS[kind]
                return self._built(opening, closing, binders, where, element)
            case Message(parts=parts):
                return self.message(parts)
            case Epistemic():
                return self._epistemic(term)
            case Before(body=body):
                return self.at(self.before).term(body, ATOM)
        raise TypeError(f"{term!r} has no notation")

    def situation_of(self, definition: str) -> Document | None:
        """The situation, if what a definition stands for depends on one."""
        body = self.theory.definitions[definition].body
        situational = any(isinstance(part, FluentTerm | PossTerm | Epistemic) for part in reached(self.theory, [body]))
        return self.now if situational else None

    def message(self, parts: Iterable[str | Term]) -> Document:
        """A string with terms in it: ``"at {location(s)}"``."""
        braces = (Text("{", r"\{"), Text("}", r"\}"))
        pieces = [
            signs.string_piece(part) if isinstance(part, str) else join(braces[0], self.term(part), braces[1])
            for part in parts
        ]
        return join(signs.string_piece('"'), *pieces, signs.string_piece('"'))

    def _terms(self, terms: Iterable[Term]) -> list[Document]:
        return [self.term(term) for term in terms]

    def _operation(self, term: Operation, last: bool) -> Document:
        match term.op, term.args:
            case Operator.NOT, (Membership(element=element, within=within),):
                return join(self.term(element, SUM, False), signs.NOT_IN, type_text(within))
            case Operator.NOT, (Operation(op=Operator.ELEMENT, args=(element, collection)),):
                return join(self.term(element, SUM, False), signs.NOT_IN, self._collection(collection))
            case Operator.ELEMENT, (element, collection):
                return join(self.term(element, SUM, False), signs.IN, self._collection(collection))
            case Operator.NOT, (operand,):
                return join(signs.NOT, self.term(operand, ATOM, last))
            case Operator.AND, operands:
                return self.infix(signs.AND, _flat(Operator.AND, operands), NOT, last)
            case Operator.OR, operands:
                return self.infix(signs.OR, _flat(Operator.OR, operands), AND, last)
            case Operator.IMPLIES, (left, right):
                parts = [self.term(left, OR, False), self.term(right, IMPLICATION, last)]
                return infixed(signs.IMPLIES, parts)
            case Operator.IFF, operands:
                return self.infix(signs.EQUIVALENT, operands, OR, last)
            case Operator.CONDITIONAL, (then, condition, otherwise):
                words = [signs.keyword(word) for word in ("if ", " then ", " else ")]
                choice = [self.term(part, IMPLICATION) for part in (condition, then, otherwise)]
                return join(*chain.from_iterable(zip(words, choice, strict=True)))
            case Operator.NEGATE, (operand,):
                return join(signs.sign("-"), self.term(operand, NEGATION, last))
            case Operator.DIVIDE, (left, right):
                inside = join(self.term(left, PRODUCT, False), signs.sign(" / "), self.term(right, NEGATION))
                return join(Text("⌊", r"\lfloor "), inside, Text("⌋", r" \rfloor"))
            case Operator.ABSOLUTE, (operand,):
                return join(Text("|", r"\lvert "), self.term(operand), Text("|", r" \rvert"))
            case Operator.INDEX, (collection, index):
                return join(self.term(collection, ATOM), signs.sign("["), self.term(index), signs.sign("]"))
            case op, (left, right) if op in INFIX:
                level, before, behind, plain, tex = INFIX[op]
                space = Line() if level == SUM else signs.sign(" ")
                sign = Text(f"{plain} ", f"{tex} ")
                return Group(join(self.term(left, before, False), space, sign, Nest(self.term(right, behind, last))))
            case op, operands:
                return self.applied(signs.words(op.value), self._terms(operands))

    def infix(self, sign: Text, operands: Iterable[Term], least: int, last: bool) -> Document:
        """Operands with a sign between them, at which lines are broken."""
        *others, final = operands
        return infixed(sign, [*(self.term(each, least, False) for each in others), self.term(final, least, last)])

    def _quantified(self, term: Quantified) -> Document:
        if term.kind in AGGREGATES:
            body = None if term.kind == "count" else term.body
            where = term.where
            if body is None:
                where = term.body if where is None else Operation(Operator.AND, (where, term.body), type=BOOL)
            opening, closing = BRACKETS["set"]
            built = self._built(opening, closing, term.binders, where, body)
            return join(AGGREGATES[term.kind], built)
        inner, binders = self.bound(term.binders)
        op, sign = (Operator.AND, signs.EXISTS) if term.kind == "exists" else (Operator.IMPLIES, signs.FORALL)
        formula = term.body if term.where is None else Operation(op, (term.where, term.body), type=BOOL)
        return quantified(sign, binders, inner.term(formula))

    def _built(
        self, opening: Text, closing: Text, binders: tuple[Binder, ...], where: Term | None, element: Term | None
    ) -> Document:
        """``{e | x: t, φ}``; without e (to be counted) ``{x: t | φ}``."""
        inner, variables = self.bound(binders)
        bar = Text(" | ", r" \mid ")
        condition = [] if where is None else [inner.term(where, IMPLICATION)]
        if element is None:
            return join(opening, separated([variables, *condition], bar), closing)
        behind = separated([variables, *condition], signs.sign(", "))
        return join(opening, inner.term(element, IMPLICATION), bar, behind, closing)

    def _epistemic(self, term: Epistemic) -> Document:
        """*Knows(φ, s)*, inside of which the situation goes without saying, *KWhether*, *KRef* (Scherl & Levesque)."""
        body = self.at(None)
        match term.kind:
            case "knows":
                return self.applied(signs.words("Knows"), [body.term(term.body)], self.now)
            case "possible":
                negated = body.term(Operation(Operator.NOT, (term.body,), type=BOOL))
                return join(signs.NOT, self.applied(signs.words("Knows"), [negated], self.now))
            case "known":
                word = "KWhether" if term.body.type == BOOL else "KRef"
                return self.applied(signs.words(word), [body.term(term.body)], self.now)

    def _collection(self, term: Term) -> Document:
        """A collection behind ∈: all values of a type are named by the type."""
        match term:
            case Literal(value=tuple() as values, type=Collection(element=element)):
                if element.finite and len(element.values) == len(values):
                    return type_text(element)
                return listed("set", [value_text(value, element) for value in values])
            case Display(elements=elements):
                return listed("set", self._terms(elements))
            case _:
                return self.term(term, SUM, False)


def _name(name: str, index: int) -> Text:
    return signs.indexed(name, index) if index else signs.words(name)


def _flat(op: Operator, operands: Iterable[Term]) -> list[Term]:
    """Operands with those of the same operation among them; no recursion, for the depth is the input's."""
    stack, found = [*operands][::-1], list[Term]()
    while stack:
        term = stack.pop()
        if isinstance(term, Operation) and term.op is op:
            stack.extend(reversed(term.args))
        else:
            found.append(term)
    return found
