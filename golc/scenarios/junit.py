"""The results of scenarios in the XML format that build servers read as JUnit's."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement, indent, tostring


@dataclass(frozen=True)
class Case:
    """A scenario of a file: ``problem`` is the first line of what is wrong, and ``details`` all of it; none if it went
    well. ``error``: the file has errors, so that nothing was run."""

    file: str
    name: str
    problem: str | None = None
    details: str = ""
    error: bool = False


def report(cases: Sequence[Case]) -> str:
    """The document; without times, so that the same results give the same text."""
    suites = Element("testsuites", _counts(cases))
    for file in dict.fromkeys(case.file for case in cases):
        inside = [case for case in cases if case.file == file]
        suite = SubElement(suites, "testsuite", {"name": file, **_counts(inside)})
        for case in inside:
            element = SubElement(suite, "testcase", classname=file, name=case.name)
            if case.problem is not None:
                problem = SubElement(element, "error" if case.error else "failure", message=_allowed(case.problem))
                problem.text = _allowed(case.details)
    indent(suites)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(suites, encoding="unicode") + "\n"


def _counts(cases: Sequence[Case]) -> dict[str, str]:
    wrong = [case for case in cases if case.problem is not None]
    errors = sum(case.error for case in wrong)
    return {"tests": str(len(cases)), "failures": str(len(wrong) - errors), "errors": str(errors)}


def _allowed(text: str) -> str:
    """The text without the control characters that XML cannot say."""
    return "".join(sign if sign >= " " or sign in "\n\t" else "�" for sign in text)
