"""What can be seen of a Python file without executing it."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.theory.python_file import PythonFile
from golc.theory.python_text import misfit


def problem(folder: Path, python: str, count: int = 1) -> str | None:
    """Why ``f`` cannot be called with a number of arguments, and the line that says so."""
    path = folder / "h.py"
    path.write_text(python)
    found = misfit(PythonFile(path, trusted=False), "f", count)
    if found is None:
        return None
    place = "" if found.place is None else f" @{found.place.line}"
    return str(found).replace(str(path), "h.py") + place + (f" ({found.help})" if found.help else "")


@pytest.mark.parametrize(
    ("python", "count"),
    [
        ("def f(a): pass", 1),
        ("def f(): pass", 0),
        ("def f(a, /, b, c=1): pass", 2),
        ("def f(a, /, b, c=1): pass", 3),
        ("def f(*all): pass", 7),
        ("def f(a, *rest, key=None, **more): pass", 1),
        ("f = lambda a: a", 1),
        ("f: object = lambda a: a", 1),
        ("import os as f", 1),
        ("from os.path import join as f", 3),
        ("from os.path import *", 1),
        ("def __getattr__(name): ...", 1),
        ("class f: pass", 2),
        ("f = make()", 2),
        ("a, f = make()", 2),
        ("for f in make(): pass", 2),
        ("import functools\n@functools.cache\ndef f(a, b, c): pass", 1),
        ("try:\n    from fast import f\nexcept ImportError:\n    def f(a, b): pass", 1),
        ("if True:\n    def f(a): pass\nelse:\n    def f(a, b): pass", 2),
        ("with open('x') as y:\n    def f(a): pass", 1),
        ("print('\\d')\ndef f(a): raise SystemExit", 1),
    ],
)
def test_what_may_be_called_is_no_problem(tmp_path: Path, python: str, count: int) -> None:
    assert problem(tmp_path, python, count) is None


@pytest.mark.parametrize(
    ("python", "count", "said"),
    [
        ("def f(a): pass", 2, "`f` in h.py takes 1 argument, not 2 @1"),
        ("\ndef f(): pass", 1, "`f` in h.py takes 0 arguments, not 1 @2"),
        ("def f(a, b, c=1): pass", 1, "`f` in h.py takes 2 to 3 arguments, not 1 @1"),
        ("def f(a, b, *c): pass", 1, "`f` in h.py takes at least 2 arguments, not 1 @1"),
        ("f = lambda: 1", 1, "`f` in h.py takes 0 arguments, not 1 @1"),
        (
            "def f(a, *, k): pass",
            1,
            "`f` in h.py needs `k` by name, but arguments are given by place @1 "
            "(leave out the `*` before it, or give it a default)",
        ),
        (
            "async def f(a): pass",
            1,
            "`f` in h.py is a coroutine, which has no value when it is called @1 (define it with `def`)",
        ),
        ("f = [1]", 1, "`f` in h.py is not a function @1"),
        ("def g(a): pass", 1, "h.py has no function `f` (define it: `def f(…): …`)"),
        ("class g:\n    def f(self, a): pass", 2, "h.py has no function `f` (define it: `def f(…): …`)"),
        ("def g():\n    f = abs", 1, "h.py has no function `f` (define it: `def f(…): …`)"),
        ("x = 1\ndef f(a:\n", 1, "h.py is not Python: '(' was never closed @2"),
        (
            "def f(a):\n\tpass\n        pass",
            1,
            "h.py is not Python: inconsistent use of tabs and spaces in indentation @3",
        ),
        ("-" * 100_000 + "1", 1, "h.py is not Python that can be read"),
    ],
)
def test_what_cannot_be_called_is_said(tmp_path: Path, python: str, count: int, said: str) -> None:
    assert problem(tmp_path, python, count) == said


def test_a_similar_name_is_proposed(tmp_path: Path) -> None:
    path = tmp_path / "h.py"
    path.write_text("def distance(a, b): pass\n")

    found = misfit(PythonFile(path, trusted=False), "distnace", 2)

    assert found is not None
    assert found.help == "did you mean `distance`?"


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (None, "there is no such file"),
        (b"", "it is empty"),
        (b"def f(a): return '\xff'", "it is not UTF-8: byte 19 is 0xff"),
        (b"def f(a): return 1\0", "it is binary, not text: byte 19 is zero"),
    ],
)
def test_a_file_that_cannot_be_read_is_said(tmp_path: Path, data: bytes | None, said: str) -> None:
    path = tmp_path / "h.py"
    if data is not None:
        path.write_bytes(data)

    found = misfit(PythonFile(path, trusted=False), "f", 1)

    assert found is not None
    assert str(found) == f"cannot read `{path}`: {said}"


@pytest.mark.parametrize("name", ["", "x" * 300, "a\0b", "."], ids=["folder", "long", "zero", "dot"])
def test_a_name_that_no_file_can_have_is_said(tmp_path: Path, name: str) -> None:
    found = misfit(PythonFile(tmp_path / name, trusted=False), "f", 1)

    assert found is not None
    assert str(found).startswith("cannot read `")
