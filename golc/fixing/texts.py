"""The texts of domain files as they are to be: as they are on disk, or as fixes have changed them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from golc.diagnostics import Edit, Source
from golc.edits import applied
from golc.syntax.text import read_domain


@dataclass(frozen=True)
class Changed:
    """A file whose text is to be another one; ``before`` is the text that was read."""

    path: Path
    before: Source
    text: str


@dataclass
class Texts:
    """Gives the text of a file, changed or not; ``changed`` is by the files' real paths."""

    changed: Mapping[Path, Changed] = field(default_factory=dict)

    def read(self, path: str | Path) -> Source:
        """The text of a domain file; raises ``UserError`` if it cannot be read."""
        changed = self.changed.get(Path(path).resolve()) if str(path) else None
        return read_domain(path) if changed is None else Source(str(path), changed.text, editable=True)

    def change(self, edits: Iterable[Edit]) -> None:
        """Carry out edits of texts that ``read`` has given."""
        by_source: dict[Source, list[Edit]] = {}
        for edit in edits:
            by_source.setdefault(edit.span.source, []).append(edit)
        for source, its in by_source.items():
            path = Path(source.name).resolve()
            before = self.changed[path].before if path in self.changed else source
            self.changed = {**self.changed, path: Changed(path, before, applied(source.text, its))}

    def take(self) -> Iterator[Changed]:
        """The files that have changed, in the order of their first change; from now on they are as on disk again."""
        changed, self.changed = self.changed, {}
        yield from changed.values()
