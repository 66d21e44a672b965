"""Operators of Python outside translated functions build terms; what they cannot mean is refused at its place."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from golc.diagnostics import Diagnostic

HEAD = """
from golc.embed import (
    Theory, before, count, enum, exists, first, forall, iff, implies, interval, known, knows, one_of, optional, poss,
    possible, rest, symbols, test, union, unknown, values,
)

theory = Theory("lift")
floor = theory.type("floor", interval(1, 6))
phase = theory.type("phase", enum("moving", "stopped"))
moving, stopped = phase
at = theory.fluent("at", floor, 1)
motion = theory.fluent("motion", phase, stopped)
lit = theory.fluent("lit", initial=False, parameters={"f": floor})
"""


@pytest.mark.parametrize(
    ("python", "text"),
    [
        ("at == 1", "at = 1"),
        ("at != 1", "at != 1"),
        ("1 < at", "1 < at"),
        ("7 - 2 >= at", "5 >= at"),
        ("1 == at", "1 = at"),
        ("lit(1) == True", "lit(1) = true"),
        ("count(floor, lambda n: lit(n)) <= at", "(count n: floor. lit(n)) <= at"),
        ("(at < 2) & (at <= 3)", "at < 2 and at <= 3"),
        ("(at > 2) | ~(at >= 3)", "at > 2 or not at >= 3"),
        ("at + 1 - 2 * at // 3 % 4 == -at", "at + 1 - 2 * at // 3 % 4 = -at"),
        ("1 + at == 2 - at", "1 + at = 2 - at"),
        ("3 * at == 7 // at", "3 * at = 7 // at"),
        ("abs(at - 3) == 1", "abs(at - 3) = 1"),
        ("lit(at)", "lit(at)"),
        ("lit(f=at + 1)", "lit(at + 1)"),
        ("motion == phase.moving", "motion = moving"),
        ("implies(lit(1), lit(2))", "lit(1) implies lit(2)"),
        ("iff(lit(1), True)", "lit(1) iff true"),
        ("exists(floor, lambda n: lit(n))", "exists n: floor. lit(n)"),
        (
            "forall(floor, phase, lambda n, p: lit(n), where=lambda n, p: p == motion)",
            "forall n: floor, p: phase where p = motion. lit(n)",
        ),
        ("count(interval(1, 3), lambda n: lit(n)) == 2", "(count n: 1..3. lit(n)) = 2"),
        ("knows(lit(1)) & possible(lit(2))", "knows(lit(1)) and possible(lit(2))"),
        ("known(at) == 1", "known(at) = 1"),
        ("before(at) == first([1, 2])", "before(at) = first([1, 2])"),
        ("at == 1.5", "at = 1.5"),
        ("at != None", "at != none"),
    ],
)
def test_operators_build_what_the_text_says(text_of: Callable[[str], str], python: str, text: str) -> None:
    assert f"goal g: {text}\n" in text_of(f'{HEAD}\ntheory.goal("g", {python})\n')


@pytest.mark.parametrize(
    ("python", "text"),
    [
        ("interval(1, 6)", "1..6"),
        ("range(1, 7)", "1..6"),
        ('enum("a", "b")', "{a, b}"),
        ("enum(-1, 1)", "{-1, 1}"),
        ('phase | enum("idle")', "phase + {idle}"),
        ('phase | enum("idle") | floor', "phase + {idle} + floor"),
        ("floor | None", "floor?"),
        ("int | None", "int?"),
        ("set[floor]", "set[floor]"),
        ("list[set[int]] | None", "list[set[int]]?"),
        ('"later"', "later"),
        ('optional("later")', "later?"),
        ('union("later", floor)', "later + floor"),
        ("float", "real"),
        ("str", "string"),
    ],
)
def test_types_are_objects(text_of: Callable[[str], str], python: str, text: str) -> None:
    assert f"type t = {text}\n" in text_of(f'{HEAD}\ntheory.type("t", {python})\n')


def test_unions_of_unions_are_one_in_annotations(text_of: Callable[[str], str]) -> None:
    text = text_of(
        f"from __future__ import annotations\n{HEAD}\n@theory.fluent\n"
        "def f(a: union(phase | enum('idle'), floor), b: optional(union('phase', floor)), c: union(phase, None)): ...\n"
    )

    assert text.endswith("fluent f(a: phase + {idle} + floor, b: phase + floor?, c: phase?)\n")


def test_a_symbol_may_have_any_name(text_of: Callable[[str], str]) -> None:
    text = text_of(
        f"{HEAD}\nkind = theory.type('kind', enum('name', 'value', 'node', 'symbols'))\n"
        "for each in (kind.name, kind.value, kind.node, kind.symbols):\n    theory.initially(each == kind.node)\n"
    )

    assert text.endswith(
        "initially name = node\ninitially value = node\ninitially node = node\ninitially symbols = node\n"
    )


@pytest.mark.parametrize(
    ("line", "place", "code", "message", "help_"),
    [
        ('theory.goal("g", at == 1 and lit(2))', (18, 18), "GL142", "`and` asks a term for its truth", "`(…) & (…)`"),
        ('theory.goal("g", lit(1) or lit(2))', (18, 16), "GL142", "`or` asks a term for its truth", "`(…) | (…)`"),
        ('theory.goal("g", not lit(1))', (18, 10), "GL142", "`not` asks a term for its truth", "`~(…)`"),
        ('theory.goal("g", 1 <= at <= 6)', (18, 12), "GL142", "a chain of comparisons", "(a <= x) & (x <= b)"),
        ('theory.goal("g", at == 1 | at == 2)', (18, 17), "GL142", "a chain of comparisons", "(a == x) & (b == y)"),
        ("if at == 1: pass", (4, 7), "GL142", "`if` asks a term for its truth", "decides it once"),
        ("x = 1 if lit(1) else 2", (10, 6), "GL142", "`… if … else …` asks a term", "decides it once"),
        ("while lit(1):\n    pass", (7, 6), "GL142", "`while` asks a term for its truth", "decides it once"),
        ("if not lit(1):\n    pass", (4, 10), "GL142", "`not` asks a term for its truth", "`~(…)`"),
        ("assert lit(1)", (8, 6), "GL142", "`assert` asks a term", "decides it once"),
        ("[n for n in floor if lit(n)]", (22, 6), "GL142", "`if` asks a term", "decides it once"),
        ("min(at, at + 1)", (1, 15), "GL142", "`min` asks a term for its truth", "translated function"),
        ("any(lit(n) for n in floor)", (1, 26), "GL142", "`any` asks a term", "`exists(station, lambda n: …)`"),
        ("for n in floor: n == at and print(n)", (17, 20), "GL142", "`and` asks a term", "`(…) & (…)`"),
        ("filter(None, [at]).__next__()", (1, 29), "GL142", "`__next__` asks a term", None),
        ('theory.goal("g", at in floor)', (18, 11), "GL143", "`in` answers at once", "translated function"),
        ('theory.goal("g", at in {1, 2})', (18, 12), "GL143", "`in` answers at once", "translated function"),
        ('theory.goal("g", at not in [1, 2])', (18, 16), "GL143", "`in` answers at once", "translated function"),
        ('theory.goal("g", at in ())', (18, 8), "GL143", "`in` answers at once", "translated function"),
        ('theory.goal("g", at is None)', (18, 10), "GL143", "`is` asks for one object", "write `==`;"),
        ('theory.goal("g", at is not None)', (18, 14), "GL143", "`is` asks for one object", "write `!=`;"),
        ('theory.goal("g", (at is None) & lit(1))', (19, 10), "GL143", "`is` asks for one object", "bool(at is None)"),
        ("theory.initially(lit is None)", (18, 11), "GL143", "`is` asks for one object", None),
        ('theory.goal("g", at / 2 == 1)', (18, 6), "GL143", "`/` has no meaning on terms", "`//`"),
        ('theory.goal("g", 2**at == 1)', (18, 5), "GL143", "`**` has no meaning on terms", "multiply"),
        ('theory.goal("g", lit(1) ^ lit(2))', (18, 15), "GL143", "`^` has no meaning on terms", "`!=`"),
        (
            'theory.goal("g", [5, 6][at] == 1)',
            (18, 10),
            "GL143",
            "Python asks for the number",
            "make the list a static",
        ),
        ("range(at)", (1, 9), "GL143", "Python asks for the number", "`interval(1, n)`"),
        ("int(at)", (1, 7), "GL143", "Python asks for the number", "extern"),
        ("lit[1] = True", (1, 6), "GL143", "only actions change a fluent", "`causes(f(x), value)`"),
        ('theory.goal("g", len(at) == 1)', (18, 7), "GL143", "`len` answers at once", "translated function"),
        ("for x in at: pass", (1, 17), "GL143", "go through a term", None),
        ('theory.goal("g", at == object())', (24, 8), "GL144", "type `object` means nothing", "can stand here"),
        ('theory.goal("g", lit({}))', (22, 2), "GL144", "a dictionary means nothing", "table"),
        ('theory.goal("g", lit(g=1))', (18, 8), "GL015", "no parameter `g`", "`f`"),
        ('theory.goal("g", at == float("nan"))', (24, 12), "GL144", "nan is no number", None),
        ('theory.goal("some", lit(1))', (13, 6), "GL006", "word of the language", "the_some"),
        ('theory.goal("1st", lit(1))', (13, 5), "GL143", "cannot be a name", "begin it with a letter"),
        ('theory.type("t", {"a", "b"})', (18, 10), "GL144", "no type of the language", "`enum(…)`"),
        ('theory.type("t", union())', (18, 7), "GL143", "no type to be joined", "`station | None`"),
        ('theory.type("t", optional(None))', (18, 14), "GL143", "no type to be joined", "`station | None`"),
        ('theory.type("t", location)', (18, 8), "GL141", "NameError: name 'location' is not defined", None),
        ('theory.type("t", enum("a", "b c"))', (28, 5), "GL143", "cannot be a name", "`b_c`"),
        ('theory.type("t", interval(1, 2.5 + 3j))', (30, 8), "GL144", "type `complex` means nothing", None),
        ('symbols("a", "b c")', (14, 5), "GL143", "cannot be a name", "`b_c`"),
        ('theory.fluent("f", 3, 1)', (20, 1), "GL144", "no type of the language", None),
        ('theory.fluent("f", initial=1, parameters={"n": 3})', (42, 8), "GL144", "no type of the language", None),
        ('theory.fluent("f", initial=1, parameters=["n"])', (42, 5), "GL144", "are a dictionary", '{"n": station}'),
        ('Theory("my lift")', (8, 9), "GL143", "cannot be a name", "`my_lift`"),
        ('theory.type("t", list)', (18, 4), "GL143", "needs the type of its elements", "set[station]"),
        ('theory.const("c")', (1, 17), "GL143", "a value is missing", None),
        ("test(at == 1)", (1, 13), "GL143", "`test` is not run by Python", "`@theory.proc`"),
        ("values(floor)", (1, 13), "GL143", "`values` is not run by Python", "translated function"),
        ("knows(1, 2)", (1, 11), "GL015", "wrong arguments", None),
        ("exists(floor, 1)", (1, 16), "GL143", "a function of as many variables", "lambda n"),
        ("exists(floor, lambda: 1)", (1, 24), "GL015", "0 variables for 1 type", None),
        ("at.value", (1, 8), "GL141", "a term has no attribute `value`", None),
        ('theory.include("x")', (1, 19), "GL144", "only a theory can be included", None),
        ("theory.action(3)", (1, 16), "GL143", "only a function written with `def`", None),
    ],
)
def test_what_python_cannot_mean_is_refused_at_its_place(
    wrong_with: Callable[[str], list[Diagnostic]],
    line: str,
    place: tuple[int, int],
    code: str,
    message: str,
    help_: str | None,
) -> None:
    (found,) = wrong_with(HEAD + line + "\n")

    assert found.code.code == code
    assert message in found.message
    assert (found.span.line, found.span.column, found.span.end - found.span.start) == (14, *place)
    assert (help_ or "") in (found.help or "")
