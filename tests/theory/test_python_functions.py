"""Functions of Python in terms: what goes over the border, what comes back, and what goes wrong."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any, TypeAlias

import pytest

from golc.diagnostics import Code, Diagnostic, ProgramError, Severity, UserError
from golc.loading import examine, load
from golc.situation.dynamics import Dynamics
from golc.theory.border import PythonFunction
from golc.theory.terms import StaticTerm
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value

Write: TypeAlias = Callable[[str, str], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Writes a domain, and the file ``helpers.py`` beside it."""

    def write(declarations: str, python: str) -> Path:
        path = tmp_path / "trial.gl"
        path.write_text(f"domain trial\ntype t = 1..3\ntype colour = {{red, green}}\n{declarations}\n")
        (tmp_path / "helpers.py").write_text(python)
        return path

    return write


def of(theory: BasicActionTheory, *args: Value) -> tuple[Value, Value]:
    """The value of the function ``f``, as the interpreter and as compiled code has it."""
    from golc.theory.terms import Literal

    static = theory.statics["f"]
    pairs = zip(args, static.parameters, strict=True)
    term = StaticTerm("f", tuple([Literal(value, type=p.type) for value, p in pairs]), type=static.type)
    dynamics = Dynamics(theory)
    return dynamics.interpreter.evaluate(term, (), ()), dynamics.compiler.term(term, 0)((), ())


def extern(signature: str) -> str:
    return f'extern f{signature} from "helpers.py"'


@pytest.mark.parametrize(
    ("signature", "args", "returned", "value"),
    [
        ("(a: t, b: t): int", (1, 3), "a - b", -2),
        ("(a: t)", (2,), "a == 2", True),
        ("(c: colour): colour?", ("red",), "None if c == 'red' else c", None),
        ("(c: colour): colour", ("red",), "'green'", "green"),
        (": list[t]", (), "[1, 3]", (1, 3)),
        ("(l: list[colour]): set[colour]", (("red", "red"),), "set(l)", frozenset({"red"})),
        ("(s: set[t]): int", (frozenset({1, 2}),), "len(s)", 2),
        ("(x: real): real", (Fraction(1, 4),), "x * 2", Fraction(1, 2)),
        ("(x: int): real", (10,), "x / 4", Fraction(5, 2)),
        ("(x: int): real", (10,), "x / 5", 2),
        ("(s: string): string", ("ab",), "s.upper()", "AB"),
        ("(a: t): bool", (1,), "a > 2", False),
    ],
)
def test_arguments_go_out_and_a_value_comes_back(
    write: Write, signature: str, args: tuple[Value, ...], returned: str, value: Value
) -> None:
    names = ", ".join(part.split(":")[0].strip() for part in signature.partition(")")[0][1:].split(",") if args)
    theory = load(write(extern(signature), f"def f({names}):\n    return {returned}\n"))

    assert of(theory, *args) == (value, value)
    assert [type(found) for found in of(theory, *args)] == [type(value)] * 2


def failure(path: Path) -> Diagnostic:
    """What is said where the initial value of a fluent calls the function."""
    with pytest.raises(UserError) as raised:
        load(path)
    (diagnostic,) = raised.value.diagnostics
    return diagnostic


@pytest.mark.parametrize(
    ("type_", "returned", "shown"),
    [
        ("t", "4", "4 in"),
        ("t", "True", "True in"),
        ("t", "2.0", "2.0 in"),
        ("t", "None", "None in"),
        ("bool", "1", "1 in"),
        ("colour", "'blue'", "'blue' in"),
        ("list[t]", "{1}", "{1} in"),
        ("list[t]", "[1, 7]", "[1, 7] in"),
        ("set[colour]", "['red']", "['red'] in"),
        ("real", "float('inf')", "inf in"),
        ("real", "object", "<class 'object'> in"),
        ("string", "b'x'", "b'x' in"),
    ],
)
def test_a_value_outside_the_declared_type_is_an_error(write: Write, type_: str, returned: str, shown: str) -> None:
    path = write(f"{extern(f': {type_}')}\nfluent x: {type_} = f", f"\ndef f():\n    return {returned}\n")

    found = failure(path)

    assert found.code is Code.EXTERN
    assert found.message.startswith(f"`f` is {shown} {path.parent / 'helpers.py'}, which is not of type `")
    assert (found.span.line, found.span.text) == (5, "f")
    (label,) = found.labels
    assert (label.span.source.name, label.span.line, label.span.text) == (
        str(path.parent / "helpers.py"),
        2,
        "def f():",
    )


@pytest.mark.parametrize(
    ("python", "message", "line"),
    [
        ("def f(a):\n    return 1 // 0\n", "`f(2)` failed at {file}:2: ZeroDivisionError: ", 2),
        ("import sys\ndef f(a):\n    sys.exit(3)\n", "`f(2)` failed at {file}:3: SystemExit: 3", 3),
        ("def f(a):\n    return f(a)\n", "`f(2)` failed at {file}:2: RecursionError: ", 2),
        (
            "def f(a):\n    return Odd([1])\nclass Odd(list):\n    def __iter__(self): raise KeyError\n",
            "`f(2)` failed",
            4,
        ),
        ("def f(a):\n    return 1\nimport no_such_module\n", "loading helpers.py failed at {file}:3: Module", 3),
        ("def f(a):\n    return 1\nraise ValueError('so\\nso')\n", "loading helpers.py failed at {file}:3: Val", 3),
    ],
)
def test_whatever_a_function_raises_is_an_error_with_its_line(
    write: Write, python: str, message: str, line: int
) -> None:
    path = write(f"{extern('(a: t): list[t]')}\nfluent x: list[t] = f(2)", python)

    found = failure(path)

    assert found.code is Code.EXTERN
    assert found.message.startswith(message.format(file=path.parent / "helpers.py"))
    assert found.span.text == "f(2)"
    assert [label.span.line for label in found.labels] == [line]


def test_an_interrupt_passes_through_a_function(write: Write) -> None:
    path = write(f"{extern(': t')}\nfluent x: t = f", "def f():\n    raise KeyboardInterrupt\n")

    with pytest.raises(KeyboardInterrupt):
        load(path)


@pytest.mark.parametrize(
    ("python", "message"),
    [
        ("def g(a): return a\n", "{file} has no function `f`"),
        ("def f(): return 1\n", "`f` in {file} takes 0 arguments, not 1"),
        ("f = 3\n", "`f` in {file} is not a function"),
        ("def f(a) return a\n", "{file} is not Python: "),
    ],
)
def test_a_function_that_is_not_there_is_an_error_of_the_declaration(write: Write, python: str, message: str) -> None:
    path = write(f"{extern('(a: t): t')}\nfluent x: t = f(1)\nconst c = f(2)", python)

    found = failure(path)

    assert found.code is Code.PYTHON
    assert found.message.startswith(message.format(file=path.parent / "helpers.py"))
    assert (found.span.line, found.span.text) == (4, "f")


def test_a_function_is_called_once_for_the_same_arguments(write: Write) -> None:
    theory = load(write(extern("(a: t): int"), "calls = []\ndef f(a):\n    calls.append(a)\n    return len(calls)\n"))

    assert [of(theory, 2), of(theory, 1), of(theory, 2)] == [(1, 1), (2, 2), (1, 1)]


def test_one_file_is_executed_once_and_only_when_a_function_is_needed(write: Write, tmp_path: Path) -> None:
    log = tmp_path / "log"
    python = f"open({str(log)!r}, 'a').write('executed ')\ndef f(a): return a\ndef g(a): return -a\n"
    theory = load(write(f'{extern("(a: t): int")}\nextern g(a: t): int from "./helpers.py"', python))

    assert not log.exists()
    assert of(theory, 2) == (2, 2)
    assert of(theory, 3) == (3, 3)
    bodies = [static.body for static in theory.statics.values()]
    assert [body.file for body in bodies if isinstance(body, PythonFunction)] == [
        theory.python.file(log.parent / "helpers.py")
    ] * 2
    assert log.read_text() == "executed "


def test_the_path_is_relative_to_the_file_with_the_declaration(write: Write, tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "part.gl").write_text('domain part\nextern g(n: int): int from "sums.py"\n')
    (tmp_path / "parts" / "sums.py").write_text(
        "import neighbour_of_sums\ndef g(n): return n + neighbour_of_sums.ONE\n"
    )
    (tmp_path / "parts" / "neighbour_of_sums.py").write_text("ONE = 1\n")
    theory = load(write('import "parts/part.gl"\nconst c = g(2)', ""))

    assert theory.constants["c"].value == 3


def test_dataclasses_work_in_a_file(write: Write) -> None:
    python = "from __future__ import annotations\nfrom dataclasses import dataclass\n@dataclass\nclass P:\n    x: int\n"
    theory = load(write(extern("(a: t): int"), python + "def f(a): return P(a).x\n"))

    assert of(theory, 3) == (3, 3)


def test_arguments_have_to_be_of_their_types(write: Write) -> None:
    theory = load(write(f"{extern('(a: t): int')}\nfluent n: int = 4", "def f(a): return a\n"))

    with pytest.raises(ProgramError) as raised:
        of(theory, 4)
    assert raised.value.diagnostic.code is Code.ARGUMENT_OUTSIDE_TYPE


USES: list[tuple[str, int]] = [
    ("const c = f(1)", 5),
    ("type u = 0..(f(2))", 5),
    ("static s = f(1) > 1", 5),
    ("static s(a: t): int = {1: f(1), 2: 2, 3: 3}", 5),
    ("fluent x: t = f(2)", 5),
    ("fluent x(a: t): t = f(a)", 5),
    ("fluent x: int = one of {f(1), 3}", 5),
    ("initially f(1) = 1", 5),
    ("invariant i: f(1) = 1", 5),
    ("static s(a: t): int = f(a) + 1\nconst c = s(2)", 5),
]


@pytest.mark.parametrize(("use", "line"), USES, ids=[use for use, _ in USES])
def test_without_trust_what_needs_a_value_is_a_note(write: Write, use: str, line: int) -> None:
    path = write(f"{extern('(a: t): int')}\n{use}", "def f(a):\n    raise AssertionError('executed')\n")

    found = [finding for finding in examine(path).findings if finding.code is not Code.UNUSED]

    assert {finding.severity for finding in found} == {Severity.NOTE}
    assert {(finding.code, finding.span.line) for finding in found} == {(Code.NOT_EXECUTED, line)}
    assert (
        found[0].message
        == f"this has no value yet: it depends on `f`, and {path.parent / 'helpers.py'} is not executed"
    )


@pytest.mark.parametrize(("use", "line"), USES, ids=[use for use, _ in USES])
def test_with_trust_there_is_a_value(write: Write, use: str, line: int) -> None:
    path = write(f"{extern('(a: t): int')}\n{use}", "def f(a):\n    return a\n")

    examined = examine(path, trust=True)

    codes = (Code.UNUSED, Code.IDLE_CONSTRAINT)
    assert [finding for finding in examined.findings if finding.code not in codes] == []
    assert examined.theory is not None


@pytest.mark.parametrize(
    "use",
    [
        "fluent x: int = f(2)",
        "fluent x(a: t): int = f(a)",
        "fluent x: t = 1 if f(2) > 3 else 2",
        "invariant i: f(1) = f(1)",
        "fluent x: int = f(2)\ninvariant i: x = f(2)",
        "fluent x: int = one of {1, 3}\ninvariant i: f(x) = f(1) or f(x) = f(3)",
    ],
)
def test_without_trust_nothing_is_said_of_what_is_so_for_every_function(write: Write, use: str) -> None:
    path = write(f"{extern('(a: t): int')}\n{use}", "def f(a):\n    raise AssertionError('executed')\n")

    assert [finding for finding in examine(path).findings if finding.code is not Code.UNUSED] == []


@pytest.mark.parametrize(
    ("use", "message"),
    [
        ("invariant i: f(1) != f(1)", "invariant `i` is false in the initial state"),
        ("fluent x: t = one of {1, 3}\ninvariant i: f(x) != f(1)", "invariant `i` is false in a world that is"),
    ],
)
def test_without_trust_what_is_false_for_every_function_is_an_error(write: Write, use: str, message: str) -> None:
    path = write(f"{extern('(a: t): int')}\n{use}", "def f(a):\n    raise AssertionError('executed')\n")

    (error,) = [finding for finding in examine(path).findings if finding.code is not Code.UNUSED]
    assert error.code is Code.INVARIANT_AT_FIRST
    assert error.message.startswith(message)


def test_without_trust_the_rest_is_checked(write: Write) -> None:
    text = f"{extern('(a: t): int')}\nconst c = f(1)\naction a:\n    poss f(1, 2) = c and f(red) = 1 and g(2)\n"
    found = examine(write(text, "def f(a): return a\n")).findings

    errors = [(finding.code, finding.span.text) for finding in found if finding.severity is Severity.ERROR]
    assert errors == [(Code.ARITY, "f"), (Code.TYPE_MISMATCH, "red"), (Code.UNKNOWN_NAME, "g")]


def test_a_theory_that_is_loaded_without_trust_never_executes(write: Write) -> None:
    python = "def f(a):\n    raise AssertionError('executed')\n"
    theory = load(write(extern("(a: t): int"), python), trust=False)

    with pytest.raises(ProgramError) as raised:
        of(theory, 1)
    assert raised.value.diagnostic.code is Code.NOT_EXECUTED

    with pytest.raises(UserError) as refused:
        load(write(f"{extern('(a: t): int')}\nconst c = f(1)", python), trust=False)
    assert [finding.code for finding in refused.value.diagnostics] == [Code.NOT_EXECUTED]


def test_two_declarations_of_the_same_function_are_equal(write: Write) -> None:
    first: Any = load(write(extern("(a: t): int"), "def f(a): return a\n"))
    second: Any = load(write(extern("(b: t): int"), "def f(b): return -b\n"))
    other: Any = load(write(extern("(b: t): int").replace("helpers", "./helpers"), "def f(b): return b\n"))

    assert first.statics == second.statics
    assert first.statics != other.statics
