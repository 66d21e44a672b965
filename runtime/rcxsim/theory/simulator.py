"""Puts a simulated brick together from a theory: one line, a world, and a program for each brick that it declares."""

from __future__ import annotations

import random

from golc.diagnostics import Code, Diagnostic, Span, UserError
from golc.nqc.numbering import ActionMap, number_bricks
from golc.runtime.rcxsim.line import Line, LineOptions
from golc.runtime.rcxsim.theory.behaviours import TheoryBrick
from golc.runtime.rcxsim.theory.classic import ClassicProgram
from golc.runtime.rcxsim.theory.events import Chance, Events, Scripted
from golc.runtime.rcxsim.theory.programs import Programs
from golc.runtime.rcxsim.theory.world import TheoryWorld
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.sources.schedule import Player, Schedule
from golc.theory.forms import add_a_brick
from golc.theory.theory import BasicActionTheory


def build(theory: BasicActionTheory, options: LineOptions, schedule: Schedule | None, seed: int, trace: Trace) -> Line:
    """The line with every brick of the theory, in its initial state; without a schedule events come by chance.

    Raises UserError if the theory declares no brick, or if the numbers of one cannot be told apart. ``seed`` decides
    what is left to chance, in a stream for each purpose: more noise does not change how long actions take.
    """
    world = TheoryWorld(theory, _stream(seed, "world"), trace)
    programs = []
    for numbers in bricks(theory):
        name = numbers.device.name
        events: Events
        if schedule is None:
            events = Chance(world, numbers, _stream(seed, f"events of {name}"))
        else:
            events = Scripted(Player(_reported_by(numbers, schedule)))
        durations = _stream(seed, f"durations of {name}")
        brick = TheoryBrick(world, numbers, events, durations, trace)
        programs.append(ClassicProgram(brick, numbers.wire, trace))
    return Line(Programs(programs, trace), options, _stream(seed, "noise"), trace)


def bricks(theory: BasicActionTheory) -> list[ActionMap]:
    """The numbers of every brick that a theory declares; raises UserError if there is none or they make no sense."""
    if not theory.bricks:
        nowhere = Span(theory.source, 0, 0)
        message = f"domain {theory.name} declares no brick to simulate"
        raise UserError(Diagnostic(Code.NO_DEVICE, message, nowhere, help=add_a_brick(nowhere)))
    return [*number_bricks(theory).values()]


def _reported_by(numbers: ActionMap, schedule: Schedule) -> Schedule:
    """The lines that are about this brick; the others are for the host."""
    return schedule.only(lambda call: numbers.handles(call.action, call.args))


def _stream(seed: int, purpose: str) -> random.Random:
    return random.Random(f"{seed}: {purpose}")
