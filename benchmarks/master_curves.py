"""Errors and intervals of shift factors found from random sets of known factors.

Three to eight temperatures, eight to 24 rows at each, 1 to 3 % of noise, moduli proportional to
(T/T_r)^v with v = 0, 0.3 or 1 (`tests/synthetic_isotherms.py`). Sets count as right if all factors
are within 0.1 decades of the truth, and as warned of if the master curve has a warning. The last
columns are the share of factors, warned of or not, whose 95 % interval holds the truth.

    python benchmarks/master_curves.py [--seeds 2000:2400]
"""

from __future__ import annotations

import argparse
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from synthetic_isotherms import known_sets

#: Vertical shift that is right, by the exponent v; None: none of those with a name.
NAMES = {0.0: "none", 0.3: None, 1.0: "rubber"}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", default="2000:2400")
    first, last = map(int, parser.parse_args().seeds.split(":"))
    verdicts, inside = defaultdict(list), defaultdict(list)
    for seed in range(first, last):
        known = known_sets(seed)
        kinds = {known.test: {}}
        if known.test != "oscillation" and NAMES[known.exponent]:
            kinds[f"{known.test}, vertical shift given"] = {"vertical": NAMES[known.exponent]}
        for kind, options in kinds.items():
            try:
                curve = known.joined(**options)
            except ValueError:
                verdicts[kind].append((False, True))
                continue
            errors, widths = np.abs(known.errors(curve)), curve.uncertainty.decades
            verdicts[kind].append((errors.max() < 0.1, bool(curve.warnings)))
            if errors.max() > 0.1 and not curve.warnings:
                print(f"in silence: seed {seed}, {known.law}, {kind}: {errors.max():.3f} decades")
            inside[kind] += (errors <= widths)[widths > 0].tolist()
    print(
        "| test | sets | right | warned of, of these | wrong, warned of | wrong, in silence | in |"
    )
    print("|---|---|---|---|---|---|---|")
    for kind in sorted(verdicts):
        right, warned = np.array(verdicts[kind]).T
        counts = [right.size, right.sum(), (right & warned).sum(), (~right & warned).sum()]
        counts.append((~right & ~warned).sum())
        share = f"{100 * np.mean(inside[kind]):.0f} %"
        print(f"| {kind} | {' | '.join(map(str, counts))} | {share} |")


if __name__ == "__main__":
    main()
