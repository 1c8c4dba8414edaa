"""Names of parameters in figures: keys of scene files in words, with units."""

from __future__ import annotations

import re

from pyfret._util.text import literal

__all__ = ["parameter_label"]

#: The last part of a key: words, unit, and how many of its SI unit that is.
MEANINGS: dict[str, tuple[str, str, float]] = {
    "E": ("modulus", "GPa", 1e9),
    "nu": ("Poisson's ratio", "", 1.0),
    "thickness": ("thickness", "µm", 1e-6),
    "mu": (r"$\mu$", "", 1.0),
    "R": ("radius", "mm", 1e-3),
    "W": ("$W$", "N", 1.0),
    "T_x": ("$T_x$", "N", 1.0),
    "T_y": ("$T_y$", "N", 1.0),
    "M_z": ("$M_z$", "N m", 1.0),
    "delta_x": (r"$\delta_x$", "µm", 1e-6),
    "delta_y": (r"$\delta_y$", "µm", 1e-6),
    "delta_z": (r"$\delta_z$", "µm", 1e-6),
    "phi_z": (r"$\varphi_z$", "µrad", 1e-6),
    "sigma_B": (r"$\sigma_B$", "MPa", 1e6),
    "sigma_B1": (r"$\sigma_{B1}$", "MPa", 1e6),
    "extent": ("side of the grid", "mm", 1e-3),
    "n": ("cells along a side", "", 1.0),
    "rms": ("rms roughness", "µm", 1e-6),
}
#: Units of loads, which of a line contact are per metre.
LOADS = ("N", "N m")
#: Letters of a label from which on it takes two lines.
LONG = 36
#: Numbers that are given over another one: what that is called.
OVER = {
    "E_substrate": "that of the substrate",
    "a_H": "$a_H$",
    "mu_W": r"$\mu W$",
}
#: What the number belongs to, by the rest of the key; ``{n}`` is a number counted from 1.
PLACES = (
    (r"body(\d)\.coatings\.(\d+)", "coating {n} of body {body}"),
    (r"body(\d)\.substrate", "substrate of body {body}"),
    (r"body(\d)(?:\.(?:shape|surface)(?:\.\w+)*)?", "body {body}"),
    (r"path\.(\d+)", "branch {branch}"),
    (r"path\.(\*)", ""),
)


def place_in_words(whole: str) -> str | None:
    """Return the owner of a number; an empty text for the whole scene, None if unknown."""
    if whole in ("", "friction", "grid"):
        return ""
    for form, words in PLACES:
        if match := re.fullmatch(form, whole):
            first, last = match[1], match[match.lastindex or 1]
            return words.format(body=first, branch=first, n=int(last) + 1) if words else ""
    return None


def parameter_label(key: str, *, per_metre: bool = False) -> tuple[str, float]:
    """Return the name of a parameter with its unit, and the size of that unit in SI.

    What is no key of a scene file stays as it is. Forces of line contacts are `per_metre`.

    Examples
    --------
    >>> parameter_label("body2.coatings.0.thickness")
    ('thickness, coating 1 of body 2 [µm]', 1e-06)
    >>> parameter_label("speed")
    ('speed', 1.0)
    """
    first, *other_keys = key.split(",")
    amplitude = any(part.strip().startswith("-") for part in other_keys)
    whole, _, last = first.removeprefix("-").rpartition(".")
    over = OVER.get(last)
    if over is not None:
        whole, _, last = whole.rpartition(".")
    owner = place_in_words(whole)
    # A name without a point belongs to the user's own function, whatever its unit is.
    if last not in MEANINGS or owner is None or not (whole or last == "mu"):
        return literal(key), 1.0
    words, unit, size = MEANINGS[last]
    if other_keys:
        owner = ""
        words = f"amplitude of {words}" if amplitude else words
    if over is not None:
        words, unit, size = f"{words} over {over}", "", 1.0
    if per_metre and unit in LOADS:
        unit = f"{unit}/m"
    label = f"{words}, {owner}" if owner else words
    label = f"{label} [{unit}]" if unit else label
    # As long as an axis is.
    return (label.replace(", ", ",\n", 1) if len(label) > LONG else label), size
