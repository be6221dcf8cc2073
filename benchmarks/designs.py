"""Optima that designs find, compared with scans of runs.

The problems are those of `tests/design_problems.py`. The shortfall is how much the optimum of the
design is worse than the best run of the scan; the scan knows no point between its own, so that it
can be below zero. The stated error is the error bar of the best run and the remaining gain.

    python benchmarks/designs.py [--only NAME]
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import warnings
from pathlib import Path

import viscontact as vc

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from design_problems import PROBLEMS


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="")
    only = parser.parse_args().only
    warnings.simplefilter("ignore", vc.AccuracyWarning)
    print(
        "| problem | runs | scan | best of the scan | found | shortfall | error bar | gain left |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for problem in PROBLEMS:
        if only in problem.name:
            with tempfile.TemporaryDirectory() as folder:
                scan = problem.scanned(Path(folder))
                found = problem.designed(Path(folder), workers=1)
            value, error = problem.found(found)
            gain = getattr(found, "remaining_gain", float("nan"))
            parts = (problem.shortfall(value, scan), error / value, gain / value)
            shares = " | ".join(f"{100 * part:.2f} %" for part in parts)
            size = " x ".join(map(str, problem.points))
            row = f"{found.runs} | {size} | {scan:.5g} | {value:.5g} | {shares}"
            print(f"| {problem.name} | {row} |", flush=True)


if __name__ == "__main__":
    main()
