"""Joins a domain file with the files that it imports: one tree, in which each import has become what it brings."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeAlias

from golc.diagnostics import Code, Diagnostic, Findings, Label, Source, Span, UserError
from golc.syntax import tree
from golc.syntax.parse import parse_file
from golc.syntax.text import read_domain

Reading: TypeAlias = Callable[[str | Path], Source]
"""Gives the text of a domain file; raises ``UserError`` if it cannot be read."""


@dataclass(frozen=True)
class Joined:
    """A file with the declarations of the files it imports, and the sources of all of them, its own first.

    An import that could not be followed, which is a finding, is among the declarations still.
    """

    file: tree.File
    sources: tuple[Source, ...]


def join(file: tree.File, source: Source, findings: Findings, read: Reading = read_domain) -> Joined:
    """Follow the imports of a file; each file is joined once, where it is imported first."""
    if not any(isinstance(node, tree.Import) for node in file.declarations):
        return Joined(file, (source,))
    joiner = _Joiner(findings, read)
    joiner.enter(file, source, None)
    joiner.run()
    joined = replace(file, declarations=tuple(joiner.declarations), unread=tuple(joiner.unread))
    return Joined(joined, tuple(joiner.sources))


@dataclass
class _Open:
    """A file whose declarations are being joined, and the import that led to it."""

    path: Path
    source: Source
    importing: tree.Import | None
    rest: Iterator[tree.Declaration]


@dataclass
class _Joiner:
    """Goes through the files depth first; a stack instead of recursion, for a chain of imports may be long."""

    findings: Findings
    read: Reading
    declarations: list[tree.Declaration] = field(default_factory=list)
    sources: list[Source] = field(default_factory=list)
    unread: list[Span] = field(default_factory=list)
    seen: set[Path] = field(default_factory=set)
    stack: list[_Open] = field(default_factory=list)

    def enter(self, file: tree.File, source: Source, importing: tree.Import | None) -> None:
        path = Path(source.name).resolve()
        self.seen.add(path)
        self.sources.append(source)
        self.unread += file.unread
        self.stack.append(_Open(path, source, importing, iter(file.declarations)))

    def run(self) -> None:
        while self.stack:
            node = next(self.stack[-1].rest, None)
            if node is None:
                self.stack.pop()
            elif not isinstance(node, tree.Import) or not self.follow(node):
                self.declarations.append(node)

    def follow(self, node: tree.Import) -> bool:
        """Begin with the file of an import, unless it has been joined; False, and a finding, if that cannot be."""
        name = os.path.join(os.path.dirname(node.span.source.name), node.path)  # noqa: PTH118, PTH120
        path = Path(name).resolve()
        for place, opened in enumerate(self.stack):
            if opened.path == path:
                self.circle(node, self.stack[place + 1 :])
                return False
        if path in self.seen:
            return True
        try:
            source = self.read(name)
        except UserError as error:
            for diagnostic in error.diagnostics:
                self.findings.add(_at_the_import(diagnostic, node))
            return False
        file = parse_file(source, self.findings)
        if file is None:
            self.unread.append(Span(source, 0, len(source.text)))
            self.seen.add(path)
            return False
        self.enter(file, source, node)
        return True

    def circle(self, node: tree.Import, through: list[_Open]) -> None:
        labels = [Label(opened.importing.span, "imported here") for opened in through if opened.importing is not None]
        message = f"`{node.path}` is imported by what it imports itself" if labels else "a file imports itself"
        self.findings.error(
            Code.CIRCULAR,
            message,
            node.span,
            "closes the circle",
            "put what both need into a file of its own" if labels else "leave the line out",
            labels=tuple(labels[:5]),
        )


def _at_the_import(diagnostic: Diagnostic, node: tree.Import) -> Diagnostic:
    """What is wrong with a file that cannot be read, said where it is imported; a place in its text stays there."""
    if diagnostic.span.source.text:
        return replace(diagnostic, labels=(*diagnostic.labels, Label(node.span, "imported here")))
    help_ = diagnostic.help or "the path is relative to the folder of this file"
    return replace(diagnostic, span=node.span, marker="imported here", help=help_)
