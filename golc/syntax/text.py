"""Reading a file as the text of a source, and the error that a file cannot be written."""

from __future__ import annotations

from pathlib import Path
from typing import BinaryIO

from golc.diagnostics import Code, Diagnostic, Source, Span, UserError

LARGEST = 16 * 2**20
"""Bytes: what is larger was not written by a person, and a device such as ``/dev/zero`` never ends."""


DOMAIN_LINE = "a file begins with its domain line: `domain delivery`"


def read_source(path: str | Path, empty: str = DOMAIN_LINE) -> Source:
    """The text of a file, named as the user named it, without a byte order mark; ``empty`` helps with one without text.

    Raises ``UserError`` if it is missing, no file, too large, binary, not UTF-8 (with the place of the byte) or empty.
    """
    name = str(path)
    if not name:
        raise _unreadable(name, "a file has a name")
    try:
        with Path(path).open("rb") as file:
            return read_stream(name, file, empty)
    except (OSError, ValueError) as error:
        raise _unreadable(name, _reason(error)) from None


def read_domain(path: str | Path) -> Source:
    """The text of a domain file, which fixes may change; raises ``UserError`` as ``read_source`` does."""
    source = read_source(path)
    return Source(source.name, source.text, editable=True)


def read_stream(name: str, stream: BinaryIO, empty: str = DOMAIN_LINE) -> Source:
    """The text of an open file, as ``read_source`` has it."""
    data = stream.read(LARGEST + 1)
    if len(data) > LARGEST:
        raise _unreadable(name, f"it is larger than {LARGEST // 2**20} MiB")
    return Source(name, _decoded(name, data, empty))


def _decoded(name: str, data: bytes, empty: str) -> str:
    if not data:
        raise _unreadable(name, "it is empty", help=empty)
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise _unreadable(name, "it is UTF-16, not UTF-8", help="save it as UTF-8 in your editor")
    if b"\0" in data:
        raise _unreadable(name, f"it is binary, not text: byte {data.index(0) + 1} is zero")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise _undecodable(name, data, error) from None


def _reason(error: OSError | ValueError) -> str:
    match error:
        case FileNotFoundError():
            return "there is no such file"
        case IsADirectoryError():
            return "it is a directory"
        case PermissionError():
            return "you may not read it"
        case OSError(strerror=str(text)):
            return text[:1].lower() + text[1:]
    return "no file can have this name"


def _undecodable(name: str, data: bytes, error: UnicodeDecodeError) -> UserError:
    # Only ``utf-8-sig`` with a mark counts its offsets from behind the mark.
    body = data.removeprefix(b"\xef\xbb\xbf")
    offset = error.start if len(error.object) == len(body) else error.start + len(error.object) - len(body)
    place = len(body[:offset].decode("utf-8"))
    source = Source(name, body.decode("utf-8", errors="replace"))
    at = len(data) - len(body) + offset
    return _unreadable(
        name,
        f"it is not UTF-8: byte {at + 1} is 0x{data[at]:02x}",
        help="save it as UTF-8 in your editor",
        span=Span(source, place, place + 1),
    )


def _unreadable(name: str, reason: str, help: str | None = None, span: Span | None = None) -> UserError:
    place = span or Span(Source(name, ""), 0, 0)
    return UserError(Diagnostic(Code.UNREADABLE, f"cannot read `{name}`: {reason}", place, help=help))


def unwritable(path: Path, error: OSError) -> UserError:
    """The error that a file that was named cannot be opened for writing."""
    place = Span(Source(str(path), ""), 0, 0)
    return UserError(Diagnostic(Code.UNREADABLE, f"cannot write `{path}`: {error.strerror or error}", place))
