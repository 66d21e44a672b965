# Several mistakes in one declaration, none of which hides another.
from __future__ import annotations

from golc.embed import Theory, after, causes, each, interval, poss, test

theory = Theory("several")
station = theory.type("station", interval(1, 6))
location = theory.fluent("location", station, 3)
MANY = [(k, None) for k in range(400)]


@theory.fluent
def free(n: station):
    return True


@theory.define
def operations():
    return locatio + 1 == location and fre(location) or {locatio} == {lo}
#! 12+7 GL012 `locatio` is neither a Python constant nor declared
#! help: did you mean `location`?
#! 40+3 GL012 `fre` is neither a Python constant nor declared
#! help: did you mean `free`?
#! 58+7 GL012 `locatio` is neither a Python constant nor declared
#! help: did you mean `location`?
#! 71+2 GL012 `lo` is neither a Python constant nor declared
#! help: assign it, declare it with the theory, or import it from `golc.embed`


@theory.define
def halved():
    return MANI / 2 == location
#! 12+4 GL012 `MANI` is neither a Python constant nor declared
#! help: did you mean `MANY`?


@theory.define
def quantified():
    return any(fre(n) for n in station if full(n))
#! 16+3 GL012 `fre` is neither a Python constant nor declared
#! help: did you mean `free`?
#! 43+4 GL012 `full` is neither a Python constant nor declared
#! help: assign it, declare it with the theory, or import it from `golc.embed`


@theory.action
def parameters(a: statio, b, c: station):
#! 19+6 GL012 `statio` is neither a Python constant nor declared
#! help: did you mean `station`?
#! 27+1 GL143 the parameter `b` has no type
#! help: write `b: station`
    poss(fre(a))
#! 10+3 GL012 `fre` is neither a Python constant nor declared
#! help: did you mean `free`?


@theory.fluent
def result() -> statio:
#! 17+6 GL012 `statio` is neither a Python constant nor declared
#! help: did you mean `station`?
    return locatio
#! 12+7 GL012 `locatio` is neither a Python constant nor declared
#! help: did you mean `location`?


@theory.action
def effects():
    for n in station:
        poss(free(n))
#! 9+13 GL143 this line has no meaning here
#! help: write `causes(…)`
        causes(location + 1, locatio)
#! 16+12 GL143 this is no action, procedure or fluent
#! help: write the name of an action or a fluent, with its arguments
#! 30+7 GL012 `locatio` is neither a Python constant nor declared
#! help: did you mean `location`?
    for n in each(station, where=fre(n)):
#! 34+3 GL012 `fre` is neither a Python constant nor declared
#! help: did you mean `free`?
        causes(free(m), True)
#! 21+1 GL012 `m` is neither a Python constant nor declared
#! help: assign it, declare it with the theory, or import it from `golc.embed`


@theory.axiom(free)
def typed(n: station):
#! 14+7 GL143 `n` has the type that the fluent gives it
#! help: leave the annotation out
    after(effects, fre(n))
#! 20+3 GL012 `fre` is neither a Python constant nor declared
#! help: did you mean `free`?


@theory.proc
def crossed():
    for a, b in MANY:
        for c, d in MANY:
#! 21+4 GL144 with this loop more than 100000 rounds of one function would be written out
#! help: write `for n in interval(1, 6):` for integers in a row
            pass


@theory.proc
def crossed_with_a_mistake():
    for a, b in MANY:
        for c, d in MANY:
            test(a == m)
#! 23+1 GL012 `m` is neither a Python constant nor declared
#! help: assign it, declare it with the theory, or import it from `golc.embed`
            for e, f in MANY:
                test(e == n)
#! 27+1 GL012 `n` is neither a Python constant nor declared
#! help: assign it, declare it with the theory, or import it from `golc.embed`
