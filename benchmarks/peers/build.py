"""Create an environment for each other program, in benchmarks/peers/environments (not in git).

ASPHER is built from source: it needs CMake, a C++17 compiler and Eigen (Debian: cmake g++
libeigen3-dev). slippy cannot be installed on Python 3.11 or later and is left out.

    python benchmarks/peers/build.py [NAME ...] [--anew]
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent / "environments"

#: Packages of each program, with the versions for which the drivers were written.
PACKAGES = {
    "aspher": ["aspher==0.1.3.post1"],
    "tamaas": ["tamaas==2.9.0"],
    "contactmechanics": ["ContactMechanics==1.8.3"],
}


def python_of(name: str) -> Path:
    """Path of the Python of an environment, which need not exist."""
    return HERE / name / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def build(name: str) -> str:
    """Create one environment and return the outcome in one line."""
    shutil.rmtree(HERE / name, ignore_errors=True)
    commands = [
        [sys.executable, "-m", "venv", str(HERE / name)],
        [str(python_of(name)), "-m", "pip", "install", "--quiet", *PACKAGES[name]],
    ]
    for command in commands:
        done = subprocess.run(command, text=True, capture_output=True, check=False)
        if done.returncode:
            # An incomplete environment would be regarded as complete.
            shutil.rmtree(HERE / name, ignore_errors=True)
            said = (done.stderr or done.stdout).strip().splitlines()
            return f"{name}: not built: {said[-1] if said else 'no reason given'}"
    return f"{name}: built ({', '.join(PACKAGES[name])})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(PACKAGES))
    parser.add_argument("--anew", action="store_true", help="also those that are there")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in PACKAGES]
    if unknown:
        parser.error(f"no peer '{unknown[0]}'; there are {', '.join(PACKAGES)}")
    for name in options.names or PACKAGES:
        there = python_of(name).exists() and not options.anew
        print(f"{name}: there already" if there else build(name), flush=True)


if __name__ == "__main__":
    main()
