"""Compile the core into the package of this checkout; where that fails, say why.

`./go` runs it at set-up, and hatch_build.py for wheels. It uses the standard library, and CMake and
nanobind, which are in the locks. VISCONTACT_CORE=off leaves the core out.

    .venv/bin/python src/core/compile_core.py            # compile
    python src/core/compile_core.py --lacks              # packages of the lock that it needs here
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PLACE = ROOT / "src" / "viscontact" / "backend"  # where a checkout has its own
BUILD = ROOT / "build" / f"core-{sysconfig.get_config_var('SOABI') or sys.implementation.cache_tag}"
COMPILERS = ("c++", "g++", "clang++")
OLDEST_CMAKE = (3, 18)
#: Variables that CMake reads at the first configuration of a folder.
VARIABLES = ("CXX", "CXXFLAGS", "LDFLAGS", "SDKROOT", "MACOSX_DEPLOYMENT_TARGET")


class NotCompiledError(Exception):
    """There is no compiled core; the message is the reason, in one line."""


def compiled(build: Path = BUILD) -> Path:
    """Compile the core in a folder, and return the extension module."""
    if is_off():
        raise NotCompiledError("VISCONTACT_CORE is off")
    if not has_compiler():
        raise NotCompiledError("there is no C++ compiler")
    cmake = program("cmake")
    if cmake is None:
        raise NotCompiledError("there is no CMake")
    if os.name != "nt" and not (program("make") or program("ninja")):
        raise NotCompiledError("there is neither make nor Ninja")
    asked = options()
    # CMake keeps what it found, so a folder made for another place, Python or compiler begins anew.
    made_for = "\n".join([str(HERE), *asked, *(os.environ.get(name, "") for name in VARIABLES)])
    marker, log, into = build / "made-for.txt", build / "log.txt", build / "installed"
    if not (marker.exists() and marker.read_text(encoding="utf-8") == made_for):
        shutil.rmtree(build, ignore_errors=True)
        build.mkdir(parents=True)
    shutil.rmtree(into, ignore_errors=True)
    log.write_text("", encoding="utf-8")
    done([cmake, "-S", str(HERE), "-B", str(build), *asked], log)
    marker.write_text(made_for, encoding="utf-8")
    done([cmake, "--build", str(build), "--config", "Release", "--parallel"], log)
    done([cmake, "--install", str(build), "--config", "Release", "--prefix", str(into)], log)
    (extension,) = into.glob("_core*")
    return extension


def is_off() -> bool:
    """Whether the environment leaves the core out."""
    return os.environ.get("VISCONTACT_CORE") == "off"


def options() -> list[str]:
    """Return the options of CMake: which Python, what builds, and the processors of a Mac."""
    asked = ["-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}"]
    ninja = program("ninja") if os.name != "nt" else None  # Visual Studio has its own
    if ninja:
        asked += ["-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={ninja}"]
    if processors := re.findall(r"-arch (\S+)", os.environ.get("ARCHFLAGS", "")):
        asked.append(f"-DCMAKE_OSX_ARCHITECTURES={';'.join(processors)}")
    return asked


def done(step: list[str], log: Path) -> None:
    """Run a step of CMake; if it fails, raise the first line that says why."""
    ran = subprocess.run(step, capture_output=True, text=True, errors="replace")
    said = ran.stdout + ran.stderr
    with log.open("a", encoding="utf-8") as kept:
        kept.write(said)
    if ran.returncode != 0:
        raise NotCompiledError(f"{cause(said)} (all of it is in {log})")


def cause(said: str) -> str:
    """Return the reason in one line, from the output of CMake or of a compiler."""
    told = re.search(
        r"^CMake Error[^\n]*:\s*\n(.*?)(\n  It fails with|\n\n\n|\Z)", said, re.M | re.S
    )
    if told:
        return " ".join(told[1].split()).rstrip(".")
    wrong = re.search(r"^.*\berror\b.*$", said, re.M | re.I)
    return wrong[0].strip() if wrong else (said.strip().splitlines() or ["no reason given"])[-1]


def has_compiler() -> bool:
    """Whether there seems to be a C++ compiler; a broken one is found by using it."""
    if named := os.environ.get("CXX"):
        return shutil.which(named.split()[0]) is not None
    if os.name == "nt":  # it is on no path; CMake finds it as vswhere does
        programs = Path(os.environ.get("PROGRAMFILES(X86)", "C:/Program Files (x86)"))
        found = programs / "Microsoft Visual Studio" / "Installer" / "vswhere.exe"
        return found.exists() or shutil.which("cl") is not None
    if sys.platform == "darwin":  # the commands are there without the tools, and offer them
        asked = subprocess.run(["/usr/bin/xcode-select", "-p"], capture_output=True)
        return asked.returncode == 0
    return any(map(shutil.which, COMPILERS))


def program(name: str) -> str | None:
    """Return the path of a program, that of the environment if the system has none."""
    beside = str(Path(sys.executable).parent)
    for place in (shutil.which(name), shutil.which(name, path=beside)):
        if place and (name != "cmake" or version_of(place) >= OLDEST_CMAKE):
            return place
    return None


def version_of(cmake: str) -> tuple[int, ...]:
    """Return the version of a CMake; none if it does not start."""
    try:
        said = subprocess.run([cmake, "--version"], capture_output=True, text=True).stdout
    except OSError:
        return ()
    found = re.search(r"version (\d+)\.(\d+)", said)
    return (int(found[1]), int(found[2])) if found else ()


def lacks() -> list[str]:
    """Return the build tools, of those in the lock, that this machine needs and does not have.

    CMake takes a sixth of the space of all other packages of the demo.
    """
    if is_off() or not has_compiler():
        return []
    return [] if program("cmake") else ["cmake"]


def into_checkout() -> Path:
    """Compile the core and put it into the package of this checkout, in place of an earlier one."""
    earlier = [] if is_off() else [*PLACE.glob("_core*.so"), *PLACE.glob("_core*.pyd")]
    try:
        extension = compiled()
    except NotCompiledError:
        remove(earlier)  # built of other sources, or for another Python
        raise
    # At once: a run that starts meanwhile finds the earlier one or this one, and no half of a file.
    place = PLACE / extension.name
    copy = Path(shutil.copy2(extension, PLACE / f".{extension.name}"))
    try:
        copy.replace(place)
    except PermissionError as error:  # Windows keeps what a process has loaded
        copy.unlink()
        raise NotCompiledError(f"{place.name} is in use: {error}") from error
    remove([each for each in earlier if each != place])
    return place


def remove(files: list[Path]) -> None:
    """Delete files, but for those that a process has loaded, on Windows."""
    for each in files:
        with contextlib.suppress(PermissionError):
            each.unlink()


def main(argv: list[str]) -> int:
    """Compile the core, or name what that lacks."""
    if argv == ["--lacks"]:
        print(" ".join(lacks()))
        return 0
    try:
        print(into_checkout())
    except NotCompiledError as reason:
        print(reason)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
