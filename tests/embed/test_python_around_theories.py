"""Python around a theory works as a Python programmer expects: loops, functions, dictionaries, files, other modules."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from golc.diagnostics import Diagnostic, Findings, Source
from golc.embed.modules import read_theory
from golc.loading import examine
from golc.syntax.parse import parse_file
from golc.syntax.unparse import unparse

Text = Callable[[str], str]
Wrong = Callable[[str], list[Diagnostic]]


def test_a_loop_declares_a_family_of_fluents_and_actions(text_of: Text) -> None:
    text = text_of(
        """
        from golc.embed import Theory, causes, poss

        theory = Theory("lamps")
        lamps = []
        for k in range(2):
            lamps.append(theory.fluent(f"lamp{k}", initial=False))

            @theory.action(name=f"toggle{k}")
            def toggle(lamp=lamps[k]):
                poss(not lamp)
                causes(lamp, True)
        theory.goal("bright", lamps[0] & lamps[1])
        """
    )

    assert text == (
        "domain lamps\n\nfluent lamp0 = false\n\naction toggle0:\n    poss not lamp0\n    causes lamp0 := true\n\n"
        "fluent lamp1 = false\n\naction toggle1:\n    poss not lamp1\n    causes lamp1 := true\n\n"
        "goal bright: lamp0 and lamp1\n"
    )


def test_a_range_with_a_step_is_a_list_in_a_program(text_of: Text) -> None:
    text = text_of(
        """
        from golc.embed import Theory

        theory = Theory("lamps")

        @theory.action
        def go(n: int):
            pass

        @theory.proc
        def control():
            for n in range(1, 6, 2):
                go(n)
            for n in range(1, 3):
                go(n)
        """
    )

    assert text.endswith("proc control:\n    for n in [1, 3, 5]:\n        go(n)\n    for n: 1..2:\n        go(n)\n")


def test_the_variable_of_a_loop_has_to_be_given(wrong_with: Wrong) -> None:
    found = wrong_with(
        """
        from golc.embed import Theory, causes

        theory = Theory("lamps")
        level = theory.fluent("level", int, 0)
        for k in range(3):

            @theory.action(name=f"set{k}")
            def set_level():
                causes(level, k)
        """
    )

    assert [(each.code.code, each.message, each.span.line, each.span.text) for each in found] == [
        ("GL145", "`k` was 0 when the function was declared and is 2 now", 10, "k"),
        ("GL145", "`k` was 1 when the function was declared and is 2 now", 10, "k"),
    ]
    assert found[0].help == "give it to the function as a default: `def set_level(…, k=k):`"


def test_a_mutable_default_is_refused(wrong_with: Wrong) -> None:
    (found,) = wrong_with(
        """
        from golc.embed import Theory, causes

        theory = Theory("lamps")
        level = theory.fluent("level", int, 0)

        @theory.action
        def raise_it(steps=[1, 2]):
            causes(level, steps[0])
        """
    )

    assert (found.code.code, found.span.text) == ("GL143", "steps")
    assert found.message == "the default of `steps` is a list, which may change after the function was declared"


def test_a_function_makes_theories_by_its_arguments(text_of: Text) -> None:
    text = text_of(
        """
        from __future__ import annotations

        from golc.embed import Theory, causes, interval, poss

        def lift(floors, name="lift"):
            made = Theory(name)
            floor = made.type("floor", interval(1, floors))
            at = made.fluent("at", floor, 1)

            @made.action
            def go(to: floor):
                poss(to != at and to <= floors - 1)
                causes(at, to)

            return made

        small, theory = lift(3), lift(9, "tower")
        """
    )

    assert text == (
        "domain tower\n\ntype floor = 1..9\n\nfluent at: floor = 1\n\n"
        "action go(to: floor):\n    poss to != at and to <= 8\n    causes at := to\n"
    )


def test_a_theory_is_built_from_a_table_of_text(text_of: Text) -> None:
    text = text_of(
        """
        import csv, io

        from golc.embed import Theory, enum

        MAP = "hall,kitchen,4\\nkitchen,garden,7\\n"
        theory = Theory("house")
        roads = [(a, b, int(d)) for a, b, d in csv.reader(io.StringIO(MAP))]
        names = sorted({place for a, b, _ in roads for place in (a, b)})
        room = theory.type("room", enum(*names))
        rooms = dict(zip(names, room))
        near = {(rooms[a], rooms[b]): d for a, b, d in roads}
        table = {(x, y): near.get((x, y), 0) for x in room for y in room}
        length = theory.static("length", int, table, parameters={"a": room, "b": room})
        at = theory.fluent("at", room, rooms["hall"])

        @theory.define
        def near_kitchen():
            return length(at, rooms["kitchen"]) > 0
        """
    )

    assert "type room = {garden, hall, kitchen}" in text
    assert "(hall, kitchen): 4" in text
    assert "(kitchen, garden): 7" in text
    assert "(garden, garden): 0" in text
    assert "fluent at: room = hall" in text
    assert "define near_kitchen := length(at, kitchen) > 0" in text


def test_plain_functions_build_terms_where_they_are_called(text_of: Text) -> None:
    text = text_of(
        """
        from golc.embed import Theory, causes, interval, poss

        def between(low, x, high):
            return (low <= x) & (x <= high)

        LIMITS = {"low": 2, "high": 5}
        theory = Theory("lift")
        floor = theory.type("floor", interval(1, 6))
        at = theory.fluent("at", floor, 3)

        @theory.action
        def go(to: floor):
            poss(between(LIMITS["low"], to, LIMITS["high"] - 1))
            causes(at, to)
        """
    )

    assert "poss 2 <= to and to <= 4" in text


def test_a_condition_of_python_chooses_a_part_of_the_program(text_of: Text) -> None:
    text = text_of(
        """
        from golc.embed import Theory, say

        LOUD, LEVELS = False, ("low", "high")
        theory = Theory("d")

        @theory.action
        def up():
            pass

        @theory.action
        def down():
            pass

        @theory.proc
        def control():
            if LOUD:
                say("beginning")
            else:
                pass
            for act in (up, down):
                act()
            for level in LEVELS:
                say(f"at {level}")
        """
    )

    assert text.endswith(
        'proc control:\n    skip\n    up\n    down\n    for level in ["low", "high"]:\n        say "at {level}"\n'
    )


def test_parts_come_from_another_module(tmp_path: Path) -> None:
    (tmp_path / "parts.py").write_text(
        "from golc.embed import Theory, causes, interval\n"
        'base = Theory("parts")\n'
        'floor = base.type("floor", interval(1, 3))\n'
        'at = base.fluent("at", floor, 1)\n'
        "@base.action\n"
        "def up():\n"
        "    causes(at, at + 1)\n"
    )
    (tmp_path / "whole.py").write_text(
        "import parts\n"
        "from golc.embed import Theory, poss\n"
        'theory = Theory("whole")\n'
        "theory.include(parts.base)\n"
        "@theory.proc\n"
        "def control():\n"
        "    if parts.at == 1:\n"
        "        parts.up()\n"
    )

    written = read_theory(tmp_path / "whole.py")

    assert written.findings.diagnostics == []
    assert unparse(written.file) == (
        "domain whole\n\ntype floor = 1..3\n\nfluent at: floor = 1\n\naction up:\n    causes at := at + 1\n\n"
        "proc control:\n    if at = 1:\n        up\n"
    )
    assert [Path(source.name).name for source in written.sources] == ["whole.py", "parts.py"]


def test_a_module_in_another_folder_imports_what_lies_beside_it(tmp_path: Path) -> None:
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "base.gl").write_text("domain base\ntype floor = 1..3\n")
    (tmp_path / "lib" / "parts.py").write_text(
        'from golc.embed import Theory\ntheory = Theory("parts")\ntheory.import_("base.gl")\n'
    )
    (tmp_path / "whole.py").write_text(
        "from golc.embed import Theory, types\nfrom lib import parts\n"
        'theory = Theory("whole")\ntheory.include(parts.theory)\n'
        'at = theory.fluent("at", types("floor"), 3)\ntheory.goal("top", at == 3)\n'
    )

    assert [finding.message for finding in examine(tmp_path / "whole.py").findings] == []


def test_a_docstring_and_an_ellipsis_say_nothing(text_of: Text) -> None:
    text = text_of(
        '''
        from golc.embed import Theory

        theory = Theory("d")

        @theory.action
        def up():
            """Goes up."""

        @theory.fluent
        def lit(f: int):
            """Whether there is light."""
            ...
        '''
    )

    assert text == "domain d\n\naction up\n\nfluent lit(f: int)\n"


@pytest.mark.parametrize(
    ("text", "code", "message", "line"),
    [
        ("theory = 1 +\n", "GL140", "Python cannot read this: invalid syntax", 1),
        ("x = 1\n\n1 / 0\n", "GL141", "ZeroDivisionError: division by zero", 3),
        ("import nothing_such\n", "GL141", "No module named 'nothing_such'", 1),
        ("x = 1\n", "GL146", "the file makes no theory", 1),
        ("raise SystemExit(3)\n", "GL141", "SystemExit", 1),
        ("\n", "GL146", "the file makes no theory", 1),
        ("def f():\n    return f()\n\n\nf()\n", "GL141", "RecursionError", 2),
        (
            "from golc.embed import Theory\na, b = Theory('a'), Theory('b')\n",
            "GL146",
            "the file makes several theories: `a`, `b`",
            1,
        ),
    ],
)
def test_a_file_that_python_cannot_run_is_one_finding(
    wrong_with: Wrong, text: str, code: str, message: str, line: int
) -> None:
    (found,) = wrong_with(text)

    assert (found.code.code, found.span.line) == (code, line)
    assert message in found.message


@pytest.mark.parametrize(("count", "places"), [(499, []), (500, [("GL008", 8)])])
def test_nesting_is_as_deep_as_in_a_text(wrong_with: Wrong, count: int, places: list[tuple[str, int]]) -> None:
    found = wrong_with(
        f"""
        from golc.embed import Theory

        theory = Theory("d")
        total = theory.fluent("level", int, 0)
        for k in range({count}):
            total = total + 1
        theory.goal("g", total == 1)
        """
    )
    findings = Findings()
    parse_file(Source("d.gl", f"domain d\nfluent level: int = 0\ngoal g: level{' + 1' * count} = 1\n"), findings)

    assert [(each.code.code, each.span.line) for each in found] == places
    assert [each.code.code for each in findings.diagnostics] == [code for code, _ in places]


def test_a_failure_in_a_called_function_shows_both_places(wrong_with: Wrong) -> None:
    (found,) = wrong_with(
        """
        from golc.embed import Theory

        def broken(x):
            return {}[x]

        theory = Theory("d")
        theory.fluent("f", int, broken(3))
        """
    )

    assert (found.code.code, found.span.line) == ("GL141", 5)
    assert [(label.span.line, label.text) for label in found.labels] == [(8, "called here")]


def test_the_values_of_a_type_can_be_kept_in_lists_and_counted(text_of: Text) -> None:
    text = text_of(
        """
        from golc.embed import Theory, enum, interval

        theory = Theory("blocks")
        block = theory.type("block", enum("a", "b", "c"))
        blocks = list(block)
        theory.const("how_many", len(block) + len(tuple(theory.type("row", interval(1, 4)))))
        theory.fluent("above", block, blocks[-1])
        """
    )

    assert text == (
        "domain blocks\n\ntype block = {a, b, c}\ntype row = 1..4\n\nconst how_many = 7\n\nfluent above: block = c\n"
    )


def test_a_star_spreads_a_list_of_python(text_of: Text) -> None:
    text = text_of(
        """
        from __future__ import annotations
        from golc.embed import Theory, causes, enum, interval

        theory = Theory("d")
        NAMES = ["Bonn", "Essen"]
        floor = theory.type("floor", interval(1, 6))
        at = theory.fluent("at", floor, 1)
        ARGS = (2, 3)

        @theory.fluent
        def seen(t: enum(*NAMES)):
            return False

        @theory.action
        def go(n: floor, m: floor):
            causes(at, max(m, *ARGS))

        @theory.proc
        def control():
            go(*ARGS)
            for n in [1, *ARGS]:
                go(n, n)

        @theory.define
        def d():
            return at in {*ARGS, 6}
        """
    )

    assert "fluent seen(t: {Bonn, Essen}) = false\n" in text
    assert "causes at := max(m, 2, 3)\n" in text
    assert "    go(2, 3)\n    for n in [1, 2, 3]:\n" in text
    assert "define d := at in {2, 3, 6}\n" in text


def test_any_mapping_of_python_is_a_table(text_of: Text) -> None:
    text = text_of(
        """
        from types import MappingProxyType
        from golc.embed import Theory, interval

        theory = Theory("d")
        floor = theory.type("floor", interval(1, 2))
        theory.static("size", int, MappingProxyType({1: 5, 2: 7}), parameters={"n": floor})
        """
    )

    assert text.endswith("static size(n: floor): int = {1: 5, 2: 7}\n")


def test_a_loop_through_pairs_is_written_out(text_of: Text) -> None:
    text = text_of(
        """
        from __future__ import annotations
        from golc.embed import Theory, causes, interval

        theory = Theory("d")
        floor = theory.type("floor", interval(-6, 6))
        at = theory.fluent("at", floor, 1)

        @theory.action
        def go(n: floor, m: floor):
            causes(at, max(n, m))

        @theory.proc
        def control():
            for n, m in [(-1, 2), (at, 4)]:
                go(n, m)
            for n in floor:
                for m, _ in ((n, [1, "x"]), (3, None)):
                    go(n, m)
        """
    )

    assert text.endswith(
        "proc control:\n    go(-1, 2)\n    go(at, 4)\n    for n: floor:\n        go(n, n)\n        go(n, 3)\n"
    )


def test_a_list_with_terms_may_be_another_one_when_a_function_is_translated(wrong_with: Wrong) -> None:
    (found,) = wrong_with(
        """
        from golc.embed import Theory

        theory = Theory("d")
        for name in ("red", "green"):
            pair = (theory.fluent(name, int, 0), name)

            @theory.goal(name=name + "_is_on")
            def on():
                return pair[0] == 1
        """
    )

    assert found.message == ("`pair` was (red, 'red') when the function was declared and is (green, 'green') now")


def test_python_may_compare_symbols(text_of: Text) -> None:
    text = text_of(
        """
        from golc.embed import Theory, enum, symbols

        theory = Theory("d")
        colour = theory.type("colour", enum("red", "green", "blue"))
        pairs = [f"{a}_{b}" for a in colour for b in colour if a != b]
        left = [each for each in colour if each == colour.green or each in (colour.red,)]
        where = list(colour).index(colour.blue)
        by_name = {symbols("red"): 5}[colour.red]
        theory.const("how_many", len(pairs) + len(left) * 10 + where * 100 + by_name * 1000)
        theory.goal("g", colour.red == colour.red)
        """
    )

    assert text == "domain d\n\ntype colour = {red, green, blue}\n\nconst how_many = 5226\n\ngoal g: red = red\n"


TOWNS = """
from golc.embed import Theory, causes, enum, poss

theory = Theory("roads")
town = theory.type("town", enum("Bonn", "Essen"))
at = theory.fluent("at", town, town.Bonn)
"""


@pytest.mark.parametrize(
    ("line", "message", "place", "help_"),
    [
        (
            'theory.static("far", int, {"Bonn": 1, "Essen": 2}, parameters={"t": town})',
            "the table has the string 'Bonn' where `town` has symbols",
            '{"Bonn": 1, "Essen": 2}',
            "`symbol = {str(each): each for each in town}` finds them: `symbol['Bonn']`",
        ),
        (
            'theory.static("next", town, {t: "Bon" for t in town}, parameters={"t": town})',
            "the table has the string 'Bon' where `town` has symbols",
            '{t: "Bon" for t in town}',
            "`symbol = {str(each): each for each in town}` finds them: `symbol['Bonn']`",
        ),
        (
            'theory.fluent("to", town, initial={town.Bonn: town.Essen})',
            "a dictionary means nothing in a theory",
            "{town.Bonn: town.Essen}",
            "a table is the value of a static: `start = theory.static(…)`; a term can use it: `start(x)`",
        ),
        (
            'theory.type("town", enum("Bad Godesberg"))',
            "`Bad Godesberg` cannot be a name",
            '"Bad Godesberg"',
            "begin it with a letter and go on with letters (without accents), digits and `_`, as in `Bad_Godesberg`",
        ),
    ],
)
def test_a_table_from_a_file_is_told_what_is_missing(
    wrong_with: Wrong, line: str, message: str, place: str, help_: str
) -> None:
    found = wrong_with(TOWNS + line + "\n")

    assert [(each.message, each.span.text, each.help) for each in found] == [(message, place, help_)]


@pytest.mark.parametrize(
    ("text", "help_"),
    [
        ("from golc.embed import Theory, intervall", "did you mean `interval`?"),
        ("from golc.embed import Theory, abs_", "Python's own `abs` has a meaning in a theory"),
        ("from golc.embed import Theory, turtle", None),
        ("import golc_turtle", "install it where golc runs, or put it beside this file"),
        (
            'open("theory.py")',
            '`Path(__file__).with_name("theory.py")` is the file beside this one, wherever golc is run',
        ),
        ('open("nowhere.csv")', None),
        ("from golc.embed import Theory\ninterval(1, 6)", "import it: `from golc.embed import interval`"),
        ("stations = 3\nstation", "did you mean `stations`?"),
        ("import math\nmath.flor(1)", "did you mean `floor`?"),
        (
            "from golc.embed import Theory\nt = Theory('t')\n{1: 2}[t.fluent('at', int, 1)]",
            "a term has no value yet: make the dictionary a static, whose value is a table",
        ),
        ("from golc.embed import Theory\nt = Theory('t')\nt.flunt('at', int, 1)", "did you mean `fluent`?"),
        ("from golc.embed import Theory\nt = Theory('t')\nt.fluent('at', int, inital=1)", "did you mean `initial`?"),
        (
            "from golc.embed import Theory\nt = Theory('t')\nt.fluent('at', int, 1, 2)",
            "it takes `type`, `initial`, `name=`, `parameters=`",
        ),
        (
            "from golc.embed import Theory\nt = Theory('t')\n@t.extern\ndef f() -> int: ...",
            "write `theory.extern(file=…)`",
        ),
        ("from golc.embed import Theory, interval\ninterval(1)", "it takes `low`, `high`"),
        ("def interval(low, high):\n    pass\n\n\ninterval(1)", None),
        ("from golc.embed import Theory\nTheory()", "it takes `domain`"),
        ("from golc.embed import enum\nenum(['a', 'b'])", "write `enum(*names)` for all that a list has"),
        (
            "from golc.embed import Theory\ndef lifts(n):\n    return Theory('lifts')",
            "call the function that makes it where every import runs it: `theory = delivery(6)`",
        ),
        (
            "from golc.embed import symbols\nred, green = symbols('red', 'green')",
            'begin it with `from golc.embed import Theory` and `theory = Theory("delivery")`',
        ),
    ],
)
def test_what_helps_where_a_file_fails(wrong_with: Wrong, text: str, help_: str | None) -> None:
    (found,) = wrong_with(text + "\n")

    assert found.help == help_
