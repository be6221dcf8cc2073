"""Optima that designs find, compared with scans of runs.

    python benchmarks/designs.py [--only NAME] [--scans FILE]
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from design_problems import PROBLEMS


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="")
    parser.add_argument("--scans", type=Path)
    given = parser.parse_args()
    known = json.loads(given.scans.read_text()) if given.scans and given.scans.exists() else {}
    for problem in PROBLEMS:
        if given.only not in problem.name:
            continue
        with tempfile.TemporaryDirectory() as place:
            folder, begin = Path(place), time.time()
            try:
                if problem.name not in known:
                    known[problem.name] = problem.scanned(folder)
                    if given.scans:
                        given.scans.write_text(json.dumps(known))
                scanned = time.time()
                best, where, bar = known[problem.name]
                found = problem.designed(folder, workers=1)
            except Exception as error:
                print(problem.name, "FAILED", type(error).__name__, str(error)[:300], known.get(problem.name), flush=True)
                continue
        value = float(found.best[problem.goal])
        error = float(found.best[f"{problem.goal}_error"])
        short = (value - best) / best * (1 if problem.least else -1)
        gain = float(getattr(found, "remaining_gain", float("nan")))
        print(f"{problem.name} | scan {best:.5g} +-{bar:.2g} {where} | found {value:.5g} {found.settings} | short {100*short:.2f} % | bar {100*error/value:.2f} % | gain {100*gain/value:.2f} % | runs {found.runs}/{problem.runs or 60} | scan {scanned-begin:.0f} s design {time.time()-scanned:.0f} s", flush=True)


if __name__ == "__main__":
    main()
