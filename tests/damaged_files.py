"""Files of runs and studies that are damaged at random, and what commands make of them.

`python damaged_files.py FOLDER [DAMAGES] [SEED]`, with a FOLDER for the files: each damage is made
in a copy of a directory, and a command is run on that in a process of its own. A command passes
that says what it says of the undamaged directory, or refuses the damaged file in words. Prints a
table: damages that had no effect, that were noticed, and that were not.
"""

from __future__ import annotations

import io
import json
import os
import random
import re
import resource
import shutil
import signal
import sys
import traceback
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout, suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import xarray as xr

import viscontact as vc
from interrupted_runs import CASE, WITH_ERRORS, kill
from swept_runs import sweep_of
from viscontact.cli import main
from viscontact.drawing.matplotlib import FIGURES
from viscontact.studies.journal import JOURNAL_NAME, Entry, journal_of
from viscontact.web.runs.status import result_summary
from viscontact.web.workspace.pictures import PictureChoice, figure_of
from viscontact.web.workspace.problems import RequestError

#: Time [s] and memory [bytes] of a command.
TIME, MEMORY = 120, 2**33
UNCHANGED, NOTICED = "unchanged", "noticed"
#: Words of a message about damage; it names the file as well.
WORDS = re.compile(
    r"damaged|not a netCDF|neither a run|cannot be read|is not a line of JSON|not UTF-8|"
    r"no digest|--overwrite|remove the file|must be|too little memory|is missing"
)


def flipped(data: bytes, chance: random.Random) -> bytes:
    """Flip one to four bits of neighbouring bytes."""
    changed, at = bytearray(data), chance.randrange(len(data))
    for place in range(at, min(at + chance.choice((1, 1, 1, 2, 4)), len(data))):
        changed[place] ^= 1 << chance.randrange(8)
    return bytes(changed)


def zeroed(data: bytes, chance: random.Random) -> bytes:
    """Replace a block by zeros."""
    size, at = chance.choice((1, 8, 64, 512, 4096)), chance.randrange(len(data))
    at -= at % size
    return (data[:at] + bytes(size) + data[at + size :])[: len(data)]


def cut(data: bytes, chance: random.Random) -> bytes:
    """Leave out the end."""
    return data[: chance.randrange(len(data))]


def exchanged(data: bytes, chance: random.Random) -> bytes:
    """Exchange two blocks of one size."""
    size = chance.choice((8, 64, 512, 2304, 4096))
    count = len(data) // size
    if count < 2:
        return data
    one, other = sorted(chance.sample(range(count), 2))
    first, second = (slice(size * n, size * (n + 1)) for n in (one, other))
    between = data[first.stop : second.start]
    return data[: first.start] + data[second] + between + data[first] + data[second.stop :]


DAMAGES = (flipped, flipped, zeroed, cut, exchanged)


@dataclass(frozen=True)
class Trial:
    """A file of a directory that is damaged, and the command that reads it."""

    name: str
    source: str  # directory that is copied, one of `Sources`
    file: str  # in it
    read: Callable[[], str]  # text about the directory `place`, in the working directory
    often: float  # share of the damages


PLACE = "place"


def command(*words: str) -> Callable[[], str]:
    """What a command prints; SystemExit with its code if it is not 0."""

    def run() -> str:
        printed = io.StringIO()
        with redirect_stdout(printed):
            code = main([each.replace("PLACE", PLACE) for each in words])
        if code:
            raise SystemExit(code)
        return printed.getvalue()

    return run


def drawing(*words: str, output: str) -> Callable[[], str]:
    """Bytes of a file that a command writes."""

    def run() -> str:
        command(*words, "-o", output)()
        return Path(output).read_bytes().hex()

    return run


def resumed() -> str:
    """All bits of a run that is resumed."""
    command("run", "case.yaml", "-o", PLACE, "--resume", "-q")()
    with xr.open_dataset(Path(PLACE) / "result.nc") as ds:
        bits = {str(name): each.values.tobytes().hex() for name, each in ds.variables.items()}
        kept = {name: str(ds.attrs[name]) for name in ("case", "warnings", "complete")}
    return json.dumps([bits, kept])


def opened_whole() -> str:
    """All bits that `open_results` returns."""
    with vc.open_results(Path(PLACE) / "joint.nc") as ds:
        return json.dumps(
            {str(name): repr(each.values.tolist()) for name, each in ds.variables.items()}
        )


def shown_on_page() -> str:
    """What the page says of a run, and a picture."""
    found = result_summary(Path(PLACE))
    try:
        drawn = figure_of(Path(PLACE), FIGURES, PictureChoice("history", kind="png"))
    except RequestError as error:
        raise ValueError(f"{PLACE}: {error}") from error
    return json.dumps(found) + drawn.hex()


STUDY = {"case": "abc", "change": {"load.force": ["1 N", "2 N"]}}
VALUES = {f"run {n}": {"force": [n / 7, n / 70]} for n in range(30)}


def journal_kept() -> str:
    """Whether the runs that a journal returns are those that it was given."""
    with journal_of("design", STUDY, directory=PLACE) as journal:
        assert journal is not None
        found = {key: dict(each.values) for key, each in journal.recorded.items()}
    # A run that is missing is computed again.
    assert all(VALUES.get(key) == values for key, values in found.items()), found
    return ""


class Sources:
    """Undamaged directories, written in the working directory when they are used."""

    @cached_property
    def done(self) -> Path:
        text = WITH_ERRORS.replace("[0 s, 2 s, 3 s]", "all")
        Path("done.yaml").write_text(text, encoding="utf-8")
        assert main(["run", "done.yaml", "-o", "done", "-q"]) == 0
        return Path("done")

    @cached_property
    def stopped(self) -> Path:
        Path("case.yaml").write_text(CASE, encoding="utf-8")
        kill(5, "-o", "stopped", "-q")
        return Path("stopped")

    @cached_property
    def sweep(self) -> Path:
        return sweep_of(Path.cwd(), [{"load.force": f"{force} N"} for force in (3, 4, 5)])

    @cached_property
    def joint(self) -> Path:
        Path("joint").mkdir()
        assert main(["collect", str(self.sweep), "-o", "joint/joint.nc", "--fields"]) == 0
        return Path("joint")

    @cached_property
    def study(self) -> Path:
        with journal_of("design", STUDY, directory="study") as journal:
            assert journal is not None
            for key, values in VALUES.items():
                journal.keep(key, Entry(values))
        return Path("study")


RESULT, STATE, LOG = "result.nc", "state.npz", "progress.jsonl"
A_RUN = "force=4N"
TABLE = drawing("collect", "PLACE", output="table.csv")
TRIALS = (
    Trial("show", "done", RESULT, command("show", "PLACE", "--all", "--errors"), 14),
    Trial("export", "done", RESULT, command("export", "PLACE", "--point", "0.1 mm,0 mm"), 14),
    Trial("plot", "done", RESULT, drawing("plot", "PLACE", "pressure-map", output="a.png"), 6),
    Trial("report", "done", RESULT, drawing("report", "PLACE", output="report.html"), 2),
    Trial("page", "done", RESULT, shown_on_page, 6),
    Trial("resume", "stopped", RESULT, resumed, 12),
    Trial("resume", "stopped", STATE, resumed, 12),
    Trial("resume", "stopped", LOG, resumed, 10),
    Trial("collect", "sweep", f"{A_RUN}/{RESULT}", TABLE, 4),
    Trial("collect", "sweep", f"{A_RUN}/{LOG}", TABLE, 8),
    Trial("collect", "sweep", "runs.jsonl", TABLE, 8),
    Trial("open_results", "joint", "joint.nc", opened_whole, 6),
    Trial("--resume of a study", "study", JOURNAL_NAME, journal_kept, 6),
)


def outcome_of(read: Callable[[], str]) -> tuple[int, str, str]:
    """Read in a process of its own: how that ended, what it returned, what it wrote."""
    for name in ("said", "returned"):
        Path(name).unlink(missing_ok=True)
    child = os.fork()
    if not child:
        code = 70
        try:
            signal.alarm(TIME)
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            os.dup2(os.open("said", os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 2)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            sys.stderr = os.fdopen(2, "w", buffering=1)
            try:
                Path("returned").write_text(read(), encoding="utf-8")
                code = 0
            except SystemExit as end:
                code = int(end.code or 0)
            except ValueError as error:  # what a call raises
                print(error, file=sys.stderr)
                code = 2
            except BaseException:
                traceback.print_exc()
        finally:
            with suppress(Exception):
                sys.stderr.flush()
            os._exit(code)
    _, status = os.waitpid(child, 0)
    text = [Path(name).read_text(errors="replace") if Path(name).exists() else "" for name in
            ("returned", "said")]  # fmt: skip
    return os.waitstatus_to_exitcode(status), text[0], text[1]


def verdict(trial: Trial, expected: str, found: tuple[int, str, str]) -> str:
    """Name of the outcome of a damage; words that say what is wrong if it was not noticed."""
    code, returned, said = found
    if code < 0:
        return f"ended by signal {-code}: {said[-300:]}"
    if "Traceback" in said or "fault of viscontact" in said or code == 70:
        return f"fault: {said[-300:]}"
    names = (Path(trial.file).name, PLACE)
    in_words = WORDS.search(said) is not None and any(name in said for name in names)
    if code == 0 and returned == expected:
        return UNCHANGED
    # A table is written that has the reason in place of the run.
    if trial.name == "collect" and ("cannot be read" in returned or code == 1):
        text = Path("table.csv").read_text() if Path("table.csv").exists() else ""
        in_words = in_words or "damaged" in text or "cannot be read" in text
        rows = [line for line in text.splitlines() if not WORDS.search(line)]
        if any(line not in bytes.fromhex(expected).decode() for line in rows):
            return f"table changed: {rows}"
    if code and in_words:
        return NOTICED if len(said.splitlines()) <= 4 else f"many lines: {said}"
    return f"code {code}, returned {returned[:100]!r}, said {said[-300:]!r}"


class Campaign:
    """Damages of all kinds in the working directory, spread over the trials by their shares."""

    def __init__(self, seed: int) -> None:
        self.chance, self.sources = random.Random(seed), Sources()
        self.counts: Counter[tuple[str, str, str]] = Counter()
        self.lost: list[str] = []
        self._expected: dict[int, str] = {}

    def try_one(self, number: int) -> None:
        """Damage a file, and judge what is said of it."""
        trial = TRIALS[number]
        if number not in self._expected:
            self._copy(trial)
            code, self._expected[number], said = outcome_of(trial.read)
            assert code == 0, said
        self._copy(trial)
        path = Path(PLACE) / trial.file
        damage = self.chance.choice(DAMAGES)
        path.write_bytes(damage(path.read_bytes(), self.chance))
        judged = verdict(trial, self._expected[number], outcome_of(trial.read))
        known = judged if judged in (UNCHANGED, NOTICED) else "lost"
        self.counts[trial.name, Path(trial.file).name, known] += 1
        if known == "lost":
            self.lost.append(f"{trial.name} {trial.file}, {damage.__name__}: {judged}")

    def _copy(self, trial: Trial) -> None:
        shutil.rmtree(PLACE, ignore_errors=True)
        shutil.copytree(getattr(self.sources, trial.source), PLACE)

    def run(self, damages: int, only: Sequence[int] | None = None) -> None:
        """Try damages in a random order of the trials."""
        numbers = list(only) if only is not None else list(range(len(TRIALS)))
        shares = [TRIALS[n].often for n in numbers]
        for number in self.chance.choices(numbers, shares, k=damages):
            self.try_one(number)

    def table(self) -> str:
        """Rows: command, file, damages, without effect, noticed, lost."""
        rows = dict.fromkeys((trial.name, Path(trial.file).name) for trial in TRIALS)
        kinds = (UNCHANGED, NOTICED, "lost")
        counts = {row: [self.counts[*row, kind] for kind in kinds] for row in rows}
        counts["all", ""] = np.sum(list(counts.values()), axis=0).tolist()
        return "\n".join(
            f"| {name} | {file} | {sum(found)} | {' | '.join(map(str, found))} |"
            for (name, file), found in counts.items()
        )


if __name__ == "__main__":
    os.chdir(sys.argv[1])
    made = Campaign(int((*sys.argv, 1, 1)[3]))
    made.run(int((*sys.argv, 1000)[2]))
    print(made.table())
    print("\n".join(made.lost))
