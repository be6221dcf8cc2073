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
from ruamel.yaml import YAML

import viscontact

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
#: Packages whose name on conda-forge differs from that on PyPI.
ON_CONDA = {"netCDF4": "netcdf4", "matplotlib": "matplotlib-base"}


def ran(*command: object, folder: Path = ROOT) -> str:
    """Run a command and return its output; a failure is a failure of the test."""
    words = [str(word) for word in command]
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(words, cwd=folder, env=clean, capture_output=True, text=True)
    assert done.returncode == 0, f"{words}\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Return source archive and wheel of this checkout, by their suffix."""
    folder = tmp_path_factory.mktemp("dist")
    ran(sys.executable, "-m", "hatchling", "build", "-d", folder)
    return {path.suffix: path for path in folder.iterdir()}


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
def test_the_source_archive_builds_the_same_wheel(built: dict[str, Path], tmp_path: Path) -> None:
    with tarfile.open(built[".gz"]) as opened:
        opened.extractall(tmp_path, filter="data")
    (unpacked,) = tmp_path.iterdir()
    assert (unpacked / "tests" / "conftest.py").is_file()  # who packages it can test it
    ran(sys.executable, "-m", "hatchling", "build", "-t", "wheel", folder=unpacked)
    (again,) = (unpacked / "dist").iterdir()
    assert again.read_bytes() == built[".whl"].read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("kind", [".gz", ".whl"])
def test_a_package_runs_from_an_environment_of_its_own(
    built: dict[str, Path], tmp_path: Path, kind: str
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
    ran(scripts / "python", "-m", "pip", "install", "-q", *offline, built[kind])

    command = scripts / "viscontact"
    assert ran(command, "--version", folder=tmp_path) == f"viscontact {viscontact.__version__}\n"
    place = ran(scripts / "python", "-P", "-c", "import viscontact; print(viscontact.__file__)")
    assert Path(place.strip()).is_relative_to(environment)
    ran(command, "example", "sphere-zener", "-o", "my.yaml", folder=tmp_path)
    ran(command, "run", "my.yaml", "--set", "time.steps=3", "-q", folder=tmp_path)
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
    (script,) = found["build"]["python"]["entry_points"]
    assert script == f"viscontact = {PROJECT['scripts']['viscontact']}"


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
