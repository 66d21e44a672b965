# Python that has no meaning in translated functions.
from __future__ import annotations

from golc.embed import Theory, after, bind, branch, causes, cost, each, enum, expect, given, interval, on, poss, run
from golc.embed import choose, count, guard, interrupts, known, let, one_of, otherwise, pick, say, search, senses
from golc.embed import exists, forall, optional, setting, star, test, together, union, unknown, until, var, wait, within

theory = Theory("mistakes")
station = theory.type("station", interval(1, 6))
phase = theory.type("phase", enum("moving", "stopped"))
moving, stopped = phase
location = theory.fluent("location", station, 3)
motion = theory.fluent("motion", phase, stopped)
TABLE = {1: 2}
LENGTHS = [2, 3]
FLUENTS = [location, motion]


@theory.fluent
def free(n: station):
    return True


def twice(term):
    return 2 * term


def fails(term):
    return term.nothing


def moves():
    go(1)


@theory.define
def d0():
    return motion is stopped
#! 12+17 GL143 `is` asks for one object of Python, not for equal values
#! help: write `==`


@theory.define
def d1():
    return motion is not None
#! 12+18 GL143 `is` asks for one object of Python, not for equal values
#! help: write `!=`


@theory.define
def d2():
    return location / 2
#! 12+12 GL143 `/` has no meaning on terms
#! help: write `//`, which rounds down


@theory.define
def d3():
    return location ** 2
#! 12+13 GL143 `**` has no meaning on terms
#! help: multiply: `x * x`; what Python is to compute can be an extern


@theory.define
def d4():
    return location << 1
#! 12+13 GL143 `<<` has no meaning on terms
#! help: multiply by a power of two


@theory.define
def d5():
    return motin == stopped
#! 12+5 GL012 `motin` is neither a Python constant nor declared
#! help: did you mean `motion`?


@theory.define
def d6():
    return free(m)
#! 17+1 GL012 `m` is neither a Python constant nor declared
#! help: assign it, declare it with the theory, or import it from `golc.embed`


@theory.define
def d7():
    return location.value
#! 12+14 GL143 a term has no attribute `value`
#! help: write `f(x)` for a fluent with arguments


@theory.define
def d8():
    return lambda n: free(n)
#! 12+17 GL143 a lambda has no meaning in a translated function
#! help: write `any(… for n in station)`


@theory.define
def d9():
    return (x := location)
#! 13+13 GL143 `:=` has no meaning in a theory
#! help: write `with let(…) as x:` in a program


@theory.define
def d10():
    return {1: location}
#! 12+13 GL143 a dictionary has no meaning here
#! help: declare a static that returns it, and write `start(x)` here


@theory.define
def d11():
    return location[1:2]
#! 21+3 GL143 a list has no slices
#! help: write `first(x)`, `rest(x)` or `x[i]`


@theory.define
def d12():
    return [*phase]
#! 13+6 GL143 `*` spreads only lists of Python
#! help: write the terms one by one


@theory.define
def max_():
#! 5+4 GL006 `max` is a word of the language and cannot be a name
#! help: choose another name, for example `the_max`
    return True


@theory.define
def d_list(n: station):
    return LENGTHS[n] == 3 and TABLE[1] == LENGTHS[0]
#! 12+10 GL143 Python looks a term up at once, before there is a situation
#! help: make it a static, whose value is a table: `start = theory.static(…)`


@theory.define
def d_handles():
    return any(FLUENTS[n] for n in range(2))
#! 16+10 GL143 Python looks a term up at once, before there is a situation
#! help: go through the list itself, `for x in …`, or declare one fluent with a parameter for all of it


@theory.define
def d_enum(n: enum()):
#! 15+6 GL143 an enumeration has at least one element
#! help: write `enum("red", "green")`
    return True


@theory.define
def d_exists():
    return exists(station, lambda n: free(n)) and forall(station, lambda n: free(n))
#! 12+6 GL143 `exists(…)` is for Python outside translated functions
#! help: write `any(φ for n in station)`
#! 51+6 GL143 `forall(…)` is for Python outside translated functions
#! help: write `all(φ for n in station)`


@theory.define
def d_forall():
    return forall(station, lambda n: free(n))
#! 12+6 GL143 `forall(…)` is for Python outside translated functions
#! help: write `all(φ for n in station)`


@theory.define
#! 2+13 GL143 only a function written with `def` can be translated
#! help: write the decorator with `@` right above the `def` of what it declares, without `async`
async def d_async():
    return location == 1


@theory.action
#! 2+13 GL143 only a function written with `def` can be translated
#! help: of two decorators the upper one gets what the lower one makes, which is no function
@theory.action
#! 2+13 GL143 a second decorator would not be seen: the function is translated, not run
#! help: leave one of them out
def d_twice():
    pass


@theory.define
def d_method():
    return location.bit_length() == 2
#! 12+19 GL143 a term has no method `bit_length`
#! help: terms have `in`, `+`, `-`, `len(x)`, `first(x)`, `rest(x)`, `x[i]` and comprehensions


@theory.define
def d_sorted():
    return sorted(location) == [1]
#! 12+16 GL143 Python cannot go through a term, whose value depends on the situation
#! help: a loop or comprehension in a translated function goes through it: `for x in …`


@theory.extern(file="helpers.py")
def e_body(n: station) -> int:
    return 2 * n
#! 5+12 GL143 an extern has no body: the function stands in `helpers.py`
#! help: write `...` here; what is to be translated is a static


@theory.define
def d13():
    return (n for n in station)
#! 12+20 GL143 a generator has no meaning here
#! help: write `any(…)`, `all(…)`, `sum(…)`, `count(…)` or `[…]`


@theory.define
def d14():
    return await_(location)
#! 12+6 GL012 `await_` is neither a Python constant nor declared
#! help: did you mean `wait`?


@theory.define
def d15():
    return any(free)
#! 12+3 GL143 `any` needs `… for n in station` here
#! help: write `any(… for n in station)`


@theory.define
def d16():
    return count(location)
#! 12+5 GL143 `count` needs `… for n in station` here
#! help: write `count(φ for n in station)`


@theory.define
def d17():
    return sum(location)
#! 12+3 GL143 `sum` needs `… for n in station` here
#! help: write `sum(… for n in station)`


@theory.define
def d18():
    return min(location)
#! 12+3 GL143 `min` needs `… for n in station` here
#! help: write `min(… for n in station)`


@theory.define
def d19():
    return free(location, n=3)
#! 12+19 GL015 `n` of `free` has two values


@theory.define
def d20():
    return free(m=3)
#! 12+9 GL015 `free` has no parameter `m`
#! help: its parameters are: `n`


@theory.define
def d21():
    return free(**TABLE)
#! 17+7 GL143 `**` spreads no terms
#! help: write the arguments one by one


@theory.define
def d22():
    return test(location)
#! 12+4 GL143 `test` stands in the wrong place
#! help: it belongs in the program of a procedure: `@theory.proc`


@theory.define
def d23():
    return fails(location)
#! 12+15 GL141 Python fails here with AttributeError: a term has no attribute `nothing`


@theory.define
def d24():
    return object()
#! 12+8 GL144 a Python value of type `object` means nothing in a theory
#! help: numbers, strings, truth values, `None`, lists, sets and what the theory declares can stand here


@theory.define
def d25():
    return TABLE
#! 12+5 GL144 a dictionary means nothing in a theory
#! help: a table is the value of a static: `start = theory.static(…)`; a term can use it: `start(x)`


@theory.define
def d26():
    return known(location, motion)
#! 12+23 GL015 `known` takes 1 argument by place, not 2


@theory.define
def d27():
    return poss
#! 12+4 GL018 `poss` is no term
#! help: write `poss(…)`


@theory.define
def d28():
    return unknown
#! 12+7 GL018 `unknown` stands only for the whole value of a fluent


@theory.define
def d29():
    return 3j
#! 12+2 GL144 `3j` means nothing in a theory


@theory.define
def d30():
    return b"x"
#! 12+4 GL144 `b"x"` means nothing in a theory


@theory.define
def d31():
    return [x for x, y in station]
#! 19+4 GL143 one variable a `for`
#! help: write `for x in t for y in u`


@theory.define
def d32():
    return print(location)
#! 12+15 GL143 `print` gives no value, and what it does is not a part of the theory
#! help: a program writes `say(f"…")`


@theory.define
def d33():
    return f"{location:3}"
#! 12+15 GL143 a hole in a message has no format
#! help: write `{e}` alone


@theory.define
def d34():
    return f"{location!r}"
#! 12+15 GL143 a hole in a message has no format
#! help: write `{e}` alone


@theory.define
def d35():
    return (yield location)
#! 13+14 GL143 `yield` has no meaning in a theory


@theory.define
def d36():
    return station.flying
#! 12+14 GL012 the type `station` has no symbol `flying`


@theory.define
def d37():
    return location in station.flying
#! 24+14 GL012 the type `station` has no symbol `flying`


@theory.define
def body0():
    if location == 1:
#! 5+17 GL143 the body of this function is one `return`
#! help: write one `return` with the whole term; give parts of it names with `@theory.define`
        return True
    return False


@theory.define
def body1():
    try:
#! 5+4 GL143 the body of this function is one `return`
#! help: write one `return` with the whole term; give parts of it names with `@theory.define`
        return True
    except ValueError:
        return False


@theory.define
def body2():
    x = location
#! 5+12 GL143 the body of this function is one `return`
#! help: write one `return` with the whole term; give parts of it names with `@theory.define`
    return x == 1


@theory.define
def body3():
    return True
    return False
#! 5+12 GL143 what follows a `return` is never reached


@theory.define
def body4():
    pass
#! 5+4 GL143 the body of this function is one `return`
#! help: write one `return` with the whole term; give parts of it names with `@theory.define`


@theory.define
def body5():
    return
#! 5+6 GL143 nothing is returned
#! help: write `return` and a term


@theory.define
def head0(n):
#! 11+1 GL143 the parameter `n` has no type
#! help: write `n: station`
    return True


@theory.define
def head1(*n: station):
#! 12+10 GL143 `*n` is no parameter of the language
#! help: give each parameter a name and a type
    return True


@theory.define
def head2(**n: station):
#! 13+10 GL143 `**n` is no parameter of the language
#! help: give each parameter a name and a type
    return True


@theory.define
def head3(n: statio):
#! 14+6 GL012 `statio` is neither a Python constant nor declared
#! help: did you mean `station`?
    return True


@theory.define
def head4(n: 3):
#! 14+1 GL143 this is no type of the language
#! help: write a declared type, `bool`, `int` …
    return True


@theory.define
def head5(n: location):
#! 14+8 GL018 `location` is no type
#! help: `bool`, `int`, `str`, `float`, `interval(1, 6)`, `enum(…)` and declared types are types
    return True


@theory.define
def head6(n: set):
#! 14+3 GL143 a set or a list needs the type of its elements
#! help: write `set[station]`
    return True


@theory.define
def head7(n: None):
#! 14+4 GL143 this is no type of the language
#! help: write a declared type, `bool`, `int` …
    return True


@theory.define
def head8(n: str | None | station):
#! 14+20 GL143 `None` can stand only at the end of a union, once
    return True


@theory.define
def head9(n: "one"):
#! 14+5 GL006 `one` is a word of the language and cannot be a name
#! help: choose another name, for example `one_` or `the_one`
    return True


@theory.define
def head10(some: station):
#! 12+4 GL006 `some` is a word of the language and cannot be a name
#! help: choose another name, for example `some_` or `the_some`
    return True


@theory.define
def one():
#! 5+3 GL006 `one` is a word of the language and cannot be a name
#! help: choose another name, for example `one_` or `the_one`
    return True


@theory.define
def _hidden():
#! 5+7 GL143 `_hidden` cannot be a name
#! help: begin it with a letter and go on with letters (without accents), digits and `_`, as in `hidden`
    return True


@theory.define
def grün():
#! 5+4 GL143 `grün` cannot be a name
#! help: begin it with a letter and go on with letters (without accents), digits and `_`, as in `grun`
    return True


@theory.define
def head11(n: station | set[station]):
#! 15+22 GL143 a set or a list cannot be joined with another type
    return True


@theory.define
def head12(n: object):
#! 15+6 GL144 the Python class `object` is no type of the language
#! help: `bool`, `int`, `str`, `float`, `interval(1, 6)`, `enum(…)` and declared types are types
    return True


@theory.define
def head13(_n: station):
#! 12+2 GL143 `_n` cannot be a name
#! help: begin it with a letter and go on with letters (without accents), digits and `_`, as in `n`
    return True


@theory.action
def go(n: station):
    x = 3
#! 5+5 GL143 this line has no meaning here
#! help: write `causes(fluent, value)`
    location = n
#! 5+12 GL143 this line has no meaning here
#! help: write `causes(fluent, value)`
    location += 1
#! 5+13 GL143 this line has no meaning here
#! help: write `causes(fluent, value)`
    if free(n):
#! 5+11 GL143 this line has no meaning here
#! help: write `causes(fluent, value, when=φ)`
        causes(location, n)
    go(n)
#! 5+5 GL143 this line has no meaning here
#! help: write `poss(…)`, `causes(…)`, `senses(…)`, `cost(…)`
    causes(location)
#! 5+16 GL015 `causes` takes 2 arguments by place, not 1
    causes(location, n, where=free(n))
#! 25+13 GL015 `causes` takes no `where=`
#! help: it takes `when=`
    causes(location + 1, n)
#! 12+12 GL143 this is no action, procedure or fluent
#! help: write the name of an action or a fluent, with its arguments
    location.append(n)
#! 5+15 GL143 a term has no method `append`
#! help: write `causes(location, location + …)`, or `-` to take away
    causes(location, unknown)
    causes(location, one_of(1, 2))
#! 22+12 GL015 `one_of` takes 1 argument by place, not 2
    causes(location, one_of([1, 2]) + 1)
#! 22+6 GL143 `one_of` stands in the wrong place
#! help: it belongs in a value of a fluent
    poss(n == 1, n == 2)
#! 5+20 GL015 `poss` takes 1 argument by place, not 2
    senses()
#! 5+8 GL015 `senses` takes 1 argument by place, not 0
    "a docstring later"
    location
#! 5+8 GL143 this line has no meaning here
#! help: write `poss(…)`, `causes(…)`, `senses(…)`, `cost(…)`
    assert free(n)
#! 5+14 GL143 this line has no meaning here
#! help: write `poss(φ)`
    for m in station:
        poss(free(m))
#! 9+13 GL143 this line has no meaning here
#! help: write `causes(…)`
    for a, b in station:
#! 9+4 GL143 2 variables for 1 type
#! help: write as many names as types: `for x, y in pick(t, u)`
        causes(free(a), True)
    for m in each(station, wher=free(m)):
#! 28+12 GL015 `each` takes no `wher=`
#! help: it takes `where=`
        causes(free(m), True)
    while free(n):
#! 5+14 GL143 this line has no meaning here
#! help: write `for n in station:` with `causes(…)` in it
        causes(free(n), True)
    moves()
#! 5+7 GL143 a function of Python does nothing in a declaration
#! help: write the lines of `moves` here
    test(free(n))
#! 5+13 GL143 this line has no meaning here
#! help: write `poss(…)`, `causes(…)`, `senses(…)`, `cost(…)`


@theory.proc
def control(n: station):
    return
#! 5+6 GL143 a procedure has no value, and no way out but its end
#! help: put what may be left out under an `if`
    x = 3
#! 5+5 GL143 a program has no variables that change
#! help: write `with let(…) as x:`, or make it a fluent
    x += 1
#! 5+6 GL143 a program has no variables that change
#! help: make it a fluent that an action changes
    go
#! 5+2 GL143 this does nothing
#! help: write `go()`
    poss(free(n))
#! 5+13 GL143 this does nothing
#! help: write `test(φ)` to wait for what holds, and `poss` in an action
    known(location)
#! 5+15 GL143 this does nothing
#! help: write `test(φ)` to wait for what holds
    with pick(station) as k:
#! 27+1 GL143 `pick` gives nothing a name
#! help: write `for x in pick(station):`
        go(k)
    with pick(station):
#! 10+13 GL143 `pick` stands in the wrong place
#! help: write `for x in pick(station):`
        go(n)
    wait(location == 3)
#! 5+19 GL015 `wait` takes no arguments by place, not 1
#! help: it takes `until=`, `seconds=`
    with choose():
        for k in [1, location]:
            with branch():
                go(k)
    moves()
#! 5+7 GL143 a function of Python does nothing in a program
#! help: put `@theory.proc` above `def moves`, or write its lines here
    go(n)()
#! 5+5 GL143 this cannot be called
    location == 3
#! 5+13 GL143 this does nothing
#! help: call an action or a procedure
    try:
#! 5+4 GL143 a program catches nothing
#! help: write `with choose():` for another way, `with guard(φ):` to stop
        go(n)
    except ValueError:
        pass
    raise ValueError
#! 5+16 GL143 a program raises nothing
#! help: write `abort("…")`
    assert free(n)
#! 5+14 GL143 Python's `assert` is no test of a program
#! help: write `test(φ)`
    del n
#! 5+5 GL143 nothing can be deleted
    import os
#! 5+9 GL143 an import belongs at the beginning of the file
    def inner():
#! 5+12 GL143 a function in a function is not translated
#! help: declare it beside this one
        pass
    class Inner:
#! 5+12 GL143 a class has no meaning in a theory
        pass
    for m in station:
        break
    else:
        go(m)
#! 9+5 GL143 a loop of a program has no `else`
#! help: write it behind the loop
    while free(n):
        continue
#! 9+8 GL143 a loop of a program has no `continue`
#! help: put the rest of the body under an `if`
    with choose():
        go(n)
#! 9+5 GL143 only branches stand in `choose`
#! help: write `with branch():` around each part of `choose`
    with choose():
#! 10+8 GL143 `choose` needs two branches
#! help: write a second `with branch():`
        with branch():
            go(n)
    with choose:
#! 10+6 GL143 `choose` is called
#! help: write `with choose():`
        go(n)
    with branch():
#! 10+8 GL143 `branch` stands in the wrong place
#! help: it belongs in the program of a procedure: `@theory.proc`
        go(n)
    with open("x"):
#! 10+9 GL143 this `with` has no meaning in a theory
#! help: `with choose():`, `with search():` …
        go(n)
    with choose(), star():
#! 20+6 GL143 one word a `with`
#! help: write one `with` inside the other
        go(n)
    with star() as s:
#! 20+1 GL143 `star` gives nothing a name
#! help: `with let(e) as x:` does
        go(n)
    with let(3):
#! 10+6 GL143 `let` gives one name
#! help: write `with let(e) as x:`
        go(n)
    with let(3) as (a, b):
#! 20+6 GL143 `let` gives one name
#! help: write `with let(e) as x:`
        go(n)
    with search("longest"):
#! 17+9 GL143 this is no way to search
#! help: write `search("first")`, `search("shortest")` or `search("cheapest")`
        go(n)
    with search(at_mots=3):
#! 17+9 GL015 `search` takes no `at_mots=`
#! help: it takes `at_most=`, `within=`
        go(n)
    with otherwise():
#! 5+17 GL143 `otherwise` follows directly on a `within`
        go(n)
    with within(3):
        go(n)
    go(n)
    with otherwise():
#! 5+17 GL143 `otherwise` follows directly on a `within`
        go(n)
    with interrupts():
        go(n)
#! 9+5 GL143 only `on` stands in `interrupts`
#! help: write `with on(φ):` or `for n in on(station, where=φ):`
    with interrupts():
        for m in on(station):
#! 18+11 GL143 `on` needs a condition
#! help: write `on(station, where=φ)`
            go(m)
    for m in on(station, where=free(m)):
#! 14+26 GL143 `on` stands in `with interrupts():`
        go(m)
    for m in pick():
#! 14+6 GL015 `pick` needs a type or a list to go through
        go(m)
    for m in pick(station, station):
#! 9+1 GL143 1 variable for 2 types
#! help: write as many names as types: `for x, y in pick(t, u)`
        go(m)
    for m in location, 3:
        go(m)
    for _ in pick(station):
#! 9+1 GL143 `_` cannot be a name
#! help: what is not used has a name, too: `k`
        go(n)
    for a, b in [(1, 2), (1, 2, 3)]:
#! 9+4 GL143 the values do not fit these names
        go(a)
    for m in TABLE2:
#! 14+6 GL012 `TABLE2` is neither a Python constant nor declared
#! help: did you mean `TABLE`?
        go(m)
    wait(3)
#! 5+7 GL015 `wait` takes no arguments by place, not 1
#! help: it takes `until=`, `seconds=`
    wait(until=free(n), seconds=3)
#! 5+30 GL143 a `wait` is for a condition or for a time
#! help: write `with within(seconds):` around it
    say(location)
#! 9+8 GL143 a message is a string or an f-string
#! help: write `f"{location}"`
    say("a", "b")
#! 5+13 GL015 `say` takes 1 argument by place, not 2
    say(f"{location:>3}")
#! 9+16 GL143 a hole in a message has no format
#! help: write `{e}` alone
    match n:
#! 5+8 GL143 `match` has no meaning in a theory
#! help: write `if` and `elif`
        case 1:
            go(n)
    print("x")
#! 5+10 GL143 `print` gives no value, and what it does is not a part of the theory
#! help: a program writes `say(f"…")`
    yield go(n)
#! 5+11 GL143 this does nothing
#! help: call an action or a procedure
    go(m for m in station)
#! 7+20 GL143 a generator has no meaning here
#! help: write `any(…)`, `all(…)`, `sum(…)`, `count(…)` or `[…]`
    test()
#! 5+6 GL015 `test` takes 1 argument by place, not 0
    go(1, 2, n=3)
#! 5+13 GL015 `n` of `go` has two values


@theory.axiom(free)
def free_axiom(n):
    after(go(n), True)
    after(go(n))
#! 5+12 GL015 `after` takes 2 arguments by place, not 1
    causes(free(n), True)
#! 5+21 GL143 this line has no meaning here
#! help: write `after(…)`
    after(go(n + 1), True)
#! 14+5 GL143 this is no constant
#! help: write a symbol, an integer, `True`, `False` or `None`
    after(location + 1, True)
#! 11+12 GL143 this is no action
#! help: write an action: `after(move(x, y), …)`


@theory.scenario
def drive():
    given(location)
    run(3)
#! 9+1 GL143 this is no action, procedure or fluent
#! help: write the name of an action or a fluent, with its arguments
    on(go(1))
#! 5+9 GL143 `on` needs events and a time
#! help: write `on(event(), after=n)`, `on(event(), when=φ)` or `on(event(), waiting=True)`
    on(go(1), after=1, when=free(1))
#! 5+32 GL143 `on` needs events and a time
#! help: write `on(event(), after=n)`, `on(event(), when=φ)` or `on(event(), waiting=True)`
    on(go(1), waiting=False)
#! 23+5 GL143 `waiting` is `True` or left out
    on(go(1), befor=3)
#! 15+7 GL015 `on` takes no `befor=`
#! help: it takes `after=`, `when=`, `waiting=`
    expect(go(1), at_least=1, at_most=3)
#! 31+9 GL143 one relation an `expect`
#! help: write a second `expect`
    expect(actions=go(1))
#! 20+5 GL143 `actions` is a list
#! help: write `expect(actions=[a(), b(1)])`
    expect(go(1), often=3)
#! 19+7 GL015 `expect` takes no `often=`
#! help: it takes `at_least=`, `at_most=`, `exactly=`, `actions=`
    until()
#! 5+7 GL015 `until` takes 1 argument by place, not 0
    x = 3
#! 5+5 GL143 this line has no meaning here
#! help: write `given(…)`, `run(…)`, `on(…)`, `until(…)`, `expect(…)`


@theory.device("rcx")
def brick():
    bind(go(3), number=-1)
#! 24+2 GL144 the number of an action is a natural number
    bind(go(3), number=1, first=2)
#! 5+30 GL143 a binding has one number, or the first of several
    bind(go(3), call="a", start="b")
#! 5+32 GL143 an action is carried out in one way
#! help: leave all but one out
    bind(go(3), call=3)
#! 22+1 GL143 this must be a string
    bind(3)
#! 10+1 GL143 this is no action
#! help: write an action: `bind(turn_around, number=0)`
    bind(go(location + 1))
#! 13+12 GL143 this is no constant
#! help: write a symbol, an integer, `True`, `False` or `None`
    bind(go(var(3, station)))
#! 17+1 GL143 this must be a string
    bind(go(var("n")))
#! 13+8 GL015 `var` takes 2 arguments by place, not 1
    bind(go(3), table=3)
#! 23+1 GL143 this is no table
#! help: write a dictionary: `{hall: kitchen}`
    setting("poll")
#! 5+15 GL015 `setting` takes 2 arguments by place, not 1
    setting(poll, 3)
#! 13+4 GL012 `poll` is neither a Python constant nor declared
#! help: assign it, declare it with the theory, or import it from `golc.embed`
    setting("poll", 3, seconds=4)
#! 5+29 GL015 `setting` takes 1 argument by place, not 2
#! help: it takes `seconds=`
    go(3)
#! 5+5 GL143 this line has no meaning here
#! help: write `bind(…)`, `setting(…)`


@theory.fluent
def no_initial() -> statio:
#! 21+6 GL012 `statio` is neither a Python constant nor declared
#! help: did you mean `station`?
    return 1


@theory.static
def table() -> station:
    return {**TABLE}
#! 15+5 GL143 `**` spreads no table
#! help: make the dictionary outside the function


@theory.axiom(free)
def other_axiom(n: station):
#! 20+7 GL143 `n` has the type that the fluent gives it
#! help: leave the annotation out
    after(go(n), True)


@theory.goal
def g_each(n: station):
#! 12+10 GL143 `n` is a parameter, and no goal has any
#! help: write `… for n in station` in it; with a default it is a constant of Python
    return free(n)


@theory.fluent
def no_alternatives(n: union()):
#! 24+7 GL143 there is no type to be joined
#! help: write `station | None` or `station | enum("table")`
    return True


@theory.fluent
def two_bases(n: optional(station, phase)):
#! 18+24 GL015 `optional` takes 1 argument by place, not 2
    return True


AT_THREE = location == 3


@theory.define
def called_formula():
    return AT_THREE()
#! 12+8 GL143 this cannot be called


@theory.proc
def second_words():
    with together():
        with branch(), guard(free(1)):
#! 24+14 GL143 one word a `with`
#! help: write one `with` inside the other
            pass
        with branch:
#! 14+6 GL143 `branch` is called
#! help: write `with branch():`
            pass
        with branch(3):
#! 14+9 GL015 `branch` takes no arguments by place, not 1
            pass
        with branch() as part:
#! 26+4 GL143 `branch` gives nothing a name
#! help: `with let(e) as x:` does
            pass
    with interrupts():
        with on:
#! 14+2 GL143 `on` is called
#! help: write `with on():`
            pass
        with on(free(1)), guard(free(2)):
#! 27+14 GL143 one word a `with`
#! help: write one `with` inside the other
            pass
        for n in on(station, where=free(n)):
            pass
        else:
            pass
#! 13+4 GL143 a loop of a program has no `else`
#! help: write it behind the loop
    with within(3):
        pass
    with otherwise(4):
#! 10+12 GL015 `otherwise` takes no arguments by place, not 1
        pass


@theory.action
def drive(to: station):
    pass


@theory.device("rcx", file="motors.nqc", name="motors")
def motors():
    bind(drive(to=3), number=1)
#! 16+4 GL015 `drive` takes no `to=`
#! help: it takes arguments by place only
