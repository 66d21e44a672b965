"""What helps against an exception of Python in a theory, where that can be seen."""

from __future__ import annotations

import builtins
import inspect
import re
import sys
from pathlib import Path
from typing import Any

from golc.embed.places import innermost
from golc.embed.terms import Term
from golc.syntax.python_names import BUILTINS, WORDS, golc_name
from golc.theory.suggest import did_you_mean


def cure(error: BaseException, file: str) -> str | None:
    """What to do about an exception that a theory in a file has raised; ``None`` if nothing is known."""
    match error:
        case ModuleNotFoundError():
            return "install it where golc runs, or put it beside this file"
        case ImportError(msg=text, name=str(module)) if missing := re.match(r"cannot import name '(\w+)'", text):
            name = missing[1]
            if golc_name(name) in BUILTINS:
                return f"Python's own `{golc_name(name)}` has a meaning in a theory"
            return did_you_mean(name, dir(sys.modules.get(module)))
        case FileNotFoundError(filename=str(path)) if not Path(path).is_absolute():
            if (Path(file).parent / path).exists():
                return f'`Path(__file__).with_name("{path}")` is the file beside this one, wherever golc is run'
        case NameError(name=str(name)):
            if name in WORDS:
                return f"import it: `from golc.embed import {name}`"
            return did_you_mean(name, [*_names_around(error), *WORDS, *dir(builtins)])
        case AttributeError(name=str(name), obj=owner) if not isinstance(owner, Term):
            return did_you_mean(name, [each for each in dir(owner) if not each.startswith("_")])
        case KeyError(args=(Term(),)):
            return "a term has no value yet: make the dictionary a static, whose value is a table"
        case TypeError(args=(str(text),)) if called := re.match(r"(Theory\.)?(\w+)\(\) (takes|missing|got)", text):
            return _of_call(error, text, *called.group(1, 2))
    return None


def _names_around(error: BaseException) -> dict[str, Any]:
    """What has a name where an exception was raised."""
    where = innermost(error)
    return {} if where is None else {**where.tb_frame.f_globals, **where.tb_frame.f_locals}


def _of_call(error: BaseException, text: str, method: str | None, name: str) -> str | None:
    """What a function of this package takes that has been called with something else."""
    from golc import embed

    home: Any = embed.Theory if method else embed
    called = embed.Theory if name == "__init__" else getattr(home, name, None)
    if called is None or (not method and _names_around(error).get(name) is not called):
        return None
    every = [
        each for each in inspect.signature(called).parameters.values() if each.name not in ("self", "what", "function")
    ]
    wrong = re.search(r"unexpected keyword argument '(\w+)'", text)
    if wrong and (near := did_you_mean(wrong[1], [each.name for each in every])):
        return near
    needed = [each for each in every if each.kind is each.KEYWORD_ONLY and each.default is each.empty]
    if needed and " takes " in text:
        return f"write `theory.{name}({', '.join(f'{each.name}=…' for each in needed)})`"
    shown = [f"`{each.name}=`" if each.kind is each.KEYWORD_ONLY else f"`{each.name}`" for each in every]
    return f"it takes {', '.join(shown)}"
