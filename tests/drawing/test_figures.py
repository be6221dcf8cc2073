"""The table of figures agrees with the functions that draw them, and serves without Matplotlib."""

from __future__ import annotations

import subprocess
import sys
from inspect import signature

import pytest

from synthetic_results import maxwell_sphere
from viscontact import plot
from viscontact.drawing.choice import FigureChoice
from viscontact.drawing.figures import TABLE, FigureEntry

#: Keywords for axes and size, which are no choice on the command line.
_PAGE = {"axes", "width"}


@pytest.mark.parametrize("entry", TABLE, ids=lambda entry: entry.name)
def test_each_figure_takes_what_the_table_says(entry: FigureEntry) -> None:
    functions = [entry.drawn_by, *filter(None, [entry.compare])]
    for name in functions:
        assert name in plot.__all__
        _, *keywords = signature(getattr(plot, name)).parameters
        assert set(keywords) - _PAGE == set(entry.takes)
        assert "width" in keywords


def test_names_are_known_without_matplotlib() -> None:
    program = (
        "import sys\n"
        "from viscontact.drawing.figures import names_of\n"
        "assert 'history' in names_of('time')\n"
        "assert not {'matplotlib', 'plotly', 'xarray'} & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_a_misspelt_name_is_answered_with_the_next_one() -> None:
    with pytest.raises(ValueError, match="'histroy'; did you mean history"):
        FigureChoice("histroy").entry_in(["history", "creep"])


def test_times_beyond_a_run_are_refused_but_for_its_law() -> None:
    run = maxwell_sphere([0.0, 1.0], cells=8)
    FigureChoice("creep", ("1 h",)).require_within(run)
    with pytest.raises(ValueError, match=r"^--time: 1 h lies outside the run a, which goes from 0"):
        FigureChoice("history", ("1 h",), prefix="--").require_within(run, "a")
