"""``golc check`` as a process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DELIVERY = str(ROOT / "examples" / "delivery" / "delivery.gl")
SPARE = "domain d\nconst spare = 3\nfluent also_spare = true\n"
"""Two declarations that nothing uses: two warnings."""

NAMES = str(ROOT / "tests" / "programs" / "names.gl")


@pytest.fixture
def spare(tmp_path: Path) -> str:
    path = tmp_path / "spare.gl"
    path.write_text(SPARE)
    return str(path)


def golc(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "golc", *arguments]
    return subprocess.run(
        command, capture_output=True, text=True, timeout=60, check=False, env={**os.environ, **environment}
    )


def test_a_sound_domain_has_no_findings() -> None:
    done = golc("check", DELIVERY)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "checked 1 file: nothing found\n")


def test_an_error_is_shown_with_its_place(tmp_path: Path) -> None:
    path = tmp_path / "slip.gl"
    path.write_text("domain slip\nfluent motion = true\naction go:\n    poss motoin\n")
    done = golc("check", str(path))
    assert done.returncode == 1
    assert done.stdout.splitlines() == [
        "error[GL012]: unknown fluent `motoin`",
        f" --> {path}:4:10",
        "  |",
        "4 |     poss motoin",
        "  |          ^^^^^^ not declared",
        "  |",
        "2 | fluent motion = true",
        "  |        ------ a fluent with a similar name is declared here",
        "  = help: did you mean `motion`?",
        "",
    ]
    assert done.stderr == "checked 1 file: 1 error\n"


def test_warnings_count_only_when_they_are_asked_to(spare: str) -> None:
    assert golc("check", spare).returncode == 0
    done = golc("check", "--strict", spare)
    assert done.returncode == 1
    assert done.stderr == "checked 1 file: 2 warnings\n"


def test_all_files_are_checked_whatever_is_wrong_with_one(tmp_path: Path) -> None:
    broken = tmp_path / "broken.gl"
    broken.write_bytes(b"domain d\nfluent \xff = true\n")
    done = golc("check", str(tmp_path / "missing.gl"), str(broken), str(tmp_path), NAMES, DELIVERY)
    assert done.returncode == 1
    heads = [line for line in done.stdout.splitlines() if "[GL001]" in line]
    assert [head.rpartition(": ")[2] for head in heads] == [
        "there is no such file",
        "byte 17 is 0xff",
        "it is a directory",
    ]
    assert "unknown fluent `motoin`" in done.stdout
    assert done.stderr.startswith("checked 5 files: ")


def test_json_says_the_same(spare: str) -> None:
    done = golc("check", "--format", "json", spare, DELIVERY)
    found = json.loads(done.stdout)
    assert (found["errors"], found["warnings"], len(found["findings"])) == (0, 2, 2)
    assert found["findings"][0]["code"] == "GL027"
    assert found["findings"][0]["span"] == {
        "file": spare,
        "line": 2,
        "column": 7,
        "end_line": 2,
        "end_column": 12,
    }


def test_json_of_nothing_is_json() -> None:
    found = json.loads(golc("check", "--format", "json", DELIVERY).stdout)
    assert found.pop("questions") > 0
    assert found == {"findings": [], "errors": 0, "warnings": 0, "fixed": 0, "undecided": 0}


def test_a_constant_may_be_replaced(tmp_path: Path) -> None:
    path = tmp_path / "floors.gl"
    path.write_text("domain d\nconst floors = 6\nfluent at: 1..floors = 6\naction go:\n    causes at := 1\n")
    assert golc("check", "-D", "floors=9", str(path)).returncode == 0
    done = golc("check", "-D", "floors = 5", str(path))
    assert done.returncode == 1
    assert "`6` is outside `1..5`" in done.stdout
    done = golc("check", "-D", "flors=5", str(path))
    assert done.returncode == 1
    assert done.stdout.startswith(
        "error[GL024]: `flors` is not declared, so that `-D` cannot replace it\n --> -D flors:1:1"
    )
    assert golc("check", "-D", "floors", str(path)).returncode == 2


def test_quiet_says_only_what_is_wrong_and_verbose_says_more() -> None:
    assert golc("check", "-q", DELIVERY).stderr == ""
    assert "5 fluents, 9 actions" in golc("check", "-v", DELIVERY).stderr


def test_color_is_for_those_who_ask(spare: str) -> None:
    assert "\x1b[" not in golc("check", spare).stdout
    assert "\x1b[1;33mwarning[GL027]" in golc("check", "--color", "always", spare).stdout


def test_usage_errors_end_with_2() -> None:
    assert golc("check").returncode == 2
    assert golc("check", "--fromat", "json", DELIVERY).returncode == 2
    assert golc("check", "--format", "xml", DELIVERY).returncode == 2


def test_an_encoding_without_the_characters_is_no_obstacle(tmp_path: Path) -> None:
    path = tmp_path / "wide.gl"
    path.write_text('domain d\nfluent x = "日本"\n', encoding="utf-8")
    done = golc("check", str(path), PYTHONIOENCODING="ascii")
    assert done.returncode == 1
    assert "\\u65e5\\u672c" in done.stdout


def test_a_large_file_is_checked(tmp_path: Path) -> None:
    path = tmp_path / "large.gl"
    path.write_text("domain large\n" + "".join(f"fluent f{n}: 1..9 = {n % 9 + 1}\n" for n in range(1000)))
    done = golc("check", "--strict", str(path))
    assert done.stderr == "checked 1 file: 1000 warnings\n"


def test_help_has_an_example() -> None:
    done = golc("check", "--help")
    assert done.returncode == 0
    assert "golc check examples/delivery/delivery.gl" in done.stdout


@pytest.fixture
def full(tmp_path: Path) -> Path:
    """A device that takes nothing, and no file of the machine's that a fault could replace."""
    if not Path("/dev/full").is_char_device():
        pytest.skip("the system has no device that is always full")
    link = tmp_path / "full"
    link.symlink_to("/dev/full")
    return link


@pytest.mark.parametrize("arguments", [("check",), ("--help",), ("--version",), ("check", "--help")])
def test_output_that_nobody_can_store_is_said(arguments: tuple[str, ...], spare: str, full: Path) -> None:
    rest = (spare,) if arguments == ("check",) else ()
    with full.open("w") as stdout:
        done = subprocess.run(
            [sys.executable, "-m", "golc", *arguments, *rest],
            stdout=stdout,
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
            check=False,
        )
    assert (done.returncode, done.stderr) == (4, "error: cannot write the output: No space left on device\n")


def test_errors_that_nobody_can_store_leave_the_exit_code(spare: str, full: Path) -> None:
    with full.open("w") as stderr:
        command = [sys.executable, "-m", "golc", "check"]
        assert subprocess.run(command, stderr=stderr, timeout=60, check=False).returncode == 2
        done = subprocess.run(
            [*command, "--strict", spare], stdout=subprocess.DEVNULL, stderr=stderr, timeout=60, check=False
        )
        assert done.returncode == 1


def test_closed_streams_are_no_fault(spare: str) -> None:
    command = f'"{sys.executable}" -m golc check --strict "{spare}" <&- >&- 2>&-'
    assert subprocess.run(command, shell=True, timeout=60, check=False).returncode == 1


def test_a_reader_that_has_gone_ends_it(spare: str) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "w") as stdout:
        command = [sys.executable, "-m", "golc", "check", spare]
        done = subprocess.run(command, stdout=stdout, stderr=subprocess.PIPE, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (141, "")


def test_a_name_of_nothing_is_no_directory() -> None:
    done = golc("check", "", "-q")
    assert (done.returncode, done.stdout.splitlines()[0]) == (1, "error[GL001]: cannot read ``: a file has a name")


@pytest.fixture
def trusting(tmp_path: Path) -> str:
    """A domain with a constant from Python, whose file says when it is executed."""
    path = tmp_path / "far.gl"
    path.write_text(
        'domain far\nconst far = steps(2)\nextern steps(n: int): int from "steps.py"\nfluent x: int = far\n'
    )
    (tmp_path / "steps.py").write_text("import sys\nprint('here', file=sys.stderr)\ndef steps(n): return 3 * n\n")
    return str(path)


def test_python_code_is_executed_only_with_trust(trusting: str) -> None:
    done = golc("check", "--strict", trusting)
    assert done.returncode == 0
    assert done.stdout.startswith("note[GL034]: this has no value yet: it depends on `steps`, and ")
    assert done.stderr == "checked 1 file: 1 note\n"


def test_executing_python_code_is_said_once(trusting: str) -> None:
    python = trusting.replace("far.gl", "steps.py")
    done = golc("check", "--trust", trusting, trusting)
    assert "GL034" not in done.stdout
    assert done.stderr == f"executes {python}\nhere\nhere\nchecked 2 files: 2 warnings\n"

    done = golc("check", "--trust", "-q", trusting)
    assert done.stderr == "here\n"


@pytest.mark.parametrize("command", ["plan", "test", "explain", "run"])
def test_commands_that_need_values_execute_python_code_and_say_so(trusting: str, command: str) -> None:
    done = golc(command, trusting, *({"explain": ["x"], "plan": ["--goal", "x = 6"]}.get(command, [])))
    assert done.stderr.startswith(f"executes {trusting.replace('far.gl', 'steps.py')}\nhere\n")
