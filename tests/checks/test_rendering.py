"""Diagnostics as text and as JSON."""

from __future__ import annotations

from textwrap import dedent

from golc.diagnostics import Code, Diagnostic, Label, Severity, Source, Span
from golc.rendering import render, to_json

TEXT = "domain d\n\nfluent motion: phase = stopped\naction go:\n    poss motoin = stopped\n"
SOURCE = Source("delivery.gl", TEXT)


def span(part: str, source: Source = SOURCE) -> Span:
    start = source.text.index(part)
    return Span(source, start, start + len(part))


def error(place: Span, message: str = "wrong", marker: str = "", **more: object) -> Diagnostic:
    return Diagnostic(Code.UNKNOWN_NAME, message, place, Severity.ERROR, marker, **more)  # type: ignore[arg-type]


def test_the_layout_is_that_of_the_manual() -> None:
    label = Label(span("motion"), "a fluent with a similar name is declared here")
    diagnostic = error(
        span("motoin"), "unknown fluent `motoin`", "not declared", labels=(label,), help="did you mean `motion`?"
    )
    assert render(diagnostic) == dedent(
        """\
        error[GL012]: unknown fluent `motoin`
         --> delivery.gl:5:10
          |
        5 |     poss motoin = stopped
          |          ^^^^^^ not declared
          |
        3 | fluent motion: phase = stopped
          |        ------ a fluent with a similar name is declared here
          = help: did you mean `motion`?"""
    )


def test_the_gutter_is_as_wide_as_the_widest_line_number() -> None:
    source = Source("d.gl", "a\n" * 99 + "oops\n")
    label = Label(Span(source, 0, 1), "because of this")
    assert render(error(span("oops", source), labels=(label,), notes=("so it is",))) == dedent(
        """\
        error[GL012]: wrong
           --> d.gl:100:1
            |
        100 | oops
            | ^^^^
            |
          1 | a
            | - because of this
            = note: so it is"""
    )


def test_labels_in_the_same_line_stand_under_it() -> None:
    source = Source("d.gl", "go(a: t, a: t)\n")
    second, first = Span(source, 9, 10), Span(source, 3, 4)
    assert render(error(second, marker="again", labels=(Label(first, "first here"),))).splitlines()[2:] == [
        "  |",
        "1 | go(a: t, a: t)",
        "  |          ^ again",
        "  |    - first here",
    ]


def test_labels_in_other_files_name_them() -> None:
    other = Source("parts.gl", "domain p\nfluent motion = true\n")
    labels = (Label(span("motion", other), "there"), Label(span("stopped"), "here"))
    assert render(error(span("motoin"), labels=labels)).splitlines()[5:] == [
        "  |",
        "3 | fluent motion: phase = stopped",
        "  |                        ------- here",
        " ::: parts.gl:2:8",
        "  |",
        "2 | fluent motion = true",
        "  |        ------ there",
    ]


def test_marks_stand_under_wide_and_combining_characters_and_behind_tabs() -> None:
    source = Source("d.gl", '\tsay "日本e\u0301" oops\n')
    assert render(error(span("oops", source))).splitlines()[3:] == [
        '1 |     say "日本e\u0301" oops',
        "  |                 ^^^^",
    ]
    assert render(error(span("日本", source))).splitlines()[4] == "  |          ^^^^"


def test_carriage_returns_are_not_shown() -> None:
    source = Source("d.gl", "domain d\r\noops\r\n")
    assert render(error(span("oops", source))) == "error[GL012]: wrong\n --> d.gl:2:1\n  |\n2 | oops\n  | ^^^^"


def test_an_empty_span_at_the_end_of_a_line_has_a_mark() -> None:
    source = Source("d.gl", "if a\n")
    assert render(error(Span(source, 4, 4), marker="`:` is missing")).splitlines()[3:] == [
        "1 | if a",
        "  |     ^ `:` is missing",
    ]


def test_an_empty_span_at_the_end_of_the_text_has_a_mark() -> None:
    source = Source("d.gl", "if a:\n")
    assert render(error(Span(source, 6, 6), marker="a block")).splitlines() == [
        "error[GL012]: wrong",
        " --> d.gl:2:1",
        "  |",
        "2 |",
        "  | ^ a block",
    ]


def test_a_span_of_several_lines_is_marked_in_the_first_and_the_last() -> None:
    source = Source("d.gl", "a {\n  b,\n  c,\n  d}\n")
    assert render(error(Span(source, 2, 18), marker="all of this")).splitlines()[2:] == [
        "  |",
        "1 | a {",
        "  |   ^",
        "...",
        "4 |   d}",
        "  |   ^^ all of this",
    ]


def test_a_span_of_two_lines_leaves_nothing_out() -> None:
    source = Source("d.gl", "a {\n  b}\n")
    assert render(error(Span(source, 2, 8))).splitlines()[2:] == ["  |", "1 | a {", "  |   ^", "2 |   b}", "  |   ^^"]


def test_a_span_that_ends_with_its_line_is_marked_once() -> None:
    source = Source("d.gl", "abc\ndef\n")
    assert render(error(Span(source, 1, 4))).splitlines()[3:] == ["1 | abc", "  |  ^^"]


def test_of_a_long_line_only_what_is_around_the_mark_is_shown() -> None:
    source = Source("d.gl", "(" * 300 + "oops" + ")" * 300)
    line, marks = render(error(span("oops", source))).splitlines()[3:]
    assert len(line) < 170
    assert line.index("oops") == marks.index("^^^^")
    assert line.startswith("1 | …(((")
    assert line.endswith(")))…")


def test_control_characters_are_seen_instead_of_obeyed() -> None:
    source = Source("d\x1b[31m.gl", "a\x1b[2J\u202eb\n")
    text = render(error(span("b", source), "bad \x07"))
    assert "\x1b" not in text
    assert "\x07" not in text
    assert "\u202e" not in text
    assert "bad ␇" in text


def test_a_file_without_text_is_named_without_a_place() -> None:
    source = Source("missing.gl", "")
    assert render(error(Span(source, 0, 0))) == "error[GL012]: wrong\n --> missing.gl"


def test_color_paints_and_adds_nothing_else() -> None:
    import re

    diagnostic = error(span("motoin"), labels=(Label(span("motion"), "there"),), help="do")
    painted = render(diagnostic, color=True)
    assert painted.startswith("\x1b[1;31merror[GL012]\x1b[0m")
    assert re.sub("\x1b\\[[0-9;]*m", "", painted) == render(diagnostic)


def test_json_has_the_same_fields() -> None:
    diagnostic = error(
        span("motoin"), "unknown", "here", labels=(Label(span("motion"), "there"),), notes=("a",), help="b"
    )
    place = {"file": "delivery.gl", "line": 5, "column": 10, "end_line": 5, "end_column": 16}
    other = {"file": "delivery.gl", "line": 3, "column": 8, "end_line": 3, "end_column": 14}
    assert to_json(diagnostic) == {
        "code": "GL012",
        "title": "a name is not declared",
        "severity": "error",
        "message": "unknown",
        "span": place,
        "marker": "here",
        "labels": [{"span": other, "text": "there"}],
        "notes": ["a"],
        "help": "b",
        "fix": None,
    }
