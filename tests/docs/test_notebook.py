"""The notebook of the manual: it is executed in a real kernel, and shows what the text around its cells says."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import nbformat
import pytest
from nbclient import NotebookClient

DOCS = Path(__file__).parents[2] / "docs"
NOTEBOOK = DOCS / "notebook.ipynb"

Outputs = Mapping[str, Mapping[str, str]]
"""By the id of the cell and the kind of output; what was printed is ``text``."""


def notebook() -> Any:
    """The notebook as it is stored; raises ``ValidationError`` if it is none."""
    read = nbformat.read(NOTEBOOK, 4)  # type: ignore[no-untyped-call]
    nbformat.validate(read)
    return read


def test_its_outputs_are_cleared() -> None:
    cells = [cell for cell in notebook().cells if cell.cell_type == "code"]
    assert [cell.id for cell in cells if cell.outputs or cell.execution_count is not None] == []


@pytest.fixture(scope="module")
def outputs() -> Outputs:
    """What the cells show when they are executed in order; an error of one fails the test."""
    book = notebook()
    NotebookClient(book, timeout=200, kernel_name="python3", resources={"metadata": {"path": str(DOCS)}}).execute()
    return {cell.id: _shown(cell) for cell in book.cells if cell.cell_type == "code"}


def _shown(cell: Any) -> dict[str, str]:
    shown: dict[str, str] = {}
    for output in cell.outputs:
        assert output.get("name") != "stderr", output.text
        if output.output_type == "stream":
            shown["text"] = shown.get("text", "") + output.text
        else:
            shown |= {kind: data for kind, data in output.data.items() if isinstance(data, str)}
    return shown


def test_states_and_actions(outputs: Outputs) -> None:
    assert outputs["possible"]["text/plain"] == "['up', 'down', 'open', 'close']"
    assert outputs["do"]["text/plain"] == "(2, True, False)"
    assert outputs["why-not"]["text"] == "`at = n` is false {'at': 2, 'n': 5}\n"
    assert outputs["asked"]["text/plain"] == "(True, 3, frozenset({2, 5, 9}))"


def test_plans(outputs: Outputs) -> None:
    assert outputs["goal"]["text/plain"] == "<Plan: up, up, off(5)>"
    assert outputs["walk"]["text/plain"] == "[3, 2, 2, 2, 2]"
    assert outputs["loop"]["text"] == "5 2\n6 3\n7 4\n8 5\n"
    assert outputs["branches"]["text/plain"] == "<Plan: look, 2 cases>"
    # Eight worlds but the one in which all are closed; where one is closed, four but that one.
    assert outputs["look"]["text/plain"] == "(7, 3, 'closed', Unknown(values=('open', 'closed')))"


def test_a_theory_of_a_cell(outputs: Outputs) -> None:
    # Three actions are the fewest; among these plans the first takes `right` first.
    assert outputs["cart"]["text/plain"] == "<Plan: right, jump(4), jump(6)>"


def test_an_error_has_its_place(outputs: Outputs) -> None:
    assert outputs["error"]["text"].startswith("error[GL111]: `drive_in` is not possible in this state\n")
    assert "`gate(at) = open` is false (gate(middle) = closed, at = middle)" in outputs["error"]["text"]


def test_the_run_serves_everybody_and_drives_home(outputs: Outputs) -> None:
    # Two deliveries at first, one that is asked for, fetched and brought: four stops.
    assert outputs["heard"]["text/plain"] == "(4, 1, False)"
    assert outputs["check"]["text/plain"] == "<Report: nothing found>"


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        ("load", "<b>elevator</b>"),
        ("initial", "true for 2, 5, 9"),
        ("program", "<li>open</li>"),
        ("gates", "7 possible worlds"),
        ("branches", "<li>gate(middle) = open:<ol"),
        ("run", "start_to_next_station"),
        ("check", "nothing found"),
    ],
)
def test_values_show_themselves(outputs: Outputs, cell: str, text: str) -> None:
    assert text in outputs[cell]["text/html"]
