"""The table of figures agrees with the functions that draw them, and serves without Matplotlib."""

from __future__ import annotations

import subprocess
import sys
from inspect import signature

import pytest

from synthetic_results import maxwell_sphere
from viscontact import plot
from viscontact.drawing.choice import FigureChoice
from viscontact.drawing.content.look import LIGHT
from viscontact.drawing.content.map import maps_over
from viscontact.drawing.content.usefulness import TESTS
from viscontact.drawing.figures import TABLE, Chapter, FigureEntry, Reported
from viscontact.drawing.plotly.run_figures import INTERACTIVE, run_figures
from viscontact.report.result_chapters import loop_part
from viscontact.report.still_figures import still_figures
from viscontact.web.runs.run_figures import run_figures as sent_figures

#: Keywords for axes and size, which are no choice on the command line.
_PAGE = {"axes", "width"}


@pytest.mark.parametrize("entry", TABLE, ids=lambda entry: entry.name)
def test_each_figure_takes_what_the_table_says(entry: FigureEntry) -> None:
    functions = [entry.drawn_by, *filter(None, [entry.compare])]
    for name in functions:
        assert name in plot.__all__
        _, *keywords = signature(getattr(plot, name)).parameters
        alone = {"theory"} if name == entry.compare else set()  # `compare` has no such option
        assert set(keywords) - _PAGE == set(entry.takes) - alone
        assert "width" in keywords


def test_interactive_figures_are_those_of_the_table() -> None:
    reported = [each.reported for each in TABLE if each.reported]
    named = [each.interactive for each in reported if each.interactive]
    assert sorted(named) == sorted(INTERACTIVE)
    assert {each.of_use for each in reported if each.of_use} == set(TESTS)
    assert all(each.heading for each in reported)
    assert not any(
        each.interactive for each in reported if each.chapter in ("spots", "stress", "slip")
    )
    run = maxwell_sphere([0.0, 1.0], cells=8)
    drawn = run_figures(run, maps_over(run))
    names = [each.layout.meta["name"] for each in drawn["pressure"]]
    assert names == ["map", "section-x", "section-y", "outlines"]
    assert not run_figures(run, None)["pressure"]


@pytest.mark.parametrize("interactive", ["", "histories"])
def test_reports_draw_a_new_row_of_the_table(
    interactive: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = maxwell_sphere([0.0, 1.0], cells=8, fields=False)
    row = FigureEntry("further", "creep", reported=Reported("loops", "Further", interactive))
    for module in ("report.still_figures", "drawing.plotly.run_figures"):
        monkeypatch.setattr(f"viscontact.{module}.TABLE", (*TABLE, row))
    printed, shown = (
        [image.get("alt") for part in parts for image in part.iter("img")]
        for parts in (
            still_figures(run, "loops"),
            loop_part(run, run_figures(run, None)["loops"]),
        )
    )
    assert printed == ["Further"]
    assert shown == ([] if interactive else ["Further"])


@pytest.mark.parametrize("chapter", ["pressure", "friction", "histories", "loops"])
def test_page_is_sent_all_figures_of_the_report(
    chapter: Chapter, monkeypatch: pytest.MonkeyPatch
) -> None:
    run, further = maxwell_sphere([0.0, 1.0], cells=8), Reported(chapter, "Further", "histories")
    table = (*TABLE, FigureEntry("further", reported=further))
    monkeypatch.setattr("viscontact.drawing.plotly.run_figures.TABLE", table)
    shown = [each.layout.meta["name"] for each in run_figures(run, maps_over(run))[chapter]]
    sent = sent_figures(run, LIGHT)["surface" if chapter == "pressure" else chapter]
    assert [each["layout"]["meta"]["name"] for each in sent] == shown
    assert len(shown) > 1


def test_run_over_time_is_shown_without_a_reference_over_speed() -> None:
    run = maxwell_sphere([0.0, 1.0], cells=8)
    over_speed = maxwell_sphere([0.5, 1.0], cells=8).rename(time="speed").assign_attrs(along="y")
    assert sent_figures(run, LIGHT, over_speed) == sent_figures(run, LIGHT)


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
