"""A small brick as a process of its own: a pty or a TCP port, whole frames in, whole frames out, by a table of answers.

It knows the frames by heart and shares no code with the link. Usage: ``small_brick.py pty|tcp ANSWERS [echo]``, where
ANSWERS is JSON: for each message heard, the list of answers for the first, second, ... time (the last one stays). An
answer is a list of messages, or "close". Prints the port; at the end of its standard input, the messages heard.
"""

import json
import os
import select
import socket
import sys
import tty

FRAMES = {
    32: "55ff00f70820df17e8",
    33: "55ff00f70821de18e7",
    34: "55ff00f70822dd19e6",
    35: "55ff00f70823dc1ae5",
    36: "55ff00f70824db1be4",
    37: "55ff00f70825da1ce3",
    49: "55ff00f70831ce28d7",
    53: "55ff00f70835ca2cd3",
    64: "55ff00f70840bf37c8",
    65: "55ff00f70841be38c7",
    69: "55ff00f70845ba3cc3",
    74: "55ff00f7084ab541be",
    80: "55ff00f70850af47b8",
    81: "55ff00f70851ae48b7",
    82: "55ff00f70852ad49b6",
    83: "55ff00f70853ac4ab5",
    84: "55ff00f70854ab4bb4",
    85: "55ff00f70855aa4cb3",
    100: "55ff00f708649b5ba4",
}
NUMBERS = {bytes.fromhex(frame): number for number, frame in FRAMES.items()}


def open_end(kind: str) -> tuple[str, int]:
    """The name of the far end, and a descriptor of ours (for TCP: of the listening socket)."""
    if kind == "tcp":
        listener = socket.create_server(("127.0.0.1", 0))
        return f"socket://127.0.0.1:{listener.getsockname()[1]}", listener.detach()
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    return os.ttyname(theirs), ours


def main() -> None:
    kind, table, *options = sys.argv[1:]
    answers = json.loads(table)
    name, descriptor = open_end(kind)
    print(name, flush=True)
    if kind == "tcp":
        connection, _ = socket.socket(fileno=descriptor).accept()
        descriptor = connection.detach()
    heard: list[int] = []
    received = b""
    while True:
        ready, _, _ = select.select([descriptor, sys.stdin], [], [])
        if sys.stdin in ready:
            break
        try:
            data = os.read(descriptor, 100)
        except OSError:
            break
        if not data:
            break
        if "echo" in options:
            os.write(descriptor, data)
        received += data
        while (start := received.find(bytes.fromhex("55ff00"))) >= 0 and len(received) >= start + 9:
            number = NUMBERS[received[start : start + 9]]
            received = received[start + 9 :]
            heard.append(number)
            given = answers.get(str(number), [[]])
            answer = given.pop(0) if len(given) > 1 else given[0]
            if answer == "close":
                return
            os.write(descriptor, b"".join(bytes.fromhex(FRAMES[message]) for message in answer))
    print(json.dumps(heard), flush=True)


main()
