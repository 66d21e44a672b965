"""A belt that sorts bricks by colour, as `sorter.gl` has it: feed one, look at it with the light sensor, push it."""

from __future__ import annotations

from golc.embed import Theory, bind, causes, enum, expect, given, on, poss, run, say, senses, var, wait

theory = Theory("sorter")

bricks = theory.const("bricks", 5)

colour = theory.type("colour", enum("dark", "light"))
dark, light = colour
side = theory.type("side", enum("left", "right"))
left, right = side
place = theory.type("place", enum("hopper", "belt", "sensor"))
hopper, belt, sensor = place

brick_at = theory.fluent("brick_at", place, hopper)
colour_seen = theory.fluent("colour_seen", colour, dark)
hopper_empty = theory.fluent("hopper_empty", bool, False)


@theory.fluent
def sorted_(c: colour) -> int:
    return 0


@theory.static
def side_of(c: colour) -> side:
    return {dark: left, light: right}


@theory.action
def feed():
    poss(brick_at == hopper and not hopper_empty)
    causes(brick_at, belt)


@theory.action
def look():
    poss(brick_at == belt)
    causes(brick_at, sensor)
    senses(colour_seen)


@theory.action
def push(s: side):
    poss(brick_at == sensor)
    causes(brick_at, hopper)
    causes(sorted_(colour_seen), sorted_(colour_seen) + 1)


@theory.exog
def hopper_runs_empty():
    poss(not hopper_empty)
    causes(hopper_empty, True)


@theory.exog(sources=["operator"])
def fill_hopper():
    poss(hopper_empty)
    causes(hopper_empty, False)


@theory.proc
def sort_one():
    feed()
    look()
    push(side_of(colour_seen))


@theory.proc
def control():
    while sorted_(dark) + sorted_(light) < bricks:
        if hopper_empty:
            say("The hopper is empty. Fill it and type fill_hopper")
            wait(until=not hopper_empty)
        else:
            sort_one()
    say(f"sorted {sorted_(dark)} dark and {sorted_(light)} light bricks")


@theory.device("rcx", file="sorter.nqc")
def rcx_device():
    bind(feed, number=0, call="feedBrick")
    bind(look, number=1, call="lookAtBrick")
    bind(push(var("s", side)), first=2, call="pushBrick")
    bind(hopper_runs_empty, number=4)


@theory.scenario
def dark_bricks():
    expect(push(left), exactly=bricks)
    expect(sorted_(dark) == bricks and sorted_(light) == 0)


@theory.scenario
def hopper_is_refilled():
    on(hopper_runs_empty(), after=6)
    on(fill_hopper(), when=hopper_empty)
    expect(feed(), exactly=bricks)
    expect(fill_hopper(), exactly=1)
    expect(not hopper_empty)


@theory.scenario
def one_light_brick():
    given(colour_seen == light)
    run(sort_one())
    expect(actions=[feed(), look(), push(right)])
