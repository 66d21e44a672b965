"""Names: what is declared or bound but not used, what hides something else, what is bound to devices twice."""

from __future__ import annotations

from golc.checks.usage import Bound, Usage, usage
from golc.diagnostics import Code, Findings, Label
from golc.syntax import tree
from golc.syntax.walk import descendants
from golc.theory.declare import declare
from golc.theory.fitting import meet
from golc.theory.forms import sign
from golc.theory.scope import Entry, Kind, Names
from golc.theory.theory import BasicActionTheory, Binding, Device, Fixed, Parameter

DECLARED = (Kind.CONSTANT, Kind.TYPE, Kind.FLUENT, Kind.STATIC, Kind.EXTERN, Kind.DEFINITION)


def check_names(theory: BasicActionTheory, file: tree.File, findings: Findings) -> None:
    """Row 1 of what ``golc check`` proves, as far as it is not found by elaboration."""
    names = declare(file, Findings(), frozenset()).names
    found = usage(file)
    _unused_values(names, found, findings)
    _unused_doings(theory, names, found, findings)
    _unused_locals(theory, found, findings)
    _shadowing(names, found, findings)
    _loose_quantifiers(file, findings)
    _bound_twice(theory, findings)


def _unused_values(names: Names, found: Usage, findings: Findings) -> None:
    symbols: dict[int, list[str]] = {}
    for entry in names.values.of(Kind.SYMBOL):
        symbols.setdefault(id(entry.node), []).append(entry.name)
    for entry in names.values.of(*DECLARED):
        mentioned = [entry.name, *symbols.get(id(entry.node), ())]
        if found.values.isdisjoint(mentioned):
            _unused(entry, "nothing mentions it", findings)


def _unused_doings(theory: BasicActionTheory, names: Names, found: Usage, findings: Findings) -> None:
    """Without a procedure, or with a goal, every action is for planning; and any procedure without parameters may be
    the one to run."""
    if not theory.procedures:
        return
    for entry in () if theory.goals else names.doings.of(Kind.ACTION):
        if entry.name not in found.called and entry.name not in found.asked:
            _unused(entry, "no program performs it", findings)
    for entry in names.doings.of(Kind.PROCEDURE):
        callers = found.called.get(entry.name, set()) - {entry.name}
        if entry.arity and not callers and "control" in theory.procedures and entry.name != "control":
            _unused(entry, "nothing calls it", findings)


def _unused(entry: Entry, marker: str, findings: Findings) -> None:
    findings.warning(Code.UNUSED, f"{entry.kind.value} `{entry.name}` is not used", entry.span, marker)


def _unused_locals(theory: BasicActionTheory, found: Usage, findings: Findings) -> None:
    handed_over = {binding.action for device in theory.devices if device.kind != "self" for binding in device.bindings}
    for bound in found.bound:
        if not bound.used and _should_be_used(bound, handed_over):
            message = f"{bound.what} `{bound.name.text}` is not used"
            findings.warning(Code.UNUSED_LOCAL, message, bound.name.span, "nothing mentions it")


def _should_be_used(bound: Bound, handed_over: set[str]) -> bool:
    match bound.owner:
        case tree.Axiom():
            return False  # an action may change all instances
        case tree.Fluent():
            return False  # every instance may have the same initial value
        case tree.Static(value=value):
            return not isinstance(value, tree.Table)
        case tree.Action(name=name, clauses=clauses):
            return bool(clauses) and name.text not in handed_over  # a device gets it, whatever the theory says
        case tree.Exog(clauses=clauses):
            return bool(clauses)
        case tree.Quantifier(kind=kind):
            return kind in ("exists", "forall")  # the others count or add up, even without looking
        case tree.Comprehension(kind=kind):
            return kind == "set"  # a list has an element for each binding, even if all are equal
        case _:
            return True


def _shadowing(names: Names, found: Usage, findings: Findings) -> None:
    for bound in found.bound:
        name = bound.name.text
        entry = names.values.get(name)
        if bound.hidden is not None:
            what, place = f"the {bound.hidden.what} `{name}` around it", bound.hidden.name.span
        elif entry is not None:
            what, place = f"the {entry.kind.value} `{name}`", entry.span
        else:
            continue
        findings.warning(
            Code.SHADOWED,
            f"{bound.what} `{name}` hides {what}",
            bound.name.span,
            "the same name",
            labels=(Label(place, "hidden"),),
            help="choose another name",
        )


def _loose_quantifiers(file: tree.File, findings: Findings) -> None:
    """``exists n: t. p(n) or q``: the quantifier takes in ``q``, which does not speak of ``n``."""
    for node in descendants(file):
        match node:
            case tree.Quantifier(kind="forall", body=tree.Binary(op="implies")):
                pass  # a rule, whose conclusion need not speak of the variable
            case tree.Quantifier(kind="exists" | "forall", body=tree.Binary(op="or" | "implies" | "iff") as body):
                loose = body.right
                bound = {binder.name.text for binder in node.binders}
                if bound.isdisjoint(_mentioned(loose)) and not bound.isdisjoint(_mentioned(body.left)):
                    _report_loose(node, body, findings)


def _report_loose(node: tree.Quantifier, body: tree.Binary, findings: Findings) -> None:
    place, word = node.span, sign(node.kind, node.span)
    message = f"`{node.kind}` takes in everything to its right, also what does not depend on its variable"
    outside = f"{word}(…) {sign('or', place)} …" if body.op == "or" else f"{body.op}({word}(…), …)"
    findings.warning(
        Code.LOOSE_QUANTIFIER,
        place.either(message, f"a part of this `{word}` does not depend on its variable"),
        body.right.span,
        "belongs to the quantifier",
        labels=(Label(node.binders[0].span, "bound here, not used there"),),
        help=place.either(f"write `({node.kind} …) {body.op} …`, or put this first", f"write `{outside}`"),
    )


def _mentioned(node: tree.Node) -> set[str]:
    return {part.name.text for part in descendants(node) if isinstance(part, tree.Apply)}


def _bound_twice(theory: BasicActionTheory, findings: Findings) -> None:
    """An instance of a primitive action has one device; several may report an exogenous action, each once."""
    seen: dict[str, list[tuple[Device, Binding]]] = {}
    for device in theory.devices:
        for binding in device.bindings:
            others = seen.setdefault(binding.action, [])
            exogenous = theory.actions[binding.action].exogenous
            for other_device, other in others:
                if (not exogenous or device is other_device) and _share(binding, other):
                    _report_twice(binding, other, findings)
                    break
            others.append((device, binding))


def _report_twice(binding: Binding, other: Binding, findings: Findings) -> None:
    labels = (Label(other.span, "bound here"),)
    what = f"an instance of `{binding.action}`" if binding.args else f"`{binding.action}`"
    findings.error(Code.BINDING, f"{what} is bound twice", binding.span, "bound again", labels=labels)


def _share(one: Binding, other: Binding) -> bool:
    """Whether two bindings of an action have an instance in common."""
    return all(_meet(a, b) for a, b in zip(one.args, other.args, strict=True))


def _meet(a: Parameter | Fixed, b: Parameter | Fixed) -> bool:
    match a, b:
        case Fixed(value=x), Fixed(value=y):
            return x == y and isinstance(x, bool) == isinstance(y, bool)
        case (Fixed(value=x), Parameter(type=type_)) | (Parameter(type=type_), Fixed(value=x)):
            return x in type_
        case Parameter(type=s), Parameter(type=t):
            return meet(s, t)
    return False
