"""Requests that the brick's firmware answers itself, without the program's help."""

from __future__ import annotations

from golc.runtime.rcxsim.frames import TOGGLE

ALIVE = 0x10
VERSIONS = 0x15
BATTERY = 0x30

MILLIVOLTS = 8700
"""Six cells, neither new nor empty."""

_REPLIES: dict[bytes, bytes] = {
    bytes((ALIVE,)): b"",
    # ROM 3.1 and firmware 3.9, each as two big-endian words, in answer to the key 1 3 5 7 11.
    bytes((VERSIONS, 1, 3, 5, 7, 11)): bytes((0, 3, 0, 1, 0, 3, 0, 9)),
    bytes((BATTERY,)): MILLIVOLTS.to_bytes(2, "little"),
}
"""What each request answers beyond its op code. A real brick answers many more; none of them changes here."""


def reply(payload: bytes) -> bytes | None:
    """The payload that answers a request's payload: the complement of its op code, then data; None for no answer.

    These requests change nothing, so a request sent again (same toggle bit) needs no memory to be answered alike.
    """
    data = _REPLIES.get(bytes((payload[0] & ~TOGGLE, *payload[1:])))
    return None if data is None else bytes((payload[0] ^ 0xFF,)) + data
