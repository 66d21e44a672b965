"""What never changes: consts, statics, tables, and whatever else must have a value before the first situation."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from pathlib import Path

from golc.diagnostics import Code, Findings, Label, Source, Span
from golc.syntax import tree
from golc.theory.border import PythonFunction
from golc.theory.closed import NoValueError
from golc.theory.context import Context, Signature
from golc.theory.elaborate_collections import determined
from golc.theory.elaborate_terms import term
from golc.theory.elaborate_types import elaborate_type, parameters
from golc.theory.expectations import fits
from golc.theory.fitting import BROKEN, may_be, size
from golc.theory.forms import describe, typed_declaration, word
from golc.theory.python_text import misfit
from golc.theory.scope import Entry, Kind, Scope
from golc.theory.terms import DefinedTerm, Epistemic, FluentTerm, Literal, PossTerm, Term, subterms
from golc.theory.theory import Constant, Parameter, Static
from golc.theory.types import BOOL, Type, Value, show, show_call


def closed_term(context: Context, found: Term, what: str) -> bool:
    """Whether a term reads no fluent, not even through definitions; otherwise a finding. ``what`` names the value."""
    for part in subterms(found):
        match part:
            case Literal(type=type_) if type_ is BROKEN:
                return False
            case FluentTerm(fluent=name):
                reason = f"the fluent `{name}`"
            case PossTerm(action=name):
                reason = f"whether `{name}` is possible"
            case DefinedTerm(definition=name) if situational(context, name):
                reason = f"`{name}`, which reads fluents"
            case Epistemic():
                reason = "what the agent knows"
            case _:
                continue
        context.error(Code.NOT_CONSTANT, f"{what} cannot depend on {reason}", part.span, "depends on the situation")
        return False
    return True


def situational(context: Context, definition: str) -> bool:
    """Whether a definition reads a fluent or asks whether an action is possible."""
    known = context.situational
    if definition not in known:
        found = context.definition(context.names.values.entries[definition])
        known[definition] = False
        for part in subterms(found.body) if found else ():
            match part:
                case FluentTerm() | PossTerm() | Epistemic():
                    known[definition] = True
                case DefinedTerm(definition=name) if situational(context, name):
                    known[definition] = True
    return known[definition]


def constant_value(
    context: Context, node: tree.Expr, expected: Type | None, parameter: str = "", declared: Span | None = None
) -> Literal | None:
    """The value of a closed expression, as a literal with the type of the expression."""
    return _value(context, node, expected, expected, parameter, declared)


def argument(context: Context, node: tree.Expr, parameter: Parameter, owner: str) -> Literal | None:
    """The value of an argument that has to be known now."""
    what = f"parameter `{parameter.name}` of `{owner}`"
    return context.constants(context, node, parameter.type, what, parameter.span)


def _value(
    context: Context,
    node: tree.Expr,
    expected: Type | None,
    hint: Type | None,
    parameter: str = "",
    declared: Span | None = None,
) -> Literal | None:
    what = parameter or "a constant here"
    found = term(context, Scope(), node, hint)
    if expected is None:
        found = determined(context, found)
    if expected is not None and not fits(context, found, expected, what, declared):
        return None
    if not closed_term(context, found, "a constant value"):
        return None
    value = evaluated(context, found)
    if value is not None and expected is not None and not fits(context, value, expected, what, declared):
        return None
    return value


def evaluated(context: Context, found: Term) -> Literal | None:
    """The value of a closed term as a literal; a finding if it has none."""
    if isinstance(found, Literal):
        return found
    closed = context.closed()
    # Evaluating may resolve a declaration, which evaluates a constant of its own.
    around, closed.depth = closed.depth, 0
    try:
        return Literal(closed.value(found), type=found.type, span=found.span)
    except NoValueError as error:
        if error.finding is not None:
            context.findings.once(error.finding)
            context.gaps = True
        elif error.reason:
            context.error(Code.NO_VALUE, f"this has no value: {error.reason}", error.span)
    except RecursionError:
        context.error(Code.NO_VALUE, "this has no value: it is nested too deeply to be evaluated", found.span)
    finally:
        closed.depth = around
    return None


def constant(context: Context, entry: Entry) -> Constant | None:
    """The value of a const: what the command line says, otherwise what the file says."""
    assert isinstance(entry.node, tree.Const)
    written = constant_value(context, entry.node.value, None)
    if entry.name not in context.overrides or context.names.values.get(entry.name) is not entry:
        return None if written is None else Constant(entry.name, written.value, written.type, span=entry.span)
    given = _override(context, entry.name, BROKEN if written is None else written.type)
    if given is None or written is None:
        return None
    if not may_be(given.type, written.type):
        message = (
            f"`{entry.name}` is {describe(written.type, given.span)} in the file, "
            f"but {describe(given.type, given.span)} on the command line"
        )
        labels = (Label(entry.span, "declared here"),)
        context.error(Code.TYPE_MISMATCH, message, given.span, "of another type", labels=labels)
        return None
    return Constant(entry.name, given.value, given.type, span=entry.span)


def _override(context: Context, name: str, hint: Type) -> Literal | None:
    from golc.syntax.parse import parse_expression

    findings = Findings()
    node = parse_expression(Source(f"-D {name}", context.overrides[name]), findings)
    for finding in findings.diagnostics:
        context.findings.add(finding)
    return None if node is None else _value(context, node, None, hint)


def static_signature(context: Context, entry: Entry) -> Signature:
    """The parameters and the type of a static or an extern; without a type it is a relation."""
    assert isinstance(entry.node, tree.Static | tree.Extern)
    table = isinstance(entry.node, tree.Static) and isinstance(entry.node.value, tree.Table)
    what = f"{entry.kind.value} `{entry.name}`"
    found = parameters(context, entry.node.parameters, what, infinite=not table)
    type_ = BOOL if entry.node.type is None else elaborate_type(context, entry.node.type)
    return Signature(entry, found, type_)


def static(context: Context, entry: Entry) -> Static | None:
    """A static with its body: a term, a table, the value if it has no parameters, or for an extern its function."""
    assert isinstance(entry.node, tree.Static | tree.Extern)
    signature = context.signature(entry)
    if signature is None:
        return None
    body: Term | Mapping[tuple[Value, ...], Value] | PythonFunction | None
    if isinstance(entry.node, tree.Extern):
        body = _python_function(context, signature, entry.node)
    elif isinstance(entry.node.value, tree.Table):
        body = _table(context, signature, entry.node.value)
    else:
        body = _static_body(context, signature, entry.node, entry.node.value)
    if body is None:
        return None
    return Static(entry.name, signature.parameters, signature.type, body, span=entry.span)


def _python_function(context: Context, signature: Signature, node: tree.Extern) -> PythonFunction | None:
    parameter_scope(context, signature.parameters, node.parameters)
    file = context.python.file(Path(node.span.source.name).parent / node.path)
    problem = misfit(file, node.name.text, len(node.parameters))
    if problem is None:
        return PythonFunction(node.path, file)
    context.findings.add(problem.finding(node.name.span))
    return None


def _static_body(context: Context, signature: Signature, node: tree.Static, expression: tree.Expr) -> Term | None:
    scope = parameter_scope(context, signature.parameters, node.parameters)
    what = f"static `{signature.entry.name}`"
    found = term(context, scope, expression, signature.type)
    if node.type is None and found.type is not BROKEN and found.type.kinds.isdisjoint(BOOL.kinds):
        type_ = describe(found.type, found.span)
        message = f"{what} has no type, which makes it a relation (`bool`), but its value is {type_}"
        help_ = f"write its type: `{typed_declaration('static', node.name, found.type)}`"
        context.error(Code.TYPE_MISMATCH, message, found.span, f"this is {type_}", help_)
        return None
    if not fits(context, found, signature.type, what) or not closed_term(context, found, what):
        return None
    if signature.parameters:
        return found
    value = evaluated(context, found)
    return value if value is not None and fits(context, value, signature.type, what) else None


def parameter_scope(context: Context, found: tuple[Parameter, ...], nodes: tuple[tree.Parameter, ...]) -> Scope:
    """The scope inside a declaration: its parameters on the first levels."""
    scope = Scope()
    for parameter, node in zip(found, nodes, strict=True):
        if node.name.text in scope.locals:
            labels = (Label(scope.locals[node.name.text].span, "first here"),)
            message = f"two parameters have the name `{node.name.text}`"
            context.error(Code.DUPLICATE, message, node.name.span, "the same name again", labels=labels)
        scope, _ = scope.bind(node.name, parameter.type)
    return scope


def _table(context: Context, signature: Signature, node: tree.Table) -> Mapping[tuple[Value, ...], Value] | None:
    types = [parameter.type for parameter in signature.parameters]
    name = signature.entry.name
    if not types:
        message = f"`{name}` has no parameters, so that it cannot be a table"
        written = node.span.either(f"static {name}(x: …): … = …", f"def {name}(x: …) -> …: …")
        context.error(Code.TABLE, message, node.span, "a table needs keys", f"write `{written}`")
        return None
    table: dict[tuple[Value, ...], Value] = {}
    places: dict[tuple[Value, ...], tree.TableEntry] = {}
    good = True
    for entry in node.entries:
        key, value = _key(context, name, entry, types), _entry_value(context, signature, entry)
        if key is None or value is None:
            good = False
        elif key in table:
            labels = (Label(places[key].span, "first here"),)
            context.error(
                Code.TABLE,
                f"the table of `{name}` has two values for {_shown_key(key, entry.span)}",
                entry.span,
                "the same key again",
                labels=labels,
            )
            good = False
        else:
            table[key], places[key] = value.value, entry
    if not good or BROKEN in types:
        return None
    return table if _covers(context, signature, node, table) else None


def _key(context: Context, name: str, entry: tree.TableEntry, types: list[Type]) -> tuple[Value, ...] | None:
    if len(entry.key) != len(types):
        message = f"a key of the table of `{name}` has {len(types)} value{'s' * (len(types) > 1)}, not {len(entry.key)}"
        context.error(Code.TABLE, message, entry.span, f"as many values as `{name}` has parameters")
        return None
    values = [context.constants(context, part, type_) for part, type_ in zip(entry.key, types, strict=True)]
    return None if None in values else tuple([value.value for value in values if value is not None])


def _entry_value(context: Context, signature: Signature, entry: tree.TableEntry) -> Literal | None:
    return context.constants(context, entry.value, signature.type, f"static `{signature.entry.name}`")


def _covers(context: Context, signature: Signature, node: tree.Table, table: Mapping[tuple[Value, ...], Value]) -> bool:
    needed = 1
    for parameter in signature.parameters:
        needed *= size(parameter.type)
    if needed == len(table):
        return True
    first = [_shown_key(key, node.span) for key in itertools.islice(_missing(signature, table), 3)]
    more = needed - len(table) - len(first)
    missing = ", ".join(first) + (f" and {more} more" if more else "")
    message = f"the table of `{signature.entry.name}` has no value for {missing}"
    context.error(Code.TABLE, message, signature.entry.span, "a table covers its type")
    return False


def _missing(signature: Signature, table: Mapping[tuple[Value, ...], Value]) -> Iterator[tuple[Value, ...]]:
    every = itertools.product(*[parameter.type.values for parameter in signature.parameters])
    return (key for key in every if key not in table)


def _shown_key(key: tuple[Value, ...], place: Span) -> str:
    return f"`{word(show(key[0]), place)}`" if len(key) == 1 else f"`{show_call('', key)}`"


def check_overrides(context: Context) -> None:
    """Every ``-D`` must name a const."""
    for name, text in context.overrides.items():
        entry = context.names.values.get(name)
        if (entry is not None and entry.kind is Kind.CONSTANT) or context.names.assumes(name):
            continue
        source = Source(f"-D {name}", text)
        span = Span(source, 0, len(text))
        what = "is not declared" if entry is None else f"is {entry.kind.phrase}, not a const"
        similar = context.names.similar(name, [Kind.CONSTANT])
        context.error(
            Code.OVERRIDE,
            f"`{name}` {what}, so that `-D` cannot replace it",
            span,
            "there is no such const",
            similar.help(span) if similar else None,
            similar.labels if similar else (),
        )
