"""Trees as Python: every file of the project, how it is laid out, and what takes thought."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from textwrap import dedent

import pytest

from golc import embed
from golc.cli import invoke
from golc.diagnostics import Findings, Source, UserError
from golc.embed.modules import read_theory
from golc.embed.printing import python_text
from golc.loading import examine
from golc.syntax import tree as ast
from golc.syntax.parse import parse_file
from golc.syntax.python_names import WORDS, golc_name, python_name
from golc.syntax.text import read_source

ROOT = Path(__file__).parents[2]
WRONG = ("knowledge.gl", "names.gl", "types.gl")
"""Files whose mistakes Python cannot repeat: functions with two arguments, two parameters with one name."""
FILES = [
    path
    for path in sorted([*(ROOT / "examples").glob("*/*.gl"), *(ROOT / "tests/programs").glob("*.gl")])
    if path.name not in WRONG
]

Printed = Callable[[str], str]


def test_no_word_of_the_package_becomes_another_name() -> None:
    assert set(embed.__all__) == WORDS
    assert {golc_name(python_name(word)) for word in WORDS} == WORDS
    assert not WORDS.intersection(map(python_name, WORDS))


def parsed(source: Source) -> ast.File:
    file = parse_file(source, Findings())
    assert file is not None
    return file


@pytest.fixture
def printed(tmp_path: Path) -> Printed:
    """What declarations become in Python, without what stands above them; it has been read as the same tree."""

    def of(text: str) -> str:
        file = parsed(Source("d.gl", f"domain d\n{dedent(text)}"))
        path = tmp_path / "d.py"
        path.write_text(python_text(file), encoding="utf-8")
        written = read_theory(path)
        assert [finding.message for finding in written.findings.diagnostics] == []
        assert written.file == file
        return path.read_text(encoding="utf-8").partition('theory = Theory("d")\n')[2].strip("\n") + "\n"

    return of


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_file_of_the_project_is_read_as_itself(path: Path, tmp_path: Path) -> None:
    file = parsed(read_source(path))
    python = tmp_path / "theory.py"
    python.write_text(python_text(file), encoding="utf-8")

    assert read_theory(python).file == file


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_the_findings_and_the_theory_are_the_same(path: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(path.parent, tmp_path / "files", ignore=shutil.ignore_patterns("build")))
    (folder / "converted.py").write_text(python_text(parsed(read_source(path))), encoding="utf-8")
    before, after = (examine(folder / name) for name in (path.name, "converted.py"))

    assert sorted(each.code.code for each in after.findings) == sorted(each.code.code for each in before.findings)
    if before.theory is not None and after.theory is not None:
        assert replace(after.theory, source=before.theory.source) == before.theory
    assert (after.theory is None) == (before.theory is None)


BRICKS = [path for path in (ROOT / "examples").glob("*/*.gl") if "\ndevice rcx" in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("path", BRICKS, ids=lambda path: path.stem)
def test_the_nqc_is_the_same(path: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(path.parent, tmp_path / "files", ignore=shutil.ignore_patterns("build")))
    (folder / f"{path.stem}.py").write_text(python_text(parsed(read_source(path))), encoding="utf-8")
    programs = []
    for suffix in ("gl", "py"):
        out = tmp_path / suffix
        assert invoke(["gen-nqc", "-q", str(folder / f"{path.stem}.{suffix}"), "-o", str(out)]) == 0
        texts = {each.name: each.read_text(encoding="utf-8") for each in out.glob("*.nq[ch]")}
        programs.append({name: re.sub(rf"{path.stem}\.(gl|py)|sealed.*", "", text) for name, text in texts.items()})

    assert programs[0] == programs[1]
    assert programs[0]


FENCE = re.compile(r"^```golc.*\n((?:.*\n)*?)```$", re.MULTILINE)


def test_the_domains_of_the_manual_are_read_as_themselves(tmp_path: Path) -> None:
    pages = [*(ROOT / "docs").rglob("*.md"), *(ROOT / "golc" / "codes").glob("*.md"), ROOT / "README.md"]
    texts = [text for page in pages for text in FENCE.findall(page.read_text(encoding="utf-8")) if "domain " in text]
    for number, text in enumerate(texts):
        findings = Findings()
        file = parse_file(Source("manual", text), findings)
        if file is not None and not findings.has_errors:
            path = tmp_path / f"theory{number}.py"
            path.write_text(python_text(file), encoding="utf-8")
            assert read_theory(path).file == file

    assert len(texts) > 100


def test_ruff_would_not_lay_it_out_otherwise(tmp_path: Path) -> None:
    for path in FILES:
        (tmp_path / f"{path.stem}.py").write_text(python_text(parsed(read_source(path))), encoding="utf-8")
    ruff = [sys.executable, "-m", "ruff", "format", "--isolated", "--line-length", "120", "--diff", str(tmp_path)]
    found = subprocess.run(ruff, capture_output=True, text=True, check=False)

    assert found.stdout == ""
    assert found.returncode == 0


def test_what_python_may_compute_is_a_call(printed: Printed) -> None:
    assert printed("const a = 2\nconst b = 3 * a - 1\nfluent f: 0..b = -a\nfluent l: list[int]? = [1, a]\n") == dedent(
        """
        a = theory.const("a", 2)
        b = theory.const("b", 3 * a - 1)

        f = theory.fluent("f", interval(0, b), -a)
        l = theory.fluent("l", list[int] | None, [1, a])
        """
    ).lstrip("\n")


@pytest.mark.parametrize(
    "declaration",
    [
        "const a = 2 * 3",
        "const a = - -1",
        "const a = -0",
        "const a = 0.1000000000000000000001",
        "const a = b",
        "const a = 2 + 3 + b",
        "const a = {2, 1}",
        "const a = true and false",
        "fluent a: b = 1",
        "fluent a: int = one of {2, 1}",
        "fluent a: int + int = 1",
        "type a = 1..b",
        "type a = 1..(2 + 3)",
    ],
)
def test_what_python_may_not_compute_is_a_function(declaration: str, printed: Printed) -> None:
    later = "type b = 1..3" if "a: b" in declaration else "const b = 1"
    word = declaration.split()[0]

    assert f"@theory.{word}\ndef a()" in printed(f"{declaration}\n{later}\n")


def test_symbols_are_unpacked_where_they_are_declared(printed: Printed) -> None:
    text = """
        type phase = {moving, stopped}
        type idle = {never, named}
        type only = {one_symbol}
        type place = phase + {table}
        fluent gate: {open, closed} = open
        fluent motion: phase = moving
        fluent on_it: place = table
        fluent it: only = one_symbol
        """

    assert printed(text) == dedent(
        """
        phase = theory.type("phase", enum("moving", "stopped"))
        moving, stopped = phase
        idle = theory.type("idle", enum("never", "named"))
        only = theory.type("only", enum("one_symbol"))
        (one_symbol,) = only
        place = theory.type("place", phase | enum("table"))
        table = symbols("table")

        open, closed = symbols("open", "closed")
        gate = theory.fluent("gate", enum(open, closed), open)
        motion = theory.fluent("motion", phase, moving)
        on_it = theory.fluent("on_it", place, table)
        it = theory.fluent("it", only, one_symbol)
        """
    ).lstrip("\n")


def test_names_that_python_needs_get_an_underscore(printed: Printed) -> None:
    text = """
        fluent class(def: bool) = def
        fluent theory = true
        fluent class_ = true
        action run:
            poss class(theory)
        """

    assert printed(text) == dedent(
        """
        @theory.fluent
        def class_(def_: bool):
            return def_


        theory_ = theory.fluent("theory", initial=True)
        class__ = theory.fluent("class_", initial=True)


        @theory.action
        def run_():
            poss(class_(theory_))
        """
    ).lstrip("\n")


def test_one_name_for_two_things_is_told_apart(printed: Printed) -> None:
    text = """
        fluent door = false
        action door:
            causes door := not door
        goal open: door
        proc control:
            door
        scenario open:
            expect door
        """

    assert printed(text) == dedent(
        """
        door = theory.fluent("door", initial=False)


        @theory.action(name="door")
        def door_action():
            causes(door, not door)


        @theory.goal
        def open():
            return door


        @theory.proc
        def control():
            door_action()


        @theory.scenario(name="open")
        def open_scenario():
            expect(door)
        """
    ).lstrip("\n")


def test_a_variable_does_not_hide_what_its_function_needs(printed: Printed) -> None:
    text = """
        type floor = 1..3
        fluent at: floor = 1
        action go(floor: floor):
            poss floor in floor and exists n: floor. n = floor
            causes at := floor
        proc control(go: floor):
            go(go)
        """

    assert printed(text) == dedent(
        """
        floor_type = theory.type("floor", interval(1, 3))

        at = theory.fluent("at", floor_type, 1)


        @theory.action(name="go")
        def go_action(floor: floor_type):
            poss(floor in floor and any(n == floor for n in floor_type))
            causes(at, floor)


        @theory.proc
        def control(go: floor_type):
            go_action(go)
        """
    ).lstrip("\n")


def test_effects_for_the_same_variables_share_a_loop(printed: Printed) -> None:
    text = """
        fluent lit(n: 1..3) = false
        fluent hot(n: 1..3) = false
        action all_on:
            causes forall n: 1..3. lit(n) := true
            causes forall n: 1..3. hot(n) := true when lit(n)
            causes forall n: 1..3 where n > 1. hot(n) := false
        """

    assert "\n".join(printed(text).splitlines()[-7:]) == dedent(
        """
        @theory.action
        def all_on():
            for n in interval(1, 3):
                causes(lit(n), True)
                causes(hot(n), True, when=lit(n))
            for n in each(interval(1, 3), where=n > 1):
                causes(hot(n), False)
        """
    ).strip("\n")


def test_else_if_stays_apart_from_elif(printed: Printed) -> None:
    text = """
        fluent a = true
        proc p:
            if a:
                skip
            elif a:
                skip
            else:
                if a:
                    skip
        """

    assert printed(text).endswith(
        "    if a:\n        pass\n    elif a:\n        pass\n    else:\n        if a:\n            pass\n"
    )


@pytest.mark.parametrize(
    ("golc", "python"),
    [
        ("a and b and c", "a and b and c"),
        ("a and (b and c)", "a and (b and c)"),
        ("(a = b) = c", "(a == b) == c"),
        ("a in {b} and not a in [b]", "a in {b} and not a in [b]"),
        ("(not a) = b", "(not a) == b"),
        ("a implies b implies c", "implies(a, implies(b, c))"),
        ("(a iff b) or c", "iff(a, b) or c"),
        ("(1 if a else 2) + -(3 - (4 - 5)) > 0", "(1 if a else 2) + -(3 - (4 - 5)) > 0"),
        ("a if b else b if c else a", "a if b else b if c else a"),
        ("(a if b else c) if c else a", "(a if b else c) if c else a"),
        ("exists x: bool, y in {a, b} where x or y. x = y", "any(x == y for x in bool for y in {a, b} if x or y)"),
        ("exists x: bool where (a if x else b). x", "any(x for x in bool if (a if x else b))"),
        ("exists x in ({a} if a else {b}). x", "any(x for x in ({a} if a else {b}))"),
        ("forall x in bool. exists y: {1, -1}. y > 0", "all(any(y > 0 for y in enum(1, -1)) for x in values(bool))"),
        ("0 < (count x: bool. x) and a", "0 < count(x for x in bool) and a"),
        ("1 in {n + 1 for n: 1..3} + {}", "1 in {n + 1 for n in interval(1, 3)} + set()"),
        ("2 not in 1..3 and [a][0]", "2 not in interval(1, 3) and [a][0]"),
        ("min(1, 2) = max x: 1..2. x", "min(1, 2) == max(x for x in interval(1, 2))"),
    ],
)  # fmt: skip
def test_parentheses_stand_where_python_needs_them(golc: str, python: str, printed: Printed) -> None:
    text = f"fluent a = true\nfluent b = true\nfluent c = true\ngoal g: {golc}\n"

    assert printed(text).splitlines()[-1] == f"    return {python}"


@pytest.mark.parametrize(
    ("message", "python"),
    [
        (r'"at {f + 1}!"', 'f"at {f + 1}!"'),
        (r'"{ {1} } and {{f}}"', 'f"{ {1} } and {{f}}"'),
        (r'"{{plain}}"', '"{plain}"'),
        (r'"\"yes\" it\'s"', "'\"yes\" it\\'s'"),
        (r'"a\\b\tc"', r'"a\\b\tc"'),
        ('""', '""'),
    ],
)
def test_messages_are_strings(message: str, python: str, printed: Printed) -> None:
    text = printed(f"fluent f: int = 1\nproc p:\n    say {message}\n")

    assert text.splitlines()[-1] == f"    say({python})"


def test_what_python_cannot_hold_is_refused_where_it_stands() -> None:
    lines = ["domain d", "fluent a = true", "proc p:"]
    lines += ["    " * depth + "while a:" for depth in range(1, 22)]
    source = Source("d.gl", "\n".join([*lines, "    " * 22 + "skip"]) + "\n")

    with pytest.raises(UserError, match="too many statically nested blocks") as raised:
        python_text(parsed(source))
    assert raised.value.diagnostics[0].span.line == 3
