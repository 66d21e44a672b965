"""Device blocks: what carries out an action, and what reports one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

from golc.diagnostics import Code, Label, Span
from golc.syntax import tree
from golc.theory.blame import Matter, Suspect
from golc.theory.context import Context, Signature
from golc.theory.elaborate_actions import SOURCES
from golc.theory.elaborate_names import arity_fits, doing
from golc.theory.elaborate_statements import spoken
from golc.theory.elaborate_types import LARGEST, elaborate_type
from golc.theory.elaborate_values import argument, parameter_scope
from golc.theory.fitting import BROKEN, includes, size
from golc.theory.forms import describe, type_text
from golc.theory.scope import Entry, Kind
from golc.theory.suggest import closest, did_you_mean
from golc.theory.terms import Literal, Term
from golc.theory.theory import Binding, ByCall, ByPrompt, ByStart, Device, Fixed, Parameter, Setting
from golc.theory.types import INT, REAL, Type, Value


@dataclass(frozen=True)
class Abilities:
    """What the bindings of a kind of device may say; ``said`` and ``python`` name it in the two forms."""

    behaviours: tuple[type, ...]
    said: str
    python: str
    numbers: bool = False
    file: str | None = None


SILENT = "without a word, for nothing is sent"
KINDS = {
    "rcx": Abilities(
        (tree.ByCall, tree.ByStart),
        "`by call …` or `by start …`",
        '`call="…"` or `start="…"`',
        numbers=True,
        file="left.nqc",
    ),
    "operator": Abilities((tree.ByPrompt,), '`by prompt "…"`', '`prompt="…"`'),
    "host": Abilities((tree.ByCall,), "`by call …`", '`call="…"`', file="helpers.py"),
    "self": Abilities((), SILENT, SILENT),
}


def device_name(node: tree.Device) -> str:
    """What tells a device from the others: its name, otherwise its kind."""
    return node.kind.text if node.name is None else node.name.text


def devices(context: Context, nodes: list[tree.Device], sensed: Mapping[str, tuple[Term, ...]]) -> tuple[Device, ...]:
    """All device blocks; ``sensed`` gives what each action senses."""
    first: dict[str, tree.Device] = {}
    found = []
    for node in nodes:
        name = device_name(node)
        if name in first:
            span = (node.name or node.kind).span
            labels = (Label((first[name].name or first[name].kind).span, "first declared here"),)
            help_ = f"give it a name: `{_head(node, 'left')}`"
            context.error(Code.DUPLICATE, f"device `{name}` is declared twice", span, "again", help_, labels)
        first.setdefault(name, node)
        device = _device(context, node, sensed)
        if device is not None:
            found.append(device)
    return tuple(found)


def _device(context: Context, node: tree.Device, sensed: Mapping[str, tuple[Term, ...]]) -> Device | None:
    abilities = KINDS.get(node.kind.text)
    if abilities is None:
        help_ = did_you_mean(node.kind.text, SOURCES) or f"known are {', '.join(SOURCES)}"
        context.error(Code.DEVICE, f"unknown kind of device `{node.kind.text}`", node.kind.span, "not known", help_)
        meant = closest(node.kind.text, SOURCES)
        return None if meant is None else _device(context, replace(node, kind=replace(node.kind, text=meant)), sensed)
    if node.file is not None and abilities.file is None:
        message = f"a device `{node.kind.text}` has no file"
        context.error(Code.DEVICE, message, node.kind.span, "leave the file out")
    if node.file is None and node.kind.text == "host":
        message = "a device `host` needs the file with its functions"
        context.error(Code.DEVICE, message, node.kind.span, "which file?", f"write `{_head(node)}`")
    bindings: list[Binding] = []
    settings: dict[str, Setting] = {}
    for item in node.items:
        if isinstance(item, tree.Binding):
            binding = _binding(context, node, abilities, item, sensed)
            if binding is not None:
                bindings.append(binding)
        else:
            setting = _setting(context, item, settings)
            if setting is not None:
                settings[setting.name] = setting
    folder = str(Path(node.span.source.name).parent)
    return Device(
        node.kind.text,
        device_name(node),
        node.file,
        tuple(bindings),
        settings,
        folder,
        span=(node.name or node.kind).span,
    )


def _head(node: tree.Device, name: str | None = None) -> str:
    """How a device of this kind begins, with its file if it takes one."""
    kind, abilities = node.kind.text, KINDS.get(node.kind.text)
    file = abilities.file if abilities else None
    golc = ["device", kind, *([name] if name else []), *([f'"{file}"'] if file else [])]
    python = [f'"{kind}"', *([f'file="{file}"'] if file else []), *([f'name="{name}"'] if name else [])]
    return node.kind.span.either(f"{' '.join(golc)}:", f"@theory.device({', '.join(python)})")


def _setting(context: Context, node: tree.Setting, settings: Mapping[str, Setting]) -> Setting | None:
    if node.name.text in settings:
        labels = (Label(settings[node.name.text].span, "first set here"),)
        context.error(Code.DUPLICATE, f"`{node.name.text}` is set twice", node.name.span, "again", labels=labels)
    value = _quantity(context, node.value)
    return None if value is None else Setting(node.name.text, value, span=node.name.span)


def _quantity(context: Context, node: tree.Expr) -> Fraction | None:
    """A number that may have decimals."""
    found = context.constants(context, node, REAL)
    return Fraction(found.value) if found is not None and isinstance(found.value, int | Fraction) else None


def _binding(
    context: Context,
    device: tree.Device,
    abilities: Abilities,
    node: tree.Binding,
    sensed: Mapping[str, tuple[Term, ...]],
) -> Binding | None:
    given = None if node.args is None else len(node.args)
    entry = doing(context, node.action, given, (Kind.ACTION, Kind.EXOGENOUS))
    signature = None if entry is None else context.signature(entry)
    if entry is None or signature is None:
        return None
    if entry.kind is Kind.PROCEDURE:
        message = f"`{entry.name}` is a procedure, and devices carry out actions"
        labels = (Label(entry.span, "declared here"),)
        context.error(Code.MISUSED_NAME, message, node.action.span, "an action is needed here", labels=labels)
        return None
    if given is not None and not arity_fits(context, node, entry, given):
        return None
    args = _args(context, node, signature)
    _fits_kind(context, device, abilities, node, entry)
    _fits_number(context, node, args, abilities.numbers)
    return Binding(
        entry.name,
        args,
        node.number,
        _behaviour(context, node, signature),
        None if node.table is None else _table(context, node.table, entry, sensed.get(entry.name, ())),
        _timeout(context, node),
        span=node.action.span,
    )


def _fits_kind(context: Context, device: tree.Device, abilities: Abilities, node: tree.Binding, entry: Entry) -> None:
    kind, behaviour = device.kind.text, node.behaviour
    if node.number is not None and not abilities.numbers:
        message = f"a device `{kind}` has no message numbers"
        context.error(Code.DEVICE, message, node.span, "leave the number out")
    if behaviour is not None and entry.kind is Kind.EXOGENOUS:
        message = f"`{entry.name}` is an exogenous action, which a device reports and does not carry out"
        context.error(Code.DEVICE, message, behaviour.span, "leave this out")
    elif behaviour is not None and not isinstance(behaviour, abilities.behaviours):
        message = f"a device `{kind}` carries out actions {node.span.either(abilities.said, abilities.python)}"
        context.error(Code.DEVICE, message, behaviour.span, f"not by a device `{kind}`")


def _fits_number(context: Context, node: tree.Binding, args: tuple[Parameter | Fixed, ...], numbers: bool) -> None:
    """A binding of several instances says so: it takes as many numbers, from the one that is written on."""
    count = 1
    for arg in args:
        if isinstance(arg, Parameter) and arg.type.finite:
            count *= size(arg.type)
    if node.number is not None and numbers and count > 1 and not node.ranged:
        many = f"{count}" if count <= LARGEST else f"more than {LARGEST}"
        message = f"`{node.action.text}` has {many} instances here, and each takes a number"
        written = node.span.either(f"{node.number} .. {node.action.text}…", f"first={node.number}")
        help_ = f"write `{written}`, which takes the numbers from {node.number} on"
        context.error(Code.BINDING, message, node.span, f"takes {many} numbers", help_)


def _args(context: Context, node: tree.Binding, signature: Signature) -> tuple[Parameter | Fixed, ...]:
    if node.args is None:
        return signature.parameters
    found = []
    for arg, parameter in zip(node.args, signature.parameters, strict=True):
        found.append(_arg(context, arg, parameter, node.action.text))
    return tuple(found)


def _arg(
    context: Context,
    node: tree.Parameter | tree.Ident | tree.Number | tree.Truth | tree.Nothing,
    parameter: Parameter,
    action: str,
) -> Parameter | Fixed:
    match node:
        case tree.Parameter(name=name):
            type_ = elaborate_type(context, node.type)
            if not _part_of(type_, parameter.type):
                here, there = describe(type_, node.span), describe(parameter.type, node.span)
                message = f"`{name.text}` is of type {here} here, but of type {there} in `{action}`"
                labels = (Label(parameter.span, "declared here"),)
                marker, blamed = "not a part of that type", [Suspect(Matter.TYPE, parameter.span)]
                context.error(Code.BINDING, message, node.span, marker, labels=labels, suspects=blamed)
            return Parameter(name.text, type_, span=name.span)
        case tree.Ident(text=name) if name not in context.names.values.entries:
            _unknown_arg(context, node, parameter)
            return parameter
        case tree.Ident():
            value = argument(context, tree.Apply(node, span=node.span), parameter, action)
        case _:
            value = argument(context, node, parameter, action)
    return Fixed(None if value is None else value.value)


def _unknown_arg(context: Context, node: tree.Ident, parameter: Parameter) -> None:
    if context.names.assumes(node.text) or parameter.type is BROKEN:
        return
    similar = context.names.similar(node.text, [Kind.SYMBOL, Kind.CONSTANT], 0)
    if similar is None:
        type_ = type_text(parameter.type, node.span)
        written = node.span.either(f"{node.text}: {type_}", f'var("{node.text}", {type_})')
        help_ = f"write its type: `{written}`"
        message = f"`{node.text}` is neither a constant nor a parameter with its type"
        context.error(Code.BINDING, message, node.span, "not a constant", help_)
    else:
        context.complaints.misspelt(Code.UNKNOWN_NAME, node, similar)


def _part_of(type_: Type, whole: Type) -> bool:
    if BROKEN in (type_, whole) or type_ == whole:
        return True
    return type_.finite and includes(whole, type_)


def _behaviour(context: Context, node: tree.Binding, signature: Signature) -> ByCall | ByStart | ByPrompt | None:
    match node.behaviour:
        case tree.ByCall(function=name):
            return ByCall(name.text, name.span)
        case tree.ByStart(task=name):
            return ByStart(name.text, name.span)
        case tree.ByPrompt(message=message):
            scope = parameter_scope(context, signature.parameters, _nodes(signature))
            return ByPrompt(spoken(context, scope, message), message.span)
        case _:
            return None


def _nodes(signature: Signature) -> tuple[tree.Parameter, ...]:
    node = signature.entry.node
    return node.parameters if isinstance(node, (tree.Action, tree.Exog)) else ()


def _timeout(context: Context, node: tree.Binding) -> Fraction | None:
    if node.timeout is None:
        return None
    value = _quantity(context, node.timeout)
    if value is not None and value <= 0:
        context.error(Code.OUTSIDE_TYPE, "a timeout has to be positive", node.timeout.span, "more than 0 s")
        return None
    return value


def _table(context: Context, node: tree.Table, entry: Entry, senses: tuple[Term, ...]) -> Mapping[int, Value] | None:
    if len(senses) != 1:
        message = f"`{entry.name}` senses {len(senses) or 'nothing'}, so that a table of its values has no meaning"
        labels = (Label(entry.span, "declared here"),)
        context.error(Code.BINDING, message, node.span, "only for an action that senses one value", labels=labels)
        return None
    found: dict[int, Value] = {}
    places: dict[int, Span] = {}
    for line in node.entries:
        key = _number(context, line)
        if key is None and isinstance(line.value, tree.Number):
            return None  # the wrong way round, in all lines
        value = context.constants(context, line.value, senses[0].type, f"what `{entry.name}` senses")
        if key is None or value is None:
            continue
        if key in found:
            labels = (Label(places[key], "first here"),)
            context.error(Code.DUPLICATE, f"number {key} has two values", line.span, "again", labels=labels)
        found[key], places[key] = value.value, line.span
    return found


def _number(context: Context, line: tree.TableEntry) -> int | None:
    if len(line.key) != 1:
        context.error(Code.BINDING, "a device answers one number", line.span, "one number before the colon")
        return None
    if isinstance(line.value, tree.Number) and isinstance(line.key[0], tree.Apply):
        pair = f"{line.value.value}: {line.key[0].span.text}"
        message, help_ = "a table says of each number what it means", f"write `{line.span.either(pair, f'{{{pair}}}')}`"
        context.error(Code.BINDING, message, line.span, "the number comes first", help_)
        return None
    key: Literal | None = context.constants(context, line.key[0], INT)
    return key.value if key is not None and isinstance(key.value, int) else None
