#!/usr/bin/env python3
"""Run a task of the project: `./go demo`, `./go test` (on Windows: `py go demo`).

The first start makes `.venv` from `requirements.lock`, where every file is pinned by its hash:
with uv when it is on the path, else with Python's own venv and pip. Later starts need no network.
Standard library only, so that an empty machine with Python and git is enough.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent
LOCK = ROOT / "requirements.lock"
VENV = ROOT / ".venv"
STAMP = VENV / "go-stamp"  # written last: without it the environment is half made
LOG = VENV / "go-setup.log"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
OLDEST = (3, 11)
# Words by which pip and uv say that they could not reach anything.
OFFLINE = ("dns error", "connection", "name resolution", "unreachable", "timed out", "retries")


class TaskError(Exception):
    """The task cannot go on; the message is one line for the user."""


# --- tasks ------------------------------------------------------------------------------------


def demo(args: list[str]) -> int:
    """Compute the shipped roller case and draw its pictures."""
    return run(["-m", "viscontact", "demo", *args])


def test(args: list[str]) -> int:
    """Run the tests on two processes; --slow adds the slow ones, the rest goes to pytest."""
    chosen = ["-m", ""] if "--slow" in args else []
    return run(["-m", "pytest", "-n", "2", *chosen, *(a for a in args if a != "--slow")])


def lint(args: list[str]) -> int:
    """Check style, format and types; `--fix` mends the first two."""
    mend = "--fix" in args
    style = ["ruff", "check", "--fix"] if mend else ["ruff", "check"]
    layout = ["ruff", "format"] if mend else ["ruff", "format", "--check"]
    return max([run(["-m", *check]) for check in (style, layout, ["mypy"])])


def docs(args: list[str]) -> int:
    """Build the manual into build/docs/html; `-D plot_gallery=0` leaves out the gallery's runs."""
    folder, source = "build/docs", ROOT / "docs"
    examples = {path.stem for path in (source / "gallery").glob("*.py")}
    shown = {path.stem for path in (source / "examples").glob("plot_*.rst")}
    # What an earlier build has made of sources that are gone would be taken for pages.
    stale = [ROOT / folder / "html", source / "reference" / "generated"]
    for made in [*stale, source / "examples"] if shown - examples else stale:
        shutil.rmtree(made, ignore_errors=True)
    strict = ["-W", "--keep-going", "-n", "-q", "-E", "-d", f"{folder}/doctrees"]
    status = run(["-m", "sphinx", *strict, *args, "docs", f"{folder}/html"])
    if status == 0:
        print(f"go: the manual is {folder}/html/index.html")
    return status


def bench(args: list[str]) -> int:
    """Time the paper's rollers, or what is named first: published, peers, growth, ..."""
    folder = ROOT / "benchmarks"
    if not folder.is_dir():
        raise TaskError("there are no benchmarks here")
    if not args or args[0].startswith("-"):
        return run(["benchmarks/run.py", *args])
    script = BENCHMARKS.get(args[0])
    if script is None:
        raise TaskError(f"no benchmark '{args[0]}'; there are {', '.join(BENCHMARKS)}")
    return run([f"benchmarks/{script}", *args[1:]])


def build(args: list[str]) -> int:
    """Make the wheel in dist/."""
    return run(["-m", "hatchling", "build", "-t", "wheel", *args])


def lock(args: list[str]) -> int:
    """Write requirements.lock anew from pyproject.toml (`--upgrade`: to the newest versions)."""
    # No configuration of this machine may leak in: the lock names public files only.
    for name in [n for n in os.environ if n.startswith(("UV_INDEX", "UV_DEFAULT", "UV_FIND"))]:
        del os.environ[name]
    options = "--no-config --universal --generate-hashes --no-emit-index-url --no-annotate --quiet"
    wanted = f"--python-version {OLDEST[0]}.{OLDEST[1]} --extra all --extra dev"
    written = ["--custom-compile-command", "./go lock", "--output-file", LOCK.name]
    uv = ["-m", "uv", "pip", "compile", "pyproject.toml"]
    return run([*uv, *options.split(), *wanted.split(), *written, *args])


#: What `./go bench` takes as its first word.
BENCHMARKS = {
    "run": "run.py",
    "costs": "cost_model.py",
    "convolutions": "convolutions.py",
    "growth": "growth.py",
    "published": "published.py",
    "build-peers": "peers/build.py",
    "peers": "peers/compare.py",
    "memory": "memory.py",
    "long-runs": "long_runs.py",
    "start-up": "start_up.py",
}

TASKS = {
    "demo": demo,
    "test": test,
    "lint": lint,
    "docs": docs,
    "bench": bench,
    "build": build,
    "lock": lock,
}


# --- environment ------------------------------------------------------------------------------


def fingerprint() -> str:
    """Return what the environment depends on, as one hash: lock, project file and place."""
    contents = [LOCK.read_bytes(), (ROOT / "pyproject.toml").read_bytes(), str(ROOT).encode()]
    return hashlib.sha256(b"\0".join(contents)).hexdigest()


def is_ready() -> bool:
    """Tell whether the environment is whole and up to date."""
    return PYTHON.exists() and STAMP.exists() and STAMP.read_text() == fingerprint()


def set_up() -> None:
    """Make the environment, or bring it up to date; a half-made one is made from scratch."""
    uv = shutil.which("uv")
    make = [uv, "venv", "--python", sys.executable] if uv else [sys.executable, "-m", "venv"]
    pip = [uv, "pip", "install", "--python", str(PYTHON)] if uv else venv_pip()
    # An environment made by uv has no pip: without uv it cannot be brought up to date.
    updating = PYTHON.exists() and STAMP.exists() and (uv or any(PYTHON.parent.glob("pip*")))
    doing = "bringing .venv up to date" if updating else "setting up .venv, once, about a minute"
    print(f"go: {doing}", flush=True)
    STAMP.unlink(missing_ok=True)
    if not updating:
        if VENV.exists():
            shutil.rmtree(VENV)
        install(make, [str(VENV)])
    install(pip, ["--require-hashes", "-r", str(LOCK)])
    # The build backend is in the lock: no isolated build, which would fetch another one.
    install(pip, ["--no-deps", "--no-build-isolation", "--editable", str(ROOT)])
    STAMP.write_text(fingerprint())


def venv_pip() -> list[str]:
    """Return the command of the environment's own pip; building would fetch unhashed files."""
    return [str(PYTHON), "-m", "pip", "install", "--only-binary", ":all:"]


def install(command: list[str], args: list[str]) -> None:
    """Run a step of the set-up in silence; raise `TaskError` with its last word if it fails."""
    done = subprocess.run(
        [*command, *args], cwd=ROOT, env=clean(), text=True, capture_output=True, errors="replace"
    )
    if done.returncode == 0:
        return
    said = (done.stdout + done.stderr).strip()
    if VENV.is_dir():
        LOG.write_text(said, encoding="utf-8")
    raise TaskError(cause(said))


def cause(said: str) -> str:
    """Return in one line why the set-up failed, from what the installer said."""
    if "ensurepip" in said:
        return "this Python cannot make environments: install python3-venv, or uv"
    if any(word in said.lower() for word in OFFLINE):
        return "set-up needs the network once, and the package index could not be reached"
    last = said.splitlines()[-1] if said else "no reason given"
    return f"set-up failed ({last}); all of it is in {LOG}"


def clean() -> dict[str, str]:
    """Return the environment variables without those that would let other packages in."""
    foreign = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "PIP_USER", "PIP_TARGET", "PIP_PREFIX")
    return {name: value for name, value in os.environ.items() if name not in foreign}


def run(args: list[str]) -> int:
    """Run the environment's Python and return its exit status, as a shell counts it."""
    child = subprocess.Popen([str(PYTHON), *args], cwd=ROOT, env=clean())
    # Ctrl-C reaches the child too, which finishes its step and saves: wait for it.
    signal.signal(signal.SIGINT, lambda *_: None)
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:  # as under nohup
            signal.signal(number, lambda number, _: child.send_signal(number))
    status = child.wait()
    return status if status >= 0 else 128 - status


# --- front door -------------------------------------------------------------------------------


def main(argv: list[str], version: tuple[int, int] = sys.version_info[:2]) -> int:
    """Run the task named first, with the other arguments passed on to it."""
    if not argv or argv[0] in ("-h", "--help"):
        print("usage: ./go TASK [ARGUMENTS]\n")
        print("\n".join(f"  {name:6} {task.__doc__}" for name, task in TASKS.items()))
        return 0
    try:
        if argv[0] not in TASKS:
            raise TaskError(f"no task '{argv[0]}'; there are {', '.join(TASKS)}")
        if version < OLDEST:
            raise TaskError(
                f"needs Python {OLDEST[0]}.{OLDEST[1]} or newer, and this is"
                f" {version[0]}.{version[1]} ({sys.executable}); try: python3.13 go {argv[0]}"
            )
        if not is_ready():
            set_up()
        return TASKS[argv[0]](argv[1:])
    except (TaskError, OSError) as error:
        print(f"go: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("go: stopped; the next start begins the set-up again", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
