"""What golc has to say about an input: sources, spans, diagnostics, and the errors that carry them."""

from __future__ import annotations

import bisect
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property


@dataclass(frozen=True, eq=False)
class Source:
    """A text with the name under which messages speak of it (a path as the user gave it, or ``<goal>``).

    ``editable``: it was read as golc text from a file, so that a fix may change it; no other text is ever changed.
    ``python``: it is Python, so that advice is given in its words.
    """

    name: str
    text: str = field(repr=False)
    editable: bool = False
    python: bool = False

    @cached_property
    def line_starts(self) -> list[int]:
        """Offset of the first character of each line; only ``\\n`` ends a line."""
        starts = [0]
        for offset, character in enumerate(self.text):
            if character == "\n":
                starts.append(offset + 1)
        return starts

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both from 1; columns count characters."""
        line = bisect.bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line(self, number: int) -> str:
        """The text of a line (from 1) without its line end."""
        start = self.line_starts[number - 1]
        end = self.line_starts[number] - 1 if number < len(self.line_starts) else len(self.text)
        return self.text[start:end].rstrip("\r")


@dataclass(frozen=True, slots=True)
class Span:
    """The half-open range ``start..end`` of offsets in a source."""

    source: Source
    start: int
    end: int

    @property
    def line(self) -> int:
        """Line of the first character, from 1."""
        return self.source.position(self.start)[0]

    @property
    def column(self) -> int:
        """Column of the first character, from 1, in characters."""
        return self.source.position(self.start)[1]

    @property
    def text(self) -> str:
        """The characters themselves."""
        return self.source.text[self.start : self.end]

    def to(self, other: Span) -> Span:
        """From the start of this span to the end of the other one."""
        return Span(self.source, self.start, other.end)

    def either(self, golc: str, python: str) -> str:
        """Of two texts the one in the form in which this place is written: golc's own, or Python."""
        return python if self.source.python else golc

    def __str__(self) -> str:
        return f"{self.source.name}:{self.line}:{self.column}"


NOWHERE = Span(Source("<built in>", ""), 0, 0)


class Severity(Enum):
    """How bad a finding is; only errors make ``golc check`` fail."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


class Code(Enum):
    """Every finding that golc can make: its stable code and its title."""

    # 001..009: text and syntax
    UNREADABLE = ("GL001", "a file cannot be read as text or written")
    SYNTAX = ("GL002", "the text does not follow the grammar")
    INDENTATION = ("GL003", "the indentation makes no block")
    MISSING = ("GL004", "a colon, a bracket or a block is missing")
    FOREIGN = ("GL005", "a sign or word of another language, or the wrong one")
    RESERVED = ("GL006", "a word of the language is used as a name")
    STRING = ("GL007", "a string or a message cannot be read")
    NESTING = ("GL008", "the text is nested too deeply")
    DOMAIN = ("GL009", "the domain line is missing or out of place")

    # 010..039: names, types, declarations
    NO_FILE = ("GL010", "an import in a text that is no file")
    DUPLICATE = ("GL011", "a name is declared twice")
    UNKNOWN_NAME = ("GL012", "a name is not declared")
    UNKNOWN_ACTION = ("GL013", "an action or a procedure is not declared")
    UNKNOWN_TYPE = ("GL014", "a type is not declared")
    ARITY = ("GL015", "the number of arguments is wrong")
    TYPE_MISMATCH = ("GL016", "a term has the wrong type")
    OUTSIDE_TYPE = ("GL017", "a constant is outside the type")
    MISUSED_NAME = ("GL018", "a name is used for what it is not")
    CIRCULAR = ("GL019", "a declaration depends on itself")
    NOT_CONSTANT = ("GL020", "a value that never changes depends on the situation")
    NO_VALUE = ("GL021", "a constant value cannot be computed")
    BAD_TYPE = ("GL022", "a type cannot be used here")
    TABLE = ("GL023", "a table does not cover its type exactly")
    OVERRIDE = ("GL024", "the command line replaces a constant that does not exist")
    MISPLACED_CLAUSE = ("GL025", "a clause does not belong where it stands")
    SHADOWED = ("GL026", "a local name hides a declared one")
    UNUSED = ("GL027", "a declaration is not used")
    UNUSED_LOCAL = ("GL028", "a parameter or variable is not used")
    DEVICE = ("GL029", "a device block says what its kind cannot do")
    BINDING = ("GL030", "a binding does not fit its action")
    LOOSE_QUANTIFIER = ("GL031", "a quantifier takes in more than it seems")
    IDLE_IGNORE = ("GL032", "a `golc: ignore` comment has no effect")
    PYTHON = ("GL033", "a Python function is not there, or does not fit its declaration")
    NOT_EXECUTED = ("GL034", "Python code is not executed")

    # 040..049: questions about all situations
    EFFECT_CONFLICT = ("GL040", "two effects of an action may give one fluent two values")
    EFFECT_FAILS = ("GL041", "an action can go wrong where it is possible")
    INVARIANT_NOT_KEPT = ("GL042", "an action may break an invariant")
    NEVER_POSSIBLE = ("GL043", "an action can never be possible")
    NOT_DECIDED = ("GL049", "a property of the theory is not decided")

    # 050..059: initial values
    NO_INITIAL = ("GL050", "a fluent has no initial value")
    INITIAL_VALUE = ("GL051", "an initial value cannot be computed or is outside the type")
    INVARIANT_AT_FIRST = ("GL052", "an invariant is false in the initial state")
    NO_INITIAL_WORLD = ("GL053", "what is said of the initial situation leaves no possible world")
    IDLE_CONSTRAINT = ("GL054", "a constraint on the initial situation rules nothing out")

    # 060..069: knowledge
    NO_CHOICE = ("GL060", "a fluent is one of no values")
    NEVER_KNOWN = ("GL061", "something is asked that can never be known")

    # 070..079: programs
    UNREACHABLE = ("GL070", "an interrupt is not reached")
    NEVER_FIRES = ("GL071", "an interrupt can never fire")
    STUCK = ("GL072", "an action can never be possible where it stands")
    CONSTANT = ("GL073", "a condition is always true or always false")
    ENDLESS_LOOP = ("GL074", "nothing changes the condition of a loop")

    # 080..099: devices and NQC
    NO_DEVICE = ("GL080", "a primitive action has no device")
    SEVERAL_MESSAGES = ("GL081", "a number takes several messages")
    NUMBER_CLASH = ("GL082", "two bindings take the same number")
    NUMBER_RANGE = ("GL083", "a number does not fit the brick")
    BINDING_UNBOUNDED = ("GL084", "a binding ranges over a type whose values cannot be listed")
    SENSING_NUMBER = ("GL085", "a sensing value that the brick cannot answer with")
    UNREPORTED = ("GL086", "an exogenous action that no device reports")
    NO_END = ("GL087", "a behaviour is started and nothing tells its end")
    NQC_NAME = ("GL088", "a name that NQC does not take")
    DEVICE_SETTING = ("GL089", "a setting of a device makes no sense")
    IMAGE = ("GL090", "a compiled program cannot be loaded")
    WORLD = ("GL091", "a world file says what cannot be")
    MESSAGE_RANGES = ("GL092", "two ranges of messages overlap")
    ARGUMENT_NUMBER = ("GL093", "an argument that a behaviour cannot be given")
    NQC_REFUSED = ("GL094", "the NQC compiler refuses the program")
    NQC_LIMIT = ("GL095", "the program is too large for the brick")
    NQC_BEHAVIOUR = ("GL096", "a behaviour in the NQC file does not fit its binding")
    NQC_BUSY = ("GL097", "a task that never rests slows down the answers")
    NQC_SAMPLED = ("GL098", "exogenous actions are sampled and may be lost")
    NQC_EDITED = ("GL099", "a generated file was edited and is left alone")

    # 100..139: run time
    ARGUMENT_OUTSIDE_TYPE = ("GL100", "an argument is outside its parameter's type")
    VALUE_OUTSIDE_TYPE = ("GL101", "a value is outside its type")
    NOTHING = ("GL102", "`none` where a value is needed")
    DIVISION_BY_ZERO = ("GL103", "division by zero")
    EMPTY_EXTREMUM = ("GL104", "`min` or `max` over nothing")
    CONFLICTING_EFFECTS = ("GL105", "two effects give one fluent two values")
    ENDLESS_RECURSION = ("GL106", "a recursion does not end")
    RUNS_IN_CIRCLES = ("GL107", "the program runs in circles")
    BLOCKED = ("GL108", "the program is blocked and nothing can unblock it")
    NO_ELEMENT = ("GL109", "a list has no such element")
    EVENTS = ("GL110", "a line of an events file cannot be understood")
    EVENT = ("GL111", "an action is written that cannot be reported or performed so")
    IMPOSSIBLE_EVENT = ("GL112", "an exogenous action has occurred that the theory thinks impossible")
    ABORTED = ("GL113", "the program has ended itself as failed")
    WAITS_FOR_EVER = ("GL114", "the program waits and nothing can happen any more")
    SURPRISE = ("GL115", "a device senses what the theory thinks impossible")
    TOO_MANY_WORLDS = ("GL116", "there are more possible worlds than golc can go through")
    UNDECIDED = ("GL117", "the agent does not know what it needs to go on")
    TOO_LARGE = ("GL118", "a number, a set or a list grows too large")
    EXTERN = ("GL119", "a Python function in a term fails")
    INVARIANT_BROKEN = ("GL120", "an invariant is false after an action")
    SCENARIO = ("GL121", "a scenario does not go as it expects")
    EVENT_OF_BRICK = ("GL122", "a script reports what the brick reports by itself")

    # 140..149: theories in Python
    PYTHON_SYNTAX = ("GL140", "the Python of a theory cannot be read")
    PYTHON_RAISED = ("GL141", "the Python of a theory fails")
    PYTHON_TRUTH = ("GL142", "Python asks a term for its truth")
    PYTHON_MEANING = ("GL143", "Python that has no meaning in a theory")
    PYTHON_VALUE = ("GL144", "a Python value that means nothing in a theory")
    PYTHON_CHANGED = ("GL145", "a name of Python has changed since the function was declared")
    NO_THEORY = ("GL146", "a Python file does not hold exactly one theory")

    def __init__(self, code: str, title: str) -> None:
        self.code = code
        self.title = title


@dataclass(frozen=True, slots=True)
class Label:
    """A second place that explains a finding."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Edit:
    """The text of a span becomes another one; at an empty span something is inserted."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Fix:
    """A change with which a finding goes, and which its writer obviously meant; ``does`` begins with a verb."""

    does: str
    edits: tuple[Edit, ...]


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding: what, where, how bad, why, and what to do about it.

    ``message`` is one sentence without a full stop that names the thing and the cause; ``marker`` stands beside the
    underlined place; ``help`` is a concrete proposal; ``fix`` carries it out where that is safe, and is dropped if it
    would change a source that is not ``editable``.
    """

    code: Code
    message: str
    span: Span
    severity: Severity = Severity.ERROR
    marker: str = ""
    labels: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str | None = None
    fix: Fix | None = None

    def __post_init__(self) -> None:
        if self.fix is not None and not all(edit.span.source.editable for edit in self.fix.edits):
            object.__setattr__(self, "fix", None)


@dataclass
class Findings:
    """Collects the diagnostics of a pass, which goes on after each."""

    diagnostics: list[Diagnostic] = field(default_factory=list)

    def add(self, diagnostic: Diagnostic) -> None:
        """Keep a finding."""
        self.diagnostics.append(diagnostic)

    def once(self, diagnostic: Diagnostic) -> None:
        """Add a finding that may have been made on another way."""
        if diagnostic not in self.diagnostics:
            self.add(diagnostic)

    def error(
        self,
        code: Code,
        message: str,
        span: Span,
        marker: str = "",
        help: str | None = None,
        labels: tuple[Label, ...] = (),
        notes: tuple[str, ...] = (),
        fix: Fix | None = None,
    ) -> None:
        """Add an error; the parameters are those of ``Diagnostic``."""
        self.add(Diagnostic(code, message, span, Severity.ERROR, marker, labels, notes, help, fix))

    def warning(
        self,
        code: Code,
        message: str,
        span: Span,
        marker: str = "",
        help: str | None = None,
        labels: tuple[Label, ...] = (),
        notes: tuple[str, ...] = (),
    ) -> None:
        """Add a warning; the parameters are those of ``Diagnostic``."""
        self.add(Diagnostic(code, message, span, Severity.WARNING, marker, labels, notes, help))

    @property
    def has_errors(self) -> bool:
        """Whether one of the findings is an error."""
        return any(diagnostic.severity is Severity.ERROR for diagnostic in self.diagnostics)


def counted(number: int, what: str) -> str:
    """``1 error``, ``2 errors``: a number of things, for a message."""
    return f"{number} {what}{'s' * (number != 1)}"


class GolcError(Exception):
    """The base of every error that golc raises on purpose; ``exit_code`` is what the command line ends with."""

    exit_code = 70

    def _render_traceback_(self) -> list[str]:
        """What a notebook shows in place of a traceback."""
        from golc.notebook import error_lines

        return error_lines(self)


def _rendered(diagnostics: tuple[Diagnostic, ...]) -> str:
    """The text of an error, made when a traceback or somebody else wants it: what the command line would write."""
    from golc.rendering import render

    return "\n\n".join(map(render, diagnostics))


class UserError(GolcError):
    """The input is wrong: carries what is to be said about it."""

    exit_code = 1

    def __init__(self, *diagnostics: Diagnostic) -> None:
        super().__init__(*diagnostics)
        self.diagnostics = diagnostics

    def __str__(self) -> str:
        return _rendered(self.diagnostics)


class ProgramError(GolcError):
    """The theory or the program fails while it runs: an argument outside its type, running in circles, blocked."""

    exit_code = 5

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic)
        self.diagnostic = diagnostic

    def __str__(self) -> str:
        return _rendered((self.diagnostic,))


class LimitError(GolcError):
    """golc gave up at a limit (steps, time, nodes, memory)."""

    exit_code = 3


class DeviceError(GolcError):
    """The world is wrong: a device, a link or a tool does not do what it should.

    ``help`` says what a person can do about it; ``lasting``: trying again is of no use.
    """

    exit_code = 4
    lasting = False

    def __init__(self, message: str, help: str | None = None) -> None:
        super().__init__(message)
        self.help = help
