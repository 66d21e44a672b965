"""What a brick has room for, seen before anything is compiled: nqc says less about it, and at the wrong place."""

from __future__ import annotations

from golc.diagnostics import Code, Findings, Label, Span
from golc.nqc.behaviours import Wanted, reach, wanted
from golc.nqc.program import Program
from golc.nqc.source import Kind, NqcSource
from golc.nqc.toolchain import SUBS, TASKS, VARIABLES, Target
from golc.nqc.words import HOOKS
from golc.theory.theory import ByCall, ByStart

LOOP_VARIABLES = 13
"""Variables of the event loop."""

LOOP_TASKS = ("main", "golc_worker")


def check_limits(
    program: Program, user: NqcSource, stubs: tuple[Wanted, ...], target: Target, where: Span, findings: Findings
) -> None:
    """Find more tasks, subs or variables than a brick has, and subs that two tasks cannot share."""
    own = [task.name for task in user.of(Kind.TASK)] + [stub.name for stub in stubs if stub.kind is ByStart]
    tasks = [*LOOP_TASKS, *own]
    if len(tasks) > TASKS:
        findings.error(
            Code.NQC_LIMIT,
            f"the program has {len(tasks)} tasks, but a brick has {TASKS}",
            where,
            notes=(f"they are {', '.join(tasks)}",),
            help="let behaviours that never run at once share a task, or call them instead of starting them",
        )
    subs = user.of(Kind.SUB)
    if len(subs) > SUBS:
        findings.error(
            Code.NQC_LIMIT,
            f"the program has {len(subs)} subs, but a brick has {SUBS}",
            subs[SUBS].span,
            help="make some of them functions: `void` instead of `sub`",
        )
    _check_variables(program, user, target, where, findings)
    if target is Target.RCX:
        _check_shared_subs(program, user, findings)


def _check_variables(program: Program, user: NqcSource, target: Target, where: Span, findings: Findings) -> None:
    """Global variables alone; those inside tasks and functions are nqc's to place."""
    own = program.variables
    # Where tasks have no variables of their own, the event loop calculates in one more.
    loop = LOOP_VARIABLES + (1 if target.locals else 2)
    total = loop + len(own) + len(user.variables)
    if total > VARIABLES:
        findings.error(
            Code.NQC_LIMIT,
            f"the program has {total} variables, but a brick has {VARIABLES}",
            where,
            notes=(f"the event loop has {loop}, events and arguments {len(own)}, the NQC files {len(user.variables)}",),
            help="each exogenous action of the brick takes one for each combination of its arguments"
            if len(own) > len(user.variables)
            else "make variables local to a task or a function",
        )


def _check_shared_subs(program: Program, user: NqcSource, findings: Findings) -> None:
    """Firmware 1.0 has no variables for a sub that runs in two tasks."""
    called = {behaviour.name for behaviour in wanted(program.actions) if behaviour.kind is ByCall}
    starts = {task.name: {task.name} for task in user.of(Kind.TASK)}
    starts["golc_worker"] = {"startBehaviour"} if program.own_hooks else called
    starts["main"] = set(HOOKS) - {"startBehaviour"}
    for sub in user.of(Kind.SUB):
        if not any(token.text == "int" for token in sub.body):
            continue
        tasks = [task for task, names in starts.items() if sub.name in reach(names, user, starts=False)[0]]
        if len(tasks) > 1:
            findings.error(
                Code.NQC_LIMIT,
                f"sub `{sub.name}` has variables of its own and runs in the tasks {' and '.join(tasks)}",
                sub.span,
                labels=tuple(
                    Label(user.definitions[task].span, "runs it") for task in tasks if task in user.definitions
                ),
                help="firmware 1.0 cannot do that: make it a function (`void`), or use `--target rcx2`",
            )
