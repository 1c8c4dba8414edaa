"""Tables of rigs in the forms that loggers and spreadsheets write."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pyfret as fret

SHIFT = np.r_[np.linspace(0, 10, 9), np.linspace(10, -10, 17)[1:], np.linspace(-10, 10, 17)[1:]]
FORCE = 5 * np.tanh(SHIFT / 4)


def table(
    head: str = "delta [um];T [N]",
    *,
    separator: str = ";",
    decimal: str = ".",
    end: str = "\n",
    behind: str = "",
    above: str = "",
    quote: str = "",
) -> str:
    """Loops as a program writes them."""
    rows = [
        [f"{quote}{value:.4f}{quote}".replace(".", decimal) for value in row]
        for row in zip(SHIFT, FORCE, strict=True)
    ]
    lines = [head.replace(";", separator), *(separator.join(row) for row in rows)]
    return above + "".join(line + behind + end for line in lines)


#: Forms that are read right, each as bytes.
RIGHT: dict[str, bytes] = {
    "UTF-8 with a mark": b"\xef\xbb\xbf" + table().encode(),
    "UTF-16": table().encode("utf-16"),
    "UTF-16 without a mark": table().encode("utf-16-le"),
    "Latin-1": table("Weg [µm];Kraft [N]").encode("latin-1"),
    "decimal comma": table(decimal=",").encode(),
    "decimal comma, tabs": table(separator="\t", decimal=",").encode(),
    "commas": table(separator=",").encode(),
    "blanks": table(separator="  ").encode(),
    "line ends of Windows": table(end="\r\n").encode(),
    "line ends of old": table(end="\r").encode(),
    "a separator behind each line": table(behind=";").encode(),
    "a comma behind each line": table(separator=",", behind=",").encode(),
    "a tab behind each line": table(separator="\t", behind="\t").encode(),
    "quotes": table(quote='"').encode(),
    "the line sep=; of Excel": table(above="sep=;\n").encode(),
    "comments": table(above="# rig 3\n% of May\n").encode(),
    "units in a line": table("delta;T\num;N").encode(),
    "units in brackets": table("delta (um);T (N)").encode(),
    "units behind a bar": table("delta / um;T / N").encode(),
    "words for units": table("delta [Micrometers];T [Newton]").encode(),
    "the end of a text of DOS": table().encode() + b"\x1a",
    "parts with heads": table().encode() + table().encode(),
}
#: Forms that are refused, and part of the reason.
REFUSED: dict[str, tuple[bytes, str]] = {
    "a division by zero of Excel": (table().replace("10.0000;", "#DIV/0!;", 1).encode(), "#DIV/0!"),
    "no value of Excel": (table().replace("10.0000;", "#NV;", 1).encode(), "#NV"),
    "not a number": (table().replace("10.0000;", "nan;", 1).encode(), "must be numbers"),
    "an empty cell": (table().replace("10.0000;", ";", 1).encode(), "must be numbers"),
    "an empty last cell": (table().replace("10.0000;4.9331", "10.0000;", 1).encode(), "1 numbers"),
    "underscores": (table().replace("10.0000;", "1_0;", 1).encode(), "must be numbers"),
    "digits of another script": (
        table().replace("10.0000;", "\u0661\u0660;", 1).encode(),
        "must be num",
    ),
    "a foot": (table().encode() + b"End of data\n", "1 numbers"),
    "an unknown unit": (table("delta [counts];T [N]").encode(), "counts"),
    "no unit": (table("delta;T").encode(), "unit of length"),
    "units of one column": (table("delta [um];T").encode(), "unit of force"),
    "zeros": (table().encode() + b"\0\0", "is no text"),
    "a packed file": (b"PK\x03\x04" + bytes(99), "is no whole archive"),
}


@pytest.mark.parametrize("form", RIGHT)
def test_loops_in_the_forms_of_loggers(tmp_path: Path, form: str) -> None:
    file = tmp_path / "loop.csv"
    file.write_bytes(RIGHT[form])
    loops = fret.fit.read_loops(file)
    assert np.ptp(loops.delta) == pytest.approx(20e-6)
    assert loops.T.max() == pytest.approx(FORCE.max(), abs=1e-4)


@pytest.mark.parametrize("form", REFUSED)
def test_what_is_no_number_is_refused_in_its_line(tmp_path: Path, form: str) -> None:
    file = tmp_path / "loop.csv"
    content, text = REFUSED[form]
    file.write_bytes(content)
    with pytest.raises((ValueError, OSError), match=text) as refused:
        fret.fit.read_loops(file)
    assert "loop.csv" in str(refused.value)
