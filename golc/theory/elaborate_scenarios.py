"""Scenarios: whatever stands in them but formulas has a value before they run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from golc.diagnostics import Code, Label, Span
from golc.syntax import tree
from golc.theory.context import Context
from golc.theory.elaborate_names import TERMS, arity_fits, doing
from golc.theory.elaborate_terms import formula
from golc.theory.elaborate_values import argument, evaluated, situational
from golc.theory.expectations import broken, fits
from golc.theory.fitting import BROKEN
from golc.theory.forms import word
from golc.theory.scenarios import (
    Assignment,
    Assumption,
    Events,
    ExpectActions,
    Expectation,
    ExpectCount,
    ExpectFormula,
    Given,
    GroundCall,
    Scenario,
)
from golc.theory.scope import Entry, Kind, Scope
from golc.theory.suggest import distance
from golc.theory.terms import DefinedTerm, Epistemic, FluentTerm, Operation, Operator, PossTerm, Term, subterms
from golc.theory.types import INT, Value, show_call


def scenarios(context: Context, nodes: Sequence[tree.Scenario]) -> dict[str, Scenario]:
    """The scenarios of a file by name; they have a namespace of their own."""
    found: dict[str, Scenario] = {}
    places: dict[str, Span] = {}
    for node in nodes:
        name = node.name.text
        if name in places:
            labels = (Label(places[name], "first declared here"),)
            message = f"scenario `{name}` is declared twice"
            context.error(Code.DUPLICATE, message, node.name.span, "declared again", labels=labels)
        places.setdefault(name, node.name.span)
        scenario = _Scenario(context, node).scenario()
        if scenario is not None:
            found.setdefault(name, scenario)
    return found


@dataclass
class _Scenario:
    """Collects the lines of a scenario; ``good`` is whether all of them have a meaning."""

    context: Context
    node: tree.Scenario
    good: bool = True
    givens: list[Given] = field(default_factory=list)
    given_values: dict[tuple[str, tuple[Value, ...]], Span] = field(default_factory=dict)
    runs: list[tuple[Span, GroundCall]] = field(default_factory=list)
    events: list[Events] = field(default_factory=list)
    until: list[tuple[Span, Term]] = field(default_factory=list)
    expectations: list[Expectation] = field(default_factory=list)

    def scenario(self) -> Scenario | None:
        """The scenario, or none if there is an error in it."""
        for item in self.node.items:
            self.item(item)
        self.once("run", [span for span, _ in self.runs])
        self.once("until", [span for span, _ in self.until])
        procedure = self.runs[0][1] if self.runs else self.control()
        if not self.good or procedure is None:
            return None
        return Scenario(
            self.node.name.text,
            tuple(self.givens),
            procedure,
            tuple(self.events),
            self.until[0][1] if self.until else None,
            tuple(self.expectations),
            span=self.node.name.span,
        )

    def once(self, word: str, spans: list[Span]) -> None:
        for span in spans[1:]:
            labels = (Label(spans[0], "the first one"),)
            message = f"scenario `{self.node.name.text}` has two lines with `{word}`"
            self.context.error(Code.MISPLACED_CLAUSE, message, span, "a second one", labels=labels)
            self.good = False

    def control(self) -> GroundCall | None:
        """What is run where the scenario does not say it."""
        if any(isinstance(item, tree.Run) for item in self.node.items):
            return None
        entry = self.context.names.doings.get("control")
        if entry is not None and entry.kind is Kind.PROCEDURE and not entry.arity:
            return GroundCall("control", (), span=self.node.name.span)
        if self.context.names.assumes("control") or self.context.names.nameless:
            return None
        message = f"scenario `{self.node.name.text}` does not say what it runs, and there is no procedure `control`"
        help_ = f"add a line `{self.node.name.span.either('run …', 'run(…)')}`"
        self.context.error(Code.MISPLACED_CLAUSE, message, self.node.name.span, help=help_)
        return None

    def item(self, item: tree.ScenarioItem) -> None:
        match item:
            case tree.Given(condition=condition):
                self.given(self.formula(condition, "`given`"))
            case tree.Run(program=program):
                call = self.call(program, (Kind.PROCEDURE,), "a procedure")
                self.runs += [(item.span, call)] if call else []
            case tree.OnEvents():
                self.on(item)
            case tree.Until(condition=condition):
                self.until.append((item.span, self.formula(condition, "`until`")))
            case tree.ExpectCount():
                self.count(item)
            case tree.ExpectActions(actions=actions):
                calls = [self.call(action, (Kind.ACTION,), "a primitive action") for action in actions]
                self.expectations.append(ExpectActions(tuple([call for call in calls if call]), span=item.span))
            case tree.ExpectFormula(condition=tree.ListLiteral() as actions):
                golc = "a list of actions stands behind the word `actions`: `expect actions […]`"
                help_ = actions.span.either(golc, "a list of actions has its name: `expect(actions=[…])`")
                self.context.error(Code.TYPE_MISMATCH, "a list is no formula", actions.span, "not a formula", help_)
                self.good = False
            case tree.ExpectFormula(condition=condition):
                self.expectations.append(ExpectFormula(self.formula(condition, "`expect`"), span=item.span))

    def formula(self, node: tree.Expr, what: str) -> Term:
        found = formula(self.context, Scope(), node, what)
        self.good &= found.type is not BROKEN
        return found

    def given(self, condition: Term) -> None:
        """Conjuncts of the form ``f(args) = e``, with values that are known now, replace initial values; where several
        initial values are possible they say, as all others do, which of the possible worlds is the real one."""
        for part in _conjuncts(condition):
            match part:
                case Operation(op=Operator.EQUAL, args=(FluentTerm() as target, value)) if not any(
                    self.situational(term) for term in (*target.args, value)
                ):
                    self.value(part, target, value)
                case _:
                    self.givens.append(Assumption(part, span=part.span))

    def situational(self, term: Term) -> bool:
        return any(
            isinstance(part, FluentTerm | PossTerm | Epistemic)
            or (isinstance(part, DefinedTerm) and situational(self.context, part.definition))
            for part in subterms(term)
        )

    def value(self, condition: Term, target: FluentTerm, value: Term) -> None:
        context, span = self.context, condition.span
        signature = context.signature(context.names.values.entries[target.fluent])
        types = [] if signature is None else [*(p.type for p in signature.parameters), signature.type]
        whats = [f"an argument of `{target.fluent}`"] * len(target.args) + [f"fluent `{target.fluent}`"]
        values = []
        for term, type_, what in zip((*target.args, value), types, whats, strict=True):
            found = evaluated(context, term)
            if found is None or not fits(context, found, type_, what):
                self.good = False
                return
            values.append(found.value)
        key = (target.fluent, tuple(values[:-1]))
        if key in self.given_values:
            message = f"`{show_call(*key)}` is given two values"
            labels = (Label(self.given_values[key], "the first one"),)
            context.error(Code.DUPLICATE, message, span, "given again", labels=labels)
            self.good = False
        self.given_values.setdefault(key, span)
        if self.chosen(target.fluent):
            self.givens.append(Assumption(condition, span=span))
        else:
            self.givens.append(Assignment(*key, values[-1], span=span))

    def chosen(self, fluent: str) -> bool:
        """Whether the declaration of a fluent says that several initial values are possible."""
        node = self.context.names.values.entries[fluent].node
        return isinstance(node, tree.Fluent) and isinstance(node.initial, tree.Unknown | tree.OneOf)

    def on(self, item: tree.OnEvents) -> None:
        calls = [self.call(event, (Kind.EXOGENOUS,), "an exogenous action") for event in item.events]
        trigger: int | Term | None = None
        if item.argument is not None and item.trigger == "after":
            trigger = self.number(item.argument)
        elif item.argument is not None:
            trigger = self.when(item.argument)
        self.events.append(Events(tuple([call for call in calls if call]), trigger, span=item.span))

    def when(self, node: tree.Expr) -> Term:
        """The condition of an event; a name that is like nothing but `waiting` is that word misspelt."""
        if isinstance(node, tree.Apply) and not node.args and distance(node.name.text, "waiting", 2) < 2:
            name, names = node.name, self.context.names
            if name.text not in names.values.entries and names.similar(name.text, TERMS, 0) is None:
                message, help_ = f"unknown word `{name.text}`", f"did you mean `{word('waiting', name.span)}`?"
                self.context.error(Code.UNKNOWN_NAME, message, name.span, "not declared", help_)
                self.good = False
                return broken(node.span)
        return self.formula(node, "`when`")

    def count(self, item: tree.ExpectCount) -> None:
        count = self.number(item.count)
        kinds = (Kind.ACTION, Kind.EXOGENOUS)
        if item.action.args:
            call = self.call(item.action, kinds, "an action")
            name, args = (call.name, call.args) if call else ("", None)
        else:
            entry = self.doing(item.action, kinds, "an action")
            name, args = (entry.name if entry else ""), None
        self.expectations.append(ExpectCount(name, args, item.relation, count, span=item.span))

    def number(self, node: tree.Expr) -> int:
        found = self.context.constants(self.context, node, INT)
        if found is None or not isinstance(found.value, int):
            self.good = False
            return 0
        if found.value < 0:
            self.context.error(Code.OUTSIDE_TYPE, f"the number {found.value} is negative", node.span, "at least 0")
            self.good = False
        return found.value

    def doing(self, node: tree.Apply, kinds: tuple[Kind, ...], what: str) -> Entry | None:
        entry = doing(self.context, node.name, len(node.args), kinds)
        if entry is not None and entry.kind not in kinds:
            labels = (Label(entry.span, "declared here"),)
            message = f"`{entry.name}` is {entry.kind.phrase}, not {what}"
            self.context.error(Code.MISUSED_NAME, message, node.name.span, f"{what} is needed here", labels=labels)
            entry = None
        self.good &= entry is not None
        return entry

    def call(self, node: tree.Apply, kinds: tuple[Kind, ...], what: str) -> GroundCall | None:
        entry = self.doing(node, kinds, what)
        signature = None if entry is None else self.context.signature(entry)
        if entry is None or signature is None or not arity_fits(self.context, node, entry, len(node.args)):
            self.good = False
            return None
        pairs = zip(node.args, signature.parameters, strict=True)
        values = [argument(self.context, arg, parameter, entry.name) for arg, parameter in pairs]
        if None in values:
            self.good = False
            return None
        return GroundCall(entry.name, tuple([value.value for value in values if value]), span=node.span)


def _conjuncts(term: Term) -> Iterator[Term]:
    stack = [term]
    while stack:
        term = stack.pop()
        if isinstance(term, Operation) and term.op is Operator.AND:
            stack.extend(reversed(term.args))
        else:
            yield term
