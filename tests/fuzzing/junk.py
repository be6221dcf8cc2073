"""Unexpected values: numbers, units, texts, names of files."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hypothesis import strategies as st

NUMBERS = (
    *("0", "-0", "1", "-1", "2", "0.5", "1.5", "3", "1e-3", "1e3", "7", "64", "100", "1e6"),
    *("1e12", "1e15", "1e18", "1e30", "1e100", "1e101", "1e-100", "1e-12", "1e-30", "-1e9"),
    *("1e308", "-1e308", "1e309", "1e-320", "5e-324", "1e999999999", "1e-999999999"),
    *("nan", ".nan", "NaN", "inf", ".inf", "-.inf", "-inf", "Infinity", "∞"),
    *("9" * 100_000, "0." + "0" * 5000 + "1", "1" + "0" * 400, "-" + "9" * 30),
    *("1_000", "0x10", "0o17", "0b1", "1,5", "1.000,5", "1'000", "٣", "½", "²", "Ⅳ", "１２"),
    *("1.", "+.5", ".", "--1", "+-1", "1e", "1e+", "e5", "1d3", "1e3e3", "1.2.3", "0.1f", "1/2"),
    *("9007199254740993", "18446744073709551616", "2147483648", "-2147483649", "1e9", "1000001"),
)

UNITS = (
    *("mm", "m", "um", "µm", "μm", "nm", "km", "in", "parsec", "lightyear"),
    *("N", "kN", "MN", "uN", "lbf", "MPa", "Pa", "GPa", "kPa", "psi", "1/MPa", "/ MPa", "1 / Pa"),
    *("s", "min", "h", "d", "us", "year", "MPa s", "Pa*s", "1/(Pa s)", "1e-3 / MPa", "GPa·s"),
    *("rad", "deg", "mrad", "°", "K", "degC", "°C", "degF", "kJ/mol", "Hz", "rad/s"),
    *("", " ", "%", "m/s", "m^2", "m²", "m⁻¹", "m**9", "m**99", "9**9**9", "m**m", "(mm", "mm)"),
    *(
        "mm mm",
        "mm*",
        "/",
        "//",
        "*",
        "1",
        "-",
        "degC*degC",
        "dB",
        "pH",
        "delta_degC",
        "Ω",
        "counts",
    ),
    *("m" * 70, "__import__('os')", "lambda", "dimensionless", "N\n", "m\0", "ｍｍ", "\u202emm"),
)

ODD_TEXTS = (
    *("", " ", "null", "~", "true", "false", "yes", "on", "free", "all", "none", "log", "adaptive"),
    *("sphere", "roller", "zener", "maxwell", "table", "card", "step", "history", "harmonic"),
    *("pmma-paper", "pmma", "creep_compliance", "shear", "uniaxial", "deviatoric"),
    *("\0", "\ufeff", "\u202e", "\ud7ff", "\x1b[31m", "a\tb", "a\nb", "a\rb", "\x85", "\u2028"),
    *(
        "x" * 5000,
        "é" * 300,
        "😀",
        "ﬀ",
        "[",
        "]",
        "{",
        "}",
        "{}",
        "[]",
        "%s %d {0} {x}",
        "[red]x[/]",
    ),
    *(
        "!!python/object:os.system",
        "*a",
        "&a",
        "<<",
        "? ",
        "- ",
        "# no",
        "'",
        '"',
        "|",
        ">",
        "@",
        "`",
    ),
    *("2026-01-01", "12:30:45", "=", "1 mm 2 mm", "ramp to 10 kN in 1 s", "repeat 9 times"),
)

#: Names that a case may give a file, good and bad; `places` puts the special ones into a folder.
FILE_NAMES = (
    *("load.csv", "creep.csv", "relax.csv", "card.inp", "card.mac", "absent.csv", "creep.csv "),
    *("./load.csv", "sub/../load.csv", "sub/load.csv", "load.csv/", "load.csv/x", "LOAD.CSV"),
    *(
        "folder",
        ".",
        "..",
        "",
        "/",
        "//",
        "loop",
        "loop/x",
        "fifo",
        "socket",
        "huge.csv",
        "dangling",
    ),
    *("unreadable.csv", "/dev/zero", "/dev/null", "/dev/stdin", "/dev/full", "/dev/fd/0"),
    *("/proc/self/mem", "/proc/self/environ", "/proc/self/fd/0", "/etc/passwd", "/etc"),
    *("../../../../../../../../etc/passwd", "~", "~/load.csv", "$HOME", "file:///etc/passwd"),
    *("http://localhost/load.csv", "a" * 300, "a/" * 3000, "nul\0.csv", "new\nline.csv", "é.csv"),
    *("case.yaml", "result.nc", "RESULT.NC", "state.npz", "progress.jsonl", "CON", "C:\\load.csv"),
    *("empty.csv", "binary.csv", "\ud7ff", "|ls", "-", "-o", "--overwrite", "*.csv", "load.csv\n"),
)


def one_of(values: Sequence[Any]) -> st.SearchStrategy[Any]:
    """Any of these; Hypothesis' own `sampled_from` writes all of them out, long ones too."""
    return st.integers(0, len(values) - 1).map(lambda place: values[place])


def number_texts() -> st.SearchStrategy[str]:
    """Numbers as they are written, and what nearly is one."""
    return st.one_of(
        one_of(NUMBERS),
        st.floats().map(repr),
        st.integers(-(10**25), 10**25).map(str),
        st.builds("{}e{}".format, st.integers(-99, 99), st.integers(-400, 400)),
    )


def quantities() -> st.SearchStrategy[str]:
    """Numbers with units that fit or do not."""
    return st.builds(
        lambda number, blank, unit: f"{number}{blank}{unit}",
        number_texts(),
        st.sampled_from((" ", "", "  ", "\t", "\u00a0", "\u2009", "\n")),
        one_of(UNITS),
    )


def texts() -> st.SearchStrategy[str]:
    """Texts that are short and odd, or long."""
    return st.one_of(
        one_of(ODD_TEXTS),
        one_of(FILE_NAMES),
        st.text(max_size=12),
    )


def scalars() -> st.SearchStrategy[Any]:
    """Anything that is neither list nor mapping."""
    return st.one_of(
        quantities(),
        number_texts(),
        texts(),
        st.sampled_from((None, True, False, 0, 1, -1, 2, 10**30, 0.0, 0.38, float("nan"))),
        st.floats(),
        st.integers(-(10**20), 10**20),
    )


def values() -> st.SearchStrategy[Any]:
    """Scalars, and lists and mappings of them."""
    return st.recursive(
        scalars(),
        lambda inner: st.one_of(
            st.lists(inner, max_size=4),
            st.dictionaries(
                st.sampled_from(("file", "law", "kind", "x", "1", "")), inner, max_size=3
            ),
        ),
        max_leaves=6,
    )
