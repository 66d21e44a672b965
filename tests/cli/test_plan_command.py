from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from golc.cli import invoke
from golc.diagnostics import LimitError
from golc.planning.limits import Budget, Limits

ROOT = Path(__file__).parents[2]
ELEVATOR = str(ROOT / "examples" / "elevator" / "elevator.gl")
LIFT = str(ROOT / "tests" / "programs" / "lift.gl")


def golc(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "golc", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)


def test_a_plan_is_printed_one_action_a_line() -> None:
    done = golc("plan", LIFT)
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "down(3)",
        "turnoff(3)",
        "open",
        "close",
        "up(5)",
        "turnoff(5)",
        "open",
        "close",
        "down(0)",
        "open",
    ]
    assert done.stderr == "1 plan\n"


def test_all_plans_have_headings() -> None:
    done = golc("plan", LIFT, "--all")
    assert done.returncode == 0
    assert [line for line in done.stdout.splitlines() if line.startswith("#")] == [
        "# plan 1: 10 actions",
        "# plan 2: 10 actions",
    ]


def test_only_so_many_plans() -> None:
    done = golc("plan", LIFT, "--all", "1", "--format", "json")
    assert done.returncode == 0
    document = json.loads(done.stdout)
    assert document["outcome"] == "found"
    assert [len(plan) for plan in document["plans"]] == [10]
    assert document["plans"][0][0] == {"action": "down", "args": [3]}


def test_a_procedure_may_have_arguments() -> None:
    assert golc("plan", LIFT, "go(6)").stdout == "up(6)\n"


def test_a_program_that_would_end_itself_is_named(tmp_path: Path) -> None:
    file = tmp_path / "doubt.gl"
    file.write_text('domain doubt\nproc control:\n    abort "no way"\n')
    done = golc("plan", str(file))
    assert done.returncode == 1
    assert f"{file}:3:5: the program would end itself as failed here" in done.stderr


def test_no_plan_says_how_far_it_came_and_why() -> None:
    done = golc("plan", ELEVATOR, "handle(3)")
    assert done.returncode == 1
    assert done.stdout == ""
    lines = done.stderr.splitlines()
    assert lines[0] == "no plan for `handle(3)`: proven: it cannot be executed to its end"
    assert lines[1].startswith("the longest way was: up, up, open, close, off(5); there")
    assert any("`left > 0` is false" in line for line in lines)


def test_giving_up_is_not_proving() -> None:
    for limit in (["--nodes", "5"], ["--steps", "3"]):
        done = golc("plan", ELEVATOR, "smart" if limit[0] == "--nodes" else "handle(25)", *limit)
        assert done.returncode == 3
        assert done.stderr.startswith("no plan for `")


def test_the_clock_is_looked_at_before_each_step_however_long_it_takes() -> None:
    with pytest.raises(LimitError, match=r"gave up after 0 s \(1 pairs expanded\)"):
        Budget(Limits(seconds=0)).spend()


def test_a_memory_that_is_full_is_a_limit(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def fill(**options: object) -> None:
        raise MemoryError

    monkeypatch.setattr("golc.cli.cli.main", fill)
    assert invoke(["plan"]) == 3
    assert capsys.readouterr().err == "error: gave up: there is no memory left\n"


def test_a_constant_may_be_replaced() -> None:
    done = golc("plan", ELEVATOR, "go_to(12)", "-D", "top=12")
    assert done.stdout.split() == ["up"] * 9


def test_a_plan_may_go_to_a_file(tmp_path: Path) -> None:
    file = tmp_path / "plan.txt"
    done = golc("plan", LIFT, "go(6)", "-o", str(file))
    assert (done.returncode, done.stdout, file.read_text()) == (0, "", "up(6)\n")


def test_a_file_that_cannot_be_written_is_a_usage_error(tmp_path: Path) -> None:
    done = golc("plan", LIFT, "go(6)", "-o", str(tmp_path / "missing" / "plan.txt"))
    assert done.returncode == 1
    assert "No such file or directory" in done.stderr
    assert "Traceback" not in done.stderr


def test_an_unknown_procedure_is_named_with_a_proposal() -> None:
    done = golc("plan", ELEVATOR, "parc")
    assert done.returncode == 1
    assert "unknown procedure `parc`" in done.stderr
    assert "did you mean `park`?" in done.stderr


def test_a_wrong_argument_is_told() -> None:
    done = golc("plan", ELEVATOR, "serve(11)")
    assert done.returncode == 1
    assert "`n` of `serve` is of type floor (1..10), not `11`" in done.stderr


def test_first_and_all_exclude_each_other() -> None:
    done = golc("plan", ELEVATOR, "--first", "--all")
    assert done.returncode == 2
    assert "--first and --all exclude each other" in done.stderr


def test_statistics_are_printed_on_request() -> None:
    done = golc("plan", LIFT, "--stats")
    assert "1 plan, " in done.stderr
    assert "expanded in" in done.stderr


def test_an_error_while_planning_has_its_place(tmp_path: Path) -> None:
    domain = tmp_path / "d.gl"
    domain.write_text(
        "domain d\ntype t = 1..3\nfluent x: t = 1\naction inc:\n    causes x := x + 1\nproc control:\n"
        "    while true:\n        inc\n"
    )
    done = golc("plan", str(domain))
    assert done.returncode == 5
    assert "GL101" in done.stderr
    assert f"{domain}:5:17" in done.stderr
    assert "`x` would be 4, which is outside `t` (1..3)" in done.stderr


def test_a_goal_needs_no_program() -> None:
    done = golc("plan", ELEVATOR, "--goal", "at = 5 and not lit(5)", "--format", "json")
    assert done.returncode == 0
    plan = [{"action": "up", "args": []}, {"action": "up", "args": []}, {"action": "off", "args": [5]}]
    assert json.loads(done.stdout)["plans"] == [plan]


def test_a_goal_that_cannot_be_reached_or_is_no_formula() -> None:
    done = golc("plan", ELEVATOR, "--goal", "lit(3)", "-D", "top=3")
    assert done.returncode == 1
    assert done.stderr.startswith("no plan for `lit(3)`: proven: no sequence of actions makes it true\n")
    assert golc("plan", ELEVATOR, "--goal", "lit(3)", "--nodes", "5").returncode == 3
    assert golc("plan", ELEVATOR, "--goal", "lit(3").returncode == 1
    assert golc("plan", ELEVATOR, "basic", "--goal", "lit(3)").returncode == 2
    assert golc("plan", ELEVATOR, "--all", "--goal", "lit(3)").returncode == 2


CHOICE = """domain choice
action walk(n: 1..3):
    cost 2 * n
action ride:
    cost 5
proc control:
    choose:
        walk(1)
        walk(2)
    or:
        walk(1)
        walk(1)
        walk(1)
        test false
    or:
        ride
        skip
    or:
        walk(1)
        walk(1)
"""


def test_the_shortest_and_the_cheapest_plan(tmp_path: Path) -> None:
    file = tmp_path / "choice.gl"
    file.write_text(CHOICE)
    assert golc("plan", str(file)).stdout.split() == ["walk(1)", "walk(2)"]
    assert golc("plan", str(file), "--shortest").stdout.split() == ["ride"]
    done = golc("plan", str(file), "--cheapest", "--stats")
    assert done.stdout.split() == ["walk(1)", "walk(1)"]
    assert done.stderr.startswith("1 plan of cost 4, ")
    document = json.loads(golc("plan", str(file), "--cheapest", "--format", "json").stdout)
    assert (document["outcome"], document["cost"]) == ("found", 4)


def test_a_plan_within_its_bound_is_a_success(tmp_path: Path) -> None:
    file = tmp_path / "choice.gl"
    file.write_text(CHOICE)
    for strategy in ("--first", "--shortest", "--cheapest"):
        done = golc("plan", str(file), strategy, "--steps", "1")
        assert (done.returncode, done.stdout, done.stderr) == (0, "ride\n", "1 plan\n")


def test_strategies_exclude_each_other() -> None:
    done = golc("plan", ELEVATOR, "--shortest", "--cheapest")
    assert done.returncode == 2
    assert "--shortest and --cheapest exclude each other" in done.stderr


def test_a_pipe_is_written_to_and_stays(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen([sys.executable, "-m", "golc", "plan", LIFT, "go(6)", "-o", str(pipe)]) as writer:
        assert pipe.read_text() == "up(6)\n"
        assert writer.wait(60) == 0
    assert pipe.is_fifo()


def test_a_link_stays_and_its_file_keeps_its_mode(tmp_path: Path) -> None:
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("an older plan\n")
    target.chmod(0o640)
    link.symlink_to(target)
    assert golc("plan", LIFT, "go(6)", "-o", str(link)).returncode == 0
    assert link.is_symlink()
    assert (target.read_text(), target.stat().st_mode & 0o777) == ("up(6)\n", 0o640)


def test_files_beside_the_plan_stay(tmp_path: Path) -> None:
    beside = tmp_path / "plan.part"
    beside.write_text("somebody else's\n")
    assert golc("plan", LIFT, "go(6)", "-o", str(tmp_path / "plan")).returncode == 0
    assert beside.read_text() == "somebody else's\n"
    assert {path.name for path in tmp_path.iterdir()} == {"plan", "plan.part"}


def test_a_long_name_is_a_name(tmp_path: Path) -> None:
    assert golc("plan", LIFT, "go(6)", "-o", str(tmp_path / ("x" * 253))).returncode == 0
    done = golc("plan", LIFT, "go(6)", "-o", str(tmp_path / ("x" * 256)))
    assert (done.returncode, "File name too long" in done.stderr, "Traceback" in done.stderr) == (1, True, False)


@pytest.mark.parametrize("options", [("--time", "nan"), ("--time", "inf"), ("--all", "1" + 30 * "0"), ("-o", "")])
def test_numbers_and_names_that_are_none_are_wrong_usage(options: tuple[str, str]) -> None:
    done = golc("plan", LIFT, "go(6)", *options)
    assert (done.returncode, "Traceback" in done.stderr) == (2, False)


GATES = """domain gates
type side = {north, south}
type state = {open, shut}
fluent gate(s: side): state = unknown
fluent outside: bool = false
fluent warned: bool = false
action look(s: side):
    senses gate(s)
action ask:
    senses gate(north)
    senses gate(south) = open
action pass(s: side):
    poss gate(s) = open
    causes outside := true
action push(s: side):
    causes gate(s) := open
    cost 3
exog ring expected:
    poss not warned
    causes warned := true
goal out: outside
proc control:
    look(north)
    wait until warned
    if gate(north) = shut:
        push(north)
    pass(north)
proc asking:
    ask
    pick s: side:
        pass(s)
proc both:
    ask
    if gate(north) = open or gate(south) = open:
        skip
    else:
        push(south)
"""


@pytest.fixture
def gates(tmp_path: Path) -> str:
    file = tmp_path / "gates.gl"
    file.write_text(GATES)
    return str(file)


def test_a_conditional_plan_is_indented(gates: str) -> None:
    done = golc("plan", gates)
    assert (done.returncode, done.stderr) == (0, "1 plan\n")
    assert done.stdout == (
        "look(north)\n"
        "gate(north) = open:\n"
        "    … ring\n"
        "    pass(north)\n"
        "gate(north) = shut:\n"
        "    … ring\n"
        "    push(north)\n"
        "    pass(north)\n"
    )


def test_a_branch_without_a_step_says_so_and_all_results_are_named(gates: str) -> None:
    assert golc("plan", gates, "both").stdout.splitlines() == [
        "ask",
        "gate(north) = open, (gate(south) = open) = true: nothing more",
        "gate(north) = open, (gate(south) = open) = false: nothing more",
        "gate(north) = shut, (gate(south) = open) = true: nothing more",
        "gate(north) = shut, (gate(south) = open) = false:",
        "    push(south)",
    ]


def test_a_conditional_plan_as_json(gates: str) -> None:
    [plan] = json.loads(golc("plan", gates, "--format", "json").stdout)["plans"]
    ring = {"expected": "ring", "args": []}
    push, through = ({"action": name, "args": ["north"]} for name in ("push", "pass"))
    branches = [
        {"results": ["open"], "plan": [ring, through]},
        {"results": ["shut"], "plan": [ring, push, through]},
    ]
    assert plan == [{"action": "look", "args": ["north"], "senses": ["gate(north)"], "branches": branches}]


def test_a_conditional_plan_as_a_graph(gates: str) -> None:
    text = golc("plan", gates, "--format", "dot", "-q").stdout
    assert text.startswith("digraph plans {\n") and text.endswith("}\n")
    nodes = dict(re.findall(r'^    (n\d+) \[label="([^"]*)"', text, re.MULTILINE))
    edges = re.findall(r'^    (\w+) -> (\w+)(?: \[label="(.*)"\])?;', text, re.MULTILINE)
    named = sorted((nodes.get(a, a), nodes.get(b, b), label) for a, b, label in edges)
    assert named == [
        ("begin1", "look(north)", ""),
        ("look(north)", "… ring", "gate(north) = open"),
        ("look(north)", "… ring", "gate(north) = shut"),
        ("pass(north)", "end1", ""),
        ("pass(north)", "end1", ""),
        ("push(north)", "pass(north)", ""),
        ("… ring", "pass(north)", ""),
        ("… ring", "push(north)", ""),
    ]
    assert text.count("style=dashed") == 2


def test_graphs_of_several_plans_stand_beside_each_other() -> None:
    text = golc("plan", LIFT, "--all", "--format", "dot", "-q").stdout
    assert [line.strip() for line in text.splitlines() if 'label="plan' in line] == [
        'label="plan 1";',
        'label="plan 2";',
    ]
    assert text.count("{") == text.count("}") == 3


def test_the_result_that_has_no_way_is_named(gates: str) -> None:
    done = golc("plan", gates, "asking")
    assert done.returncode == 1
    lines = done.stderr.splitlines()
    assert lines[0] == "no plan for `asking`: proven: it cannot be executed to its end"
    assert lines[1] == "the longest way was: ask (gate(north) = shut, (gate(south) = open) = false); there"
    assert lines[2].endswith("`pass(north)` is not possible: `gate(s) = open` is false (gate(north) = shut, s = north)")


def test_a_conformant_plan_makes_no_use_of_results(gates: str) -> None:
    for options in (["--goal", "out"], ["--goal", "out", "--shortest"]):
        assert golc("plan", gates, *options, "--conformant").stdout == "push(north)\npass(north)\n"
    assert golc("plan", gates, "asking", "--conformant").returncode == 1
    assert golc("plan", gates, "asking", "--conformant", "--all", "--cheapest").returncode == 2


def test_plans_that_branch_are_not_listed(gates: str) -> None:
    done = golc("plan", gates, "--all")
    assert done.returncode == 2
    assert "those that do not are listed with --conformant" in done.stderr


def test_the_cost_is_that_of_the_dearest_branch(gates: str) -> None:
    done = golc("plan", gates, "--cheapest", "--stats")
    assert done.stderr.startswith("1 plan of cost 5, ")


@pytest.mark.parametrize(("color", "head"), [("always", "\x1b[1;31merror[GL012]\x1b[0m"), ("never", "error[GL012]: ")])
def test_what_ends_a_command_has_the_color_that_was_asked_for(
    color: str, head: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "wrong.gl").write_text("domain wrong\nproc control:\n    test x\n    test y\n")
    assert invoke(["plan", str(tmp_path / "wrong.gl"), "--color", color]) == 1
    first, _, second = capsys.readouterr().err.partition("\n\n")
    assert (first.startswith(head), second.startswith(head)) == (True, True)
