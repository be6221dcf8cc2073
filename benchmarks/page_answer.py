"""Time from the click to the answer of the calculator page, on a server that has been idle.

For each case that the page offers: the request that a click on *Coarse answer* or *Refine* sends,
until the run is over, with its summary and the numbers of its figures; of a full run also until
its values are there, which the page shows before their error bars. Prints the shortest
wall-clock time of several clicks, and the CPU time of server and run from click to answer: on a
machine with other work, only the CPU time measures the program. The pause before each click lets
the process that waits for a run get ready; what it has computed before the click does not count.

    ./go bench page-answer [--repeat 3] [--pause 4] [EXAMPLE ...]
"""

from __future__ import annotations

import argparse
import json
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from urllib.request import Request, urlopen

import psutil

QUALITIES = ("coarse", "full")


@contextmanager
def served(folder: str) -> Iterator[tuple[str, psutil.Process]]:
    """Address and process of a server of its own."""
    command = [sys.executable, "-m", "viscontact", "serve", "--no-open", "--port", "0"]
    process = subprocess.Popen([*command, "--dir", folder], stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout
        found = re.search(r"http://\S+/", process.stdout.readline())
        assert found
        yield found[0], psutil.Process(process.pid)
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()


def asked(address: str, body: dict[str, str] | None = None) -> Any:
    """Answer to a request, as JSON."""
    data = None if body is None else json.dumps(body).encode()
    headers = {"content-type": "application/json"}
    with urlopen(Request(address, data, headers)) as answer:
        return json.load(answer)


def processor_time(process: psutil.Process) -> float:
    """CPU time of a process [s]."""
    used = process.cpu_times()
    return float(used.user + used.system)


def spent(server: psutil.Process) -> float:
    """CPU time of the server and of the processes that have ended [s]."""
    used = server.cpu_times()
    return processor_time(server) + float(used.children_user + used.children_system)


def answered(
    address: str, server: psutil.Process, text: str, quality: str
) -> tuple[float, float, float, float]:
    """Wall-clock and CPU time from the click until all that the page shows has arrived [s].

    First until the values are there, then until they have their error bars.
    """
    waiting = server.children()
    idle = sum(map(processor_time, waiting))
    began, before = time.perf_counter(), spent(server)
    run = asked(f"{address}api/runs", {"yaml": text, "quality": quality})["id"]
    values: tuple[float, float] | None = None
    with urlopen(f"{address}api/runs/{run}/events") as events:
        for line in events:
            if not line.startswith(b"data:"):
                continue
            last = json.loads(line[5:])
            if last["stage"] == "errors" and values is None:
                asked(f"{address}api/runs/{run}/data")
                running = sum(processor_time(each) for each in waiting if each.is_running())
                # Also the part of the error bars that was computed meanwhile.
                values = time.perf_counter() - began, spent(server) + running - before - idle
    if last["state"] != "done":
        raise SystemExit(f"{last['title']}: {last['state']}: {last['message']}")
    asked(f"{address}api/runs/{run}/data")
    whole = time.perf_counter() - began, spent(server) - before - idle
    return *(values or whole), *whole


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--pause", type=float, default=4.0)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, served(folder) as (address, server):
        offered = {each["name"]: each["yaml"] for each in asked(f"{address}api/examples")}
        kinds = ("values s", "CPU s", "all s", "CPU s")
        heads = [f"{quality} {kind}" for quality in QUALITIES for kind in kinds]
        print(f"{'example':24}" + "".join(f"{head:>17}" for head in heads))
        for name in given.examples or offered:
            times: list[float] = []
            for quality in QUALITIES:
                each = []
                for _ in range(given.repeat):
                    time.sleep(given.pause)
                    each.append(answered(address, server, offered[name], quality))
                times += [min(kind) for kind in zip(*each, strict=True)]
            print(f"{name:24}" + "".join(f"{found:17.2f}" for found in times), flush=True)
        time.sleep(given.pause)
        idle = server.children()
        before = sum(map(processor_time, idle))
        time.sleep(20)
        used = sum(map(processor_time, idle)) - before
        memory = sum(child.memory_info().rss for child in idle) / 1e6
        print(f"idle: {len(idle)} waiting process, {memory:.0f} MB, {used:.2f} s of CPU in 20 s")


if __name__ == "__main__":
    main()
