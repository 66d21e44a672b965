"""Frames: bytes from packets, and packets from any stream of bytes."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.runtime.devices.rcx.packets import Decoder, Packet, encode, encode_message

MESSAGE_36 = bytes.fromhex("55 ff 00 f7 08 24 db 1b e4")
MESSAGE_49 = bytes.fromhex("55 ff 00 f7 08 31 ce 28 d7")
MESSAGE_8 = bytes.fromhex("55 ff 00 f7 08 08 f7 ff 00")
REMOTE = bytes.fromhex("55 ff 00 d2 2d 00 ff 01 fe d3 2c")


def numbers(packets: list[Packet]) -> list[int]:
    assert all(packet.opcode == 0xF7 for packet in packets)
    return [packet.parameters[0] for packet in packets]


def test_a_message_is_nine_bytes_with_complements_and_a_sum() -> None:
    assert encode_message(36) == MESSAGE_36
    assert encode_message(49) == MESSAGE_49
    assert encode_message(8) == MESSAGE_8
    assert encode_message(255) == bytes.fromhex("55 ff 00 f7 08 ff 00 f6 09")


def test_a_packet_has_as_many_pairs_as_bytes() -> None:
    assert encode(Packet(0xD2, b"\x00\x01")) == REMOTE


@pytest.mark.parametrize("number", [0, 256, -1])
def test_a_message_outside_1_to_255_is_refused(number: int) -> None:
    with pytest.raises(ValueError, match="from 1 to 255"):
        encode_message(number)


def test_a_frame_may_come_byte_by_byte() -> None:
    decoder = Decoder()
    packets = [packet for byte in MESSAGE_36 for packet in decoder.feed(bytes((byte,)))]
    assert packets == [Packet(0xF7, b"\x24")]
    assert decoder.noise == 0


@pytest.mark.parametrize("missing", [1, 2])
def test_the_header_may_lack_its_first_bytes(missing: int) -> None:
    assert numbers(Decoder().feed(MESSAGE_36[missing:] + MESSAGE_49[missing:])) == [36, 49]


def test_without_any_header_there_is_no_frame() -> None:
    decoder = Decoder()
    assert decoder.feed(MESSAGE_36[3:]) == []
    assert decoder.noise == 6


def test_noise_is_skipped_and_counted() -> None:
    decoder = Decoder()
    assert numbers(decoder.feed(b"\x13\x37" + MESSAGE_36 + b"\xfe" + MESSAGE_49 + b"\x01\x02")) == [36, 49]
    assert decoder.noise == 5


def test_the_frame_after_a_cut_one_is_found() -> None:
    for length in range(1, 9):
        assert numbers(Decoder().feed(MESSAGE_36[:length] + MESSAGE_49)) == [49], length


def test_a_frame_inside_of_a_broken_one_is_found() -> None:
    assert numbers(Decoder().feed(bytes.fromhex("55 ff 00 f7 08 00") + MESSAGE_36)) == [36]


def test_the_last_byte_of_a_frame_can_be_the_header_of_the_next() -> None:
    # The cut frame of message 8 and the header that lost its first byte look like a whole frame together.
    assert 36 in numbers(Decoder().feed(MESSAGE_8[:-2] + MESSAGE_36[1:]))


@pytest.mark.parametrize("place", range(3, 9))
@pytest.mark.parametrize("bit", range(8))
def test_no_single_changed_bit_goes_unnoticed(place: int, bit: int) -> None:
    broken = bytearray(MESSAGE_36)
    broken[place] ^= 1 << bit
    assert Decoder().feed(bytes(broken)) == []


def test_the_remote_control_is_recognised_as_a_whole() -> None:
    assert Decoder().feed(REMOTE + MESSAGE_36) == [Packet(0xD2, b"\x00\x01"), Packet(0xF7, b"\x24")]


NOISE = st.binary(max_size=12) | st.sampled_from(
    [whole[:length] for whole in (MESSAGE_36, MESSAGE_49, MESSAGE_8, REMOTE) for length in range(1, len(whole))]
)
HEADERLESS_FRAME = re.compile(rb"\x00(\xf7\x08(?:...)|\xd2\x2d)", re.DOTALL)


@given(parts=st.lists(st.tuples(NOISE, st.integers(1, 255), st.integers(0, 2))), tail=NOISE, cuts=st.data())
def test_no_noise_between_frames_loses_a_frame(
    parts: list[tuple[bytes, int, int]], tail: bytes, cuts: st.DataObject
) -> None:
    stream = b"".join(noise + encode_message(number)[missing:] for noise, number, missing in parts) + tail
    decoder, found = Decoder(), []
    while stream:
        size = cuts.draw(st.integers(1, len(stream)))
        found += [packet.parameters[0] for packet in decoder.feed(stream[:size]) if packet.opcode == 0xF7]
        stream = stream[size:]
    # Noise can happen to form a frame of its own; then there is one more, but never one less.
    rest = iter(found)
    assert all(number in rest for _, number, _ in parts), found


@given(noise=st.binary(max_size=40).filter(lambda data: not HEADERLESS_FRAME.search(data)))
def test_noise_alone_is_nothing(noise: bytes) -> None:
    assert Decoder().feed(noise) == []


@given(st.binary(max_size=4000))
def test_what_is_kept_does_not_grow(data: bytes) -> None:
    decoder = Decoder()
    found = len(decoder.feed(data))
    assert decoder.noise >= len(data) - 11 * found - 13


def test_the_frames_in_the_manual_are_right() -> None:
    text = (Path(__file__).parents[2] / "docs" / "wire.md").read_text()
    shown = re.findall(r"^(?:host|brick) +(\d+) +((?:[0-9a-f]{2} ){8}[0-9a-f]{2})\b", text, re.MULTILINE)
    assert len(shown) == 16
    assert all(encode_message(int(number)) == bytes.fromhex(frame) for number, frame in shown)
