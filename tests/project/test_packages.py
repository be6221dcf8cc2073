"""What is published: source archive, wheel, conda recipe and the versions of the manual."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import venv
import zipfile
from email import message_from_bytes
from pathlib import Path
from typing import Any

import pytest
from packaging.tags import sys_tags
from packaging.utils import parse_wheel_filename
from ruamel.yaml import YAML

import viscontact

ROOT = Path(__file__).parents[2]
SETTINGS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = SETTINGS["project"]
#: Packages whose name on conda-forge differs from that on PyPI.
ON_CONDA = {"netCDF4": "netcdf4", "matplotlib": "matplotlib-base"}


def ran(*command: object, folder: Path = ROOT, **added: str) -> str:
    """Run a command and return its output; a failure is a failure of the test."""
    words = [str(word) for word in command]
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(words, cwd=folder, env=clean | added, capture_output=True, text=True)
    assert done.returncode == 0, f"{words}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Return source archive and wheel of this checkout, by their suffix.

    VISCONTACT_WHEELS is a folder with wheels that were built before: the one for this Python.
    """
    folder = tmp_path_factory.mktemp("dist")
    ran(sys.executable, "-m", "hatchling", "build", "-d", folder)
    found = {path.suffix: path for path in folder.iterdir()}
    if given := os.environ.get("VISCONTACT_WHEELS"):
        here = {str(tag) for tag in sys_tags()}
        wheels = sorted((ROOT / given).glob("*.whl"))
        (found[".whl"],) = (path for path in wheels if tags(path) & here)
    return found


def tags(wheel: Path) -> set[str]:
    """Tags of the systems that a wheel is for."""
    return {str(tag) for tag in parse_wheel_filename(wheel.name)[3]}


def core_of(wheel: Path) -> list[str]:
    """Compiled cores in a wheel."""
    return [name for name in files_of(wheel) if name.endswith((".so", ".pyd"))]


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the wheel of a machine whose compiler fails."""
    folder = tmp_path_factory.mktemp("plain")
    ran(
        sys.executable,
        "-m",
        "hatchling",
        "build",
        "-t",
        "wheel",
        "-d",
        folder,
        CXX="false",
        VISCONTACT_CORE="",
    )
    (wheel,) = folder.iterdir()
    return wheel


def files_of(wheel: Path) -> set[str]:
    with zipfile.ZipFile(wheel) as opened:
        return set(opened.namelist())


@pytest.mark.slow
def test_archive_and_wheel_pass_the_check_of_the_package_index(built: dict[str, Path]) -> None:
    assert set(built) == {".gz", ".whl"}
    ran(sys.executable, "-m", "twine", "check", "--strict", *built.values())


@pytest.mark.slow
def test_the_wheel_holds_the_package_and_nothing_else(built: dict[str, Path]) -> None:
    names = files_of(built[".whl"])
    assert {name.split("/")[0] for name in names} == {
        "viscontact",
        f"viscontact-{viscontact.__version__}.dist-info",
    }
    source = ROOT / "src" / "viscontact"
    for path in source.rglob("*"):  # examples, static files and stubs too
        if path.is_file() and "__pycache__" not in path.parts:
            assert path.relative_to(source.parent).as_posix() in names


@pytest.mark.slow
def test_a_wheel_is_for_the_systems_that_its_core_runs_on(
    built: dict[str, Path], plain: Path
) -> None:
    core = core_of(built[".whl"])
    if os.environ.get("VISCONTACT_CORE") == "required":
        assert core
    for name in core:
        assert Path(name).parent == Path("viscontact/backend")
        assert "any" not in {tag.rsplit("-", 1)[1] for tag in tags(built[".whl"])}
        assert tags(built[".whl"]) & {str(tag) for tag in sys_tags()}
        stable = Path(name).name in ("_core.abi3.so", "_core.pyd")
        assert all(("-abi3-" in tag) == stable for tag in tags(built[".whl"]))
        if os.environ.get("VISCONTACT_WHEELS"):  # published: one for all later versions
            assert stable == (sys.version_info >= (3, 12))
    assert core_of(plain) == []
    assert tags(plain) == {"py3-none-any"}
    # The binary holds code of nanobind, whose licence wants to be there.
    added = files_of(built[".whl"]) - files_of(plain)
    information = f"viscontact-{viscontact.__version__}.dist-info"
    licence = f"{information}/licenses/nanobind/LICENSE"
    assert added == {*core, licence} if core else added == set()
    if core:
        with zipfile.ZipFile(built[".whl"]) as opened:
            text = opened.read(licence).decode()
        assert "Wenzel Jakob" in text
        assert "MIT License" in text


@pytest.mark.slow
def test_a_core_that_is_required_and_fails_stops_the_build(tmp_path: Path) -> None:
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    given = {**os.environ, "VISCONTACT_CORE": "required", "CXX": "false"}
    done = subprocess.run(build, cwd=ROOT, env=given, capture_output=True, text=True)
    assert done.returncode != 0
    assert not any(tmp_path.iterdir())


@pytest.mark.slow
def test_the_source_archive_builds_the_same_wheel(built: dict[str, Path], tmp_path: Path) -> None:
    with tarfile.open(built[".gz"]) as opened:
        opened.extractall(tmp_path, filter="data")
    (unpacked,) = tmp_path.iterdir()
    assert (unpacked / "tests" / "conftest.py").is_file()  # who packages it can test it
    ran(sys.executable, "-m", "hatchling", "build", "-t", "wheel", folder=unpacked)
    (again,) = (unpacked / "dist").iterdir()
    assert again.read_bytes() == built[".whl"].read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("kind", [".gz", ".whl", "plain"])
def test_a_package_runs_from_an_environment_of_its_own(
    built: dict[str, Path], plain: Path, tmp_path: Path, kind: str
) -> None:
    environment = tmp_path / "environment"
    venv.create(environment, with_pip=True)
    scripts = environment / ("Scripts" if sys.platform == "win32" else "bin")
    # Its dependencies are those of the tests: nothing is downloaded. The editable install there
    # is not seen, as files of paths count in the environment's own folder only.
    installed = ran(scripts / "python", "-c", "import sysconfig as s; print(s.get_path('purelib'))")
    dependencies = {str(path) for path in map(Path, sys.path) if path.name == "site-packages"}
    (Path(installed.strip()) / "dependencies.pth").write_text("\n".join(sorted(dependencies)))
    offline = ("--no-index", "--no-deps", "--no-build-isolation", "--force-reinstall")
    package = built.get(kind, plain)
    ran(scripts / "python", "-m", "pip", "install", "-q", *offline, package)

    command = scripts / "viscontact"
    assert ran(command, "--version", folder=tmp_path) == f"viscontact {viscontact.__version__}\n"
    place = ran(scripts / "python", "-P", "-c", "import viscontact; print(viscontact.__file__)")
    assert Path(place.strip()).is_relative_to(environment)
    usual = {"VISCONTACT_CORE": ""}  # one of the packages is without what CI requires
    said = ran(command, "doctor", folder=tmp_path, **usual)
    kernels = "compiled" if core_of(built[".whl"]) else "NumPy (no compiled core: it is not built)"
    if package == plain:
        kernels = "NumPy (no compiled core: it is not built)"
    assert re.search(rf"^inner loops +{re.escape(kernels)} *$", said, re.MULTILINE)
    ran(command, "example", "sphere-zener", "-o", "my.yaml", folder=tmp_path, **usual)
    ran(command, "run", "my.yaml", "--set", "time.steps=3", "-q", folder=tmp_path, **usual)
    assert (tmp_path / "my" / "result.nc").is_file()


@pytest.mark.slow
def test_what_is_built_names_every_supported_python(built: dict[str, Path]) -> None:
    with zipfile.ZipFile(built[".whl"]) as opened:
        (name,) = (name for name in opened.namelist() if name.endswith("METADATA"))
        metadata = message_from_bytes(opened.read(name))
    listed = [line for line in metadata.get_all("Classifier", []) if "Python :: 3." in line]
    checked = (ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8")
    (matrix,) = re.findall(r"python: \[(.*)\]", checked)
    assert [line.rsplit(" ", 1)[1] for line in listed] == re.findall(r"[\d.]+", matrix)


# --- conda --------------------------------------------------------------------------------------


def recipe() -> dict[str, Any]:
    found: dict[str, Any] = YAML(typ="safe").load(ROOT / "recipe" / "recipe.yaml")
    return found


def wanted(needs: list[str]) -> set[str]:
    """Requirements of pyproject.toml in the words of conda, without their environment markers."""
    plain = [need.split(";")[0].strip() for need in needs if not need.startswith("viscontact")]
    pairs = [re.fullmatch(r"([\w.-]+)(.*)", need) for need in plain]
    return {f"{ON_CONDA.get(pair[1], pair[1])} {pair[2]}" for pair in pairs if pair}


def test_the_conda_recipe_requires_what_the_project_requires() -> None:
    found, extras = recipe(), PROJECT["optional-dependencies"]
    assert found["context"]["version"] == PROJECT["version"]
    assert f">={found['context']['python_min']}" == PROJECT["requires-python"]
    run = set(found["requirements"]["run"]) - {"python >=${{ python_min }}"}
    assert run == wanted(PROJECT["dependencies"])
    optional = wanted([need for extra in extras.values() for need in extra])
    assert set(found["requirements"]["run_constraints"]) <= optional


def test_the_conda_recipe_compiles_the_core_with_the_project_s_tools() -> None:
    found = recipe()
    assert found["build"]["script"]["env"] == {"VISCONTACT_CORE": "required"}
    assert "noarch" not in found["build"]
    tools = {*SETTINGS["build-system"]["requires"], *SETTINGS["dependency-groups"]["build"]}
    needs = found["requirements"]
    assert wanted(sorted(tools)) <= {*needs["build"], *needs["host"]}
    assert "${{ compiler('cxx') }}" in needs["build"]


# --- the manual ---------------------------------------------------------------------------------


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
def test_each_version_of_the_manual_is_kept_and_listed(tmp_path: Path) -> None:
    publish, site = ROOT / ".ci" / "publish-manual", tmp_path / "site"
    for version in ("v0.9.0", "v0.10.0", "main"):
        made = tmp_path / version
        made.mkdir()
        (made / "index.html").write_text(f"manual of {version}", encoding="utf-8")
        ran("bash", publish, made, site, version)
    (tmp_path / "main" / "index.html").write_text("newer", encoding="utf-8")
    ran("bash", publish, tmp_path / "main", site, "main")
    listed = re.findall(r'href="([^"]*)"', (site / "index.html").read_text(encoding="utf-8"))
    assert listed == ["v0.10.0/index.html", "v0.9.0/index.html", "main/index.html"]
    texts = [(site / page).read_text(encoding="utf-8") for page in listed]
    assert texts == ["manual of v0.10.0", "manual of v0.9.0", "newer"]
    refused = subprocess.run(["bash", publish, site, site, "../x"], capture_output=True, text=True)
    assert refused.returncode == 2
    assert "a version is main or a tag like v0.1.0" in refused.stderr
