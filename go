#!/usr/bin/env python3
"""Run a task of the project: `./go demo`, `./go test` (on Windows: `py go demo`).

The first call creates `.venv` from `requirements.lock`; for `demo` and `viscontact` from the part
of it that computes and draws, `requirements-demo.lock`. Every file is pinned there by its hash.
Where there is a C++ compiler, the core is compiled into the package; elsewhere runs use NumPy.
It uses uv if that is on the path, otherwise Python's venv and pip. Later calls need no network.
This script uses the standard library only, so Python and git are sufficient.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent
LOCK = ROOT / "requirements.lock"
DEMO_LOCK = ROOT / "requirements-demo.lock"  # the part of it that computes and draws
BUILD_LOCK = ROOT / "requirements-build.lock"  # what compiles wheels in CI
VENV = ROOT / ".venv"
STAMP = VENV / "go-stamp"  # written last: without it the environment is incomplete
LOG = VENV / "go-setup.log"
CORE = ROOT / "src" / "core"  # sources of the compiled core, and the script that compiles it
CORE_STAMP = VENV / "go-core-stamp"  # what was compiled, or could not be
TOOLS = VENV / "go-tools"  # what compiles it for the demo, only meanwhile
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
OLDEST = (3, 11)
AT_ONCE = 16  # packages between two lines about what is left
# Parts of the messages of pip and uv about missing network access.
OFFLINE = ("dns error", "connection", "name resolution", "unreachable", "timed out", "retries")


class TaskError(Exception):
    """The task failed; the message is one line for the user."""


# --- tasks ------------------------------------------------------------------------------------


def demo(args: list[str]) -> int:
    """Compute the shipped roller case and draw its figures."""
    return run(["-m", "viscontact", "demo", *args])


def viscontact(args: list[str]) -> int:
    """Run any command of viscontact: ./go viscontact run my.yaml."""
    return run(["-m", "viscontact", *args], Path.cwd())


def setup(args: list[str]) -> int:
    """Install all that the tasks and the commands of viscontact use, and compile the core."""
    print(f"go: all packages are in {VENV}")
    return 0


def test(args: list[str]) -> int:
    """Run the tests in two processes; --slow adds the slow tests; other options go to pytest."""
    chosen = ["-m", ""] if "--slow" in args else []
    # Halves of the tests, not every other one: few fixtures are then made in both processes.
    halves = ["-n", "2", "--dist", "worksteal"]
    return run(["-m", "pytest", *halves, *chosen, *(a for a in args if a != "--slow")])


def lint(args: list[str]) -> int:
    """Check style, format and types, and the JavaScript; `--fix` corrects the first two."""
    fix = "--fix" in args
    style = ["ruff", "check", "--fix"] if fix else ["ruff", "check"]
    layout = ["ruff", "format"] if fix else ["ruff", "format", "--check"]
    scripts = ["--deny-warnings", "-c", ".ci/oxlint.json", "src/viscontact"]
    checks = [run(["-m", *check]) for check in (style, layout, ["mypy"])]
    return max(*checks, run(scripts, program=PYTHON.with_name(f"oxlint{PYTHON.suffix}")))


def docs(args: list[str]) -> int:
    """Build the manual in build/docs/html; `-D plot_gallery=0` does not run the gallery."""
    folder, source = "build/docs", ROOT / "docs"
    examples = {path.stem for path in (source / "gallery").glob("*.py")}
    shown = {path.stem for path in (source / "examples").glob("plot_*.rst")}
    # Pages that an earlier build generated from deleted sources would become part of the manual.
    stale = [ROOT / folder / "html", source / "reference" / "generated"]
    for made in [*stale, source / "examples"] if shown - examples else stale:
        shutil.rmtree(made, ignore_errors=True)
    strict = ["-W", "--keep-going", "-n", "-q", "-E", "-d", f"{folder}/doctrees"]
    status = run(["-m", "sphinx", *strict, *args, "docs", f"{folder}/html"])
    if status == 0:
        print(f"go: the manual is {folder}/html/index.html")
    return status


def bench(args: list[str]) -> int:
    """Run a benchmark: the paper's rollers, or a named one: published, peers, growth, ..."""
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
    """Build the source archive and the wheel in dist/, and check their metadata."""
    shutil.rmtree(ROOT / "dist", ignore_errors=True)  # earlier ones would be checked, too
    status = run(["-m", "hatchling", "build", *args])
    built = sorted(str(path) for path in (ROOT / "dist").glob("*"))
    return status or run(["-m", "twine", "check", "--strict", *built])


def compatibility(args: list[str]) -> int:
    """Run most default tests with the lowest or the newest versions: compatibility lowest."""
    kind = args[0] if args else ""
    if kind not in VERSIONS:
        raise TaskError(f"compatibility: name the versions, {' or '.join(VERSIONS)}")
    folder = ROOT / "build" / f"compatibility-{kind}"
    python = folder / PYTHON.relative_to(VENV)
    shutil.rmtree(folder, ignore_errors=True)
    uv, wheels = ["-m", "uv", "pip"], ["--only-binary", ":all:"]
    chosen = ["--extra", "all", "--extra", "test", "--generate-hashes", *VERSIONS[kind].split()]
    needs, into = folder / "requirements.txt", ["--python", str(python)]
    steps = [
        ["-m", "uv", "venv", "--quiet", "--python", str(PYTHON), str(folder)],
        [*uv, "compile", "--quiet", "pyproject.toml", *chosen, *wheels, "-o", str(needs)],
        [*uv, "install", *into, *wheels, "--require-hashes", "-r", str(needs)],
        # As it is published: the environment has no build backend.
        ["-m", "hatchling", "build", "-t", "wheel", "-d", str(folder / "wheel")],
    ]
    for step in steps:
        if status := run(step):
            return status
    (wheel,) = (folder / "wheel").glob("*.whl")
    if status := run([*uv, "install", *into, "--no-deps", str(wheel)]):
        return status
    halves = ["-n", "2", "--dist", "worksteal"]
    return run(["-m", "pytest", *halves, *TESTED, *args[1:]], program=python)


def lock(args: list[str]) -> int:
    """Update the locks from pyproject.toml (`--upgrade`: to the newest versions)."""
    # Ignore the configuration of this machine: the locks contain public files only.
    for name in [n for n in os.environ if n.startswith(("UV_INDEX", "UV_DEFAULT", "UV_FIND"))]:
        del os.environ[name]
    options = "--no-config --universal --generate-hashes --no-emit-index-url --no-annotate --quiet"
    wanted = f"--python-version {OLDEST[0]}.{OLDEST[1]} --group build"
    written = ["--custom-compile-command", "./go lock", "--output-file"]
    uv = ["-m", "uv", "pip", "compile", "pyproject.toml", *options.split(), *wanted.split()]
    status = run([*uv, "--extra", "all", "--extra", "dev", *written, LOCK.name, *args])
    extras = ["--extra", "plot", "--extra", "fast", "--constraint", LOCK.name]
    extras += ["--no-emit-package", "tomlkit"]  # for a command of hatchling that no task calls
    status = status or run([*uv, *extras, *written, DEMO_LOCK.name, *args])
    uv.remove("pyproject.toml")  # what builds wheels in CI: the group alone
    return status or run([*uv, "--constraint", LOCK.name, *written, BUILD_LOCK.name, *args])


#: Choice of versions by `./go compatibility`, in options of uv.
VERSIONS = {"lowest": "--resolution lowest-direct", "newest": "--prerelease allow"}

#: Tests with these versions: those of the package, not of the tools of the project.
TESTED = ["tests", "--ignore=tests/project", "--ignore=tests/verification"]

#: Scripts of `./go bench` by their names.
BENCHMARKS = {
    "run": "run.py",
    "costs": "cost_model.py",
    "convolutions": "convolutions.py",
    "growth": "growth.py",
    "published": "published.py",
    "build-peers": "peers/build.py",
    "peers": "peers/compare.py",
    "memory": "memory.py",
    "threads": "threads.py",
    "long-runs": "long_runs.py",
    "many-runs": "many_runs.py",
    "page-answer": "page_answer.py",
    "start-up": "start_up.py",
    "storing": "storing.py",
    "friction": "friction.py",
    "adhesion": "adhesion.py",
    "steady": "steady.py",
    "layers": "layers.py",
    "ends": "ends.py",
    "error-bars": "error_bars.py",
    "temperature": "temperature.py",
    "indentation-intervals": "indentation_intervals.py",
    "inner-loops": "inner_loops.py",
}

TASKS = {
    "demo": demo,
    "viscontact": viscontact,
    "setup": setup,
    "test": test,
    "lint": lint,
    "docs": docs,
    "bench": bench,
    "build": build,
    "compatibility": compatibility,
    "lock": lock,
}

#: Tasks for which the packages of the demo are enough.
COMPUTING = ("demo", "viscontact")

#: Packages that are installed only where the compilation of the core lacks them; for the demo, of
#: which they would be a sixth, only meanwhile.
BUILD_TOOLS = ("cmake",)

# A package that is built here would use files without hashes. The locks are complete. Byte code of
# all modules would take a fifth of the space; what is imported is compiled then.
HASHED_WHEELS = ["--only-binary", ":all:", "--no-deps", "--no-compile", "--require-hashes"]


# --- environment ------------------------------------------------------------------------------


def fingerprint(lock: Path) -> str:
    """Return a hash of the inputs of the environment: lock, project file and path of the clone."""
    contents = [lock.read_bytes(), (ROOT / "pyproject.toml").read_bytes(), str(ROOT).encode()]
    return hashlib.sha256(b"\0".join(contents)).hexdigest()


def is_ready(task: str) -> bool:
    """Return whether the environment has all that a task needs, up to date."""
    if not (PYTHON.exists() and STAMP.exists()):
        return False
    enough = [LOCK, DEMO_LOCK] if task in COMPUTING else [LOCK]
    if STAMP.read_text() not in map(fingerprint, enough):
        return False
    return task != "setup" or not lacked(PYTHON)  # a compiler may be new here


def set_up(lock: Path) -> None:
    """Create the environment, or update it; an incomplete one is created again."""
    uv, pip = shutil.which("uv"), installer()
    make = [uv, "venv", "--python", sys.executable] if uv else [sys.executable, "-m", "venv"]
    # An environment created by uv has no pip, so it cannot be updated without uv.
    updating = PYTHON.exists() and STAMP.exists() and (uv or any(PYTHON.parent.glob("pip*")))
    lacking = lacked(Path(sys.executable)) if lock == LOCK else []
    packages = [each for each in locked_packages(lock) if name_of(each) not in BUILD_TOOLS]
    packages += [each for each in locked_packages(lock) if name_of(each) in lacking]
    doing = "bringing .venv up to date" if updating else "setting up .venv, once"
    print(f"go: {doing}: {len(packages)} packages", flush=True)
    for stamp in (STAMP, CORE_STAMP):
        stamp.unlink(missing_ok=True)
    if not updating:
        if VENV.exists():
            shutil.rmtree(VENV)
        install(make, [str(VENV)])
    part = VENV / "go-part.txt"
    for done in range(0, len(packages), AT_ONCE):
        part.write_text("".join(packages[done : done + AT_ONCE]), encoding="utf-8")
        install(pip, [*HASHED_WHEELS, "-r", str(part)])
        show_left(max(len(packages) - done - AT_ONCE, 0))
    # The build backend is in the lock; an isolated build would download another one. The core is
    # compiled afterwards, which says why if it cannot be.
    project = ["--no-deps", "--no-build-isolation", "--editable", str(ROOT)]
    install(pip, project, VISCONTACT_CORE="off")
    STAMP.write_text(fingerprint(lock))


def locked_packages(lock: Path) -> list[str]:
    """Return the entries of a lock, each a version with its hashes; those of other systems, too."""
    return re.split(r"^(?=\w)", lock.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]


def name_of(package: str) -> str:
    """Return the name in an entry of a lock."""
    return re.split(r"[= ]", package, maxsplit=1)[0]


def installer() -> list[str]:
    """Return the command that installs packages into the environment."""
    uv = shutil.which("uv")
    into = ["--python", str(PYTHON)]
    return [uv, "pip", "install", *into] if uv else [str(PYTHON), "-m", "pip", "install"]


def lacked(python: Path) -> list[str]:
    """Return the build tools that compiling the core needs here, and that are not installed."""
    return core_script(python, "--lacks").stdout.split()


def core_script(python: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run the script that compiles the core."""
    asked = [str(python), str(CORE / "compile_core.py"), *words]
    path = os.pathsep.join([str(TOOLS / "cmake" / "data" / "bin"), os.environ.get("PATH", "")])
    given = clean() | {"PATH": path}
    return subprocess.run(asked, env=given, text=True, capture_output=True, errors="replace")


def core_fingerprint() -> str:
    """Return a hash of the sources of the core."""
    contents = [path.read_bytes() for path in sorted(CORE.glob("*.*"))]
    return hashlib.sha256(b"\0".join(contents)).hexdigest()


def core_is_ready() -> bool:
    """Return whether the core was compiled of these sources and is there, or could not be."""
    stamp = CORE_STAMP.read_text().split() if CORE_STAMP.exists() else []
    place = ROOT / "src" / "viscontact" / "backend"
    is_there = any(place.glob("_core*.so")) or any(place.glob("_core*.pyd"))
    return stamp == [core_fingerprint(), "compiled" if is_there else "failed"]


def compile_core() -> None:
    """Compile the core into the package, and say if it cannot be: runs then use NumPy."""
    if os.environ.get("VISCONTACT_CORE") == "off":
        return
    print("go: compiling the core", flush=True)
    try:
        if lacking := lacked(PYTHON):
            part = VENV / "go-part.txt"
            tools = [each for each in locked_packages(DEMO_LOCK) if name_of(each) in lacking]
            part.write_text("".join(tools), encoding="utf-8")
            install(installer(), [*HASHED_WHEELS, "--target", str(TOOLS), "-r", str(part)])
        done = core_script(PYTHON)
        failed, said = done.returncode != 0, (done.stdout or done.stderr).strip()
    except TaskError as error:  # no network, say: the demo goes on
        failed, said = True, str(error)
    shutil.rmtree(TOOLS, ignore_errors=True)
    reason = said.splitlines()[-1] if said else "no reason given"
    ended = f"no compiled core, so runs use NumPy: {reason}" if failed else "the core is compiled"
    print(f"go: {ended}", flush=True)
    CORE_STAMP.write_text(f"{core_fingerprint()} {'failed' if failed else 'compiled'}")


def show_left(left: int) -> None:
    """Say how many packages are still to be installed, on one line of a terminal."""
    end = "\r" if left and sys.stdout.isatty() else "\n"
    said = f"{left} packages left" if left else "all packages are installed"
    print(f"go: {said:28}", end=end, flush=True)


def install(command: list[str], args: list[str], **added: str) -> None:
    """Run a step of the set-up without output; raise `TaskError` with its last line if it fails."""
    asked, given = [*command, *args], clean() | added
    done = subprocess.run(
        asked, cwd=ROOT, env=given, text=True, capture_output=True, errors="replace"
    )
    if done.returncode == 0:
        return
    said = (done.stdout + done.stderr).strip()
    if VENV.is_dir():
        LOG.write_text(said, encoding="utf-8")
    raise TaskError(cause(said))


def cause(said: str) -> str:
    """Return the reason for a failed set-up in one line, from the output of the installer."""
    if "ensurepip" in said:
        return "this Python cannot make environments: install python3-venv, or uv"
    if any(word in said.lower() for word in OFFLINE):
        return "set-up needs the network once, and the package index could not be reached"
    last = said.splitlines()[-1] if said else "no reason given"
    return f"set-up failed ({last}); all of it is in {LOG}"


def clean() -> dict[str, str]:
    """Return the environment variables without those that would add other packages."""
    foreign = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "PIP_USER", "PIP_TARGET", "PIP_PREFIX")
    return {name: value for name, value in os.environ.items() if name not in foreign}


def run(args: list[str], folder: Path = ROOT, program: Path = PYTHON) -> int:
    """Run a program of the environment in a folder, and return its exit status as a shell does."""
    child = subprocess.Popen([str(program), *args], cwd=folder, env=clean())
    # The child receives Ctrl-C, too; it finishes its step and saves: wait for it.
    signal.signal(signal.SIGINT, lambda *_: None)
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) != signal.SIG_IGN:  # as under nohup
            signal.signal(number, lambda number, _: child.send_signal(number))
    status = child.wait()
    return status if status >= 0 else 128 - status


# --- command line -----------------------------------------------------------------------------


def main(argv: list[str], version: tuple[int, int] = sys.version_info[:2]) -> int:
    """Run the task named by the first argument, with the other arguments."""
    if not argv or argv[0] in ("-h", "--help"):
        print("usage: ./go TASK [ARGUMENTS]\n")
        print("\n".join(f"  {name:14} {task.__doc__}" for name, task in TASKS.items()))
        return 0
    try:
        if argv[0] not in TASKS:
            raise TaskError(f"no task '{argv[0]}'; there are {', '.join(TASKS)}")
        if version < OLDEST:
            raise TaskError(
                f"needs Python {OLDEST[0]}.{OLDEST[1]} or newer, and this is"
                f" {version[0]}.{version[1]} ({sys.executable}); try: python3.13 go {argv[0]}"
            )
        if not is_ready(argv[0]):
            set_up(DEMO_LOCK if argv[0] in COMPUTING else LOCK)
        if argv[0] == "setup" or not core_is_ready():
            compile_core()
        return TASKS[argv[0]](argv[1:])
    except (TaskError, OSError) as error:
        print(f"go: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("go: stopped; the next start begins the set-up again", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
