"""The elevator of the Golog papers (Levesque, Reiter, Lespérance, Lin & Scherl, 1997), as `elevator.gl` has it."""

from __future__ import annotations

from golc.embed import (
    Theory,
    bind,
    branch,
    causes,
    choose,
    expect,
    given,
    interval,
    let,
    pick,
    poss,
    run,
    search,
    test,
    until,
    var,
)

theory = Theory("elevator")

top = theory.const("top", 10)

floor = theory.type("floor", interval(1, top))

at = theory.fluent("at", floor, 3)


@theory.fluent
def lit(n: floor):
    return n in {2, 5, 9}


@theory.action
def up():
    poss(at + 1 in floor)
    causes(at, at + 1)


@theory.action
def down():
    poss(at - 1 in floor)
    causes(at, at - 1)


@theory.action
def open():
    pass


@theory.action
def close():
    pass


@theory.action
def off(n: floor):
    poss(at == n and lit(n))
    causes(lit(n), False)


@theory.proc
def go_to(n: floor):
    while at != n:
        if at < n:
            up()
        else:
            down()


@theory.proc
def serve(n: floor):
    go_to(n)
    open()
    close()
    off(n)


@theory.proc
def park():
    go_to(1)
    open()


@theory.proc
def basic():
    """One lit floor after the other, lowest first, then home."""
    while any(lit(n) for n in floor):
        for n in pick(floor, where=lit(n)):
            serve(n)
    park()


@theory.proc
def handle(budget: int):
    """Serve all with at most `budget` moves, or fail."""
    with choose():
        with branch():
            test(all(not lit(n) for n in floor) and budget >= at - 1)
            park()
        with branch():
            for n in pick(floor):
                test(lit(n))
                with let(budget - abs(at - n)) as left:
                    test(left > 0)
                    serve(n)
                    handle(left)


@theory.proc
def minimize(budget: int):
    with choose():
        with branch():
            handle(budget)
        with branch():
            minimize(budget + 1)


@theory.proc
def smart():
    """Look ahead for the shortest tour: one move more at each attempt."""
    with search():
        minimize(0)


@theory.proc
def dumb():
    """As `smart`, without looking ahead."""
    minimize(0)


@theory.proc
def control():
    smart()


@theory.device("rcx", file="elevator.nqc")
def rcx_device():
    bind(up, number=0, call="goUp")
    bind(down, number=1, call="goDown")
    bind(open, number=2, call="openDoor")
    bind(close, number=3, call="closeDoor")
    bind(off(var("n", floor)), first=4, call="lightOff")


@theory.scenario
def lowest_first():
    run(basic())
    until(not lit(2))
    expect(actions=[down(), open(), close(), off(2)])


@theory.scenario
def shortest_tour():
    run(smart())
    expect(off(), exactly=3)
    expect(up(), exactly=6)
    expect(at == 1 and not any(lit(n) for n in floor))


@theory.scenario
def home_is_near():
    given(at == 2)
    run(park())
    expect(actions=[down(), open()])
