"""Where something stands in Python source: spans of nodes of Python's syntax tree, and of calls that are running."""

from __future__ import annotations

import ast
import linecache
import sys
from functools import cache
from pathlib import Path
from types import CodeType, FrameType, TracebackType

from golc.diagnostics import Source, Span

OURS = __name__.rpartition(".")[0] + "."


_sources: dict[str, tuple[list[str], Source]] = {}
"""The source of each file, as long as Python keeps the same lines of it: one file has one source."""

_positions: dict[int, tuple[CodeType, list[tuple[int | None, int | None, int | None, int | None]]]] = {}
"""The places of the instructions of a code, by its identity: its hash would go through all of it."""


def source_of(filename: str) -> Source:
    """The text of a file or notebook cell that Python has compiled; empty if it is not kept anywhere."""
    lines = linecache.getlines(filename)
    known = _sources.get(filename)
    if known is None or known[0] is not lines:
        source = Source(_shown(filename), "".join(lines), python=True)
        known = _sources[filename] = (lines, source)
        if source.name != filename:
            # What is compiled out of a cell later has its new name, and finds its lines by that.
            linecache.cache[source.name] = (len(source.text), None, lines, source.name)
            _sources[source.name] = known
    return known[1]


def _shown(filename: str) -> str:
    """How a file is named: a cell of a notebook, which is compiled under the path of a file that is not there, as
    ``In [3]``, so that what it names lies in the folder of the notebook."""
    kept = linecache.cache.get(filename, ())
    if filename.startswith("<") or Path(filename).exists() or len(kept) < 2 or kept[1] is not None:
        return filename
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    numbers = getattr(getattr(shell, "compile", None), "_filename_map", {})
    return f"In [{numbers.get(filename, Path(filename).stem)}]"


@cache
def tree_of(source: Source) -> ast.Module:
    """Python's own syntax tree of a source that Python has compiled before."""
    return ast.parse(source.text)


Positioned = ast.expr | ast.stmt | ast.arg | ast.keyword | ast.excepthandler | ast.alias
"""The nodes of Python's tree that have a place."""


def span_of(source: Source, node: Positioned) -> Span:
    """The place of a node of Python's tree, whose columns count bytes of UTF-8."""
    end_line, end_column = node.end_lineno or node.lineno, node.end_col_offset
    start = offset(source, node.lineno, node.col_offset)
    return Span(source, start, start if end_column is None else max(start, offset(source, end_line, end_column)))


def statement_around(span: Span) -> Span:
    """What a declaration that stands at a place consists of: the decorated function or else the statement around it."""
    source, found = span.source, span
    for node in ast.walk(tree_of(source)):
        if isinstance(node, ast.stmt):
            statement = span_of(source, node)
            if isinstance(node, ast.FunctionDef) and node.decorator_list:
                statement = Span(source, offset(source, node.decorator_list[0].lineno, 0), statement.end)
                if statement.start <= span.start < statement.end:
                    return statement
            elif statement.start <= span.start < statement.end:
                found = statement  # what is further in comes later
    return found


def offset(source: Source, line: int, column: int) -> int:
    """The offset of a line (from 1) and a column in bytes (from 0); the end of the text for one that is not there."""
    if line > len(source.line_starts):
        return len(source.text)
    start = source.line_starts[line - 1]
    text = source.line(line)
    return start + (column if text.isascii() else len(text.encode()[:column].decode(errors="ignore")))


def line_span(source: Source, line: int) -> Span:
    """What is written in a line (from 1)."""
    if not 1 <= line <= len(source.line_starts):
        return Span(source, 0, 0)
    text = source.line(line)
    start = source.line_starts[line - 1]
    return Span(source, start + len(text) - len(text.lstrip()), start + len(text.rstrip()))


def frame_span(frame: FrameType, instruction: int | None = None) -> Span:
    """What a frame is just computing: Python keeps the place of every instruction."""
    source = source_of(frame.f_code.co_filename)
    return code_span(source, frame.f_code, frame.f_lasti if instruction is None else instruction, frame.f_lineno)


def code_span(source: Source, code: CodeType, instruction: int, line: int) -> Span:
    """The place of an instruction (its offset in bytes); its whole line where Python does not know better."""
    if id(code) not in _positions:
        _positions[id(code)] = (code, list(code.co_positions()))
    first, last, column, end = _positions[id(code)][1][instruction // 2]
    if first is None or last is None or column is None or end is None:
        return line_span(source, line)
    return Span(source, offset(source, first, column), offset(source, last, end))


def innermost(error: BaseException) -> TracebackType | None:
    """Where an exception was raised, if it was."""
    where = error.__traceback__
    while where is not None and where.tb_next is not None:
        where = where.tb_next
    return where


def argument(call: Span, index: int | None, keyword: str) -> Span:
    """Where the value of a parameter is written in a call; all of the call where that cannot be told.

    ``index`` is its place among the arguments, none for one that is given only by its name.
    """
    node = node_at(call)
    if not isinstance(node, ast.Call):
        return call
    spread = any(isinstance(each, ast.Starred) for each in node.args)
    by_place = [] if index is None or spread else node.args[index : index + 1]
    found = [*by_place, *(each.value for each in node.keywords if each.arg == keyword)]
    return span_of(call.source, found[0]) if found else call


def each_argument(call: Span, count: int) -> list[Span]:
    """Where the arguments of a call are written, one by one; the whole call for each where that cannot be told."""
    node = node_at(call)
    given = node.args if isinstance(node, ast.Call) else []
    if len(given) != count or any(isinstance(each, ast.Starred) for each in given):
        return [call] * count
    return [span_of(call.source, each) for each in given]


def caller() -> Span:
    """What the innermost code outside this package is just computing."""
    return frame_span(calling_frame())


def calling_frame() -> FrameType:
    """The innermost frame outside this package."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None and str(frame.f_globals.get("__name__", "")).startswith(OURS):
        frame = frame.f_back
    assert frame is not None, "somebody outside has called"
    return frame


@cache
def _operations(source: Source) -> dict[tuple[int, int], ast.expr]:
    """The operations in a source by their place; of two at one place the outer one."""
    found: dict[tuple[int, int], ast.expr] = {}
    kinds = (ast.BinOp, ast.BoolOp, ast.Call, ast.Compare, ast.Subscript, ast.UnaryOp)
    for node in ast.walk(tree_of(source)):
        if isinstance(node, kinds):
            span = span_of(source, node)
            found.setdefault((span.start, span.end), node)
    return found


def node_at(span: Span) -> ast.expr | None:
    """The operation that is written at a place, if its source can be read as Python."""
    try:
        return _operations(span.source).get((span.start, span.end))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
