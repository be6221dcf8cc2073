"""Build hook of hatchling: the compiled core goes into a wheel, where it can be compiled.

Without a compiler, or with VISCONTACT_CORE=off, the wheel has none and fits every system; runs from
it use NumPy. VISCONTACT_CORE=required makes that an error.
"""

from __future__ import annotations

import os
import sys
from importlib import metadata
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.builders.wheel import WheelBuilder

sys.path.insert(0, str(Path(__file__).parent / "src" / "core"))
import compile_core


class CoreHook(BuildHookInterface[Any]):
    """Compiles the core into wheels, and of an editable install into the checkout."""

    PLUGIN_NAME = "custom"
    _folder: TemporaryDirectory[str] | None = None

    def dependencies(self) -> list[str]:
        """Return the build tools that an isolated build has to fetch."""
        return compile_core.lacks()

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile the core; of a failed compilation only say why, if nothing requires it."""
        try:
            if version == "editable":
                compile_core.into_checkout()
                return
            # A folder of its own: what is published holds nothing of an earlier compilation.
            self._folder = TemporaryDirectory(ignore_cleanup_errors=True)
            extension = compile_core.compiled(Path(self._folder.name) / "core")
        except compile_core.NotCompiledError as reason:
            if os.environ.get("VISCONTACT_CORE") == "required":
                raise
            self.app.display_warning(f"no compiled core: {reason}")
            return
        build_data["force_include"][str(extension)] = f"viscontact/backend/{extension.name}"
        build_data["force_include"][str(self.licences(extension.parent))] = (
            f"viscontact-{self.metadata.version}.dist-info/licenses/nanobind/LICENSE"
        )
        build_data["pure_python"] = False
        build_data["tag"] = self.tag(extension.name)

    def licences(self, folder: Path) -> Path:
        """Write the licences of the code of others in the binary: nanobind, and its robin map."""
        files = {path.name: path for path in metadata.files("nanobind") or []}
        header = files["robin_map.h"].read_text(encoding="utf-8")
        comment = header[header.index("/*") : header.index("*/")].splitlines()
        texts = [files["LICENSE"].read_text(encoding="utf-8"), *(line[3:] for line in comment[1:])]
        written = folder / "LICENSE"
        written.write_text("\n".join(texts), encoding="utf-8", newline="\n")
        return written

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove what was compiled: it is in the wheel."""
        if self._folder:
            self._folder.cleanup()

    def tag(self, extension: str) -> str:
        """Return the tag of a wheel: from Python 3.12 on, one fits all later versions."""
        assert isinstance(self.build_config.builder, WheelBuilder)
        tag = self.build_config.builder.get_best_matching_tag()
        is_stable = extension in ("_core.abi3.so", "_core.pyd")  # the second, of Windows
        return f"cp312-abi3-{tag.rsplit('-', 1)[1]}" if is_stable else tag
