"""Cost of a short run on a body that ends, over that of the same run without ends.

Each run is a new process, so that set-up counts: a roller on 240 x 64 cells at 20 instants, with
NumPy if not otherwise said. Runs with and without ends take turns; the ratios are medians over the
rounds of the CPU times, by `simulate` without and with error bars and by `viscontact run`.
`--eccentric` lets both kinds of pressure, even and odd ones, act between two ends.

    ./go bench ends [--rounds 7] [--core] [--eccentric]
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

import psutil

#: Most times that a run takes with ends, over one without.
PROMISED = 1.3

CASE = """
title: short run
indenter: {{shape: roller, radius: 5 mm, half_length: 8 mm, crown_radius: 75 mm}}
material:
  law: creep-series
  instant: 5.545e-4 / MPa
  amplitudes: [6.17e-5 / MPa, 8.38e-5 / MPa]
  times: [10 s, 133.8688 s]
  data: deviatoric
  poisson_ratio: 0.38
  {ends}
load: {{kind: step, force: 500 N, eccentricity_x: {lever}}}
time: {{end: 1000 s, steps: 20, spacing: log, first: 0.3 s}}
grid: {{shape: [240, 64], size: [24 mm, 2.4 mm]}}
output: {{fields: [0 s, 1000 s]}}
"""

BODIES = {
    "without": "",
    "two free ends": "length: 20 mm\n  ends: free",
    "one free end": "length: 20 mm\n  ends: [free, null]",
    "held": "length: 20 mm\n  ends: held",
}

SCRIPT = """
import sys
import viscontact as vc
case = vc.case.read_case(sys.argv[1])
vc.simulate(*(case.indenter, case.material, case.load, case.grid, case.times), errors={errors})
"""

WAYS = {
    "simulate, no error bars": ("-c", SCRIPT.format(errors=False)),
    "simulate": ("-c", SCRIPT.format(errors=True)),
    "viscontact run": ("-m", "viscontact", "run", "--overwrite"),
}


def seconds(words: tuple[str, ...], case: Path, *, core: bool) -> float:
    """CPU time of one new process [s]."""
    kept = {name: each for name, each in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    kept["OMP_NUM_THREADS"] = "1"
    if not core:
        kept["VISCONTACT_CORE"] = "off"
    before = psutil.Process().cpu_times()
    command = [sys.executable, *words, str(case)]
    subprocess.run(command, check=True, capture_output=True, cwd=case.parent, env=kept)
    after = psutil.Process().cpu_times()
    used = (after.children_user - before.children_user, after.children_system)
    return used[0] + used[1] - before.children_system


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--core", action="store_true", help="with the compiled core")
    parser.add_argument("--eccentric", action="store_true", help="a force beside the middle")
    options = parser.parse_args()
    lever = "1 mm" if options.eccentric else "0 mm"
    with tempfile.TemporaryDirectory() as folder:
        cases = {}
        for index, (name, ends) in enumerate(BODIES.items()):
            cases[name] = Path(folder) / f"case-{index}.yaml"
            cases[name].write_text(CASE.format(ends=ends, lever=lever), encoding="utf-8")
        print(f"{'':26}{'without s':>10}" + "".join(f"{name:>16}" for name in list(BODIES)[1:]))
        for way, words in WAYS.items():
            rounds = []
            for count in range(options.rounds + 1):
                each = [seconds(words, case, core=options.core) for case in cases.values()]
                if count:  # the first writes byte code
                    rounds.append(each)
            ratios = [median(each[k] / each[0] for each in rounds) for k in (1, 2, 3)]
            least = min(each[0] for each in rounds)
            print(f"{way:26}{least:10.2f}" + "".join(f"{ratio:16.2f}" for ratio in ratios))
    print(f"\nasked: at most {PROMISED}")


if __name__ == "__main__":
    main()
