"""What happens to a text on its way: pieces lost, doubled or put in, other encodings."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

_PIECES = (
    *("\0", "\t", "\n", "\r", "\r\n", " ", "  ", "\ufeff", "\u202e", "\u00a0", "\u2028", "\x85"),
    *(
        ":",
        ": ",
        "- ",
        "[",
        "]",
        "{",
        "}",
        "[[[[",
        "{{{{",
        '"',
        "'",
        "#",
        "&a ",
        "*a",
        "!",
        "!!str ",
    ),
    *(
        "!!python/object/apply:os.system ",
        "<<: ",
        "|\n",
        ">\n",
        "? ",
        "%YAML 9.9\n",
        "---\n",
        "...\n",
    ),
    *(",", ";", ",,", "=", "*", "**", "/", "\\", "e", "E", "+", "-", ".", "nan", "inf", "9" * 50),
    *("*MATERIAL, NAME=x\n", "TB,PRONY\n", "(", ")", "1e400", "é", "μ", "😀", "\x1a", "\x1b[2J"),
)
_ENCODINGS = ("utf-8", "utf-8", "utf-8", "utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1")


@st.composite
def damaged(draw: Any, text: str) -> bytes:
    """Return a text's bytes, mostly as they were."""
    if draw(st.integers(0, 2)):
        return text.encode("utf-8", "surrogatepass")
    for _ in range(draw(st.sampled_from((0, 1, 1, 2, 4)))):
        text = _hurt(draw, text)
    encoding = draw(st.sampled_from(_ENCODINGS))
    # Lone surrogates have no bytes; they come from nowhere but other programs' mistakes.
    data = text.encode(encoding, "surrogatepass" if encoding.startswith("utf") else "replace")
    if draw(st.integers(0, 9)) == 0:
        data = data[: draw(st.integers(0, len(data)))]
    if draw(st.integers(0, 9)) == 0:
        data += draw(st.binary(max_size=20))
    return data


def _hurt(draw: Any, text: str) -> str:
    begin = draw(st.integers(0, len(text)))
    end = min(len(text), begin + draw(st.sampled_from((0, 1, 2, 8, 40))))
    what = draw(st.sampled_from(("put", "put", "lose", "double", "replace", "many")))
    piece = draw(st.sampled_from(_PIECES))
    if what == "put":
        return text[:begin] + piece + text[begin:]
    if what == "lose":
        return text[:begin] + text[end:]
    if what == "double":
        return text[:end] + text[begin:]
    if what == "many":
        # Long enough to show what takes longer than its length.
        times = draw(st.sampled_from((20, 500, 20_000))) // len(piece)
        return text[:begin] + piece * times + text[begin:]
    return text[:begin] + piece + text[end:]
