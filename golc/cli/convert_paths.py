"""The files that a domain names, as it names them when it is written into another folder."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from golc.diagnostics import Span
from golc.syntax import tree


def moved(file: tree.File, folder: Path) -> tree.File:
    """The same file in a folder: what its parts name relative to their own places is named relative to that."""
    return replace(file, declarations=tuple(_moved(node, folder) for node in file.declarations))


def _moved(node: tree.Declaration, folder: Path) -> tree.Declaration:
    match node:
        case tree.Import(path=path) | tree.Extern(path=path):
            return replace(node, path=_named_from(folder, node.span, path))
        case tree.Device(file=str(path)):
            return replace(node, file=_named_from(folder, node.span, path))
    return node


def _named_from(folder: Path, place: Span, path: str) -> str:
    home = Path(place.source.name).parent
    if Path(path).is_absolute() or home.resolve() == folder.resolve():
        return path
    try:
        return Path(os.path.relpath((home / path).resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return (home / path).resolve().as_posix()
