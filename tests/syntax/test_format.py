"""The canonical layout: what it looks like, that it says the same, and that it is the same the second time."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Findings, Source
from golc.syntax import tree as ast
from golc.syntax.format import formatted
from golc.syntax.text import read_source
from golc.syntax.unparse import unparse

ROOT = Path(__file__).parents[2]
WRITTEN = sorted([*(ROOT / "examples").glob("*/*.gl"), *(ROOT / "tests" / "programs").glob("*.gl")])

Parsed = Callable[[str], ast.File]


def layout(text: str) -> str:
    """The text in canonical layout; it has to parse."""
    findings = Findings()
    result = formatted(Source("test.gl", text), findings)
    assert result is not None, [f"{d.span} {d.message}" for d in findings.diagnostics]
    return result


def in_proc(text: str) -> str:
    """The lines of a program, laid out as the body of a procedure."""
    body = "".join(f"    {line}\n" for line in text.splitlines())
    lines = layout(f"domain d\nproc p:\n{body}").splitlines()
    return "\n".join(line.removeprefix("    ") for line in lines[2:])


def test_words_stand_as_the_printer_of_trees_writes_them() -> None:
    assert in_proc("test not( a )and b [ 0 ]in{x ,-1}or - c<f (  -2,[ ] )") == (
        "test not (a) and b[0] in {x, -1} or -c < f(-2, [])"
    )
    assert in_proc("for n :1 .. 6,m in l where p( n ) :\n a(n)") == "for n: 1..6, m in l where p(n):\n    a(n)"
    assert in_proc("test(count n:t.p(n))+1 =min( 1,2 )") == "test (count n: t. p(n)) + 1 = min(1, 2)"


def test_declarations_are_set_in_the_same_way() -> None:
    text = "domain d\ntype a=1 ..( n+1 ) +{ x }\nfluent f( x:a ) :list [a ] ?=none\ndefine g( x:a ):=f( x )\n"
    assert layout(text) == (
        "domain d\ntype a = 1..(n + 1) + {x}\nfluent f(x: a): list[a]? = none\ndefine g(x: a) := f(x)\n"
    )


def test_a_function_of_python_is_set_like_a_static() -> None:
    text = 'domain d\nextern  f( a:t ,b : set [u] ) :v ?from"h.py"  # why\nextern p from "h.py"\n'
    assert layout(text) == 'domain d\nextern f(a: t, b: set[u]): v? from "h.py"  # why\nextern p from "h.py"\n'


def test_a_device_block_keeps_numbers_and_settings_apart() -> None:
    text = 'domain d\ndevice rcx"a.nqc" :\n  8..look ( s:t )by call look{3:red}\n  set poll(1)s\n  set low -1\n'
    assert layout(text) == (
        'domain d\ndevice rcx "a.nqc":\n    8 .. look(s: t) by call look {3: red}\n    set poll (1) s\n    set low -1\n'
    )


def test_blocks_are_indented_by_four() -> None:
    text = "choose:\n  a\n  if f:\n     b\n  else :\n   c\nor:\n            a"
    assert in_proc(text) == "choose:\n    a\n    if f:\n        b\n    else:\n        c\nor:\n    a"


def test_a_comment_stays_where_it_is() -> None:
    text = (
        "#!first   \n\n\n# the domain\ndomain d#name\n   # about p\nproc p: # head\n# before the first\n    choose:\n"
        "            a   #   one\n          # or else\n    or: # second\n        b\n        # end of b\n"
        "      # end of p\n\n\n\n\n# last"
    )
    assert layout(text) == (
        "#!first\n\n# the domain\ndomain d  #name\n# about p\nproc p:  # head\n    # before the first\n    choose:\n"
        "        a  #   one\n    # or else\n    or:  # second\n        b\n        # end of b\n"
        "    # end of p\n\n# last\n"
    )


def test_a_comment_inside_brackets_stays_where_it_is() -> None:
    text = (
        "domain d\nstatic f(a: t): t = { # rows\n# the first\n x: 1,   # one\n\n\n       y: 2 # two\n  # no more\n}\n"
    )
    assert layout(text) == (
        "domain d\nstatic f(a: t): t = {  # rows\n    # the first\n    x: 1,  # one\n\n    y: 2  # two\n"
        "    # no more\n}\n"
    )


def test_one_blank_line_is_kept_and_none_at_the_beginning_of_a_block() -> None:
    text = "\n\ndomain d\n\n\n\nproc p:\n\n    a\n   \t\n\n    b\n\n\n"
    assert layout(text) == "domain d\n\nproc p:\n    a\n\n    b\n"


def test_a_line_end_inside_brackets_is_kept() -> None:
    text = "test f(a,\n b, g([\n c\n], d)\n)"
    assert in_proc(text) == "test f(a,\n    b, g([\n        c\n    ], d)\n)"


def test_before_a_block_a_broken_line_is_indented_deeper_than_the_block() -> None:
    text = "domain d\nproc p(a: t,\nb: t):\n    if f(1,\n2):\n        go\n"
    assert layout(text) == "domain d\nproc p(a: t,\n        b: t):\n    if f(1,\n            2):\n        go\n"


def test_a_long_line_is_broken_in_the_widest_of_the_outermost_brackets() -> None:
    names = ", ".join(f"start_{n}(left, right)" for n in range(6))
    assert in_proc(f"test longer_than_the_others({names}) = short(1, 2)") == (
        "test longer_than_the_others(start_0(left, right), start_1(left, right), start_2(left, right),\n"
        "    start_3(left, right), start_4(left, right), start_5(left, right)) = short(1, 2)"
    )


def test_a_long_formula_is_broken_before_its_loosest_operator() -> None:
    left = "the_first_condition = first and the_second_condition != second"
    right = "the_third_condition = third and the_fourth_condition != fourth"
    assert in_proc(f"test ({left} or {right})") == f"test ({left}\n    or {right})"


def test_a_long_line_without_room_in_brackets_stays() -> None:
    text = f"test {' and '.join(f'condition_{n}(a, {n})' for n in range(8))}"
    assert in_proc(text) == text


def test_a_comment_does_not_count_for_the_length() -> None:
    text = f"test f({', '.join('value' for _ in range(12))})  # {'long ' * 10}".rstrip()
    assert in_proc(text) == text


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("if (a and b):\n    x", "if a and b:\n    x"),
        ("test ((a or b) and c)", "test (a or b) and c"),
        ("test ((a))", "test a"),
        ("test f((a), (b))", "test f((a), (b))"),
        ("test f((a + b))", "test f(a + b)"),
        ("test (a) = (b)", "test (a) = (b)"),
        ("pick x: t where (exists y: t. p(x, y)):\n    a", "pick x: t where exists y: t. p(x, y):\n    a"),
        ("wait until (a)", "wait until a"),
        ("wait (until) s", "wait (until) s"),
        ("while (at < 3):\n    up", "while at < 3:\n    up"),
        ("test (a  # why\n)", "test (a  # why\n)"),
        ("test (a\nor b)", "test (a\n    or b)"),
    ],
)
def test_parentheses_that_say_nothing_are_removed(text: str, result: str) -> None:
    assert in_proc(text) == result


def test_parentheses_that_keep_a_name_apart_from_a_word_are_kept() -> None:
    text = "domain d\nprune p: (after = 1)\nscenario s:\n    on e when (waiting)\n    expect (actions[0] = 1)\n"
    assert layout(text) == text


def test_parentheses_that_let_a_line_be_broken_are_kept() -> None:
    text = f"test ({' and '.join(f'the_condition_number_{n}' for n in range(5))})"
    assert in_proc(text).startswith("test (the_condition_number_0 and")


def test_a_text_that_does_not_parse_has_no_layout() -> None:
    findings = Findings()

    assert formatted(Source("t", "domain d\nproc p:\n    if a\n        b\n"), findings) is None
    assert [finding.code.code for finding in findings.diagnostics] == ["GL004"]


@given(st.data())
def test_what_the_printer_of_trees_writes_is_canonical(trees: Any, data: st.DataObject) -> None:
    text = unparse(data.draw(trees.files))

    if all(len(line) <= 100 for line in text.split("\n")):
        assert layout(text) == text


@given(st.data())
def test_the_tree_and_the_comments_never_change(trees: Any, parsed: Parsed, data: st.DataObject) -> None:
    file = data.draw(trees.files)
    text = strewn(unparse(file), random_of(data))
    result = layout(text)

    assert parsed(text) == parsed(result) == file
    assert layout(result) == result
    assert comments(result) == comments(text)
    assert "\n\n\n" not in result
    assert not re.search(r"[ \t\r]$", result, re.MULTILINE)


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.stem)
@pytest.mark.parametrize("seed", range(3))
def test_a_file_keeps_its_tree_and_comments_and_from_another_layout_becomes_the_same(
    path: Path, seed: int, parsed: Parsed
) -> None:
    text = read_source(path).text
    result = formatted(Source(path.name, text), Findings())

    if result is not None:
        assert parsed(result) == parsed(text)
        assert comments(result) == comments(text)
        assert layout(disordered(result, Random(seed))) == result


@given(st.data())
def test_parentheses_around_conditions_never_change_the_tree(trees: Any, parsed: Parsed, data: st.DataObject) -> None:
    file = data.draw(trees.files)
    # In a device block such a word may be the name of an action.
    file = replace(file, declarations=tuple(d for d in file.declarations if not isinstance(d, ast.Device)))
    wrapped = WORDS.sub(lambda line: f"{line[1]} (({line[2]})){line[3]}", unparse(file))

    assert parsed(layout(wrapped)) == parsed(wrapped)
    assert layout(layout(wrapped)) == layout(wrapped)


WORDS = re.compile(r"^( *(?:test|poss|senses|cost|given|until|initially|if|while|guard))\b (.*?)(:?)$", re.MULTILINE)
"""Lines that are a word and an expression."""

STRING = r'"(?:\\[^\n]|[^"\\\n])*"'
PIECES = re.compile(rf"{STRING}|#[^\n]*|\n *|[A-Za-z]\w*|\d+\.\d+|\d+|:=|\.\.|!=|<=|>=|//|[^\s]")
"""What texts are made of; a line end goes with the indentation that follows it."""


RUBBISH = ("", "", "# why", "  # (", "#  ]a\"b'", "          #")


def random_of(data: st.DataObject) -> Random:
    """Drawing each place by itself would take hypothesis minutes."""
    return Random(data.draw(st.integers(0, 2**32)))


def strewn(text: str, random: Random) -> str:
    """A text of the printer with comments, blank lines and line ends where such may stand."""

    def rubbish() -> str:
        return "\n".join(random.choices(RUBBISH, k=random.randint(1, 3)))

    depth, result = 0, []
    for piece in PIECES.findall(text):
        if piece.startswith("\n"):
            result.append(rubbish() + piece)
        elif depth > 0 and random.randrange(6) == 0:
            result.append(f"{rubbish()}\n{piece} ")
        else:
            result.append(f"{piece} ")
        depth += (piece in "([{") - (piece in ")]}")
    return "".join(result)


def comments(text: str) -> list[tuple[str, str, str, bool]]:
    """Each comment with the word before it, the word behind it, and whether it has a line of its own."""
    pieces = [piece for piece in PIECES.findall(text) if piece not in "()"]
    found = []
    for place, piece in enumerate(pieces):
        if piece.startswith("#"):
            before = next((p for p in reversed(pieces[:place]) if p[0] not in "#\n"), "")
            behind = next((p for p in pieces[place:] if p[0] not in "#\n"), "")
            found.append((piece.rstrip(), before, behind, place == 0 or pieces[place - 1][0] == "\n"))
    return found


def disordered(text: str, random: Random) -> str:
    """A canonical text with other indentation, more blank lines and spaces, and another kind of line ends."""
    widths = random.choices(range(1, 8), k=12)
    end = random.choice(["\n", "\r\n"])
    lines = []
    for line in text.removesuffix("\n").split("\n"):
        level = (len(line) - len(line.lstrip())) // 4
        words = re.sub(rf"({STRING}|#.*)|(,| [=+] )", lambda found: found[1] or f" {found[2]} ", line.strip())
        lines.append(" " * sum(widths[:level]) + words + random.choice(["", " "]))
        if not line:
            lines += [""] * random.randint(0, 2)
    return end.join(lines) + random.choice(["", end, end * 3])
