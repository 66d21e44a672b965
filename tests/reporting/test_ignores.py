"""Comments and options that leave out findings."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.cli import invoke
from golc.diagnostics import Code
from golc.loading import examine
from golc.reporting.ignores import heed
from golc.reporting.selection import Selection, parse_codes

SPARE = "const spare = 3"
"""A warning GL027 of a declaration that nothing uses, in column 7."""


@pytest.fixture
def said(tmp_path: Path, request: pytest.FixtureRequest) -> list[str]:
    """What is found in the text of the parameter, as ``line:column code message``."""
    path = tmp_path / "a.gl"
    path.write_text(f"domain a\n{request.param}\n")
    return shown(path)


def shown(path: Path, proofs: bool = True) -> list[str]:
    found = heed(examine(path, proofs=proofs), proofs)
    return [f"{f.span.line}:{f.span.column} {f.code.code} {f.message} | {f.help}" for f in found]


@pytest.mark.parametrize(
    "said",
    [
        f"{SPARE}  # golc: ignore[GL027]",
        f"{SPARE}  #golc:ignore [ GL027 ] why",
        "define always(x: bool) := true  # golc: ignore[GL027, GL028]",
        f"{SPARE}  # golc: ignore",
        f"{SPARE}  # three # golc: ignore[GL027]",
        f"# golc: ignore[GL027]\n{SPARE}",
        f"    # golc: ignore[GL027]\n# it is spare\n{SPARE}",
        f"{SPARE}  # golc: ignore[GL027]\r",
        "fluent f = none  # golc: ignore",
    ],
    indirect=True,
)
def test_what_a_comment_is_about_is_left_out(said: list[str]) -> None:
    assert said == []


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        (f"{SPARE}\n# golc: ignore[GL027]", ["2:7 GL027", "3:16 GL032 there is no finding GL027 to leave out here"]),
        (f"# golc: ignore\n\n{SPARE}", ["2:1 GL032 there is no finding to leave out here", "4:7 GL027"]),
        (f"{SPARE}  # golc: ignore[]", ["2:7 GL027", "2:18 GL032 there is no code in the brackets"]),
        (f"{SPARE}  # golc: ignore[GL027, GL028]", ["2:40 GL032 there is no finding GL028 to leave out here"]),
        (
            f"{SPARE}  # golc: ignore[GL027, GL0027]",
            ["2:40 GL032 there is no code `GL0027` | did you mean `GL002`?"],
        ),
        (
            f"{SPARE}  # golc: ignroe",
            ["2:7 GL027", "2:26 GL032 there is no comment `golc: ignroe` | did you mean `ignore`"],
        ),
        (f"{SPARE}  # golc: the tool", ["2:7 GL027"]),
        ('const spare = "# golc: ignore"', ["2:7 GL027"]),
    ],
    indirect=["said"],
)
def test_what_no_comment_is_about_remains(said: list[str], expected: list[str]) -> None:
    assert len(said) == len(expected)
    assert [line for line, start in zip(said, expected, strict=True) if not line.startswith(start)] == []


def test_idle_comments_are_told_when_all_was_looked_for(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_text(
        "domain a\nfluent f = true  # golc: ignore[GL041]\n# golc: ignore[GL027]\naction a:\n    causes f := x\n"
    )
    assert [line[:9] for line in shown(path)] == ["5:17 GL01"], "there is an error"
    path.write_text("domain a\n# golc: ignore[GL041]\naction a:\n    poss true\n# golc: ignore[GL027]\n")
    assert not any("GL032" in line for line in shown(path, proofs=False))
    assert any("GL032" in line for line in shown(path))


def test_comments_of_an_imported_file_are_heeded_and_not_judged(tmp_path: Path) -> None:
    (tmp_path / "b.gl").write_text("domain b\nconst spare = 3  # golc: ignore[GL027]\nconst two = 2\n")
    path = tmp_path / "a.gl"
    path.write_text('domain a\nimport "b.gl"\nfluent n: 0..two = 0\naction go:\n    causes n := two\n')
    assert shown(path) == []


@pytest.mark.parametrize(
    ("select", "ignore", "wanted"),
    [
        ("", "", ["GL012", "GL027", "GL041"]),
        ("GL02", "", ["GL027"]),
        ("gl02, GL041", "", ["GL027", "GL041"]),
        ("", "GL027", ["GL012", "GL041"]),
        ("GL0", "GL02,GL04", ["GL012"]),
        ("GL027", "GL02", ["GL027"]),
        ("GL027", "GL027", []),
    ],
)
def test_the_longest_beginning_decides(select: str, ignore: str, wanted: list[str]) -> None:
    selection = Selection(parse_codes(select) if select else (), parse_codes(ignore) if ignore else ())
    codes = [Code.UNKNOWN_NAME, Code.UNUSED, Code.EFFECT_FAILS]
    assert [code.code for code in codes if selection.wants(code)] == wanted


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ("--select=GL0,GL7", "there is no code `GL7`"),
        ("--ignore=GL0277", "there is no code `GL0277`: did you mean `GL027`?"),
        ("--ignore=", "there is no code ``"),
    ],
)
def test_an_unknown_code_in_an_option(option: str, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["check", option, "a.gl"]) == 2
    assert message in capsys.readouterr().err


def test_what_is_left_out_does_not_count(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.gl"
    path.write_text(f"domain a\n{SPARE}\n")
    assert invoke(["check", "--strict", "--select", "GL0", str(path)]) == 1
    assert invoke(["check", "--strict", "--ignore", "GL02", str(path)]) == 0
    path.write_text("domain a\nfluent f = x\n")
    assert invoke(["check", "--ignore", "GL012", "--ignore", "GL028", str(path)]) == 0
    assert capsys.readouterr().err.splitlines()[-1] == "checked 1 file: nothing found"


PYTHON = '''"""What is spare can be left out:

# golc: ignore[GL027]
"""
from golc.embed import Theory

theory = Theory("a")
spare = theory.const("spare", 3)  # golc: ignore[GL027]
quote = '"'  # golc: ignore[GL027] of "Python"
word = '# golc: ignore'
'''


def test_only_comments_of_python_are_comments(tmp_path: Path) -> None:
    path = tmp_path / "a.py"
    path.write_text(PYTHON)

    assert shown(path) == ["9:29 GL032 there is no finding GL027 to leave out here | remove the code"]
    assert [finding.fix for finding in heed(examine(path, proofs=True), True)] == [None]
