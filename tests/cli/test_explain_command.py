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


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["GL012"], "GL012 is a code"),
        ([ELEVATOR], "a FILE and a NAME are needed"),
        ([], "a FILE and a NAME are needed"),
        ([ELEVATOR, "up", "down"], "a FILE and a NAME are needed"),
    ],
)
def test_other_arguments_are_no_use(arguments: list[str], message: str, capsys: Captured) -> None:
    assert invoke(["explain", *arguments]) == 2
    assert message in capsys.readouterr().err
