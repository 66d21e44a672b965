"""``golc explain``: its arguments and what goes where."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.cli import invoke

ELEVATOR = str(Path(__file__).parents[2] / "examples" / "elevator" / "elevator.gl")
Captured = pytest.CaptureFixture[str]


def test_a_page(capsys: Captured) -> None:
    assert invoke(["explain", ELEVATOR, "off"]) == 0
    assert tuple(capsys.readouterr()) == (
        f"action off(n: floor)  ({ELEVATOR}:24)\n\n"
        "    Action precondition axiom\n        Poss(off(n), s) ≡ at(s) = n ∧ lit(n, s)\n\n"
        "    Effects\n        ¬lit(n, do(off(n), s))\n",
        "",
    )


def test_a_page_in_latex(capsys: Captured) -> None:
    assert invoke(["explain", ELEVATOR, "top", "--format", "latex", "-D", "top=4"]) == 0
    assert capsys.readouterr().out == (
        "\\paragraph{const top}\n\\subparagraph{Definition}\n\\begin{align*}\n& \\mathit{top} = 4\n\\end{align*}\n"
    )


def test_a_name_that_nothing_has(capsys: Captured) -> None:
    assert invoke(["explain", ELEVATOR, "minimise"]) == 1
    out, err = capsys.readouterr()
    assert (out, err.splitlines()[0]) == ("", "error[GL012]: nothing in the domain `elevator` has the name `minimise`")
    assert "did you mean `minimize`?" in err


def test_a_file_with_errors(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "a.gl"
    path.write_text("domain a\nfluent f\n")
    assert invoke(["explain", str(path), "f"]) == 1
    assert capsys.readouterr().err.startswith("error[GL050]")


def test_a_code(capsys: Captured, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    assert invoke(["explain", "gl024"]) == 0
    assert (
        capsys.readouterr().out
        == """GL024: the command line replaces a constant that does not exist

`-D name=value` replaces the value of a `const` of the file,
and the file has no const of this name.

Wrong

    domain lift
    const top = 4
    fluent at: 1..top = 1

    action up:
        poss at = 1
        causes at := top

    proc control:
        up

    $ golc check example.gl -D tpo=6

Right

    $ golc check example.gl -D top=6
"""
    )


def test_files_of_an_example_are_named(capsys: Captured, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "1000")
    assert invoke(["explain", "GL096"]) == 0
    out = capsys.readouterr().out
    assert "\n\nrobot.nqc:\n\n    task drive_up() { Wait(100); }\n\nRight\n" in out
    assert max(map(len, out.splitlines())) <= 100


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["GL0122"], "there is no code `GL0122`: did you mean `GL012`?"),
        (["GL012", "--format", "latex"], "are for a FILE and a NAME"),
        (["GL012", "-D", "top=4"], "are for a FILE and a NAME"),
        ([ELEVATOR], "a FILE and a NAME are needed"),
        ([], "a FILE and a NAME are needed"),
        ([ELEVATOR, "up", "down"], "a FILE and a NAME are needed"),
    ],
)
def test_other_arguments_are_no_use(arguments: list[str], message: str, capsys: Captured) -> None:
    assert invoke(["explain", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_a_code_with_examples_in_python(capsys: Captured, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert invoke(["explain", "GL104", "--python"]) == 0
    assert (
        capsys.readouterr().out
        == """GL104: `min` or `max` over nothing

`min` and `max` have a value only if something satisfies their `where`.

Wrong

    from __future__ import annotations

    from golc.embed import Theory, interval

    theory = Theory("lift")

    floor = theory.type("floor", interval(1, 4))


    @theory.fluent
    def lit(n: floor):
        return False


    @theory.action
    def go(to: floor):
        pass


    @theory.proc
    def control():
        go(min(n for n in floor if lit(n)))

    $ golc plan example.py

Right

    from __future__ import annotations

    from golc.embed import Theory, interval

    theory = Theory("lift")

    floor = theory.type("floor", interval(1, 4))


    @theory.fluent
    def lit(n: floor):
        return False


    @theory.action
    def go(to: floor):
        pass


    @theory.proc
    def control():
        if any(lit(n) for n in floor):
            go(min(n for n in floor if lit(n)))
"""
    )


def test_a_code_about_the_text_has_no_examples_in_python(capsys: Captured) -> None:
    assert invoke(["explain", "GL009", "--python"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("GL009: ") and "domain lamp" in out
    assert err == "GL009 is about the text of a `.gl` file: its examples have no form in Python\n"


def test_python_is_for_codes(capsys: Captured) -> None:
    assert invoke(["explain", ELEVATOR, "off", "--python"]) == 2
    assert "--python is for a CODE, not for a FILE and a NAME" in capsys.readouterr().err
