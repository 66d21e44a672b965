"""Exogenous actions over TCP: the same lines as at the terminal, each answered in one line with ``ok`` or the error."""

from __future__ import annotations

import contextlib
import json
import os
import selectors
import socket
import threading

from golc.diagnostics import DeviceError
from golc.runtime.loop.inbox import Command, Inbox, Item, Refusal, end_thread, reporting_thread
from golc.runtime.sources.exogenous import Lines, Splitter, from_operator, one_line
from golc.theory.theory import Action, BasicActionTheory
from golc.theory.types import writable


class Listener:
    """Accepts any number of clients; their lines go to the inbox in order of arrival.

    ``ok`` says that the line was understood and is in the queue; a command's answer follows as JSON on the same line.
    """

    def __init__(self, theory: BasicActionTheory, inbox: Inbox, host: str, port: int) -> None:
        """Bind at once; raises ``DeviceError`` if the address cannot be used."""
        self._theory = theory
        self._inbox = inbox
        self._server = _bind(host, port)
        self.address: tuple[str, int] = self._server.getsockname()[:2]
        self.name = "tcp"
        self.ended = False
        self._selector = selectors.DefaultSelector()
        self._wake, self._waker = os.pipe()
        self._clients: dict[int, _Client] = {}
        self._thread = reporting_thread(inbox, self.name, self._run)

    def may_report(self, action: Action) -> bool:
        return from_operator(self._theory, action)

    def start(self) -> None:
        self._selector.register(self._server, selectors.EVENT_READ)
        self._selector.register(self._wake, selectors.EVENT_READ)
        self._thread.start()

    def close(self) -> None:
        """Stop listening and hang up."""
        self.ended = True
        os.write(self._waker, b"x")
        end_thread(self._thread)
        for client in self._clients.values():
            client.connection.close()
        self._server.close()
        self._selector.close()
        os.close(self._wake)
        os.close(self._waker)

    def _run(self) -> None:
        while not self.ended:
            for key, _ in self._selector.select():
                if key.fileobj is self._server:
                    self._accept()
                elif key.fd != self._wake:
                    self._hear(self._clients[key.fd])

    def _accept(self) -> None:
        try:
            connection, _ = self._server.accept()
        except OSError:  # the client has gone again before it was greeted
            return
        client = _Client(connection, Lines(self._theory, self.name))
        self._clients[connection.fileno()] = client
        self._selector.register(connection, selectors.EVENT_READ)

    def _hear(self, client: _Client) -> None:
        try:
            data = client.connection.recv(4096)
        except OSError:
            data = b""
        for line in client.splitter.feed(data) if data else client.splitter.end():
            self._take(client, line)
        if not data:
            self._selector.unregister(client.connection)
            del self._clients[client.connection.fileno()]
            client.connection.close()

    def _take(self, client: _Client, line: bytes) -> None:
        item: Item | None = client.lines.read(line, client.answer)
        match item:
            case None:
                return
            case Refusal(diagnostics=diagnostics):
                client.send(f"error: {one_line(diagnostics)}")
            case Command():
                pass
            case _:
                client.send("ok")
        self._inbox.put(item)


class _Client:
    """One connection. Answers of commands come from the thread of the loop, all others from the listener's."""

    def __init__(self, connection: socket.socket, lines: Lines) -> None:
        connection.settimeout(2)
        self.connection = connection
        self.lines = lines
        self.splitter = Splitter()
        self._sending = threading.Lock()
        self._lost = False

    def answer(self, result: object) -> None:
        """Answer a command; nothing but ``ok`` if there is nothing to tell."""
        self.send("ok" if result is None else f"ok {json.dumps(writable(result), ensure_ascii=False)}")

    def send(self, text: str) -> None:
        """Send a line; a client that does not read, or has gone, is hung up on: it must not keep the robot waiting."""
        with self._sending:
            if self._lost:
                return
            try:
                self.connection.sendall(text.encode() + b"\n")
            except OSError:
                self._lost = True
                with contextlib.suppress(OSError):
                    self.connection.shutdown(socket.SHUT_RDWR)


def _bind(host: str, port: int) -> socket.socket:
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        server = socket.socket(family, kind, protocol)
        server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            server.bind(address)
            server.listen()
        except OSError:
            server.close()
            raise
    except (OSError, UnicodeError, OverflowError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DeviceError(f"cannot listen on {host}:{port}: {reason}", help="choose another address or port") from error
    return server
