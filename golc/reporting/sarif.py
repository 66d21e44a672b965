"""Findings as a log in SARIF 2.1.0 (OASIS), the format in which code hosts and editors exchange them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any
from urllib.parse import quote

from golc.codes.pages import page
from golc.diagnostics import Code, Diagnostic, Edit, Fix, Source, Span
from golc.reporting.words import is_file, whole_message

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"


def log(findings: Iterable[Diagnostic], counts: Mapping[str, Any]) -> dict[str, Any]:
    """A log with one run: every code as a rule, every finding as a result; ``counts`` are properties of the run."""
    driver = {"name": "golc", "version": version("golc"), "rules": [_rule(code) for code in Code]}
    ranks = {code: rank for rank, code in enumerate(Code)}
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(finding, ranks[finding.code]) for finding in findings],
        "properties": dict(counts),
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _rule(code: Code) -> dict[str, Any]:
    explained = page(code)
    return {
        "id": code.code,
        "name": _camel(code.name),
        "shortDescription": {"text": f"{code.title}."},
        "fullDescription": {"text": explained.meaning},
        "help": {"text": explained.meaning, "markdown": explained.text},
    }


def _camel(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("_"))


def _result(finding: Diagnostic, rank: int) -> dict[str, Any]:
    result = {
        "ruleId": finding.code.code,
        "ruleIndex": rank,
        "level": finding.severity.value,
        "message": {"text": whole_message(finding), "markdown": _markdown(finding)},
        "locations": [_location(finding.span, finding.marker)],
    }
    if finding.labels:
        result["relatedLocations"] = [
            {"id": number, **_location(label.span, label.text)} for number, label in enumerate(finding.labels, start=1)
        ]
    if finding.fix is not None:
        result["fixes"] = [_fix(finding.fix)]
    return result


def _fix(fix: Fix) -> dict[str, Any]:
    """Every fix changes the one file of its finding."""
    replacements = [_replacement(edit) for edit in fix.edits]
    change = {"artifactLocation": {"uri": _uri(fix.edits[0].span.source)}, "replacements": replacements}
    return {"description": {"text": fix.does}, "artifactChanges": [change]}


def _replacement(edit: Edit) -> dict[str, Any]:
    return {"deletedRegion": _region(edit.span), "insertedContent": {"text": edit.text}}


def _markdown(finding: Diagnostic) -> str:
    notes = [f"- note: {note}" for note in finding.notes]
    help_ = [] if finding.help is None else [f"**Help:** {finding.help}"]
    return "\n\n".join(part for part in (finding.message, "\n".join(notes), *help_) if part)


def _location(span: Span, text: str) -> dict[str, Any]:
    said = {"message": {"text": text}} if text else {}
    if not is_file(span.source):
        return {"logicalLocations": [{"fullyQualifiedName": span.source.name}], **said}
    place: dict[str, Any] = {"artifactLocation": {"uri": _uri(span.source)}}
    if span.source.text:
        place["region"] = {**_region(span), "snippet": {"text": span.text}}
    return {"physicalLocation": place, **said}


def _region(span: Span) -> dict[str, Any]:
    (line, column), (end_line, end_column) = span.source.position(span.start), span.source.position(span.end)
    return {"startLine": line, "startColumn": column, "endLine": end_line, "endColumn": end_column}


def _uri(source: Source) -> str:
    path = Path(source.name)
    return path.as_uri() if path.is_absolute() else quote(path.as_posix())
