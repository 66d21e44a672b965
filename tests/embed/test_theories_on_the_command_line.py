"""Commands read theories in Python as they read texts, and say that they execute them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from golc.cli import invoke

LAMP = """
from golc.embed import Theory, bind, causes, poss

print("made")
theory = Theory("lamp")
lit = theory.fluent("lit", initial=False)


@theory.action
def flash():
    poss(not lit)
    causes(lit, True)


@theory.proc
def control():
    flash()


@theory.device("host", file="lamp.py")
def host():
    bind(flash, call="flash_it")


def flash_it():
    with open("flashed", "w") as file:
        file.write("yes")
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lamp.py").write_text(LAMP)
    return tmp_path


def test_a_command_says_once_that_it_executes_the_theory(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["plan", "lamp.py"]) == 0
    out, err = capsys.readouterr()
    assert out == "flash\n"
    assert err.splitlines() == ["executes lamp.py", "made", "1 plan"]


def test_what_a_theory_prints_is_no_result(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["check", "-q", "--format", "json", "lamp.py"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["findings"] == []
    assert err == "made\n"


def test_a_theory_can_be_the_host_of_its_actions(folder: Path) -> None:
    assert invoke(["run", "lamp.py"]) == 0
    assert (folder / "flashed").read_text() == "yes"


def test_a_golc_ignore_comment_is_heeded(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    unused = 'spare = theory.fluent("spare", initial=False)'
    text = LAMP.replace("\n\n@theory.action", f"{unused}\n\n\n@theory.action", 1)
    Path("noisy.py").write_text(text)
    Path("quiet.py").write_text(text.replace(unused, f"{unused}  # golc: ignore[GL027]"))

    assert invoke(["check", "noisy.py"]) == 0
    assert "fluent `spare` is not used" in capsys.readouterr().out
    assert invoke(["check", "quiet.py"]) == 0
    assert capsys.readouterr().out == ""


def test_a_constant_is_replaced(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("lift.py").write_text(
        "from golc.embed import Theory, causes, interval, poss\n"
        'theory = Theory("lift")\n'
        'top = theory.const("top", 3)\n'
        'floor = theory.type("floor", interval(1, top))\n'
        'at = theory.fluent("at", floor, 1)\n'
        "@theory.action\n"
        "def up():\n"
        "    poss(at < top)\n"
        "    causes(at, at + 1)\n"
        'theory.goal("high", at == top)\n'
    )

    assert invoke(["plan", "lift.py", "--goal", "high", "-D", "top=5"]) == 0
    assert capsys.readouterr().out == "up\nup\nup\nup\n"


def test_what_plain_functions_print_and_import_stays_out_of_the_results(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "floors.py").write_text("TOP = 3\n", encoding="utf-8")
    path = tmp_path / "lift.py"
    path.write_text(
        "from golc.embed import Theory, causes, poss\n\n\ndef top():\n    from floors import TOP\n\n"
        "    print('asked')\n    return TOP\n\n\n"
        "theory = Theory('lift')\nat = theory.fluent('at', int, 1)\n\n\n@theory.action\ndef up():\n"
        "    poss(at < top())\n    causes(at, at + 1)\n",
        encoding="utf-8",
    )

    assert invoke(["plan", str(path), "--goal", "at = 3"]) == 0

    out, err = capfd.readouterr()
    assert out == "up\nup\n"
    assert "asked" in err


CROWDED = """\
from golc.embed import Theory, causes, interval, poss

theory = Theory("lift")
floor = theory.type("floor", interval(1, 6))
at = theory.fluent("at", floor, 9)


@theory.fluent
def lit(n: floor):
    return n is not at


@theory.action
def up():
    poss(at + 1 in flor)
    causes(at, at + "x")


@theory.action
def off(n: floor):
    poss(lit(n, 1))
    causes(lit(n), Flase)


@theory.proc
def control():
    if at == 1:
        down()
    while lit(red):
        try:
            up()
        finally:
            off(7)
        off(7)
    return 3
    off(1, 2)
"""


def test_mistakes_in_one_function_do_not_hide_each_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("lift.py").write_text(CROWDED)
    assert invoke(["check", "-q", "--format", "json", "lift.py"]) == 1
    found = json.loads(capsys.readouterr().out)["findings"]
    assert [(f["span"]["line"], f["span"]["column"], f["code"], f["message"]) for f in found] == [
        (5, 33, "GL017", "`9` is outside `floor` (1..6)"),
        (10, 12, "GL143", "`is` asks for one object of Python, not for equal values"),
        (15, 20, "GL012", "`flor` is neither a Python constant nor declared"),
        (16, 21, "GL016", '`"x"` is of type `str`, but `+` needs a number'),
        (21, 10, "GL015", "`lit` takes 1 argument, not 2"),
        (22, 20, "GL012", "`Flase` is neither a Python constant nor declared"),
        (28, 9, "GL012", "`down` is neither a Python constant nor declared"),
        (29, 15, "GL012", "`red` is neither a Python constant nor declared"),
        (30, 9, "GL143", "a program catches nothing"),
        (34, 13, "GL017", "`7` is outside `floor` (1..6)"),
        (35, 5, "GL143", "a procedure has no value, and no way out but its end"),
        (36, 5, "GL015", "`off` takes 1 argument, not 2"),
    ]


MISTAKEN = """\
from golc.embed import Theory, branch, causes, choose, expect, interval, run

theory = Theory("lift")
floor = theory.type("floor", interval(1, 6))
at = theory.fluent("at", floor, 1)


@theory.action
def up():
    causes(at, at + 1)


@theory.proc
def climb():
    with choose():
        with branch():
            up()
        up()


@theory.scenario
def climbing():
    run(3)
    expect(at == 2)


@theory.scenario
def climbing_on():
    try:
        run(climb())
    finally:
        expect(at == 2)
"""


@pytest.mark.parametrize("arguments", [["check"], ["plan"], ["run"], ["test"], ["convert"]])
def test_what_was_passed_over_is_not_missed(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("lift.py").write_text(MISTAKEN)

    assert invoke([*arguments, "lift.py"]) == 1

    out, err = capsys.readouterr()
    assert [line for line in (out + err).splitlines() if line.startswith("error")] == [
        "error[GL143]: only branches stand in `choose`",
        "error[GL143]: this is no action, procedure or fluent",
        "error[GL143]: this line has no meaning here",
    ]
