"""What a name in an expression stands for, and what to say if it stands for nothing."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from golc.diagnostics import Code, Edit, Fix, Label
from golc.syntax import tree
from golc.theory.blame import Matter, Suspect
from golc.theory.context import Context, Signature
from golc.theory.declare import BUILTIN_TYPES, FUNCTIONS
from golc.theory.elaborate_types import LARGEST, home, named_type
from golc.theory.fitting import BROKEN, size, strip_optional
from golc.theory.forms import name_text, word
from golc.theory.scope import Entry, Kind, Scope
from golc.theory.suggest import closest
from golc.theory.terms import Literal, Variable
from golc.theory.types import BOOL, Collection, Enumeration, Type, show

ASKING = (*FUNCTIONS, "known", "knows", "possible")
"""Words of the language that stand before an argument."""

VALUES = ("true", "false", "none", "unknown")
"""Words of the language that stand where a value can."""

STATEMENTS = ("skip", "wait")
"""Words of the language that are a statement alone."""

CALLS = (Kind.FLUENT, Kind.DEFINITION, Kind.STATIC, Kind.EXTERN, Kind.GOAL, Kind.INVARIANT)
TERMS = (*CALLS, Kind.CONSTANT, Kind.SYMBOL)

Resolution: TypeAlias = Variable | Literal | Signature | None
"""A variable, the value of a constant, something to apply to arguments, or none (a finding, or none of its own)."""


def resolve(context: Context, scope: Scope, node: tree.Apply, hint: Type | None) -> Resolution:
    """What the name of a term stands for: a variable in scope, otherwise what is declared.

    ``hint`` is the type that is needed here: its values are what a misspelt name probably meant.
    """
    variable = scope.get(node.name.text)
    if variable is not None:
        if not node.args:
            return variable
        _no_arguments(context, node, "a variable", None)
        return None
    entry = context.names.values.get(node.name.text)
    if entry is None and node.name.text in BUILTIN_TYPES and not node.args:
        return _listed(context, node.name)
    if entry is None:
        _unknown_term(context, scope, node, hint)
        return None
    match entry.kind:
        case Kind.CONSTANT | Kind.SYMBOL if node.args:
            _no_arguments(context, node, entry.kind.phrase, entry)
            return None
        case Kind.CONSTANT:
            constant = context.constant(entry)
            return None if constant is None else Literal(constant.value, type=constant.type, span=node.span)
        case Kind.SYMBOL:
            return Literal(entry.name, type=home(context, entry), span=node.span)
        case Kind.STATIC if not entry.arity and not node.args:
            return _fixed(context, entry, node)
        case Kind.TYPE if node.args:
            _no_arguments(context, node, entry.kind.phrase, entry)
            return None
        case Kind.TYPE:
            return _listed(context, node.name)
        case _:
            return context.signature(entry)


def _fixed(context: Context, entry: Entry, node: tree.Apply) -> Literal | None:
    """The value of a static without parameters."""
    static = context.static(entry)
    if static is None or not isinstance(static.body, Literal):
        return None
    return Literal(static.body.value, type=static.type, span=node.span)


def _listed(context: Context, name: tree.Ident) -> Literal | None:
    """The list of the values of a type."""
    type_ = named_type(context, name)
    if type_ is BROKEN:
        return None
    if type_.finite and size(type_) <= LARGEST:
        return Literal(tuple(type_.values), type=Collection("list", type_), span=name.span)
    marker = f"has more than {LARGEST} values" if type_.finite else "cannot be enumerated"
    context.error(Code.BAD_TYPE, f"`{name.text}` cannot stand for the list of its values", name.span, marker)
    return None


def is_type(context: Context, scope: Scope, name: tree.Ident) -> bool:
    """Whether a name stands for a type."""
    if scope.get(name.text) is not None:
        return False
    entry = context.names.values.get(name.text)
    return name.text in BUILTIN_TYPES or (entry is not None and entry.kind is Kind.TYPE)


def is_misspelt_type(context: Context, scope: Scope, name: tree.Ident) -> bool:
    """Whether an unknown name behind ``in`` was probably to be a type, not a set or a list."""
    if scope.get(name.text) is not None or name.text in context.names.values.entries:
        return False
    names = context.names
    if names.similar(name.text, [Kind.TYPE], variables=BUILTIN_TYPES) is not None:
        return True
    return names.similar(name.text, TERMS, 0, tuple(scope.locals)) is None


def arity_fits(context: Context, node: tree.Apply | tree.Pattern | tree.Binding, entry: Entry, given: int) -> bool:
    """Whether something gets as many arguments as it takes; otherwise a finding."""
    suspect = Suspect(Matter.ARITY, entry.span)
    if given == entry.arity:
        context.complaints.clear([suspect])
        return True
    name = node.name if isinstance(node, tree.Apply) else node.action
    if given > entry.arity:
        context.complaints.blame.short.add(entry.span)
    takes = f"{entry.arity} argument{'s' * (entry.arity != 1)}" if entry.arity else "no arguments"
    labels = (Label(entry.span, f"{entry.kind.phrase} with {takes} is declared here"),)
    marker = f"{given} argument{'s' * (given != 1)} here" if given else "no arguments here"
    message = f"`{name.text}` takes {takes}, not {given or 'none'}"
    help_ = f"write `{_written(name, entry, called=not isinstance(node, tree.Binding))}`"
    help_ += "" if entry.arity else " alone"
    context.error(Code.ARITY, message, name.span, marker, help_, labels, [suspect])
    return False


def _written(name: tree.Ident, entry: Entry, called: bool) -> str:
    """A declared name with those of its parameters; in Python an action or a procedure is ``called`` even without."""
    parameters = [name_text(each.name.text, name.span) for each in getattr(entry.node, "parameters", ())]
    called &= name.span.source.python and entry.kind in (Kind.ACTION, Kind.EXOGENOUS, Kind.PROCEDURE)
    return name_text(name.text, name.span) + (f"({', '.join(parameters)})" if parameters or called else "")


def doing(context: Context, name: tree.Ident, given: int | None, kinds: Iterable[Kind]) -> Entry | None:
    """The action or procedure of that name; ``kinds`` are those that fit here, ``given`` the number of arguments."""
    entry = context.names.doings.get(name.text)
    if entry is not None or context.names.assumes(name.text):
        return entry
    value = context.names.values.get(name.text)
    wanted = " or ".join(dict.fromkeys(kind.value.removeprefix("exogenous ") for kind in kinds))
    if value is not None:
        message = f"`{name.text}` is {value.kind.phrase}, not an {wanted}"
        test = name.span.either(f"test {name.text}", f"test({name_text(name.text, name.span)})")
        help_ = f"`{test}` goes on only if it holds" if _is_formula(context, value, kinds) else None
        labels = (Label(value.span, "declared here"),)
        context.error(Code.MISUSED_NAME, message, name.span, f"an {wanted} is needed here", help_, labels)
        return None
    similar = context.names.similar(name.text, kinds, given)
    if similar is None:
        help_ = _declare_doing(name, kinds, given)
        if Kind.PROCEDURE in kinds and not given:
            help_ = _as_word(name) or help_
        context.complaints.missing(Code.UNKNOWN_ACTION, f"unknown {wanted} `{name.text}`", name.span, help_)
        return None
    context.complaints.misspelt(Code.UNKNOWN_ACTION, name, similar)
    return None


def _declare_doing(name: tree.Ident, kinds: Iterable[Kind], given: int | None) -> str:
    kind, procedure = "exog" if {*kinds} == {Kind.EXOGENOUS} else "action", Kind.PROCEDURE in kinds
    written = name.text + ("(…)" if given else "")
    golc = f"`{kind} {written}`" + (f", or `proc {written}: …`" if procedure else "")
    python = f"`def {name_text(name.text, name.span)}(…): …` under `@theory.{kind}`"
    return "declare it: " + name.span.either(golc, python + (" or `@theory.proc`" if procedure else ""))


def _as_word(name: tree.Ident) -> str | None:
    """What helps against a name that was probably to be a statement of one word."""
    if name.text in ("pass", "noop", "nop", "nil", "nothing"):
        return f"a block that does nothing is `{word('skip', name.span)}`"
    meant = closest(name.text, STATEMENTS)
    return None if meant is None else f"did you mean `{word(meant, name.span)}`?"


def _is_formula(context: Context, value: Entry, kinds: Iterable[Kind]) -> bool:
    """Whether a name that stands as a statement is probably a forgotten ``test``."""
    signature = context.signature(value) if value.kind in CALLS and Kind.PROCEDURE in kinds else None
    return signature is not None and signature.type == BOOL


def unknown_fluent(context: Context, scope: Scope, name: tree.Ident, given: int) -> None:
    """Report the target of an effect that is declared nowhere."""
    if context.names.assumes(name.text):
        return
    if scope.get(name.text) is not None:
        message, labels = (
            f"`{name.text}` is a variable, and only fluents change",
            (Label(scope.locals[name.text].span, "bound here"),),
        )
        context.error(Code.MISUSED_NAME, message, name.span, "a fluent is needed here", labels=labels)
        return
    message = f"unknown fluent `{name.text}`"
    similar = context.names.similar(name.text, [Kind.FLUENT], given)
    if similar is None:
        declared = f"declare it: `fluent {name.text}… = …`"
        context.complaints.missing(
            Code.UNKNOWN_NAME, message, name.span, name.span.either(declared, _under_fluent(name))
        )
    else:
        context.complaints.misspelt(Code.UNKNOWN_NAME, name, similar)


def _under_fluent(name: tree.Ident) -> str:
    return f"declare it: `def {name_text(name.text, name.span)}(…): …` under `@theory.fluent`"


def _no_arguments(context: Context, node: tree.Apply, what: str, entry: Entry | None) -> None:
    labels = (Label(entry.span, "declared here"),) if entry else ()
    name = node.name.text
    message = f"`{name}` is {what} and takes no arguments"
    help_ = f"write `{name_text(name, node.name.span)}` alone"
    context.error(Code.ARITY, message, node.name.span, "no arguments here", help_, labels)


def _unknown_term(context: Context, scope: Scope, node: tree.Apply, hint: Type | None) -> None:
    name, given = node.name, len(node.args)
    if name.text == "unknown":
        message, ask = "`unknown` is no value to compare with", "`known(f)` asks whether the value of f is known"
        context.error(Code.MISUSED_NAME, message, name.span, "not a value", f"write `not known(…)`: {ask}")
        return
    if context.names.assumes(name.text):
        return
    action = context.names.doings.get(name.text)
    if action is not None:
        _no_value(context, name, action)
        return
    variables = () if given else tuple(scope.locals)
    similar = context.names.similar(name.text, CALLS if given else TERMS, given, variables, _symbols_of(hint, given))
    if similar is None:
        _unlike_any(context, name, given, hint)
    elif name.text in ASKING:
        _asks_nothing(context, name)
    else:
        local = None if similar.labels else scope.locals.get(similar.name)
        context.complaints.misspelt(Code.UNKNOWN_NAME, name, similar, None if local is None else local.span)


def _no_value(context: Context, name: tree.Ident, action: Entry) -> None:
    asked = name.span.text if len(name.span.text) <= 40 else name.text
    help_ = None if action.kind is Kind.PROCEDURE else f"`poss({asked})` says whether it is possible"
    message = f"`{name.text}` is {action.kind.phrase}, not a value"
    labels = (Label(action.span, "declared here"),)
    context.error(Code.MISUSED_NAME, message, name.span, "a value is needed here", help_, labels)


def _unlike_any(context: Context, name: tree.Ident, given: int, hint: Type | None) -> None:
    """A name that is declared nowhere and like no declared one; perhaps it is a word of the language, or like one."""
    if not given and name.text.lower() in ("true", "false", "none", "null"):
        _capital(context, name)
        return
    if hint is BROKEN and not given:
        return  # probably a value of the type that is missing, which has been said
    meant = closest(name.text, ASKING if given else VALUES)
    if name.text in ASKING:
        _asks_nothing(context, name)
    elif meant is not None:
        message, help_ = f"unknown word `{name.text}`", f"did you mean `{word(meant, name.span)}`?"
        context.error(Code.UNKNOWN_NAME, message, name.span, "not declared", help_)
    elif given:
        help_ = name.span.either(f"declare it: `fluent {name.text}(…) = …`", _under_fluent(name))
        context.complaints.missing(Code.UNKNOWN_NAME, f"unknown fluent `{name.text}`", name.span, help_)
    else:
        context.complaints.missing(Code.UNKNOWN_NAME, f"unknown name `{name.text}`", name.span, _declare(name))


def _asks_nothing(context: Context, name: tree.Ident) -> None:
    message, help_ = f"`{name.text}` is no value", f"write `{name.text}(…)`, with what it is asked of"
    context.error(Code.MISUSED_NAME, message, name.span, "a value is needed here", help_)


def _capital(context: Context, name: tree.Ident) -> None:
    """Python's ``True``, ``False`` and ``None``, and other languages' ``null``."""
    ours = word(name.text.lower().replace("null", "none"), name.span)
    fix = Fix(f"write `{ours}` for `{name.text}`", (Edit(name.span, ours),))
    small = ours == name.text.lower()
    message = f"`{ours}` is written in small letters" if small else f"“no value” is `{ours}`, not `{name.text}`"
    context.findings.error(Code.FOREIGN, message, name.span, "not declared", f"write `{ours}`", fix=fix)


def _declare(name: tree.Ident) -> str:
    fluent, const = [name.span.either(f"{kind} {name.text} = …", _as_call(name, kind)) for kind in ("fluent", "const")]
    return f"declare it: `{fluent}`, `{const}`, or as a value of a type"


def _as_call(name: tree.Ident, kind: str) -> str:
    return f'{name_text(name.text, name.span)} = theory.{kind}("{name.text}", …)'


def _symbols_of(hint: Type | None, given: int) -> tuple[str, ...]:
    type_ = strip_optional(hint) if hint is not None and hint is not BROKEN else None
    if not isinstance(type_, Enumeration) or given:
        return ()
    return tuple([show(value) for value, owner in type_.members if owner])
