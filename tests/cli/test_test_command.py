"""``golc test``: a line for each scenario, the first difference, the exit code and the XML."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from golc.cli import invoke

LAMP = """domain lamp
fluent lit: bool = false
action press:
    causes lit := not lit
proc control:
    press
    press
scenario twice:
    expect press exactly 2
scenario stays_on:
    expect lit
"""


@pytest.fixture
def lamp(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lamp.gl").write_text(LAMP)
    return "lamp.gl"


def test_scenarios_that_go_well(lamp: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path(lamp).write_text(LAMP.replace("expect lit", "expect not lit"))
    assert invoke(["test", lamp]) == 0
    out, err = capsys.readouterr()
    assert out == "ok      lamp.gl: twice (2 actions, 0 events)\nok      lamp.gl: stays_on (2 actions, 0 events)\n"
    assert err == "2 scenarios: none failed\n"


def test_a_scenario_that_fails(lamp: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["test", lamp]) == 1
    out, err = capsys.readouterr()
    assert out.splitlines() == [
        "ok      lamp.gl: twice (2 actions, 0 events)",
        "FAILED  lamp.gl: stays_on (2 actions, 0 events)",
        "error[GL121]: at the end this is not so",
        "  --> lamp.gl:11:5",
        "   |",
        "11 |     expect lit",
        "   |     ^^^^^^^^^^ `lit` is false (lit = false)",
        "after this run:",
        "    1 press",
        "    2 press",
        "",
    ]
    assert err == "2 scenarios: 1 failed\n"


def test_a_file_with_errors_fails_and_the_others_are_run(lamp: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("bad.gl").write_text("domain bad\nfluent x: int\n")
    assert invoke(["test", "bad.gl", "missing.gl", lamp, "-q"]) == 1
    out, err = capsys.readouterr()
    assert out.splitlines()[:3] == [
        "FAILED  bad.gl: the file has errors",
        "FAILED  missing.gl: the file has errors",
        "ok      lamp.gl: twice (2 actions, 0 events)",
    ]
    assert "error[GL050]" in err and "error[GL001]" in err


def test_the_results_as_xml(lamp: str) -> None:
    Path("bad.gl").write_text("domain bad\nfluent x: int\n")
    assert invoke(["test", lamp, "bad.gl", "--junit", "results.xml", "-q"]) == 1
    first = Path("results.xml").read_text()
    root = ElementTree.fromstring(first)
    assert root.attrib == {"tests": "3", "failures": "1", "errors": "1"}
    assert [(suite.get("name"), suite.get("tests")) for suite in root] == [("lamp.gl", "2"), ("bad.gl", "1")]
    assert [(case.get("name"), [problem.tag for problem in case]) for case in root.iter("testcase")] == [
        ("twice", []),
        ("stays_on", ["failure"]),
        ("load", ["error"]),
    ]
    failure = root.find(".//failure")
    assert failure is not None and failure.get("message") == "at the end this is not so"
    assert "2 press" in (failure.text or "")
    invoke(["test", lamp, "bad.gl", "--junit", "results.xml", "-q"])
    assert Path("results.xml").read_text() == first


def test_a_constant_may_be_replaced_and_a_report_that_cannot_be_written_is_said(
    lamp: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path(lamp).write_text(
        "domain d\nconst n = 1\naction a\nproc control:\n    a\nscenario s:\n    expect a exactly n\n"
    )
    assert invoke(["test", lamp]) == 0
    assert invoke(["test", lamp, "-D", "n=2"]) == 1
    capsys.readouterr()
    assert invoke(["test", lamp, "--junit", "no/such/folder.xml"]) == 1
    assert "no/such/folder.xml" in capsys.readouterr().err
