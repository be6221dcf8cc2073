"""The front door of a clone: `./go`, the lock and `.ci/run`."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterable
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType

import pytest
from packaging.requirements import Requirement

import viscontact

ROOT = Path(__file__).parents[2]
LOCK = (ROOT / "requirements.lock").read_text(encoding="utf-8")
DEMO_LOCK = (ROOT / "requirements-demo.lock").read_text(encoding="utf-8")
SETTINGS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = SETTINGS["project"]
BUILD = [*SETTINGS["build-system"]["requires"], *SETTINGS["dependency-groups"]["build"]]


class Compilation:
    """Stands in for the script that compiles the core: may fail, may lack tools."""

    def __init__(self, root: Path) -> None:
        self.times, self.reason, self.lacking = 0, "", ""
        self.place = root / "src" / "viscontact" / "backend" / "_core.so"

    def __call__(self, python: Path, *words: str) -> subprocess.CompletedProcess[str]:
        if words == ("--lacks",):
            return subprocess.CompletedProcess([], 0, self.lacking, "")
        self.times += 1
        if not self.reason:
            self.place.parent.mkdir(parents=True, exist_ok=True)
            self.place.touch()
        return subprocess.CompletedProcess([], int(bool(self.reason)), self.reason, "")


@pytest.fixture
def go(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """Return `go` as a module that believes itself in an empty clone, and installs nothing."""
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.delenv("VISCONTACT_CORE", raising=False)  # which leaves the core out
    loader = SourceFileLoader("go", str(ROOT / "go"))
    spec = importlib.util.spec_from_loader("go", loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    (tmp_path / "requirements.lock").write_text("numpy==2.2\nruff==0.9\n")
    (tmp_path / "requirements-demo.lock").write_text("numpy==2.2\n")
    (tmp_path / "pyproject.toml").write_text("")
    for name in ("LOCK", "DEMO_LOCK", "VENV", "STAMP", "LOG", "PYTHON", "CORE_STAMP", "TOOLS"):
        inside = getattr(module, name).relative_to(module.ROOT)
        monkeypatch.setattr(module, name, tmp_path / inside)
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "run", lambda args: 0)
    monkeypatch.setattr(module, "CORE", tmp_path / "core")
    monkeypatch.setattr(module, "core_script", Compilation(tmp_path))
    module.CORE.mkdir()
    return module


class Installer:
    """Stands in for venv and pip: notes what is asked, may be interrupted."""

    def __init__(self, go: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
        self.go = go
        self.asked: list[str] = []  # the commands, but for making the empty environment
        self.packages: list[str] = []  # entries of locks
        self.environments = 0
        self.interrupted = False
        monkeypatch.setattr(go, "install", self)

    def __call__(self, command: list[str], args: list[str], **added: str) -> None:
        if "venv" in command:
            self.environments += 1
            self.go.PYTHON.parent.mkdir(parents=True)
            self.go.PYTHON.touch()
            if "uv" not in command[0]:
                self.go.PYTHON.with_name("pip").touch()
            return
        self.asked.append(" ".join([*command, *args]))
        if "-r" in args:
            self.packages += Path(args[args.index("-r") + 1]).read_text().split()
        if self.interrupted:
            raise KeyboardInterrupt


@pytest.fixture
def installer(go: ModuleType, monkeypatch: pytest.MonkeyPatch) -> Installer:
    return Installer(go, monkeypatch)


def test_a_second_start_installs_nothing(go: ModuleType, installer: Installer) -> None:
    assert go.main(["test"]) == 0
    assert (installer.environments, len(installer.asked)) == (1, 2)
    assert go.main(["test"]) == 0
    assert (installer.environments, len(installer.asked)) == (1, 2)


@pytest.mark.parametrize("name", ["requirements.lock", "pyproject.toml"])
def test_a_changed_lock_or_project_is_installed_into_the_same_environment(
    go: ModuleType, installer: Installer, name: str
) -> None:
    go.main(["test"])
    (go.ROOT / name).write_text("changed")
    go.main(["test"])
    assert (installer.environments, len(installer.asked)) == (1, 4)


def test_an_interrupted_set_up_is_begun_again(
    go: ModuleType, installer: Installer, capsys: pytest.CaptureFixture[str]
) -> None:
    installer.interrupted = True
    assert go.main(["test"]) == 130
    assert "the next start begins the set-up again" in capsys.readouterr().err
    installer.interrupted = False
    assert go.main(["test"]) == 0
    assert installer.environments == 2
    assert go.is_ready("test")


def test_the_demo_installs_its_part_and_the_first_other_task_the_rest(
    go: ModuleType, installer: Installer
) -> None:
    assert go.main(["demo"]) == 0
    assert installer.packages == ["numpy==2.2"]
    assert go.is_ready("demo")
    assert go.is_ready("viscontact")
    assert not go.is_ready("test")
    assert go.main(["test"]) == 0
    assert (installer.environments, installer.packages[1:]) == (1, ["numpy==2.2", "ruff==0.9"])
    asked = len(installer.asked)
    assert go.main(["demo"]) == 0  # a larger environment has it
    assert len(installer.asked) == asked


def test_a_set_up_says_how_much_is_left(
    go: ModuleType, installer: Installer, capsys: pytest.CaptureFixture[str]
) -> None:
    entries = [f"p{number}==1 \\\n    --hash=sha256:ab\n" for number in range(2 * go.AT_ONCE + 1)]
    (go.ROOT / "requirements.lock").write_text(f"# by ./go lock\n{''.join(entries)}")
    go.main(["setup"])
    said = [line.strip() for line in capsys.readouterr().out.splitlines()]
    assert said[:4] == [
        f"go: setting up .venv, once: {len(entries)} packages",
        f"go: {go.AT_ONCE + 1} packages left",
        "go: 1 packages left",
        "go: all packages are installed",
    ]
    assert [each for each in installer.packages if "==" in each] == [
        each.split()[0] for each in entries
    ]


def test_an_environment_of_uv_is_made_anew_where_uv_is_gone(
    go: ModuleType, installer: Installer, monkeypatch: pytest.MonkeyPatch
) -> None:
    # It has no pip inside.
    monkeypatch.setattr(go.shutil, "which", lambda name: "/bin/uv")
    go.main(["test"])
    monkeypatch.setattr(go.shutil, "which", lambda name: None)
    go.main(["test"])
    assert installer.environments == 1
    (go.ROOT / "pyproject.toml").write_text("changed")
    go.main(["test"])
    assert installer.environments == 2


def test_a_moved_clone_is_set_up_anew(go: ModuleType, installer: Installer) -> None:
    # Environments and editable installs hold absolute paths.
    go.main(["test"])
    go.ROOT = go.ROOT / "elsewhere"
    go.ROOT.mkdir()
    (go.ROOT / "pyproject.toml").write_text("")
    assert not go.is_ready("test")


@pytest.mark.parametrize("uv", [None, "/bin/uv"])
def test_only_hashed_files_are_installed(
    go: ModuleType, installer: Installer, monkeypatch: pytest.MonkeyPatch, uv: str | None
) -> None:
    monkeypatch.setattr(go.shutil, "which", lambda name: uv)
    go.main(["test"])
    packages, project = installer.asked
    assert (
        "--only-binary :all: --no-deps --no-compile --require-hashes" in packages
    )  # nothing is built of other files
    assert "--no-deps --no-build-isolation --editable" in project


@pytest.mark.parametrize(
    ("said", "line"),
    [
        ("Max retries exceeded with url: /simple/numpy/", "set-up needs the network once"),
        ("dns error: failed to lookup address", "set-up needs the network once"),
        ("... ensurepip is not available ...", "install python3-venv, or uv"),
        ("first\nERROR: no space left on device", r"set-up failed \(ERROR: no space left"),
    ],
)
def test_a_failed_set_up_says_why_in_one_line(go: ModuleType, said: str, line: str) -> None:
    script = f"import sys; sys.exit({said!r})"
    with pytest.raises(go.TaskError, match=line) as caught:
        go.install([sys.executable, "-c", script], [])
    assert "\n" not in str(caught.value)


def test_an_old_python_is_refused_by_number(
    go: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    assert go.main(["demo"], (3, 10)) == 2
    assert "needs Python 3.11 or newer, and this is 3.10" in capsys.readouterr().err


def test_an_unknown_task_is_refused_with_the_known_ones(
    go: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    assert go.main(["tset"]) == 2
    assert (
        "no task 'tset'; there are demo, viscontact, setup, test, lint" in capsys.readouterr().err
    )


def test_without_a_task_all_are_listed() -> None:
    said = subprocess.run(
        [sys.executable, ROOT / "go"], text=True, capture_output=True, check=True
    ).stdout
    for task in ("demo", "viscontact", "setup", "test", "lint", "docs", "bench", "build", "lock"):
        assert re.search(rf"^  {task} +\w", said, re.MULTILINE)


def test_commands_of_viscontact_run_where_they_are_typed(
    go: ModuleType,
    installer: Installer,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    ran: list[tuple[list[str], Path]] = []
    monkeypatch.setattr(go, "run", lambda args, folder: ran.append((args, folder)) or 0)
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    monkeypatch.chdir(elsewhere)
    assert go.main(["viscontact", "run", "my.yaml", "--help"]) == 0
    assert ran == [(["-m", "viscontact", "run", "my.yaml", "--help"], elsewhere)]


def test_arguments_reach_pytest_and_slow_means_all(
    go: ModuleType, installer: Installer, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[list[str]] = []
    monkeypatch.setattr(go, "run", lambda args: ran.append(args) or 0)
    go.main(["test", "--slow", "-x"])
    assert ran[0][-3:] == ["-m", "", "-x"]


def test_lint_finds_a_name_that_no_script_defines(tmp_path: Path) -> None:
    linter = shutil.which("oxlint", path=Path(sys.executable).parent)
    if linter is None:
        pytest.skip("there is no oxlint beside this Python")
    options = ("--deny-warnings", "-c", str(ROOT / ".ci" / "oxlint.json"))
    script = tmp_path / "a.js"
    for text, code in (("document.title = titel;\n", 1), ("document.title = 'a';\n", 0)):
        script.write_text(text, encoding="utf-8")
        done = subprocess.run([linter, *options, script], capture_output=True, text=True)
        assert done.returncode == code, done.stdout
        assert ("'titel' is not defined" in done.stdout) == bool(code)


def test_lint_checks_python_and_javascript(
    go: ModuleType, installer: Installer, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[str] = []

    def run(args: list[str], program: Path | None = None) -> int:
        ran.append(args[1] if program is None else program.stem)
        return 0

    monkeypatch.setattr(go, "run", run)
    assert go.main(["lint"]) == 0
    assert ran == ["ruff", "ruff", "mypy", "oxlint"]


def test_the_manual_is_built_strictly_and_without_what_is_gone(
    go: ModuleType, installer: Installer, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[list[str]] = []
    monkeypatch.setattr(go, "run", lambda args: ran.append(args) or 1)
    kept, gone, page = (
        go.ROOT / "docs" / place
        for place in ("examples/plot_a.rst", "examples/plot_b.rst", "reference/generated/x.rst")
    )
    for made in (kept, page, go.ROOT / "docs" / "gallery" / "plot_a.py"):
        made.parent.mkdir(parents=True, exist_ok=True)
        made.touch()
    assert go.main(["docs", "-D", "plot_gallery=0"]) == 1
    assert {"-W", "-n", "-D", "plot_gallery=0"} <= set(ran[0])
    assert kept.exists()
    assert not page.exists()
    gone.touch()
    go.main(["docs"])
    assert not gone.exists()


# --- the core -----------------------------------------------------------------------------------


def test_the_core_is_compiled_once_and_again_when_its_sources_change(
    go: ModuleType, installer: Installer, capsys: pytest.CaptureFixture[str]
) -> None:
    for task in ("test", "demo", "test"):
        go.main([task])
    assert go.core_script.times == 1
    assert capsys.readouterr().out.count("go: the core is compiled\n") == 1
    (go.CORE / "a.cpp").write_text("int x;")
    asked = len(installer.asked)
    go.main(["demo"])
    assert (go.core_script.times, len(installer.asked)) == (2, asked)  # and installs nothing
    go.core_script.place.unlink()  # as `git clean` does
    go.main(["demo"])
    assert go.core_script.times == 3


def test_a_core_that_cannot_be_compiled_stops_nothing_and_is_said_once(
    go: ModuleType, installer: Installer, capsys: pytest.CaptureFixture[str]
) -> None:
    go.core_script.reason = "there is no C++ compiler"
    for _ in range(2):
        assert go.main(["test"]) == 0
    said = "go: no compiled core, so runs use NumPy: there is no C++ compiler\n"
    assert capsys.readouterr().out.count(said) == 1
    go.core_script.reason = ""
    go.main(["setup"])  # a compiler was installed
    assert go.core_script.times == 2


def test_without_the_core_in_the_environment_none_is_compiled(
    go: ModuleType, installer: Installer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VISCONTACT_CORE", "off")
    go.main(["test"])
    assert go.core_script.times == 0
    monkeypatch.delenv("VISCONTACT_CORE")
    go.main(["test"])
    assert go.core_script.times == 1


def test_build_tools_are_installed_where_they_are_lacking_only(
    go: ModuleType, installer: Installer
) -> None:
    (go.ROOT / "requirements.lock").write_text("cmake==4.4\nnumpy==2.2\n")
    go.main(["setup"])
    assert installer.packages == ["numpy==2.2"]
    go.core_script.lacking = "cmake"
    go.main(["test"])  # computes without
    assert installer.packages == ["numpy==2.2"]
    go.main(["setup"])
    assert installer.packages[1:3] == ["numpy==2.2", "cmake==4.4"]


def test_the_demo_has_build_tools_while_the_core_is_compiled_only(
    go: ModuleType, installer: Installer
) -> None:
    (go.ROOT / "requirements-demo.lock").write_text("cmake==4.4\nnumpy==2.2\n")
    go.core_script.lacking = "cmake"
    go.TOOLS.mkdir(parents=True)
    go.main(["demo"])
    assert installer.packages == ["numpy==2.2", "cmake==4.4"]
    assert f"--require-hashes --target {go.TOOLS}" in installer.asked[-1]
    assert go.core_script.times == 1
    assert not go.TOOLS.exists()


def test_build_tools_that_cannot_be_installed_stop_nothing(
    go: ModuleType,
    installer: Installer,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    go.main(["demo"])
    (go.CORE / "a.cpp").write_text("int x;")
    go.core_script.lacking = "cmake"

    def offline(*asked: object, **added: str) -> None:
        raise go.TaskError("the package index could not be reached")

    monkeypatch.setattr(go, "install", offline)
    assert go.main(["demo"]) == 0
    said = "go: no compiled core, so runs use NumPy: the package index could not be reached\n"
    assert said in capsys.readouterr().out


# --- the lock -----------------------------------------------------------------------------------


def canonical(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def locked(lock: str = LOCK) -> list[str]:
    """Return the lock's entries, each a version with its marker and hashes."""
    return re.split(r"^(?=[a-z0-9])", lock, flags=re.MULTILINE)[1:]


def names(needs: Iterable[str]) -> set[str]:
    return {canonical(re.split(r"[\[<>=!~; ]", need)[0]) for need in needs} - {"viscontact"}


def test_every_locked_file_has_its_hash_and_no_address() -> None:
    assert len(locked()) > 40
    for entry in locked():
        assert re.match(r"[\w.-]+==\S+", entry)
        assert re.search(r"--hash=sha256:[0-9a-f]{64}", entry)
    for foreign in ("://", "/simple", "--index", "--extra-index", "--find-links", " @ ", "+cpu"):
        assert foreign not in LOCK


def test_the_lock_covers_every_dependency_and_the_build_backend() -> None:
    wanted = [*PROJECT["dependencies"], *BUILD]
    wanted += [need for extra in PROJECT["optional-dependencies"].values() for need in extra]
    assert names(wanted) <= names(locked())


def test_the_lock_of_the_demo_is_a_small_part_of_the_lock_that_computes_and_draws() -> None:
    extras = PROJECT["optional-dependencies"]
    wanted = [*PROJECT["dependencies"], *BUILD, *extras["plot"], *extras["fast"]]
    assert names(wanted) <= names(locked(DEMO_LOCK))
    assert set(locked(DEMO_LOCK)) <= set(locked())
    here = [Requirement(entry.split("\\")[0]).marker for entry in locked(DEMO_LOCK)]
    # Beside viscontact itself; pip and what it brings come with Python. CMake is counted.
    assert 40 < sum(marker is None or marker.evaluate() for marker in here) < 50


# --- what is built and checked ------------------------------------------------------------------


def test_ci_ends_with_the_readme_test_command() -> None:
    lines = (ROOT / ".ci" / "run").read_text(encoding="utf-8").strip().splitlines()
    assert lines[-1] == "./go test"
    # Beside the manual, and its failure is one of the whole.
    lint = next(k for k, line in enumerate(lines) if line.startswith("./go lint &"))
    wait = lines.index("wait $!")
    assert any(line.startswith("./go docs") for line in lines[lint:wait])


def test_the_extras_are_those_promised() -> None:
    users = {"plot", "animation", "fast", "surfaces", "afm", "fit", "web", "cluster", "pdf"}
    users.add("drawing")
    assert set(PROJECT["optional-dependencies"]) == users | {"all", "test", "docs", "dev"}


def test_the_version_is_the_same_everywhere() -> None:
    assert PROJECT["version"] == viscontact.__version__
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"version: {viscontact.__version__}\n" in citation
