"""The page of a run in a browser: it is drawn, it moves, and it asks for nothing.

Skipped where there is no Chromium or Chrome.
"""

from __future__ import annotations

import html
import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from closeness import close_to
from report.test_report import _described, _run
from synthetic_results import roller
from viscontact.report import report_page

_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
_BROWSER = next(filter(None, map(shutil.which, _BROWSERS)), None)

pytestmark = pytest.mark.skipif(_BROWSER is None, reason="there is no Chromium")

# Before the page's own scripts: what goes wrong, and what is refused by the page's policy.
_WATCH = """<script>
window.faults = [];
addEventListener("error", (event) => faults.push(String(event.message)));
addEventListener("unhandledrejection", (event) => faults.push(String(event.reason)));
document.addEventListener("securitypolicyviolation", (event) => faults.push(event.blockedURI));
for (const kind of ["error", "warn"]) console[kind] = (...words) => faults.push(words.join(" "));
</script>"""

# After them, once all is drawn: what is there, before and after the slider and the button have
# been used.
_TRY = """<script>
const tried = () => {
  if (!document.documentElement.dataset.drawn) { setTimeout(tried, 20); return; }
  const seen = () => {
    const plot = document.getElementById("map");
    return {
      sum: plot ? plot._fullData[0].z.reduce(
        (sum, row) => row.reduce((part, value) => part + (value || 0), sum), 0) : null,
      rim: plot ? Math.max(...plot._fullData[1].x.filter(Number.isFinite)) : null,
      instant: plot ? document.getElementById("instant").value : null,
      bold: document.getElementById("section-x")?._fullData.at(-1).name,
      ticks: document.querySelector("#history-contact_area .xtitle")?.textContent,
    };
  };
  const before = seen(), slider = document.getElementById("slider");
  if (slider) { slider.value = "0"; slider.dispatchEvent(new Event("input")); }
  document.getElementById("time-scale")?.click();
  setTimeout(() => {
    const asked = performance.getEntriesByType("resource").map((entry) => entry.name);
    const probe = document.createElement("pre");
    probe.id = "probe";
    probe.textContent = JSON.stringify({
      faults, before, after: seen(), asked: asked.filter((name) => !name.startsWith("data:")),
      drawn: document.querySelectorAll(".plot .main-svg").length > 0,
      empty: [...document.querySelectorAll(".plot")]
        .filter((box) => !box.querySelector("svg")).length,
      small: [...document.querySelectorAll(".narrow svg")].filter((s) => s.clientWidth > 0).length,
      wide: document.documentElement.scrollWidth - document.documentElement.clientWidth,
    });
    document.body.append(probe);
  }, 300);
};
tried();
</script>"""


def _tried(page: str, folder: Path, width: int = 1280) -> dict[str, Any]:
    """Open a page, use it, and return what was seen."""
    page = page.replace("<title>", f"{_WATCH}<title>", 1).replace("</body>", f"{_TRY}</body>")
    file = folder / "page.html"
    file.write_text(page, encoding="utf-8")
    done = subprocess.run(
        [
            *(str(_BROWSER), "--headless=new", "--no-sandbox", "--disable-gpu"),
            *(f"--user-data-dir={folder / 'profile'}", f"--window-size={width},900"),
            *("--virtual-time-budget=8000", "--dump-dom", file.as_uri()),
        ],
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=60,
        check=False,
    )
    found = re.search(r'<pre id="probe">(.*?)</pre>', done.stdout, re.DOTALL)
    assert found, done.stderr[-2000:]
    seen: dict[str, Any] = json.loads(html.unescape(found[1]))
    return seen


@pytest.mark.slow
def test_the_slider_moves_the_map_and_nothing_is_asked_for(tmp_path: Path) -> None:
    seen = _tried(report_page(_run()), tmp_path)
    assert seen["faults"] == []
    assert seen["asked"] == []
    assert (seen["drawn"], seen["empty"]) == (True, 0)
    before, after = seen["before"], seen["after"]
    assert (before["instant"], after["instant"]) == ("t = 300 s", "t = 0 s")
    # The load is held: the same force on the same cells, within a contact that was smaller.
    assert after["sum"] == close_to(before["sum"], rel=0.01)
    assert after["rim"] < 0.7 * before["rim"]  # ((1 + 0)/(1 + 3))^(1/3) = 0.63
    assert (before["bold"], after["bold"]) == ("300 s", "0 s")
    assert (before["ticks"], after["ticks"]) == ("Time [s]", "Time [s], logarithmic")


@pytest.mark.slow
def test_a_page_without_fields_is_drawn_too_and_fits_a_narrow_window(tmp_path: Path) -> None:
    seen = _tried(report_page(_run(fields=False)), tmp_path, width=500)
    assert (seen["faults"], seen["empty"]) == ([], 0)
    assert seen["wide"] <= 0
    assert seen["small"] == 3  # the sphere's section, creep and relaxation


@pytest.mark.slow
def test_a_page_is_drawn_within_three_seconds_of_the_processor(tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api")
    # As large as the demo's: fields of five instants on a long grid.
    file = tmp_path / "page.html"
    file.write_text(report_page(_described(roller(shape=(512, 128)))), encoding="utf-8")
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=_BROWSER, args=["--no-sandbox"])
        page = browser.new_page()
        watch = page.context.new_cdp_session(page)
        # The time of the page's thread, not of the clock: other programs may run beside it.
        watch.send("Performance.enable", {"timeDomain": "threadTicks"})
        page.goto(file.as_uri())
        page.wait_for_selector("html[data-drawn=yes]")
        metrics = watch.send("Performance.getMetrics")["metrics"]
        browser.close()
    [taken] = [each["value"] for each in metrics if each["name"] == "TaskDuration"]
    assert 0.05 < taken < 3.0
