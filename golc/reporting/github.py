"""Findings as workflow commands of GitHub, which shows them beside the lines of a pull request."""

from __future__ import annotations

from pathlib import PurePath

from golc.diagnostics import Diagnostic, Severity, Span
from golc.reporting.words import is_file, whole_message

COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}


def annotation(diagnostic: Diagnostic) -> str:
    """One finding as one line ``::error file=…,line=…::message``; columns count from 1, the end is exclusive.

    Columns are left out where the place has several lines: GitHub takes them only within one.
    """
    properties = {**_place(diagnostic.span), "title": f"{diagnostic.code.code}: {diagnostic.code.title}"}
    listed = ",".join(f"{name}={_property(value)}" for name, value in properties.items())
    return f"::{COMMANDS[diagnostic.severity]} {listed}::{_data(whole_message(diagnostic))}"


def _place(span: Span) -> dict[str, str]:
    if not is_file(span.source):
        return {}
    file = {"file": PurePath(span.source.name).as_posix()}
    if not span.source.text:
        return file
    (line, column), (end_line, end_column) = span.source.position(span.start), span.source.position(span.end)
    columns = {"col": column, "endColumn": end_column} if line == end_line else {}
    lines = {"line": line, "endLine": end_line, **columns}
    return {**file, **{name: str(number) for name, number in lines.items()}}


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
