"""The compiled core: where it is used, and its functions against NumPy."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from viscontact.backend import compiled
from viscontact.backend.transforms import multiply_by_even
from viscontact.cli import main

SOURCES = Path(__file__).parents[2] / "src" / "core"
needs_core = pytest.mark.skipif(not compiled.core, reason=f"no compiled core: {compiled.absent}")


# --- its choice -----------------------------------------------------------------------------------


def process(choice: str, *command: str) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, *command]
    given = {**os.environ, compiled.VARIABLE: choice}
    return subprocess.run(words, env=given, capture_output=True, text=True)


KERNELS = ("-c", "from viscontact.backend import compiled; print(compiled.kernels())")


def test_the_environment_switches_the_core_off() -> None:
    assert process("off", *KERNELS).stdout == "NumPy (no compiled core: VISCONTACT_CORE is off)\n"


def test_the_environment_requires_the_core() -> None:
    usual, required = process("", *KERNELS).stdout, process("required", *KERNELS)
    if usual == "compiled\n":
        assert required.stdout == usual
    else:
        assert "there is no compiled core: it is not built; unset it" in required.stderr


def test_an_unknown_word_in_the_environment_is_refused_in_one_line() -> None:
    done = process("no", "-m", "viscontact", "doctor")
    assert done.returncode == 2
    assert done.stderr == "VISCONTACT_CORE must be 'off', 'required' or not set, got 'no'\n"


def test_a_core_that_cannot_be_loaded_leaves_numpy_and_says_why(tmp_path: Path) -> None:
    script = f"""
import sys, types
import viscontact.backend as backend
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
broken = Path({str(tmp_path)!r}) / ("_core" + EXTENSION_SUFFIXES[0])
broken.write_bytes(b"no binary of any system")
backend.__path__.insert(0, str(broken.parent))
from viscontact.backend import compiled
from viscontact.backend.transforms import multiply_by_even
print(compiled.core, compiled.kernels())
"""
    done = process("", "-c", script)
    assert done.stdout.startswith("None NumPy (no compiled core: "), done.stderr
    assert "not built" not in done.stdout


def test_a_core_that_is_not_built_leaves_numpy_and_says_so(tmp_path: Path) -> None:
    for module in Path(compiled.__file__).parent.glob("*.py"):
        shutil.copy(module, tmp_path)
    script = f"""
import viscontact.backend as backend
backend.__path__[:] = [{str(tmp_path)!r}]
from viscontact.backend import compiled
from viscontact.backend.transforms import multiply_by_even
print(compiled.core, compiled.kernels())
"""
    assert process("", "-c", script).stdout == "None NumPy (no compiled core: it is not built)\n"


def test_a_core_of_other_sources_is_not_used(tmp_path: Path) -> None:
    (tmp_path / "_core.py").write_text("INTERFACE = -1")
    script = f"""
import sys, viscontact.backend as backend
sys.modules.pop("viscontact.backend._core", None)
backend.__path__.insert(0, {str(tmp_path)!r})
from viscontact.backend import compiled
from viscontact.backend.transforms import multiply_by_even
print(compiled.core, compiled.kernels())
"""
    done = process("", "-c", script)
    assert done.stdout == "None NumPy (no compiled core: it was built of other sources)\n"


def test_doctor_says_what_computes_inner_loops(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor"]) == 0
    (line,) = (line for line in capsys.readouterr().out.splitlines() if "inner loops" in line)
    assert line.split(maxsplit=2)[2].strip() == compiled.kernels()


@needs_core
@pytest.mark.skipif(not SOURCES.is_dir(), reason="the package is not in a checkout")
def test_the_core_was_built_of_these_sources() -> None:
    names = [path.name for kind in ("*.cpp", "*.hpp") for path in SOURCES.glob(kind)]
    names = sorted([*names, "CMakeLists.txt"])
    hashes = [hashlib.sha256((SOURCES / name).read_bytes()).hexdigest() for name in names]
    lines = "".join(f"{name}={each}\n" for name, each in zip(names, hashes, strict=True))
    built = hashlib.sha256(lines.encode()).hexdigest() == compiled.core.SOURCES
    assert built, "the core is of other sources; ./go setup builds it again"


# --- its functions --------------------------------------------------------------------------------


@needs_core
@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_largest_is_that_of_numpy_in_any_layout(kind: type[np.floating]) -> None:
    field = np.random.default_rng(1).normal(size=(37, 53)).astype(kind)
    field[5, 7] = -9.0
    layouts = (
        *(field, field.T, field[::-1, ::2], field[3::2, ::-3], field[5], field[::-1, 7]),
        *(np.asfortranarray(field), np.broadcast_to(field[5], (4, 53)), field[5:6, 7:8]),
    )
    for layout in layouts:
        assert compiled.core.largest(layout) == float(abs(layout).max())
    locked = field.copy()
    locked.flags.writeable = False
    assert compiled.core.largest(locked) == 9.0


@needs_core
@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("length", [1, 3, 8, 29])
def test_largest_of_a_field_with_nan_is_nan_wherever_it_is(
    kind: type[np.floating], length: int
) -> None:
    for place in range(length):
        field = np.full(length, -np.inf, kind)
        assert compiled.core.largest(field) == np.inf
        field[place] = np.nan
        assert np.isnan(compiled.core.largest(field))


@needs_core
def test_largest_refuses_what_it_would_have_to_convert_or_cannot_answer() -> None:
    for empty in (np.zeros(0), np.zeros((0, 3)), np.zeros((3, 0), np.float32)):
        with pytest.raises(ValueError, match="an array without numbers has no largest one"):
            compiled.core.largest(empty)
    with pytest.raises(ValueError, match="expected an array of one or two axes"):
        compiled.core.largest(np.zeros((2, 2, 2)))
    for other in (np.zeros(3, int), np.zeros(3, complex), [1.0], np.zeros(3, ">f8")):
        with pytest.raises(TypeError, match="incompatible function arguments"):
            compiled.core.largest(other)


@needs_core
@pytest.mark.parametrize("number", ["f4", "f8"])
@pytest.mark.parametrize("is_complex", [False, True])
@pytest.mark.parametrize(("axis", "known"), [(0, 9), (0, 5), (1, 8), (1, 5)])
def test_a_spectrum_times_an_even_symbol_is_that_of_numpy_to_the_bit(
    number: str, is_complex: bool, axis: int, known: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    random = np.random.default_rng(3)
    shape = (9, 8)
    spectrum = random.normal(size=(*shape, 2)).astype(number)
    spectrum = (
        spectrum.view(np.result_type(number, "c8"))[..., 0] if is_complex else spectrum[..., 0]
    )
    symbol = random.normal(size=(known, 8) if axis == 0 else (9, known)).astype(number)
    for layout in (np.ascontiguousarray(spectrum), np.asfortranarray(spectrum)):
        expected, found = layout.copy("K"), layout.copy("K")
        multiply_by_even(found, symbol, axis)
        with monkeypatch.context() as off:
            off.setattr(compiled, "core", None)
            multiply_by_even(expected, symbol, axis)
        np.testing.assert_array_equal(found, expected)
