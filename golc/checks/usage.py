"""Which declared names a file mentions, and what becomes of the names that it binds locally."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from golc.syntax import tree
from golc.syntax.walk import children


@dataclass(eq=False)
class Bound:
    """A parameter or a variable, and whether anything mentions it. ``hidden`` is the local name that it hides."""

    name: tree.Ident
    what: str
    owner: tree.Node
    used: bool = False
    hidden: Bound | None = None


Locals = Mapping[str, Bound]


@dataclass
class Usage:
    """What a file mentions.

    ``values`` are the names of consts, types, symbols, fluents, statics and definitions that stand anywhere but where
    they are declared; ``asked`` the actions in ``poss(…)``; ``called`` gives for each action and procedure that is
    called the declarations that call it; ``bound`` is every local name in the order of the text.
    """

    values: set[str] = field(default_factory=set)
    asked: set[str] = field(default_factory=set)
    called: dict[str, set[str]] = field(default_factory=dict)
    bound: list[Bound] = field(default_factory=list)


def usage(file: tree.File) -> Usage:
    """Look through a file."""
    found = _Walk(file)
    for declaration in file.declarations:
        found.declaration(declaration)
    found.usage.bound.sort(key=lambda bound: bound.name.span.start)
    return found.usage


class _Walk:
    """Visits every node with the local names around it; a stack instead of recursion, for the depth is the input's."""

    def __init__(self, file: tree.File) -> None:
        self.usage = Usage()
        self.inside = ""
        self.stack: list[tuple[tree.Node, Locals]] = []
        self.parameters: dict[str, Locals] = {}
        for node in file.declarations:
            if isinstance(node, (tree.Action, tree.Exog)):
                self.parameters[node.name.text] = self.bind({}, [parameter.name for parameter in node.parameters], node)

    def declaration(self, node: tree.Declaration) -> None:
        self.inside = node.name.text if isinstance(node, (tree.Proc, tree.Action, tree.Exog)) else ""
        match node:
            case tree.Action(name=name) | tree.Exog(name=name):
                self.push(node.clauses, self.parameters[name.text])
                self.push([parameter.type for parameter in node.parameters], {})
            case tree.Extern(parameters=parameters, type=type_):
                self.push([part.type for part in parameters] + ([] if type_ is None else [type_]), {})
            case tree.Proc() | tree.Define() | tree.Static() | tree.Fluent():
                inner = self.bind({}, [parameter.name for parameter in node.parameters], node)
                self.push([parameter.type for parameter in node.parameters], {})
                self.push(
                    [part for part in children(node) if not isinstance(part, (tree.Ident, tree.Parameter))], inner
                )
            case (
                tree.Invariant(condition=condition)
                | tree.Goal(condition=condition)
                | tree.Initially(condition=condition)
                | tree.Prune(condition=condition)
            ):
                self.push([condition], {})
            case tree.Axiom():
                self.axiom(node)
            case tree.PruneAfter(pattern=pattern, condition=condition):
                self.push([condition], self.pattern(pattern, node, {}))
            case tree.Scenario(items=items):
                for item in items:
                    self.scenario_item(item)
            case tree.Const(value=value):
                self.push([value], {})
            case tree.TypeDecl(type=type_):
                # Its enumerations declare their symbols, which is no mention of them.
                pieces = type_.pieces if isinstance(type_, tree.UnionType) else (type_,)
                self.push([piece for piece in pieces if not isinstance(piece, tree.EnumType)], {})
            case tree.Device(items=items):
                self.push(items, {})
        while self.stack:
            self.visit(*self.stack.pop())

    def axiom(self, node: tree.Axiom) -> None:
        self.usage.values.add(node.fluent.text)
        heads = self.bind({}, node.parameters, node)
        for case in node.cases:
            self.push([case.value, case.condition], self.pattern(case.pattern, case, heads))

    def pattern(self, node: tree.Pattern, owner: tree.Node, scope: Locals) -> Locals:
        """What stands in a pattern may be a constant as well as a name that is bound there; it counts as both."""
        names = [arg for arg in node.args if isinstance(arg, tree.Ident)]
        for name in names:
            self.mention(name.text, scope)
        for bound in self.parameters.get(node.action.text, {}).values():
            bound.used = True
        return {name.text: Bound(name, "variable", owner) for name in names} | dict(scope)

    def scenario_item(self, item: tree.ScenarioItem) -> None:
        """Names of actions are no values; what a scenario expects to be done is not thereby used."""
        match item:
            case tree.Given(condition=condition) | tree.Until(condition=condition):
                self.push([condition], {})
            case tree.ExpectFormula(condition=condition):
                self.push([condition], {})
            case tree.Run(program=program):
                self.usage.called.setdefault(program.name.text, set()).add("")
                self.push(program.args, {})
            case tree.OnEvents(events=events, argument=argument):
                self.push([argument, *[arg for event in events for arg in event.args]], {})
            case tree.ExpectCount(action=action, count=count):
                self.push([count, *action.args], {})
            case tree.ExpectActions(actions=actions):
                self.push([arg for action in actions for arg in action.args], {})

    def push(self, nodes: Iterable[tree.Node | None], scope: Locals) -> None:
        self.stack.extend([(node, scope) for node in nodes if node is not None])

    def bind(self, scope: Locals, names: Iterable[tree.Ident], owner: tree.Node) -> Locals:
        what = "parameter" if isinstance(owner, tree.Declaration) else "variable"
        for name in names:
            bound = Bound(name, what, owner, hidden=scope.get(name.text))
            self.usage.bound.append(bound)
            scope = {**scope, name.text: bound}
        return scope

    def visit(self, node: tree.Node, scope: Locals) -> None:
        match node:
            case tree.Apply(name=tree.Ident(text="poss"), args=(tree.Apply() as action,)):
                self.usage.asked.add(action.name.text)
                self.push(action.args, scope)
            case tree.Apply(name=name, args=args):
                self.mention(name.text, scope)
                self.push(args, scope)
            case tree.TypeName(name=name):
                self.mention(name.text, {})
            case tree.Call(target=target):
                self.usage.called.setdefault(target.name.text, set()).add(self.inside)
                self.push(target.args, scope)
            case tree.Let(name=name, value=value, body=body):
                self.push([value], scope)
                self.push([body], self.bind(scope, [name], node))
            case tree.Binding():
                self.binding(node)
            case tree.Setting(value=value):
                self.push([value], {})
            case tree.Ident(text=text):
                self.mention(text, scope)
            case _:
                self.inner(node, scope)

    def inner(self, node: tree.Node, scope: Locals) -> None:
        """What binders bind is known in everything beside them; a binder's collection speaks of those before it."""
        inside = [*children(node)]
        for part in inside:
            if isinstance(part, tree.Binder):
                self.push([part.type, part.collection], scope)
                scope = self.bind(scope, [part.name], node)
        self.push([part for part in inside if not isinstance(part, tree.Binder)], scope)

    def binding(self, node: tree.Binding) -> None:
        scope = self.parameters.get(node.action.text, {})
        for arg in node.args or ():
            self.push([arg.type if isinstance(arg, tree.Parameter) else arg], {})
        if isinstance(node.behaviour, tree.ByPrompt):
            self.push([node.behaviour.message], scope)
        self.push([node.table, node.timeout], {})

    def mention(self, name: str, scope: Locals) -> None:
        if name in scope:
            scope[name].used = True
        else:
            self.usage.values.add(name)
