"""The LALR parser of the grammar, built once and kept in the user's cache directory."""

from __future__ import annotations

import contextlib
import hashlib
import importlib.resources
import io
import os
import pickle
import stat
import sys
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import lark
from lark import Lark

from golc.syntax.layout import Layout

STARTS = ("start", "header", "declaration", "expr")
"""What can be parsed: a file, its first line, one declaration, an expression."""


@cache
def parser() -> Lark:
    """The parser, from the cache if it is there and ours; building it takes about eight times as long as loading it."""
    grammar = importlib.resources.files("golc.grammar").joinpath("golc.lark").read_text(encoding="utf-8")
    path = _cache_path(grammar)
    return (path and _load(path)) or _build(grammar, path)


def _build(grammar: str, path: Path | None) -> Lark:
    built = Lark(
        grammar,
        parser="lalr",
        lexer="contextual",
        start=list(STARTS),
        propagate_positions=True,
        postlex=Layout(),
    )
    if path is not None:
        buffer = io.BytesIO()
        built.save(buffer, exclude_options={"postlex"})
        with contextlib.suppress(OSError):
            _store(path, buffer.getvalue())
    return built


def _cache_path(grammar: str) -> Path | None:
    """Where the parser of this grammar, lark and Python is kept; None if there is no directory that is ours alone."""
    home = os.environ.get("XDG_CACHE_HOME", "")
    try:
        base = Path(home) if Path(home).is_absolute() else Path.home() / ".cache"
        directory = base / "golc"
        directory.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _ours(directory.lstat(), stat.S_ISDIR):
            return None
    except (OSError, RuntimeError, ValueError):
        return None
    key = "\0".join((grammar, lark.__version__, sys.version, *STARTS))
    return directory / f"{hashlib.sha256(key.encode()).hexdigest()[:32]}.parser"


def _ours(status: os.stat_result, kind: Any) -> bool:
    """Whether a file or directory belongs to this user and nobody else can have written it."""
    user = getattr(os, "geteuid", None)
    return user is not None and kind(status.st_mode) and status.st_uid == user() and not status.st_mode & 0o022


class _Plain(pickle.Unpickler):
    """Reads plain data only: a planted file cannot name anything that would run."""

    def find_class(self, module: str, name: str) -> Any:
        raise pickle.UnpicklingError(f"{module}.{name} does not belong into a parser")


def _load(path: Path) -> Lark | None:
    try:
        with open(path, "rb", opener=_open_no_link) as file:
            if not _ours(os.fstat(file.fileno()), stat.S_ISREG):
                return None
            saved = _Plain(file).load()
        load: Any = Lark._load_from_dict
        loaded: Lark = load(saved["data"], saved["memo"], postlex=Layout())
        return loaded
    except Exception:
        # Whatever a damaged file leads to, in pickle or in lark, the grammar is at hand: build from it.
        return None


def _open_no_link(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0))


def _store(path: Path, data: bytes) -> None:
    """Write in one piece: another golc that starts now reads the whole file or none."""
    handle, name = tempfile.mkstemp(dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        Path(name).replace(path)
    except OSError:
        Path(name).unlink()
        raise
