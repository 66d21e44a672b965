from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Findings, Source
from golc.nqc.busy import check_rests
from golc.nqc.source import Kind, scan, tokens


def test_definitions_are_found_with_their_kind_and_parameters() -> None:
    nqc = scan(Source("x.nqc", "void f(int a, const int &b) {}\nsub s() { f(1, 2); }\ntask main ( ) { s(); }\n"))
    found = [(definition.kind, definition.name, definition.parameters) for definition in nqc.definitions.values()]
    assert found == [(Kind.FUNCTION, "f", 2), (Kind.SUB, "s", 0), (Kind.TASK, "main", 0)]
    assert [token.text for token in nqc.definitions["s"].body] == ["f", "(", "1", ",", "2", ")", ";"]
    assert nqc.definitions["s"].span.text == "s"


@pytest.mark.parametrize(
    "text",
    [
        "// void f() {}\n",
        "/* void f() {}\n*/",
        "/* comments /* do not nest */",
        '#define TEXT "void f() {}"\n',
        "#define MAKE void f() {}\n",
        "#define MAKE \\\n void f() {}\n",
        "/* never closed  void f() {}",
        "int v(3); f();",
        "void f();",
    ],
)
def test_what_only_looks_like_a_definition_is_none(text: str) -> None:
    assert scan(Source("x.nqc", text)).definitions == {}


def test_a_definition_after_a_comment_in_a_directive_is_found() -> None:
    nqc = scan(Source("x.nqc", "#define A 1 // one\nvoid f() {}\n#define B 2 /* two\n three */ void g() {}\n"))
    assert list(nqc.definitions) == ["f", "g"]
    assert nqc.macros == {"A": "1", "B": "2"}


def test_variables_are_the_global_ones() -> None:
    nqc = scan(Source("x.nqc", "int a, b = 2;\nint c[4];\nvoid f(int d) { int e; }\nint g;\n"))
    assert list(nqc.variables) == ["a", "b", "c", "g"]


def test_words_do_not_come_from_comments_and_strings() -> None:
    nqc = scan(Source("x.nqc", "task main() { On(OUT_A); /* Off */ } // Wait\n#define R golc_report(X)\n"))
    assert nqc.words == {"task", "main", "On", "OUT_A", "golc_report", "X"}


def test_included_files_belong_to_the_program_and_are_read_once() -> None:
    files = {
        "a.nqh": Source("a.nqh", '#include "b.nqh"\n#include "x.nqc"\nvoid a() {}\n'),
        "b.nqh": Source("b.nqh", '#include "a.nqh"\nvoid b() {}\n'),
    }
    nqc = scan(Source("x.nqc", '#include "a.nqh"\n#include "none.nqh"\nvoid x() {}\n'), files.get)
    assert set(nqc.definitions) == {"a", "b", "x"}
    assert nqc.includes == {"a.nqh", "b.nqh", "x.nqc", "none.nqh"}


def test_a_brace_that_is_never_closed_ends_with_the_file() -> None:
    nqc = scan(Source("x.nqc", "void f() { if (x) {\nvoid g() {}\n"))
    assert list(nqc.definitions) == ["f"]


@given(st.text(alphabet='ab(){};"/*#\\\n int', max_size=60))
def test_no_text_makes_the_reader_fail_and_tokens_lie_where_they_say(text: str) -> None:
    scan(Source("x.nqc", text))
    for token in tokens(text):
        assert text[token.start : token.end] == token.text


def busy(text: str) -> list[int]:
    """The lines at which a loop never rests."""
    findings = Findings()
    check_rests(scan(Source("x.nqc", text)), findings)
    return [diagnostic.span.line for diagnostic in findings.diagnostics]


@pytest.mark.parametrize(
    ("body", "lines"),
    [
        ("until (S == 1);", [1]),
        ("until (S == 1) Wait(1);", []),
        ("while (true) {\n a = 1;\n}", [1]),
        ("while (true) {\n if (a) b = 1; else Wait(1);\n}", []),
        ("while (true) {\n until (x);\n Wait(1);\n}", [2]),
        ("do { a = 1; } while (b);", [1]),
        ("do { Wait(1); } while (b);", []),
        ("do Wait(1); while (b);", []),
        ("repeat (5) { a += 1; }", []),
        ("while (x) { rest(); }", []),
        ("while (x) { PAUSE; }", []),
        ("while (x) { tire(); }", [1]),
    ],
)
def test_loops_without_rest(body: str, lines: list[int]) -> None:
    helpers = "\n#define PAUSE rest()\nvoid rest() { Wait(5); }\nvoid tire() { a = 1; }\n"
    assert busy("task t() { " + body + " }" + helpers) == lines
