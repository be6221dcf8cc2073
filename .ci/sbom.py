"""Bill of materials of a release: what viscontact, its extras and its core need, as in the lock.

Run `.venv/bin/python .ci/sbom.py viscontact.cdx.json`; this is JSON of CycloneDX 1.6 (ECMA-424).
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

#: Packages whose code is in the compiled core.
COMPILED = {"nanobind"}
LOCK = Path(__file__).parents[1] / "requirements.lock"


def needed(package: str = "viscontact", extras: tuple[str, ...] = ("all",)) -> set[str]:
    """Names of all packages that a package with some extras needs on this system."""
    found: set[str] = set()
    asked = [(package, extra) for extra in ("", *extras)]
    seen = set(asked)
    while asked:
        name, extra = asked.pop()
        found.add(name)
        try:
            requires = distribution(name).requires or []
        except PackageNotFoundError:  # not for this system
            continue
        for need in map(Requirement, requires):
            if need.marker is None or need.marker.evaluate({"extra": extra}):
                new = {(canonicalize_name(need.name), each) for each in ("", *need.extras)} - seen
                seen |= new
                asked += new
    return found - {package}


def licence(package: Distribution) -> str:
    """Licence that a package states: an expression, else the names of its classifiers."""
    stated = package.metadata
    if expression := stated.get("License-Expression"):
        return str(expression)
    listed = [line for line in stated.get_all("Classifier") or [] if line.startswith("License")]
    names = [line.split(" :: ")[-1] for line in listed]
    return "; ".join(names) or (stated.get("License") or "not stated").split("\n")[0].strip("# ")


def components() -> Iterator[dict[str, Any]]:
    """Components with version, licence and hashes of their files."""
    names = needed() | COMPILED
    for entry in re.split(r"^(?=[a-z0-9])", LOCK.read_text(encoding="utf-8"), flags=re.MULTILINE):
        name, _, rest = entry.partition("==")
        if canonicalize_name(name) not in names:
            continue
        version = re.split(r"[\s;\\]", rest, maxsplit=1)[0]
        files = re.findall(r"--hash=sha256:(\w+)", entry)
        yield {
            "type": "library",
            "bom-ref": (url := f"pkg:pypi/{name}@{version}"),
            "name": name,
            "version": version,
            "purl": url,
            "licenses": [{"license": {"name": licence(distribution(name))}}],
            "externalReferences": [
                {
                    "type": "distribution",
                    "url": url,
                    "hashes": [{"alg": "SHA-256", "content": each} for each in files],
                }
            ],
        }


def bill() -> dict[str, Any]:
    """Bill of materials as plain data."""
    this = distribution("viscontact")
    url = f"pkg:pypi/viscontact@{this.version}"
    about = {"type": "library", "bom-ref": url, "name": "viscontact", "version": this.version}
    licences = [{"license": {"name": licence(this)}}]
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": about | {"purl": url, "licenses": licences}},
        "components": list(components()),
    }


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(json.dumps(bill(), indent=1) + "\n", encoding="utf-8")
