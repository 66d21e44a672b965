"""The basic action theory: the finished value that every later stage reads and none changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from golc.diagnostics import NOWHERE, Source, Span
from golc.theory.border import PythonFunction
from golc.theory.python_file import PythonFiles
from golc.theory.scenarios import Scenario
from golc.theory.statements import Message, Statement
from golc.theory.terms import Binder, Choice, Term, ranges
from golc.theory.types import Type, Value


@dataclass(frozen=True)
class Declared:
    """The base of everything that a declaration brings; ``span`` is the place of its name."""

    name: str
    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class Parameter:
    name: str = field(compare=False)
    type: Type
    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class Constant(Declared):
    value: Value
    type: Type


@dataclass(frozen=True)
class Static(Declared):
    """A function that never changes: a term over the parameters, a table from argument tuples to values, or a function
    of Python (``extern``).

    ``reads``: whether its body reads fluents, which only stand for functions of Python there (``golc.proofs.rigid``).
    """

    parameters: tuple[Parameter, ...]
    type: Type
    body: Term | Mapping[tuple[Value, ...], Value] | PythonFunction
    reads: bool = False


@dataclass(frozen=True)
class Fluent(Declared):
    """``initial`` is a term over the parameters. The parameters' types are finite; the fluent's own may be ``int``."""

    parameters: tuple[Parameter, ...]
    type: Type
    initial: Term | Choice


@dataclass(frozen=True)
class Definition(Declared):
    """Evaluated by value: a term over the parameters that reads the current situation.

    Goals and invariants are definitions, too: formulas without parameters.
    """

    parameters: tuple[Parameter, ...]
    type: Type
    body: Term


@dataclass(frozen=True)
class Effect:
    """One ``causes`` clause. Binders take the levels after the action's parameters.

    For each binding that satisfies ``where`` and ``condition``, both evaluated before the action, the ground fluent
    gets the value of ``value``, evaluated before the action too.
    """

    binders: tuple[Binder, ...]
    where: Term | None
    fluent: str
    args: tuple[Term, ...]
    value: Term | Choice
    condition: Term | None
    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)

    @property
    def terms(self) -> tuple[Term, ...]:
        """All terms of the clause."""
        value = self.value.among if isinstance(self.value, Choice) else self.value
        conditions = [term for term in (self.where, self.condition) if term is not None]
        return (*ranges(self.binders), *self.args, value, *conditions)


@dataclass(frozen=True)
class Action(Declared):
    """A primitive or an exogenous action.

    ``preconditions`` are the ``poss`` lines, all of which must hold, in order. ``senses`` are evaluated in the
    situation after the action's own effects. ``sources`` names the device kinds that may report an exogenous action
    (empty: any). ``expected``: look-ahead may count on it.
    Parameters of primitive actions have finite types or ``int``.
    """

    parameters: tuple[Parameter, ...]
    exogenous: bool
    preconditions: tuple[Term, ...]
    effects: tuple[Effect, ...]
    senses: tuple[Term, ...]
    cost: Term | None
    sources: tuple[str, ...] = ()
    expected: bool = False


@dataclass(frozen=True)
class Prune(Declared):
    """A bad situation, which look-ahead never enters: one in which ``condition`` holds.

    With an ``action``: only after it; then the variables of the condition are the action's parameters, and ``Before``
    terms speak of the situation before it.
    """

    action: str | None
    condition: Term


@dataclass(frozen=True)
class Procedure(Declared):
    """``recursive``: whether a call of it may lead to another call of it."""

    parameters: tuple[Parameter, ...]
    body: Statement
    recursive: bool


@dataclass(frozen=True)
class Fixed:
    """An argument of a binding that is fixed to a constant."""

    value: Value


@dataclass(frozen=True)
class ByCall:
    """A function or sub (NQC), a Python function (host): done when it returns."""

    function: str
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True)
class ByStart:
    """An NQC task: starting it returns at once."""

    task: str
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True)
class ByPrompt:
    """A message to a person, who presses Enter; the variables of the terms are the action's parameters."""

    message: Message
    span: Span = field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True)
class Binding:
    """What a device does for an action (or that it reports one, if the action is exogenous).

    ``args`` has one element for each of the action's parameters. ``number`` is the first message number, or none where
    the file leaves it to golc; ``table`` maps a device's number to a sensing value; ``timeout`` is in seconds.
    """

    action: str
    args: tuple[Parameter | Fixed, ...]
    number: int | None
    behaviour: ByCall | ByStart | ByPrompt | None
    table: Mapping[int, Value] | None
    timeout: Fraction | None
    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class Setting:
    """``set name value [s]``."""

    name: str
    value: Fraction
    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class Device:
    """A ``device`` block: ``kind`` is ``rcx``, ``operator``, ``host`` or ``self``.

    ``name`` distinguishes several of one kind (otherwise it is the kind); ``file`` is the path as written; ``folder``
    the directory of the file that declares the device, against which ``file`` is resolved.
    """

    kind: str
    name: str
    file: str | None
    bindings: tuple[Binding, ...]
    settings: Mapping[str, Setting]
    folder: str = field(default=".", compare=False)
    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class BasicActionTheory:
    """Everything a domain file says, resolved and typed. Every mapping is by name, in the order of declaration."""

    name: str
    source: Source
    constants: Mapping[str, Constant]
    types: Mapping[str, Type]
    statics: Mapping[str, Static]
    fluents: Mapping[str, Fluent]
    definitions: Mapping[str, Definition]
    actions: Mapping[str, Action]
    procedures: Mapping[str, Procedure]
    devices: tuple[Device, ...]
    inline_types: tuple[Type, ...] = ()
    """The enumerations that stand in place of a type's name and declare symbols."""
    goals: tuple[str, ...] = ()
    """The definitions that are goals."""
    invariants: tuple[str, ...] = ()
    """The definitions that are invariants."""
    scenarios: Mapping[str, Scenario] = field(default_factory=dict)
    initially: tuple[Term, ...] = ()
    """What holds in every possible initial world, beside the initial values."""
    prunes: Mapping[str, Prune] = field(default_factory=dict)
    python: PythonFiles = field(default_factory=PythonFiles, compare=False, repr=False)
    """The Python files of its functions and devices."""

    @property
    def bricks(self) -> tuple[Device, ...]:
        """The devices of kind ``rcx``."""
        return tuple([device for device in self.devices if device.kind == "rcx"])

    @property
    def symbols(self) -> frozenset[Value]:
        """Every symbol of every enumeration."""
        return frozenset(
            value
            for type_ in (*self.types.values(), *self.inline_types)
            if type_.finite and not type_.kinds <= {"int", "bool", "none"}
            for value in type_.values
            if isinstance(value, str)
        )
