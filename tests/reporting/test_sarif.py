"""The SARIF log of findings, compared with the schema of SARIF 2.1.0 by OASIS (as jest-sarif ships it under the MIT
license) and with what is written down here."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft4Validator

from golc.cli import invoke
from golc.diagnostics import Code, Diagnostic, Edit, Fix, Label, Severity, Source, Span
from golc.reporting.sarif import log

SCHEMA = json.loads((Path(__file__).parent / "sarif-2.1.0-rtm.5.json").read_text(encoding="utf-8"))
PROGRAMS = Path(__file__).parents[1] / "programs"
TEXT = Source("a b.gl", "domain d\nfluent 日本: 1..3\n")
"""Twelve characters follow the line end: the second line's `日本` has the columns 8 and 9."""


def result(finding: Diagnostic) -> Any:
    return log([finding], {})["runs"][0]["results"][0]


def test_a_finding_is_a_result() -> None:
    finding = Diagnostic(
        Code.NO_INITIAL,
        "`日本` has no initial value",
        Span(TEXT, 16, 18),
        marker="no `=` here",
        labels=(Label(Span(TEXT, 7, 8), "the domain"),),
        notes=("a note",),
        help="add `= 1`",
    )
    place = {"artifactLocation": {"uri": "a%20b.gl"}}
    region = {"startLine": 2, "startColumn": 8, "endLine": 2, "endColumn": 10, "snippet": {"text": "日本"}}
    domain = {"startLine": 1, "startColumn": 8, "endLine": 1, "endColumn": 9, "snippet": {"text": "d"}}
    found = result(finding)
    assert list(Code)[found.pop("ruleIndex")] is Code.NO_INITIAL
    assert found == {
        "ruleId": "GL050",
        "level": "error",
        "message": {
            "text": "`日本` has no initial value (no `=` here)\nnote: a note\nhelp: add `= 1`",
            "markdown": "`日本` has no initial value\n\n- note: a note\n\n**Help:** add `= 1`",
        },
        "locations": [{"physicalLocation": {**place, "region": region}, "message": {"text": "no `=` here"}}],
        "relatedLocations": [
            {"id": 1, "physicalLocation": {**place, "region": domain}, "message": {"text": "the domain"}}
        ],
    }


def test_what_has_no_text_has_no_region() -> None:
    finding = Diagnostic(Code.UNREADABLE, "cannot read it", Span(Source("/tmp/é.gl", ""), 0, 0), Severity.WARNING)
    assert result(finding)["locations"] == [
        {"physicalLocation": {"artifactLocation": {"uri": "file:///tmp/%C3%A9.gl"}}}
    ]


def test_a_value_from_the_command_line_is_in_no_file() -> None:
    finding = Diagnostic(Code.OVERRIDE, "no such const", Span(Source("-D x", "3"), 0, 1))
    assert result(finding)["locations"] == [{"logicalLocations": [{"fullyQualifiedName": "-D x"}]}]


def test_a_fix_is_a_change_of_its_file() -> None:
    text = Source("a b.gl", "domain d\nfluent 日本 == true\n", editable=True)
    edits = (Edit(Span(text, 19, 21), "="), Edit(Span(text, 26, 26), "  # yes"))
    finding = Diagnostic(Code.FOREIGN, "no", Span(text, 19, 21), fix=Fix("write `=`", edits))
    deleted = {"startLine": 2, "startColumn": 11, "endLine": 2, "endColumn": 13}
    inserted = {"startLine": 2, "startColumn": 18, "endLine": 2, "endColumn": 18}
    assert result(finding)["fixes"] == [
        {
            "description": {"text": "write `=`"},
            "artifactChanges": [
                {
                    "artifactLocation": {"uri": "a%20b.gl"},
                    "replacements": [
                        {"deletedRegion": deleted, "insertedContent": {"text": "="}},
                        {"deletedRegion": inserted, "insertedContent": {"text": "  # yes"}},
                    ],
                }
            ],
        }
    ]


def test_every_code_is_a_rule() -> None:
    run = log([], {"errors": 0})["runs"][0]
    assert [rule["id"] for rule in run["tool"]["driver"]["rules"]] == [code.code for code in Code]
    assert (run["results"], run["properties"]) == ([], {"errors": 0})


def test_a_log_with_fixes_follows_the_schema(capsys: pytest.CaptureFixture[str]) -> None:
    mistakes = sorted((Path(__file__).parents[1] / "syntax" / "mistakes").glob("*.gl"))
    invoke(["check", "-q", "--no-proofs", "--format", "sarif", *map(str, mistakes)])
    written = json.loads(capsys.readouterr().out)
    assert [error.message for error in Draft4Validator(SCHEMA).iter_errors(written)] == []
    results = written["runs"][0]["results"]
    assert any("fixes" in each for each in results)
    assert any("fixes" not in each for each in results)


@pytest.mark.parametrize("names", [("names", "warnings", "values", "knowledge"), ("everything",), ("missing",)])
def test_logs_follow_the_schema(names: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    files = [str(PROGRAMS / f"{name}.gl") for name in names]
    invoke(["check", "-q", "--no-proofs", "--format", "sarif", "-D", "nothing=3", *files])
    written = json.loads(capsys.readouterr().out)
    assert [error.message for error in Draft4Validator(SCHEMA).iter_errors(written)] == []
    assert written["runs"][0]["results"]
