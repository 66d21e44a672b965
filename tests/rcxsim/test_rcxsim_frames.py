"""The brick's own packet codec, against bytes written by hand."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from golc.runtime.rcxsim.frames import Receiver, message, message_in, packet

POLL = bytes.fromhex("55 ff 00 f7 08 53 ac 4a b5")


def received(data: bytes) -> list[bytes]:
    receiver = Receiver()
    return [payload for byte in data if (payload := receiver.feed(byte)) is not None]


def test_message_bytes() -> None:
    assert message(83) == POLL


def test_packet_with_no_parameters() -> None:
    assert packet(b"\x10") == bytes.fromhex("55 ff 00 10 ef 10 ef")


def test_receives_message() -> None:
    assert [message_in(payload) for payload in received(POLL)] == [83]


def test_receives_message_with_toggle_bit() -> None:
    assert [message_in(payload) for payload in received(packet(bytes((0xFF, 7))))] == [7]


def test_request_is_no_message() -> None:
    assert message_in(b"\x10") is None


def test_receives_request_with_five_parameters() -> None:
    versions = bytes.fromhex("15 01 03 05 07 0b")
    assert received(packet(versions)) == [versions]


def test_receives_a_transfer_which_says_its_own_length() -> None:
    block = bytes.fromhex("45 01 00 03 00 0a 0b 0c 21")
    assert received(packet(block)) == [block]
    assert received(packet(b"\x4d" + block[1:])) == [b"\x4d" + block[1:]]


def test_skips_noise_between_packets() -> None:
    assert received(b"\x00\xff\x55\x55" + POLL + b"\x17\x55\xff" + POLL) == [b"\xf7\x53", b"\xf7\x53"]


def test_finds_packet_behind_one_that_was_cut() -> None:
    assert received(POLL[:5] + POLL) == [b"\xf7\x53"]


def test_refuses_wrong_complement() -> None:
    assert received(bytes.fromhex("55 ff 00 f7 08 53 ad 4a b5")) == []


def test_refuses_wrong_sum() -> None:
    assert received(bytes.fromhex("55 ff 00 f7 08 53 ac 4b b4")) == []


@given(st.lists(st.integers(1, 255), max_size=6), st.binary(max_size=12))
def test_messages_arrive_in_order(values: list[int], noise: bytes) -> None:
    assert [message_in(p) for p in received(b"".join(map(message, values)))] == values
    after_noise = received(noise + b"\x00" * 14 + b"".join(map(message, values)))
    assert [message_in(p) for p in after_noise][-len(values) or 99 :] == values


@given(st.integers(1, 255), st.integers(0, 8), st.integers(0, 7))
def test_every_changed_bit_is_noticed(value: int, place: int, bit: int) -> None:
    damaged = bytearray(message(value))
    damaged[place] ^= 1 << bit
    assert received(bytes(damaged)) == []
