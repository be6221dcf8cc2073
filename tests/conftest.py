"""Hypothesis draws the same examples in every run; campaigns report their figures at the end."""

import multiprocessing
import os
import signal
import sys
from collections.abc import Callable, Generator, Iterator

import pytest
from hypothesis import settings

# As at the command line, and before NumPy is imported: the products are too short for several
# threads, which take up to thirty times as long when the cores are busy.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from viscontact.cli.quick_imports import quick_imports
from viscontact.studies.executors import local

settings.register_profile("reproducible", derandomize=True, deadline=None)
settings.load_profile("reproducible")

# Tests start a hundred processes. Where no bytecode may be written each would compile all that it
# imports, which takes longer than what it is started for.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# The tests send these; `nohup` and a shell's background leave them ignored, for children too.
for name, usual in (("SIGINT", signal.default_int_handler), ("SIGHUP", signal.SIG_DFL)):
    number = getattr(signal, name, None)  # Windows knows no SIGHUP
    if number is not None and signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, usual)

# No test cuts the power, and a killed process loses nothing that it has given to the system.
os.fsync = lambda descriptor: None

# Many tests start workers, each of which would import everything again. They are forked from one
# process that has. Doctests, scripts and commands in processes of their own start them as usual.
if "forkserver" in multiprocessing.get_all_start_methods():
    forked = multiprocessing.get_context("forkserver")
    forked.set_forkserver_preload(
        ["viscontact.cli.run.execution", "viscontact.studies.sweep.many", "pint"]
    )
    local._SPAWN = forked


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect half a million objects that stay, and that the collector of garbage leaves out."""
    with quick_imports():
        return (yield)


CAMPAIGN = "campaign"  # the name under which a report carries a campaign's line to the summary


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put slow tests that take long at the beginning of each half of the tests.

    Each of two processes begins with one half, and takes over tests that the other one has not
    begun: short ones at the end keep both in use.
    """
    dear = [item for item in items if _takes_long(item)]
    others = [item for item in items if not _takes_long(item)]
    half = len(others) // 2
    items[:] = [*dear[::2], *others[:half], *dear[1::2], *others[half:]]


#: Files with slow tests of half a minute and more, beside campaigns.
LONG = ("test_documented.py", "test_memory_forecast.py", "test_design_problems.py")


def _takes_long(item: pytest.Item) -> bool:
    if item.get_closest_marker("slow") is None:
        return False
    return CAMPAIGN in getattr(item, "fixturenames", ()) or item.path.name in LONG


@pytest.fixture
def campaign(record_property: Callable[[str, object], None]) -> Callable[[str], None]:
    """Return `campaign(line)`, which adds a line of figures to the end of pytest's output.

    The lines travel with the test's report, so that they arrive from a process of pytest-xdist
    too; a test that fails after it has reported still shows its lines.
    """

    def report(line: str) -> None:
        record_property(CAMPAIGN, line)

    return report


def campaign_lines(terminalreporter: pytest.TerminalReporter) -> Iterator[str]:
    """Yield the lines that campaigns have reported, once each, in the order of the tests."""
    reports = [
        report
        for outcome in ("passed", "failed", "xfailed", "xpassed")
        for report in terminalreporter.stats.get(outcome, [])
        if isinstance(report, pytest.TestReport) and report.when == "call"
    ]
    for report in sorted(reports, key=lambda report: report.nodeid):
        for name, line in report.user_properties:
            if name == CAMPAIGN:
                yield str(line)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    lines = list(campaign_lines(terminalreporter))
    if lines:
        terminalreporter.section("campaigns")
    for line in lines:
        terminalreporter.write_line(line)
