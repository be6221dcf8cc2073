"""What CI may do: pinned actions, few rights, hashed packages; no writing where code runs."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from returned import some

ROOT = Path(__file__).parents[2]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
BUILD_LOCK = "requirements-build.lock"
RUN = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
#: Words of commands that install packages or run code of them.
RUNS = re.compile(r"\b(go|pip|uv|python|pytest|twine|hatchling|cibuildwheel)\b|\.ci/run")


def unpinned(text: str) -> list[str]:
    """Actions of a workflow that are not pinned by a commit with its version beside it."""
    used = re.findall(r"^\s*(?:-\s*)?uses:\s*(.*)$", text, re.MULTILINE)
    return [each for each in used if not re.fullmatch(r"[\w./-]+@[0-9a-f]{40} # v\d[\d.]*", each)]


def unhashed(command: str) -> list[str]:
    """Lines that install files without hashes, which ./go does not."""
    lines = command.replace("\\\n", " ").splitlines()
    strict = ("--require-hashes", "--only-binary :all:")
    return [
        line
        for line in lines
        if re.search(r"\b(pip|uv|pipx|npm|conda|apt-get)\b.*\b(install|sync|run|tool)\b", line)
        and not all(option in line for option in strict)
    ]


def workflow(path: Path) -> dict[str, Any]:
    read: dict[str, Any] = YAML(typ="safe").load(path)
    return read


def jobs() -> Iterator[tuple[str, dict[str, Any]]]:
    """Jobs of all workflows by name."""
    for path in some(WORKFLOWS):
        for name, job in some(workflow(path)["jobs"].items()):
            yield f"{path.stem}/{name}", job


def commands(job: dict[str, Any]) -> str:
    return "\n".join(step.get("run", "") for step in job["steps"])


def writes(job: dict[str, Any]) -> bool:
    return any(right == "write" for right in job.get("permissions", {}).values())


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_every_action_is_pinned_by_its_commit(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert "uses:" in text
    assert unpinned(text) == []


@pytest.mark.parametrize(
    "action",
    ["actions/checkout@v4", "a/b@release/v1", "a/b@" + 40 * "a", "a/b@" + 39 * "a" + " # v1"],
)
def test_an_action_of_a_tag_a_branch_or_without_its_version_is_found(action: str) -> None:
    assert unpinned(f"    steps:\n      - uses: {action}\n") == [action]
    assert unpinned(f"    steps:\n      - name: a\n        uses: {action}\n") == [action]


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_may_read_the_repository_and_nothing_else(path: Path) -> None:
    assert workflow(path)["permissions"] == {"contents": "read"}
    assert not {"pull_request_target", "workflow_run"} & set(workflow(path).get("on", {}))


def test_jobs_that_may_write_install_and_run_nothing() -> None:
    writing = {name: job for name, job in jobs() if writes(job)}
    assert set(writing) == {
        "manual/publish",
        "release/attest",
        "release/publish",
        "release/release",
        "weekly/propose",
    }
    for name, job in writing.items():
        assert not RUNS.search(commands(job)), name
        assert not any("setup" in step.get("uses", "") for step in job["steps"]), name


def test_no_job_has_rights_that_it_does_not_need() -> None:
    needed = {
        "manual/publish": {"contents": "write"},
        "release/attest": {"id-token": "write", "attestations": "write"},
        "release/publish": {"id-token": "write"},
        "release/release": {"contents": "write"},
        "weekly/propose": {"contents": "write", "pull-requests": "write"},
    }
    for name, job in some(list(jobs())):
        assert job.get("permissions", {}) == needed.get(name, {}), name


def test_no_checkout_leaves_the_token_on_the_disk() -> None:
    checkouts = [
        step for _, job in jobs() for step in job["steps"] if "checkout@" in step.get("uses", "")
    ]
    for step in some(checkouts):
        assert step["with"]["persist-credentials"] is False


def test_every_job_ends_in_time_and_takes_no_text_of_an_event_as_code() -> None:
    for name, job in some(list(jobs())):
        assert job["timeout-minutes"] <= 90, name
        assert "${{" not in commands(job), name


def test_every_package_that_ci_installs_has_its_hash() -> None:
    for name, job in some(list(jobs())):
        assert unhashed(commands(job)) == [], name
    for file in (".ci/conda-requirements.txt", ".ci/wheels-requirements.txt", BUILD_LOCK):
        pinned = (ROOT / file).read_text(encoding="utf-8")
        for entry in some(re.split(r"^(?=[a-z])", pinned, flags=re.MULTILINE)[1:]):
            assert re.match(r"[\w-]+==[\w.]+ ", entry)
            assert "--hash=sha256:" in entry


def test_what_compiles_wheels_has_its_hash_and_is_in_the_lock() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    settings = project["tool"]["cibuildwheel"]
    assert unhashed(settings["before-build"]) == []
    assert settings["before-build"].endswith(f"{{project}}/{BUILD_LOCK}")
    assert "--no-build-isolation" in settings["build-frontend"]["args"]
    compiling, locked = entries(BUILD_LOCK), entries("requirements.lock")
    for need in [*project["build-system"]["requires"], *project["dependency-groups"]["build"]]:
        assert any(entry.startswith(re.split(r"[<>=]", need)[0] + "==") for entry in compiling)
    assert compiling <= locked


def test_core_and_numpy_are_both_tried_on_all_systems() -> None:
    steps = workflow(ROOT / ".github" / "workflows" / "ci.yml")["jobs"]["test"]["steps"]
    tried = {step["env"]["VISCONTACT_CORE"]: step["run"] for step in steps if "env" in step}
    assert tried["required"] == "python go test"
    assert tried["off"].startswith("python go test tests/backend tests/mechanics")
    assert any("VISCONTACT_CORE=off" in line and "tests/mechanics" in line for line in RUN)


def entries(lock: str) -> set[str]:
    """Entries of a lock, with their hashes."""
    read = (ROOT / lock).read_text(encoding="utf-8")
    return set(re.split(r"^(?=[a-z])", read, flags=re.MULTILINE)[1:])


@pytest.mark.parametrize(
    "command", ["pip install x", "uv pip install -r a", "uv tool run x", "apt-get install -y x"]
)
def test_an_install_without_hashes_is_found(command: str) -> None:
    assert unhashed(f"a\n{command}\nb") == [command]


def test_packages_are_built_apart_from_where_they_are_published() -> None:
    release = workflow(ROOT / ".github" / "workflows" / "release.yml")["jobs"]
    assert release["publish"]["needs"] == "attest"
    assert release["attest"]["needs"] == ["build", "wheels"]
    for job in ("build", "wheels"):
        assert "permissions" not in release[job]
    assert "go build" in commands(release["build"])
    assert "cibuildwheel" in commands(release["wheels"])
    for job in ("attest", "publish", "release"):  # all of them, or none is published
        taken = [step["with"] for step in release[job]["steps"] if "download" in str(step)]
        assert {"name": "packages", "path": "dist"} in taken
        assert {"pattern": "wheels-*", "path": "dist", "merge-multiple": True} in taken
    attested = [step["with"] for step in release["attest"]["steps"] if "attest@" in step["uses"]]
    assert [given.get("sbom-path") for given in attested] == [None, "viscontact.cdx.json"]


def test_actions_and_what_builds_the_conda_package_are_renewed() -> None:
    renewed = YAML(typ="safe").load(ROOT / ".github" / "dependabot.yml")["updates"]
    assert {(each["package-ecosystem"], each["directory"]) for each in renewed} == {
        ("github-actions", "/"),
        ("pip", "/.ci"),
    }


def test_lowest_and_newest_versions_are_tried_by_the_same_command() -> None:
    run = {name: commands(job).strip() for name, job in jobs()}
    assert run["ci/lowest"] == "python go compatibility lowest"
    assert run["weekly/newest"] == "python go compatibility newest"
