"""The Python that has no meaning in a translated function, and what to write instead."""

from __future__ import annotations

import ast
from collections.abc import Mapping

IDENTITY = "`is` asks for one object of Python, not for equal values"

STATEMENTS: Mapping[type[ast.stmt], tuple[str, str | None]] = {
    ast.Return: ("a procedure has no value, and no way out but its end", "put what may be left out under an `if`"),
    ast.Try: ("a program catches nothing", "write `with choose():` for another way, `with guard(φ):` to stop"),
    ast.Raise: ("a program raises nothing", 'write `abort("…")`'),
    ast.Assert: ("Python's `assert` is no test of a program", "write `test(φ)`"),
    ast.Assign: ("a program has no variables that change", "write `with let(…) as x:`, or make it a fluent"),
    ast.AnnAssign: ("a program has no variables that change", "write `with let(…) as x:`, or make it a fluent"),
    ast.AugAssign: ("a program has no variables that change", "make it a fluent that an action changes"),
    ast.Break: ("a loop of a program ends by its condition", "write the condition into the `while`"),
    ast.Continue: ("a loop of a program has no `continue`", "put the rest of the body under an `if`"),
    ast.FunctionDef: ("a function in a function is not translated", "declare it beside this one"),
    ast.AsyncFunctionDef: ("a function in a function is not translated", "declare it beside this one"),
    ast.ClassDef: ("a class has no meaning in a theory", None),
    ast.Import: ("an import belongs at the beginning of the file", None),
    ast.ImportFrom: ("an import belongs at the beginning of the file", None),
    ast.Global: ("a program has no variables of Python", "make it a fluent"),
    ast.Nonlocal: ("a program has no variables of Python", "make it a fluent"),
    ast.Delete: ("nothing can be deleted", None),
    ast.Match: ("`match` has no meaning in a theory", "write `if` and `elif`"),
    ast.AsyncFor: ("`async` has no meaning in a theory", "concurrency is `with together():`"),
    ast.AsyncWith: ("`async` has no meaning in a theory", "concurrency is `with together():`"),
}
"""Statements: what is wrong and the help."""

EXPRESSIONS: Mapping[type[ast.expr], tuple[str, str | None]] = {
    ast.Lambda: ("a lambda has no meaning in a translated function", "write `any(… for n in station)`"),
    ast.NamedExpr: ("`:=` has no meaning in a theory", "write `with let(…) as x:` in a program"),
    ast.Dict: ("a dictionary has no meaning here", "declare a static that returns it, and write `start(x)` here"),
    ast.DictComp: (
        "a dictionary has no meaning here",
        "declare a static with it as its value, and write `start(x)` here",
    ),
    ast.Await: ("`await` has no meaning in a theory", "write `wait(until=φ)`"),
    ast.Yield: ("`yield` has no meaning in a theory", None),
    ast.YieldFrom: ("`yield` has no meaning in a theory", None),
    ast.Starred: ("`*` spreads only lists of Python", "write the terms one by one"),
    ast.Slice: ("a list has no slices", "write `first(x)`, `rest(x)` or `x[i]`"),
    ast.GeneratorExp: ("a generator has no meaning here", "write `any(…)`, `all(…)`, `sum(…)`, `count(…)` or `[…]`"),
}
"""Expressions: what is wrong and the help."""

OPERATORS: Mapping[type[ast.operator], tuple[str, str]] = {
    ast.Div: ("`/` has no meaning on terms", "write `//`, which rounds down"),
    ast.Pow: ("`**` has no meaning on terms", "multiply: `x * x`; what Python is to compute can be an extern"),
    ast.MatMult: ("`@` has no meaning on terms", "write `*`"),
    ast.LShift: ("`<<` has no meaning on terms", "multiply by a power of two"),
    ast.RShift: ("`>>` has no meaning on terms", "divide with `//`"),
    ast.BitXor: ("`^` has no meaning on terms", "write `!=` between two formulas"),
}
"""Operators: what is wrong and the help."""
