"""Slips that the classic interpreters pass over in silence, each seeded into the delivery domain."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.diagnostics import Diagnostic, Severity
from golc.loading import examine

DELIVERY = (Path(__file__).parents[2] / "examples/delivery/delivery.gl").read_text()


def seeded(tmp_path: Path, old: str, new: str) -> tuple[Diagnostic, ...]:
    """What is found in the delivery domain with one slip: the first of ``old`` replaced by ``new``."""
    assert old in DELIVERY
    path = tmp_path / "delivery.gl"
    path.write_text(DELIVERY.replace(old, new, 1))
    return examine(path).findings


def place(diagnostic: Diagnostic) -> str:
    """The line of a finding, with the marked part between arrows."""
    span = diagnostic.span
    line, column = span.source.line(span.line), span.column - 1
    end = column + span.end - span.start
    return f"{line[:column]}»{line[column:end]}«{line[end:]}".strip()


def test_the_delivery_domain_has_no_findings(tmp_path: Path) -> None:
    path = tmp_path / "delivery.gl"
    path.write_text(DELIVERY)
    examined = examine(path)
    theory, diagnostics = examined.theory, examined.findings
    assert theory is not None
    assert diagnostics == ()


@pytest.mark.parametrize(
    ("old", "new", "message", "where", "help_"),
    [
        pytest.param(
            "causes motion := moving",
            "causes motoin := moving",
            "unknown fluent `motoin`",
            "causes »motoin« := moving",
            "did you mean `motion`?",
            id="fluent in an effect",
        ),
        pytest.param(
            "when delivery_requested(location) = m",
            "when delivery_requsted(location) = m",
            "unknown fluent `delivery_requsted`",
            "causes forall m: station where m != location. holding_delivery_for(m) := true when "
            "»delivery_requsted«(location) = m",
            "did you mean `delivery_requested`?",
            id="fluent in an effect's condition",
        ),
        pytest.param(
            "poss motion = stopped",
            "poss moton = stopped",
            "unknown fluent `moton`",
            "poss »moton« = stopped",
            "did you mean `motion`?",
            id="fluent in a precondition",
        ),
        pytest.param(
            "on motion = suspended:",
            "on mtion = suspended:",
            "unknown fluent `mtion`",
            "on »mtion« = suspended:",
            "did you mean `motion`?",
            id="fluent in an interrupt's condition",
        ),
        pytest.param(
            "causes location := location + direction",
            "causes location := location + directoin",
            "unknown fluent `directoin`",
            "causes location := location + »directoin«",
            "did you mean `direction`?",
            id="fluent in arithmetic",
        ),
        pytest.param(
            "        head_for(n)",
            "        had_for(n)",
            "unknown procedure `had_for`",
            "»had_for«(n)",
            "did you mean `head_for`?",
            id="procedure in a call",
        ),
        pytest.param(
            "poss motion = stopped",
            "poss motion = stoped",
            "unknown value `stoped`",
            "poss motion = »stoped«",
            "did you mean `stopped`?",
            id="value",
        ),
    ],
)
def test_a_misspelt_name_is_found(tmp_path: Path, old: str, new: str, message: str, where: str, help_: str) -> None:
    (finding,) = seeded(tmp_path, old, new)
    assert (finding.message, place(finding), finding.help) == (message, where, help_)
    assert "similar name is declared here" in finding.labels[0].text


def test_a_missing_action_is_found_once(tmp_path: Path) -> None:
    action = "action signal_arrival\n"
    (finding,) = seeded(tmp_path, action, "")
    assert finding.message == "unknown action or procedure `signal_arrival`"
    assert place(finding) == "»signal_arrival«"
    assert finding.help == "declare it: `action signal_arrival`, or `proc signal_arrival: …`"


def test_a_missing_fluent_is_found_once(tmp_path: Path) -> None:
    (finding,) = seeded(tmp_path, "fluent motion: phase = stopped\n", "")
    assert finding.message == "unknown name `motion`"
    assert finding.severity is Severity.ERROR
    assert place(finding) == "poss »motion« = stopped"
    assert finding.notes[0].startswith("also used in lines 22, 23, ")


def test_a_missing_initial_value_is_found(tmp_path: Path) -> None:
    (finding,) = seeded(tmp_path, "fluent motion: phase = stopped", "fluent motion: phase")
    assert finding.message == "fluent `motion` has no initial value"
    assert place(finding) == "fluent »motion«: phase"


def test_a_wrong_arity_of_an_exogenous_action_is_found(tmp_path: Path) -> None:
    (finding,) = seeded(tmp_path, "    5 push_go_button", "    5 push_go_button(3)")
    assert finding.message == "`push_go_button` takes no arguments, not 1"
    assert place(finding) == "5 »push_go_button«(3)"


def test_a_wrong_arity_of_an_exogenous_action_in_a_condition_is_found(tmp_path: Path) -> None:
    (finding,) = seeded(tmp_path, "on location > 1:", "on poss(request_delivery(location)):")
    assert finding.message == "`request_delivery` takes 2 arguments, not 1"


def test_the_idle_interrupt_placed_first_is_found(tmp_path: Path) -> None:
    (finding,) = seeded(tmp_path, "    interrupts:\n", "    interrupts:\n        on true:\n            wait\n")
    assert finding.severity is Severity.WARNING
    assert finding.message == "`on true` stands above other interrupts, which are never reached"
    assert place(finding) == "on »true«:"
    assert finding.labels[0].span.text == "motion = suspended"


def test_an_interrupt_below_a_more_general_one_is_found(tmp_path: Path) -> None:
    general = '        on location > 1:\n            say "home"\n        on location > 1 and direction = 1:\n'
    (finding,) = seeded(tmp_path, "        on location > 1:\n", general)
    assert finding.message == "this interrupt is never reached: whenever it could fire, a higher one does"
    assert place(finding) == "on »location > 1 and direction = 1«:"


def test_a_general_interrupt_that_may_not_begin_is_no_finding(tmp_path: Path) -> None:
    general = "        on location > 1:\n            turnaround\n        on location > 1 and direction = 1:\n"
    assert seeded(tmp_path, "        on location > 1:\n", general) == ()


def test_several_slips_are_all_found(tmp_path: Path) -> None:
    path = tmp_path / "delivery.gl"
    path.write_text(DELIVERY.replace("motion = stopped", "motoin = stoped"))
    findings = examine(path).findings
    assert [finding.message for finding in findings] == ["unknown fluent `motoin`", "unknown value `stoped`"]
    assert all(finding.notes[0].startswith("also used in lines ") for finding in findings)


def test_a_name_that_is_misspelt_where_it_is_declared_is_one_finding(tmp_path: Path) -> None:
    (finding,) = seeded(tmp_path, "fluent location", "fluent locaton")
    assert (finding.message, place(finding)) == (
        "unknown fluent `location`",
        "poss motion in {stopped, suspended} and »location« + direction in station",
    )
    assert finding.help == "declare it by the name `location`: nothing uses `locaton`"
    assert finding.notes[0].startswith("also used in lines ")
