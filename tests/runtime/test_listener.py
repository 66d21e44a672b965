"""Exogenous actions over real sockets."""

from __future__ import annotations

import json
import socket
import threading
import time
from collections.abc import Iterator
from typing import IO

import pytest

from golc.diagnostics import DeviceError
from golc.runtime.loop.inbox import Command, Inbox, Item, Refusal, Report
from golc.runtime.sources.listener import Listener
from golc.theory.theory import BasicActionTheory


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def listener(delivery: BasicActionTheory, inbox: Inbox) -> Iterator[Listener]:
    made = Listener(delivery, inbox, "127.0.0.1", 0)
    made.start()
    yield made
    made.close()


def connect(listener: Listener) -> IO[bytes]:
    connection = socket.create_connection(listener.address, timeout=20)
    stream: IO[bytes] = connection.makefile("rwb", buffering=0)  # type: ignore[assignment]
    connection.close()  # the stream keeps it open
    return stream


def exchange(client: IO[bytes], line: bytes) -> str:
    client.write(line + b"\n")
    return client.readline().decode().rstrip("\n")


def next_item(inbox: Inbox) -> Item:
    deadline = time.monotonic() + 20
    while not inbox.items and time.monotonic() < deadline:
        inbox.wait(1)
    return inbox.items.popleft()


def test_each_line_is_answered(listener: Listener, inbox: Inbox) -> None:
    with connect(listener) as client:
        assert exchange(client, b"request_delivery(2, 5)") == "ok"
        assert next_item(inbox) == Report("request_delivery", (2, 5), "tcp")
        assert exchange(client, b"request_delivery(2, 7)").startswith(
            "error: `to` of `request_delivery` is of type station (1..6), not `7`"
        )
        assert isinstance(next_item(inbox), Refusal)


def test_a_command_is_answered_by_the_loop(listener: Listener, inbox: Inbox) -> None:
    with connect(listener) as client:
        client.write(b"!state\n")
        item = next_item(inbox)
        assert isinstance(item, Command)
        item.reply({"location": 3, "delivery_requested(1)": None})

        word, _, rest = client.readline().decode().partition(" ")

    assert word == "ok"
    assert json.loads(rest) == {"location": 3, "delivery_requested(1)": None}


def test_bad_bytes_do_no_harm(listener: Listener, inbox: Inbox) -> None:
    with connect(listener) as client:
        assert exchange(client, b"\xff\xfe\x00").startswith("error: the line is not UTF-8: byte 0xff")
        assert exchange(client, b"\x00\x07").startswith("error: ")
        assert exchange(client, b"push_go_button\r") == "ok"


def test_several_clients_at_once(listener: Listener, inbox: Inbox) -> None:
    def request(station: int) -> None:
        with connect(listener) as client:
            answers.append(exchange(client, f"request_delivery({station}, 1)".encode()))

    answers: list[str] = []
    with connect(listener):  # one that says nothing
        threads = [threading.Thread(target=request, args=(station,)) for station in range(2, 7)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    assert answers == ["ok"] * 5
    got = [next_item(inbox) for _ in range(5)]
    assert {item.args[0] for item in got if isinstance(item, Report)} == {2, 3, 4, 5, 6}


def test_a_line_without_an_end_counts_when_the_client_hangs_up(listener: Listener, inbox: Inbox) -> None:
    with connect(listener) as client:
        client.write(b"push_go_button")

    assert next_item(inbox) == Report("push_go_button", (), "tcp")


def test_a_client_that_has_gone_does_not_disturb_the_answer(listener: Listener, inbox: Inbox) -> None:
    with connect(listener) as client:
        client.write(b"!state\n")
        item = next_item(inbox)
    assert isinstance(item, Command)
    item.reply({})
    item.reply({})

    with connect(listener) as client:
        assert exchange(client, b"push_go_button") == "ok"


def test_a_port_in_use_is_a_device_error(listener: Listener, delivery: BasicActionTheory) -> None:
    with pytest.raises(DeviceError, match=r"cannot listen on 127\.0\.0\.1:\d+: Address already in use"):
        Listener(delivery, Inbox(), *listener.address)


def test_a_host_that_is_not_ours_is_a_device_error(delivery: BasicActionTheory) -> None:
    with pytest.raises(DeviceError, match="cannot listen on"):
        Listener(delivery, Inbox(), "203.0.113.1", 0)


def test_a_client_that_does_not_read_is_hung_up_on(listener: Listener, inbox: Inbox) -> None:
    with connect(listener) as client:
        client.write(b"!state\n")
        item = next_item(inbox)
        assert isinstance(item, Command)
        item.reply("x" * 20_000_000)
        item.reply("y")
        said = client.read(1_000_000)
        while more := client.read(1_000_000):
            said = more
        assert said.endswith(b"x")  # and then the end, within the patience of the client
    with connect(listener) as other:
        assert exchange(other, b"request_delivery(2, 5)") == "ok"
