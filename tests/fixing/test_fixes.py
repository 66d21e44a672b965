"""What is fixed, and what is left to the writer."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.cli import invoke
from golc.diagnostics import Code, Diagnostic, Edit, Fix, Source, Span
from golc.fixing.rounds import Looked, fix
from golc.fixing.texts import Texts

HEAD = "domain d\nfluent f = true\nfluent n: 1..3 = 1\naction a\n"


def fixed(folder: Path, text: str) -> str:
    path = folder / "a.gl"
    path.write_bytes((HEAD + text).encode())
    invoke(["check", "--fix", "-q", str(path)])
    return path.read_bytes().decode().removeprefix(HEAD)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            "proc p:\n\tif f:\n\t\ta\n\n\t# c\nproc q:\n\ta\n",
            "proc p:\n    if f:\n        a\n\n    # c\nproc q:\n    a\n",
        ),
        ("proc p:\n\u00a0\u00a0\u00a0 a\n", "proc p:\n    a\n"),
        ("proc p:\n    \u200ba\n", "proc p:\n    a\n"),
        ("goal g: f = True and n != None\n", "goal g: f = true and n != none\n"),
        ("goal g:(f)∧(f)\n", "goal g:(f) and (f)\n"),
        ("goal g: !f&&¬f||!!f\n", "goal g: not f and not f or not not f\n"),
        ("goal g: f, not f\n", "goal g: f and not f\n"),
        ("goal g: ∃x: 1..3. x=n\n", "goal g: exists x: 1..3. x=n\n"),
        ("proc p:\n    say ‘x’  # ’\n    say 'it is {n}'\n", "proc p:\n    say ‘x’  # ’\n    say 'it is {n}'\n"),
        ("proc p:\n    say “it is”\n", 'proc p:\n    say "it is"\n'),
        ("proc p:\n    f?  # why\n", "proc p:\n    test f  # why\n"),
        ("proc p:\n    while f do  # why\n        a\n", "proc p:\n    while f:  # why\n        a\n"),
        ("proc p:\n    if f: a  # why\n", "proc p:\n    if f:\n        a  # why\n"),
        ("axiom n:\n  after a := (\n 1)  # why\n", "axiom n:\n  after a := (\n 1)  # why\n  otherwise unchanged\n"),
        ("proc p:\n    a;  # why\n", "proc p:\n    a  # why\n"),
        ("goal g: n is 1 and n is not 2\n", "goal g: n = 1 and n != 2\n"),
    ],
)
def test_what_is_fixed(tmp_path: Path, before: str, after: str) -> None:
    assert fixed(tmp_path, before) == after


@pytest.mark.parametrize(
    "text",
    [
        "proc p:\n    if f:\n\ta\n",  # a tab may have any width
        "fluent &&: bool = f\n",  # a name is missing
        "goal g: n / 2 = 1\n",  # which may not be meant to round
        "goal g: n => 2\n",  # implication, or at least
        "goal g: f or f, f\n",  # which the comma does not join
        "goal g: f = !f\n",  # `not` needs parentheses here
        "goal g: n = 'red'\n",  # a symbol of Prolog, a text of Python
        "proc p:\n    say 'it's'\n",
        "proc p:\n    a; a\n",  # Prolog's sequence, or its disjunction
        "proc p:\n    test (f;\n        f)\n",
        "proc p:\n    if f: a else: a\n",
        "proc p:\n    wait 5\n",  # seconds, or what NQC counts in
        "proc p:\n    test (f and f\n",  # where the bracket ends
        "goal g: m = 1\n",  # a name that is not declared
        "goal g: nn = 1\n",  # another name is close, which may not be meant
        "function p:\n    a\n",
        "type t: int\n",
        "invariant on track: f\n",
        "const spare = 1\n",  # not used, or not yet
    ],
)
def test_what_is_left_to_the_writer(tmp_path: Path, text: str) -> None:
    assert fixed(tmp_path, text) == text


SPARE = "const spare = 3"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (f"{SPARE}  # golc: ignroe[GL027]\n", f"{SPARE}  # golc: ignore[GL027]\n"),
        ("goal g: f  # golc: ignore\n", "goal g: f\n"),
        ("goal g: f  # golc: ignore[GL027, GL028]\n", "goal g: f\n"),
        ("goal g: f  # always # golc: ignore[GL027]\n", "goal g: f  # always\n"),
        ("goal g: f  # golc: ignore[GL027] for ever\n", "goal g: f  # for ever\n"),
        ("# one\n    # golc: ignore[GL027]\n# two\ngoal g: f\n", "# one\n# two\ngoal g: f\n"),
        ("# golc: ignore[GL027]\r\ngoal g: f\r\n", "goal g: f\r\n"),
        (f"{SPARE}  # golc: ignore[GL026, GL027, GL028, GL031]\n", f"{SPARE}  # golc: ignore[GL027]\n"),
        (f"{SPARE}  # golc: ignore[GL027, GL0028]\n", f"{SPARE}  # golc: ignore[GL027, GL0028]\n"),
    ],
)
def test_comments_that_leave_out_nothing_are_removed(tmp_path: Path, before: str, after: str) -> None:
    both = "action b:\n    causes f := n = 1\n    causes n := 2\n"
    assert fixed(tmp_path, both + before) == both + after


@pytest.mark.parametrize("option", ["-Dfar=2", "--reachable", "--no-proofs"])
def test_a_comment_that_may_be_of_use_in_another_run_stays(tmp_path: Path, option: str) -> None:
    path = tmp_path / "a.gl"
    path.write_text(f"{HEAD}const far = 1\ngoal g: n = far and f  # golc: ignore[GL041]\n")
    before = path.read_text()
    invoke(["check", "--fix", "-q", option, str(path)])
    assert path.read_text() == before
    invoke(["check", "--fix", "-q", str(path)])
    assert "golc:" not in path.read_text()


def test_no_other_text_is_ever_changed() -> None:
    for source in (Source("theory.py", "f == 1"), Source("<goal>", "f == 1")):
        edit = Edit(Span(source, 2, 4), "=")
        assert Diagnostic(Code.FOREIGN, "no", edit.span, fix=Fix("write `=`", (edit,))).fix is None
    golc = Source("a.gl", "f == 1", editable=True)
    fix = Fix("write `=` in both", (Edit(Span(golc, 2, 4), "="), edit))
    assert Diagnostic(Code.FOREIGN, "no", edit.span, fix=fix).fix is None


def found(source: Source, place: int, text: str, message: str) -> Diagnostic:
    """An error of the name at a place, and what is to be written for it."""
    span = Span(source, place, place + 1)
    return Diagnostic(Code.UNKNOWN_NAME, message, span, fix=Fix(f"write {text}", (Edit(span, text),)))


def test_a_fix_that_makes_it_worse_is_not_carried_out_and_keeps_no_other_from_it(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_text("a b c")
    texts = Texts()

    def look() -> Looked:
        """`a` should be `x`, `b` should not be `y`, which is no better; what is done about `c` changes nothing."""
        source = texts.read(path)
        findings = [
            found(source, place, replacement, f"no {letter}")
            for letter, replacement in (("a", "x"), ("b", "y"), ("c", "c"), ("y", "b"))
            if (place := source.text.find(letter)) >= 0
        ]
        return Looked(tuple(findings), tuple(findings))

    outcome = fix(texts, look(), look)
    assert texts.read(path).text == "x b c"
    assert [each.message for each in outcome.fixed] == ["no a"]
    assert [(each.finding.message, each.because and each.because.message) for each in outcome.refused] == [
        ("no b", "no y"),
        ("no c", None),
    ]
