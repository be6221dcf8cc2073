"""Connections of the server, limited in number and in the time that a request takes to arrive."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

#: Largest number of connections; a page with a run needs two or three.
MOST_CONNECTIONS = 200

#: Time for the lines of a request, and for the first bytes of its body [s]; time between two
#: readings of an answer [s]. uvicorn has a limit for the time between two requests only.
HEADER_TIME, BODY_TIME, READ_TIME = 10.0, 20.0, 120.0
#: Lowest rate at which a body arrives [bytes/s], and largest body [bytes].
_RATE, _LARGEST = 200_000, 64_000_000

_FULL = b"""HTTP/1.1 503 Service Unavailable\r
content-type: text/plain; charset=utf-8\r
retry-after: 5\r
connection: close\r
content-length: 49\r
\r
the server has too many connections; try it later"""


class LimitedConnection(H11Protocol):
    """Connection that is closed when a request, or the reader of an answer, is too slow."""

    def __init__(self, *words: Any, **named: Any) -> None:
        super().__init__(*words, **named)
        self._awaited: object = None
        self._arrival: asyncio.TimerHandle | None = None
        self._reading: asyncio.TimerHandle | None = None
        self._since = self.loop.time()

    @property
    def is_idle(self) -> bool:
        """True without a request that waits for its answer."""
        return self.cycle is None or self.cycle.response_complete

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Take a connection; beyond the limit, in place of the one that has been idle longest."""
        super().connection_made(transport)
        self._watch()
        if len(self.connections) <= MOST_CONNECTIONS:
            return
        idle = [each for each in self._others() if each.is_idle]
        if idle:
            longest = min(idle, key=lambda each: each._since)
            self.connections.discard(longest)  # it is lost a moment later
            longest.transport.abort()
        else:
            transport.write(_FULL)
            transport.close()

    def data_received(self, data: bytes) -> None:
        """Read a part of a request."""
        super().data_received(data)
        self._watch()

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        self._since = self.loop.time()
        self._watch()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the connection."""
        for timer in (self._arrival, self._reading):
            if timer is not None:
                timer.cancel()
        super().connection_lost(exc)
        # uvicorn leaves it to its timer, which then finds a closed connection.
        self._unset_keepalive_if_required()

    def pause_writing(self) -> None:
        """Wait for the client, which reads too slowly."""
        super().pause_writing()
        self._reading = self.loop.call_later(READ_TIME, self.transport.abort)

    def resume_writing(self) -> None:
        """Continue an answer."""
        if self._reading is not None:
            self._reading.cancel()
            self._reading = None
        super().resume_writing()

    def send_400_response(self, msg: str) -> None:
        """Answer bytes that are no request; after an answer has begun, there is no other."""
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE) and self.is_idle:
            super().send_400_response(msg)
        else:
            self.transport.close()

    def shutdown(self) -> None:
        """End the connection of a client that sends or reads too slowly; let others be answered."""
        if self._reading is not None or self.conn.their_state is h11.SEND_BODY:
            self.transport.abort()
        else:
            super().shutdown()

    def _others(self) -> Iterator[LimitedConnection]:
        for each in self.connections:
            if isinstance(each, LimitedConnection) and each is not self:
                yield each

    def _watch(self) -> None:
        """Limit the time for what is awaited next: the lines of a request, or its body."""
        awaited = self.conn.their_state
        if awaited is self._awaited:
            return
        self._awaited = awaited
        if self._arrival is not None:
            self._arrival.cancel()
            self._arrival = None
        if awaited is h11.IDLE:
            self._arrival = self.loop.call_later(HEADER_TIME, self.transport.abort)
        elif awaited is h11.SEND_BODY:
            self._arrival = self.loop.call_later(self._body_time(), self.transport.abort)

    def _body_time(self) -> float:
        """Time for the body of the current request [s]."""
        size = dict(self.headers).get(b"content-length", b"0")
        announced = min(int(size), _LARGEST) if size.isdigit() and len(size) < 20 else _LARGEST
        return BODY_TIME + announced / _RATE
