"""What messages look like on the line."""

from __future__ import annotations


def frame(number: int) -> bytes:
    """The nine bytes of a user message, worked out anew."""
    total = (0xF7 + number) & 0xFF
    return bytes((0x55, 0xFF, 0x00, 0xF7, 0x08, number, number ^ 0xFF, total, total ^ 0xFF))
