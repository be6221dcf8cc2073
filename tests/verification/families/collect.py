"""Collect runs, their coarser runs and exact values, to try formulas of error bars on them.

    python -m verification.families.collect --seed 1 --count 50 --out runs.pickle

The pickled list of dicts is described in `solved.py`. With ``--families a,b`` only these are
drawn; the K-th run of a family and a seed is the same whichever others are drawn.
"""

import argparse
import pickle
import time
from pathlib import Path

from verification.families.drawn import FAMILIES, drawn
from verification.families.solved import solve


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--families", default=",".join(FAMILIES))
    parser.add_argument("--sampled", type=int, default=None)
    given = parser.parse_args()
    records = []
    started = time.perf_counter()
    for family, run in drawn(given.seed, given.count, tuple(given.families.split(","))):
        record = solve(family, run, sampled=given.sampled)
        record["seed"] = given.seed
        records.append(record)
        refused = record.get("refused", "")
        print(f"{time.perf_counter() - started:7.1f} s  {family}: {run.name} {refused}", flush=True)
        if len(records) % 10 == 0:
            given.out.write_bytes(pickle.dumps(records))
    given.out.write_bytes(pickle.dumps(records))


if __name__ == "__main__":
    main()
