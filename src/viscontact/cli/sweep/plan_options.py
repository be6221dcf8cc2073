"""Options of `run` that vary keys: `--vary`, `--zip`, `--table`, `--sample` and `--range`."""

from __future__ import annotations

import glob
import json
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case.yaml_source import SourceError, parse_value
from viscontact.cli.terminal.messages import refuse
from viscontact.runs.processes.request import no_option
from viscontact.studies.space import Range, read_range
from viscontact.studies.sweep.design_table import read_design
from viscontact.studies.sweep.designs import (
    NOTHING_VARIED,
    Design,
    EqualValuesError,
    Method,
    grid_design,
    paired_design,
    sample_design,
)
from viscontact.studies.typed_values import split_values


@dataclass(frozen=True)
class PlanOptions:
    """Options that vary keys, as they were typed."""

    varied: tuple[str, ...] = ()  # KEY=VALUE,VALUE,...
    zipped: bool = False
    table: Path | None = None
    sample: int | None = None  # number of runs
    ranges: tuple[str, ...] = ()  # KEY=LOW:HIGH[:log]
    seed: int | None = None
    method: Method | None = None

    @property
    def option(self) -> str:
        """Main option of the design, for messages."""
        return "--table" if self.table else "--vary" if self.sample is None else "--sample"

    def design(self, case: Path, settings: Sequence[str] = ()) -> Design:
        """Design of the runs of a case, whose files may be named by wildcards."""
        self._refuse_contradictions()
        if self.table is not None:
            found = _read_plan(self.table)
        elif self.sample is not None:
            found = self._sampled(self.sample)
        else:
            found = self._plan_of(case)
        self._refuse_keys_given_twice(found, settings)
        return found

    def words(self) -> Iterator[str]:
        """Words of the options on the command line."""
        for text in self.varied:
            yield from ("--vary", text)
        if self.zipped:
            yield "--zip"
        if self.table is not None:
            yield from ("--table", no_option(self.table))
        if self.sample is not None:
            yield from ("--sample", str(self.sample))
        for text in self.ranges:
            yield from ("--range", text)
        if self.seed is not None:
            yield from ("--seed", str(self.seed))
        if self.method is not None:
            yield from ("--method", self.method)

    def as_typed(self, line: str, keys: Sequence[str]) -> str:
        """Name the option or table in a message about a value of some varied keys."""
        option, blank, rest = line.partition(" ")
        named = re.split(r"[:=\s]", rest, maxsplit=1)[0]
        if option != "--set" or not any(share_a_branch(named, key) for key in keys):
            return line
        if self.option == "--sample":
            return self._as_range(named, rest)
        place = {"--table": f"{self.table}:"}.get(self.option, "--vary")
        return f"{place}{blank}{rest}"

    def _as_range(self, key: str, rest: str) -> str:
        """Message about a sampled value of a key, with the bound that has no unit as typed."""
        for text in self.ranges:
            if key_of(text) == key:
                low = text.partition("=")[2].partition(":")[0].strip()
                rest = re.sub(r"(?<=: )[-+.\de]+(?= has no unit)", low, rest, count=1)
        return f"--range {rest}"

    def _refuse_contradictions(self) -> None:
        given = {"--vary": self.varied, "--table": self.table, "--sample": self.sample is not None}
        several = [option for option, is_given in given.items() if is_given]
        if len(several) > 1:
            refuse(f"{several[0]} and {several[1]}: give one of them")
        if self.zipped and len(self.varied) < 2:
            refuse("--zip pairs the values of two --vary or more: give them, or leave it out")
        if self.sample is not None and not self.ranges:
            refuse(f"--sample {self.sample}: name a range, e.g. --range load.force='5 kN:20 kN'")
        if self.sample is None:
            for option, value in {
                "--range": self.ranges or None,
                "--seed": self.seed,
                "--method": self.method,
            }.items():
                if value is not None:
                    refuse(f"{option}: goes with --sample N, the number of runs, e.g. --sample 64")

    def _plan_of(self, case: Path) -> Design:
        axes = [_axis(text) for text in self.varied]
        _refuse_repeated("--vary", [key for key, _ in axes], "all its values behind one --vary")
        values = {key: _with_files(key, given, case) for key, given in axes}
        if not values:
            return NOTHING_VARIED
        try:
            return paired_design(values) if self.zipped else grid_design(values)
        except EqualValuesError as error:
            refuse(f"--vary {error}")
        except ValueError as error:
            refuse(f"--zip: {error}; leave it out for all combinations")

    def _sampled(self, number: int) -> Design:
        ranges = [_range(text) for text in self.ranges]
        _refuse_repeated("--range", [each.key for each in ranges], "one range")
        try:
            return sample_design(ranges, number, self.seed or 0, self.method or "sobol")
        except ValueError as error:
            refuse(f"--sample {number}: {error}")

    def _refuse_keys_given_twice(self, design: Design, settings: Sequence[str]) -> None:
        for key in map(key_of, settings):
            if key in design.keys:
                place = {"--table": f"{self.table}:", "--sample": "--range"}
                where = place.get(self.option, "--vary")
                refuse(f"{where} {key}: is given twice, also by --set; leave one of them out")


def key_of(text: str) -> str:
    """Key of a setting, as KEY=VALUE."""
    return text.partition("=")[0].strip()


def _read_plan(table: Path) -> Design:
    try:
        return read_design(table)
    except ValueError as error:
        is_placed = str(error).startswith(f"{table}:")
        refuse(f"{'' if is_placed else '--table: '}{error}")


def _range(text: str) -> Range:
    try:
        return read_range(text)
    except ValueError as error:
        refuse(f"--range {text}: {error}")


def _refuse_repeated(option: str, keys: Sequence[str], once: str) -> None:
    twice = [key for key, count in Counter(keys).items() if count > 1]
    if twice:
        refuse(f"{option} {twice[0]}: is given twice; name {once}")


def share_a_branch(one: str, other: str) -> bool:
    """Test whether two keys are the same, or one is a part of the other."""
    steps = zip(re.split(r"[.\[]", one), re.split(r"[.\[]", other), strict=False)
    return all(a == b for a, b in steps)


def _axis(text: str) -> tuple[str, list[str]]:
    _, equals, given = text.partition("=")
    values = split_values(given)
    if not (key_of(text) and equals and values and all(values)):
        refuse(f"--vary {text}: write KEY=VALUE,VALUE,..., e.g. --vary load.force=5kN,10kN")
    return key_of(text), values


def _with_files(key: str, values: Sequence[str], case: Path) -> list[str]:
    """Values of a key; wildcards in names of files are replaced by the files, sorted."""
    found: list[str] = []
    for value in values:
        if key.rpartition(".")[2] != "file" or not glob.has_magic(value):
            found.append(value)
            continue
        # A name in a case is relative to the folder of the case, and may hold such signs itself.
        whole, folder = _name_in_yaml(value) or value, case.parent
        found_there = glob.glob(value, root_dir=folder, recursive=True)  # noqa: PTH207 may be absolute
        names = [whole] if (folder / whole).exists() else sorted(found_there)
        if not names:
            refuse(f"--vary {key}={value}: no file of that name in {case.parent.resolve()}")
        found += [_yaml_name(Path(name).as_posix()) for name in names]
    return found


def _yaml_name(name: str) -> str:
    """Name of a file as a value of YAML, in quotes where it could be another value."""
    return name if _name_in_yaml(name) == name else json.dumps(name, ensure_ascii=False)


def _name_in_yaml(text: str) -> str:
    """Name that a value of YAML is; empty for another value."""
    try:
        found = parse_value(text)
    except SourceError:
        return ""
    return found if isinstance(found, str) else ""
