"""What the formats for other programs share: a finding as one text, and whether its place is in a file."""

from __future__ import annotations

from golc.diagnostics import Diagnostic, Source


def whole_message(diagnostic: Diagnostic) -> str:
    """The message, what stands beside the mark, the notes and the help, one a line."""
    head = f"{diagnostic.message} ({diagnostic.marker})" if diagnostic.marker else diagnostic.message
    help_ = () if diagnostic.help is None else (f"help: {diagnostic.help}",)
    return "\n".join((head, *(f"note: {note}" for note in diagnostic.notes), *help_))


def is_file(source: Source) -> bool:
    """Whether a source has the name of a file; a value behind ``-D`` and what is built in have none."""
    return not source.name.startswith(("-D ", "<"))
