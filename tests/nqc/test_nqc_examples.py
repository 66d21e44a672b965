"""The behaviours of every example fit its domain, and the whole program compiles for both firmwares."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.cli import invoke
from golc.loading import load

EXAMPLES = Path(__file__).parents[2] / "examples"
ON_BRICKS = [path for path in sorted(EXAMPLES.glob("*/*.gl")) if any(d.kind == "rcx" for d in load(path).devices)]


@pytest.mark.parametrize("target", ["rcx", "rcx2"])
@pytest.mark.parametrize("path", ON_BRICKS, ids=lambda path: path.stem)
def test_the_program_of_an_example_compiles(
    path: Path, target: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    code = invoke(["gen-nqc", str(path), "--target", target, "--compile", "-o", str(tmp_path)])
    assert (code, capfd.readouterr().err) == (0, "")
    assert not list(tmp_path.glob("*stubs*")), "no behaviour is missing"
    assert list(tmp_path.glob("*.rcx"))
