"""The same run gives the same bits: again, elsewhere, after other work, and on more threads.

Nothing physical is at stake, and nothing is compared but our own results with each other; but who
cannot reproduce a number cannot defend it. `repeated_runs` lists the runs: recursive and summed
memories, chosen steps, stages, two bodies, a rough surface, halves mirrored and whole.
"""

import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from returned import some
from verification.repeated_runs import CASES, arrays
from viscontact.backend.threads import limit_threads

TESTS = Path(__file__).parents[1]


#: Of processes: how text is hashed, and how many threads a library of linear algebra may use. The
#: command line asks it for one; a script gets as many as the machine has cores.
SURROUNDINGS = {
    "one thread of linear algebra": {"PYTHONHASHSEED": "1", "OPENBLAS_NUM_THREADS": "1"},
    "three threads of linear algebra": {"PYTHONHASHSEED": "2", "OPENBLAS_NUM_THREADS": "3"},
}


@pytest.fixture(scope="module", autouse=True)
def threads_of_linear_algebra():
    """Two, as in a script on two cores; the other tests have one."""
    with limit_threads(2):
        yield


@cache
def first(name, threads=1):
    """The result of a first run in this process."""
    return arrays(name, threads)


SHORT = ("roller, load aside", "table, summed over the past", "stage")
some_and_all = pytest.mark.parametrize(
    "names",
    [
        pytest.param(SHORT, id="short ones"),
        pytest.param(tuple(CASES), id="all", marks=pytest.mark.slow),
    ],
)


def differing(one, other):
    """Names of the arrays that are not the same to the last bit."""
    assert one.keys() == other.keys()
    return [name for name, array in one.items() if array.tobytes() != other[name].tobytes()]


@some_and_all
def test_runs_made_again_after_other_work_give_the_same_bits(names):
    # Each after another one than before, with memory in other places and of other content.
    rubbish, before = [], {name: first(name) for name in names}
    for name in reversed(names):
        rubbish += [np.full(size, np.nan)[1:] for size in (3, 1001, 65537, 300001)]
        assert differing(before[name], arrays(name)) == []


@pytest.mark.slow
@pytest.mark.parametrize("surroundings", SURROUNDINGS)
def test_a_process_of_its_own_gives_the_same_bits(surroundings, tmp_path):
    command = [sys.executable, "-m", "verification.repeated_runs", str(tmp_path)]
    environment = {**os.environ, **SURROUNDINGS[surroundings]}
    subprocess.run(command, check=True, cwd=TESTS, env=environment, timeout=120)
    for number, name in enumerate(CASES):
        with np.load(tmp_path / f"{number}.npz") as stored:
            assert (name, differing(first(name), dict(stored))) == (name, [])


#: Of an eccentricity [m] or a tilt [rad] that is zero by symmetry; measured: 2e-21.
ROUNDING = 1e-18


@some_and_all
@pytest.mark.parametrize("threads", [2, pytest.param(4, marks=pytest.mark.slow)])
def test_more_threads_change_no_field_by_more_than_1e_10(threads, names):
    for name in names:
        several = first(name, threads)
        for variable, array in some(first(name).items()):
            values = array.astype(float)
            allowed = 1e-10 * np.abs(values[np.isfinite(values)]).max(initial=0.0)
            allowed = max(allowed, ROUNDING)  # what symmetry makes zero differs by rounding
            np.testing.assert_allclose(
                several[variable].astype(float), values, rtol=0, atol=allowed
            )


def test_runs_on_two_threads_give_the_same_bits_again():
    for name in ("roller, load aside", "table, summed over the past"):
        assert differing(first(name, 2), arrays(name, 2)) == []
