"""Licences of GNU are those of extras alone, which the README names; the bill of materials."""

from __future__ import annotations

import importlib.util
import json
import re
import tomllib
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from packaging.utils import canonicalize_name

from returned import some

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
README = (ROOT / "README.md").read_text(encoding="utf-8")
#: Packages of an extra under a licence of GNU, by the words of their metadata.
BINDING = {"fast": {"ducc0"}, "surfaces": {"igor2"}, "afm": {"igor2"}}
#: Packages that bring a program under such a licence, which their metadata do not state.
WITH_PROGRAM = {"animation": {"imageio-ffmpeg"}}
#: Licences that ask for nothing but their own text.
FREE = re.compile(
    r"MIT|BSD|Apache|ISC|PSF|Python Software Foundation|Mozilla Public|MPL|Zlib|CC0|0BSD|Unlicense"
)


@pytest.fixture(scope="module")
def sbom() -> ModuleType:
    """Return the script that writes the bill of materials."""
    spec = importlib.util.spec_from_file_location("sbom", ROOT / ".ci" / "sbom.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def installed(names: set[str]) -> dict[str, Any]:
    """Packages by name, without those that are for other systems."""
    found = {}
    for name in names:
        try:
            found[name] = distribution(name)
        except PackageNotFoundError:
            continue
    return found


def is_binding(licence: str) -> bool:
    """True for licences of GNU, unless there is a choice."""
    return re.search(r"GPL|General Public", licence) is not None and not FREE.search(licence)


def test_nothing_that_is_required_is_under_a_licence_of_gnu(sbom: ModuleType) -> None:
    for name, package in some(installed(sbom.needed(extras=())).items()):
        assert FREE.search(sbom.licence(package)), (name, sbom.licence(package))


def test_licences_of_gnu_stay_in_extras_which_the_readme_names(sbom: ModuleType) -> None:
    users = set(PROJECT["optional-dependencies"]) - {"all", "test", "docs", "dev"}
    for extra in some(sorted(users)):
        packages = installed(sbom.needed(extras=(extra,)))
        found = {name for name, each in packages.items() if is_binding(sbom.licence(each))}
        assert found <= BINDING.get(extra, set()), extra
        for name in found | WITH_PROGRAM.get(extra, set()):
            assert f"`{extra}`" in README
            assert name in README


def test_every_licence_is_known_to_ask_for_little_or_is_one_of_gnu(sbom: ModuleType) -> None:
    packages = installed(sbom.needed())
    assert len(packages) > 40
    for name, package in packages.items():
        licence = sbom.licence(package)
        assert FREE.search(licence) or is_binding(licence), (name, licence)


def test_the_bill_of_materials_has_the_files_of_the_lock(sbom: ModuleType) -> None:
    bill = json.loads(json.dumps(sbom.bill()))
    assert (bill["bomFormat"], bill["specVersion"]) == ("CycloneDX", "1.6")
    assert bill["metadata"]["component"]["version"] == PROJECT["version"]
    names = {each["name"] for each in bill["components"]}
    required = {re.split(r"[<>=]", need)[0] for need in PROJECT["dependencies"]}
    assert {canonicalize_name(name) for name in required} <= names
    assert not names & {"pytest", "mypy", "ruff", "sphinx", "uv"}
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    for each in bill["components"]:
        assert f"{each['name']}=={each['version']}" in lock
        (files,) = each["externalReferences"]
        assert files["hashes"]
        for known in files["hashes"]:
            assert f"--hash=sha256:{known['content']}" in lock
