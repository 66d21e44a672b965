"""Python that could be read as something else than it says is refused at its place, or keeps its meaning."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from golc.diagnostics import Code, Diagnostic
from golc.embed.modules import read_theory
from golc.loading import examine
from golc.syntax.tree import IntervalType
from golc.syntax.unparse import unparse
from golc.syntax.walk import descendants

Text = Callable[[str], str]
Wrong = Callable[[str], list[Diagnostic]]

THEORY = """from __future__ import annotations
from golc.embed import Theory, enum, exists, interval, say

theory = Theory("lamps")
room = theory.type("room", enum("hall", "attic"))
hall, attic = room
at = theory.fluent("at", room, hall)
power = theory.fluent("power", int, 0)


@theory.fluent
def light(r: room) -> int:
    return 0


"""


def _in_define(body: str, parameters: str = "") -> str:
    return f"@theory.define\ndef d({parameters}):\n    return {body}\n"


@pytest.mark.parametrize(
    ("code", "place", "message"),
    [
        pytest.param(
            'here = theory.fluent("spot", room, hall)\n' + _in_define("here == spot", "spot: room"),
            "here",
            "what is `spot` in the theory cannot be meant where a variable has this name",
            id="a handle whose name in the theory is that of a parameter",
        ),
        pytest.param(
            "def like(x):\n    return exists(room, lambda r: light(r) == light(x))\n"
            + _in_define("like(r)", "r: room"),
            "exists(room, lambda r: light(r) == light(x))",
            "another `r` cannot be meant where a variable has this name",
            id="the variable of a lambda around another one with its name",
        ),
        pytest.param(
            'HERE = at == hall\ntheory.goal("g", exists(room, lambda at: (light(at) == 1) & HERE))\n',
            "exists(room, lambda at: (light(at) == 1) & HERE)",
            "another `at` cannot be meant where a variable has this name",
            id="a fluent under a lambda variable with its name",
        ),
        pytest.param(
            "SIZES = {hall: 1}\n" + _in_define("power == SIZES.get(r, 0)", "r: room"),
            "SIZES.get(r, 0)",
            "Python looks a term up at once, before there is a situation",
            id="the value of a dictionary for a variable",
        ),
        pytest.param(
            "SIZES = {hall: 1}\n" + _in_define("power == SIZES.get(at, 0)"),
            "SIZES.get(at, 0)",
            "Python looks a term up at once, before there is a situation",
            id="the value of a dictionary for a fluent",
        ),
        pytest.param(
            "DARK = {hall}\ndef size(r):\n    return 1 if r in DARK else 2\n"
            + _in_define("power == size(r)", "r: room"),
            "r in DARK",
            "Python looks a term up at once, before there is a situation",
            id="a set of Python asked for a variable by a function of Python",
        ),
        pytest.param(
            'def label(r):\n    return f"in {r}"\n@theory.proc\ndef p(r: room):\n    say(label(r))\n',
            'f"in {r}"',
            "Python writes a term at once, before there is a situation",
            id="a variable written into a string by a function of Python",
        ),
        pytest.param(
            _in_define("min((light(r) for r in room), default=7) == 3"),
            "default=7",
            "`min` takes no `default=`",
            id="the default of a minimum",
        ),
        pytest.param(
            _in_define("sum((light(r) for r in room), start=7) == 3"),
            "start=7",
            "`sum` takes no `start=`",
            id="the start of a sum",
        ),
        pytest.param(
            _in_define("any(x == z for x in room if x == y for y in room for z in room)", "y: room"),
            "y",
            "`y` means something else in the `if` before",
            id="a condition before the variable that hides its own",
        ),
    ],
)
def test_it_is_refused(wrong_with: Wrong, code: str, place: str, message: str) -> None:
    (found,) = wrong_with(THEORY + code)

    assert (found.span.text, found.message) == (place, message)


def test_a_loop_of_python_hides_a_parameter_with_its_name(text_of: Text) -> None:
    text = text_of(
        THEORY
        + 'PAIRS = (("a", hall), ("b", attic))\n'
        + '@theory.proc\ndef p(r: room):\n    for _, r in PAIRS:\n        say(f"{r}")\n'
    )

    assert text.endswith('proc p(r: room):\n    say "{hall}"\n    say "{attic}"\n')


def test_the_order_of_a_set_of_python_is_the_same_each_time(text_of: Text) -> None:
    text = text_of(
        THEORY
        + "S = {(hall, 2), (hall, 1), (attic, 3)}\n"
        + '@theory.proc\ndef p():\n    for r, n in S:\n        say(f"{r} {n}")\n'
    )

    assert text.endswith('    say "{attic} {3}"\n    say "{hall} {1}"\n    say "{hall} {2}"\n')


def test_a_loop_through_a_set_of_values_is_one_of_the_language(text_of: Text) -> None:
    text = text_of(THEORY + 'S = {2, 1}\n@theory.proc\ndef p():\n    for n in S:\n        say(f"{n}")\n')

    assert text.endswith('    for n in {1, 2}:\n        say "{n}"\n')


@pytest.mark.parametrize(
    ("code", "place", "message"),
    [
        ("import sys\ndef stop():\n    sys.exit(3)\n" + _in_define("power == stop()"), "stop()", "SystemExit: 3"),
        (
            'error = ValueError("one\\ntwo")\nerror.add_note("three")\nraise error\n',
            "raise error",
            "ValueError: one two",
        ),
    ],
)
def test_what_python_raises_is_said_in_one_line(wrong_with: Wrong, code: str, place: str, message: str) -> None:
    (found,) = wrong_with(THEORY + code)

    assert (found.span.text, found.message) == (place, f"Python fails here with {message}")


@pytest.mark.parametrize(
    ("code", "place", "message"),
    [
        ("N = 3\n" + _in_define("(yield N)"), "yield N", "`yield` has no meaning in a theory"),
        ("ARGS = {hall}\n" + _in_define("light(*ARGS)"), "*ARGS", "`*` spreads only lists of Python"),
        (_in_define("light(*at)"), "*at", "`*` spreads only lists of Python"),
        ("x = theory.import_(3)\n", "3", "a Python value of type `int` is no path of a file"),
        (
            "@theory.device('host', file=3)\ndef d():\n    pass\n",
            "3",
            "a Python value of type `int` is no path of a file",
        ),
        ("N = 10**5000\n" + _in_define("power == N"), "N", "a number of so many digits is too long: the limit is 4000"),
        (
            _in_define("power == 1e9999999"),
            "1e9999999",
            "a number of so many digits is too long: the limit is 4000",
        ),
        (
            "from unittest.mock import Mock\nM = Mock()\n" + _in_define("power == M"),
            "M",
            "a Python value of type `Mock` means nothing in a theory",
        ),
        (
            "@theory.define\ndef ℌ():\n    return motion\n",
            "motion",
            "`motion` is neither a Python constant nor declared",
        ),
        (
            "class Odd:\n    def __repr__(self):\n        return self.no\nodd = Odd()\n"
            + _in_define("odd")
            + "odd = 1\n",
            "odd",
            "`odd` was <Odd instance> when the function was declared and is 1 now",
        ),
        (
            "class Odd:\n    pass\nodd = Odd()\n" + _in_define("odd") + "odd = Odd()\n",
            "odd",
            "`odd` was <golc_theory_theory.Odd object> when the function was declared and is another now",
        ),
        (
            'huge = theory.type("huge", interval(0, 10**12))\n' + _in_define("huge.top"),
            "huge.top",
            "the type `huge` has no symbol `top`",
        ),
    ],
)
def test_odd_python_is_said_at_its_place(wrong_with: Wrong, code: str, place: str, message: str) -> None:
    (found,) = wrong_with(THEORY + code)

    assert (found.span.text, found.message) == (place, message)


def test_two_theories_have_each_their_own_module_beside_them(tmp_path: Path) -> None:
    goals = []
    for name, number in (("a", 1), ("b", 2)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "sizes_beside.py").write_text(f"SIZE = {number}\n", encoding="utf-8")
        path = tmp_path / name / "t.py"
        path.write_text(THEORY + 'from sizes_beside import SIZE\ntheory.goal("g", power == SIZE)\n', encoding="utf-8")
        goals.append(unparse(read_theory(path).file).splitlines()[-1])

    assert goals == ["goal g: power = 1", "goal g: power = 2"]
    assert "sizes_beside" not in sys.modules


def test_a_function_may_import_and_print_while_others_are_translated(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "sizes_late.py").write_text("SIZE = 1\n", encoding="utf-8")
    late = "def size():\n    import sizes_late\n    print('late')\n    return sizes_late.SIZE\n"
    path = tmp_path / "t.py"
    path.write_text(THEORY + late + _in_define("power == size()"), encoding="utf-8")

    assert read_theory(path).findings.diagnostics == []
    assert capsys.readouterr().out == ""


def test_a_file_may_change_the_path_of_python(text_of: Text) -> None:
    path = list(sys.path)
    text_of(THEORY + "import sys\nsys.path.clear()\n")

    assert sys.path == path


def test_the_body_of_a_function_does_not_see_the_names_of_the_class_around_it(text_of: Text) -> None:
    text = text_of(
        THEORY + "N = 1\nclass Lamps:\n    N = 2\n    @theory.define\n    def d():\n        return power == N\n"
    )

    assert text.endswith("define d := power = 1\n")


@pytest.mark.parametrize(
    ("code", "place", "message"),
    [
        (
            "import json\ntheory.define(json.dumps)\n",
            "theory.define(json.dumps)",
            "only a function written with `def` can be translated",
        ),
        ("@theory.device\ndef d():\n    pass\n", "theory.device", "a device needs its kind"),
        ("@theory.axiom\ndef light(r):\n    pass\n", "theory.axiom", "an axiom needs its fluent"),
        (
            '@theory.action("fly")\ndef fly():\n    pass\n',
            'theory.action("fly")',
            "the name of what is declared is that of its function, or given by `name=`",
        ),
        (
            "@theory.fluent(initial=3)\ndef f(r: room) -> int: ...\n",
            "3",
            "`initial` is what the function says",
        ),
        (
            "@theory.static(type=int, parameters={'r': room})\ndef s(r):\n    return 3\n",
            "int",
            "`type` is what the function says",
        ),
        ("@theory.const(value=2)\ndef c():\n    return 3\n", "2", "`value` is what the function says"),
        ('theory.fluent("f", int, 1, name="g")\n', '"g"', "this has its name already"),
        ("@theory.axiom(3)\ndef a():\n    pass\n", "theory.axiom(3)", "a Python value of type `int` cannot be a name"),
    ],
)
def test_a_decorator_says_what_it_cannot_take(wrong_with: Wrong, code: str, place: str, message: str) -> None:
    (found,) = wrong_with(THEORY + code)

    assert (found.span.text, found.message) == (place, message)


@pytest.mark.parametrize(
    "code",
    [
        'theory.goal("g")',
        'theory.fluent(name="f")',
        "theory.action()",
        'theory.device("rcx")',
        'theory.axiom("at")',
        "theory.type()",
    ],
)
def test_a_decorator_of_nothing_is_a_mistake(wrong_with: Wrong, code: str) -> None:
    (found,) = wrong_with(THEORY + code + "\n")

    assert (found.span.text, found.message) == (code, "this declares nothing")


@pytest.mark.parametrize(
    ("code", "place", "message"),
    [
        (
            "import itertools\n@theory.proc\ndef p():\n    for n in itertools.count():\n        say('x')\n",
            "itertools.count()",
            "this has more than 100000 elements, which would all be written out",
        ),
        (
            _in_define("power in range(10**30)"),
            "range(10**30)",
            "this has more than 100000 elements, which would all be written out",
        ),
        (
            "PAIRS = zip([hall], [1])\n@theory.proc\ndef p():\n    for r, n in PAIRS:\n        say(f'{r}')\n",
            "PAIRS",
            "this can be gone through only once",
        ),
        (
            "@theory.type\ndef storey():\n    return interval(0, 3)\n" + _in_define("power == storey.top"),
            "storey.top",
            "the values of `storey` cannot be listed here",
        ),
    ],
)
def test_what_has_no_end_or_no_values_is_said_at_its_place(
    wrong_with: Wrong, code: str, place: str, message: str
) -> None:
    (found,) = wrong_with(THEORY + code)

    assert (found.span.text, found.message) == (place, message)


def test_the_answer_of_python_to_a_question_about_its_objects_is_a_value(text_of: Text) -> None:
    text = text_of(
        THEORY
        + """
def lamp(name, start, switch=None):
    theory.fluent(name, initial=start in ("on", "bright"))
    theory.fluent(name + "_by_hand", initial=switch is None)

lamp("lamp", "on", None)
theory.fluent("named", initial=bool(at is not None))
"""
    )

    assert text.endswith("fluent lamp = true\nfluent lamp_by_hand = true\nfluent named = true\n")


def test_one_line_of_python_that_makes_many_mistakes_is_one_finding(tmp_path: Path) -> None:
    path = tmp_path / "t.py"
    sizes = 'theory.static("size", int, {r: 0.5 for r in room}, parameters={"r": room})\n'
    path.write_text(THEORY + sizes, encoding="utf-8")
    (found,) = (each for each in examine(path).findings if each.code is Code.TYPE_MISMATCH)

    assert found.span.text == "{r: 0.5 for r in room}"


def test_a_large_real_is_written_in_full(text_of: Text) -> None:
    assert text_of(THEORY + _in_define("power == 1e40")).endswith(f"define d := power = 1{'0' * 40}.0\n")


def test_an_encoding_that_python_does_not_know_is_its_own_mistake(wrong_with: Wrong) -> None:
    (found,) = wrong_with("# -*- coding: nonsense -*-\n" + THEORY)

    assert found.message == "Python cannot read this: unknown encoding: nonsense"


def test_the_bounds_of_a_range_stand_where_it_is_written(tmp_path: Path) -> None:
    path = tmp_path / "t.py"
    path.write_text(THEORY + "N = 0\n" + _in_define("any(light(hall) == n for n in range(N))"), encoding="utf-8")
    spans = [each.span for each in descendants(read_theory(path).file) if isinstance(each, IntervalType)]

    assert [span.text for span in spans] == ["range(N)"]


def test_a_file_may_go_into_another_folder(text_of: Text, tmp_path: Path) -> None:
    here = Path.cwd()
    text_of(THEORY + f"import os\nos.chdir({str(tmp_path)!r})\n")

    assert Path.cwd() == here


@pytest.mark.parametrize(
    ("condition", "help_"),
    [
        ("power", "compare it: `power == …`"),
        ("not 3", "a truth value is `True` or `False`"),
        ("not {at}", "compare it: `{at} != set()`; ask: `x in {at}`; `+` joins it with another"),
        ("sum(light(r) == 1 for r in room) == 2", "`count(φ for n in station)` is how often something is true"),
    ],
)
def test_help_with_types_speaks_python(tmp_path: Path, condition: str, help_: str) -> None:
    path = tmp_path / "t.py"
    path.write_text(THEORY + _in_define(f"{condition} and at == hall"), encoding="utf-8")

    assert [each.help for each in examine(path).findings if each.code is Code.TYPE_MISMATCH] == [help_]
