"""Units in other spellings: mm3/(N m), mm^3/N/m, um^3/(N mm), W/m·K."""

from __future__ import annotations

import re

from pyfret import _core

__all__ = ["factor_between", "respelled"]

#: Signs of powers and products, as texts without superscripts have them.
SIGNS = str.maketrans({"²": "^2", "³": "^3", "·": " ", "*": " ", "⋅": " "})
#: A unit with its power.
FACTOR = re.compile(r"([A-Za-zµ]+)(?:\^?(-?\d+(?:\.\d+)?))?")
#: Dimensions of units in powers of metre, newton and joule, by what they measure.
DIMENSIONS: dict[str, dict[str, float]] = {
    "length": {"m": 1},
    "force": {"N": 1},
    # A wear per joule of friction is no wear per newton metre of load and slip.
    "energy": {"J": 1},
    "stress": {"N": 1, "m": -2},
}
#: Units of energy, which stand in the table of units as parts of others alone [J].
ENERGIES = {"J": 1.0, "nJ": 1e-9, "uJ": 1e-6, "µJ": 1e-6, "mJ": 1e-3, "kJ": 1e3, "MJ": 1e6}


def respelled(text: str, unit: str) -> float | None:
    """Read a number with a unit in another spelling, in a unit of SI; None if it is none.

    Examples
    --------
    >>> respelled("0.2 um^3/(N mm)", "m^2/N")
    2e-16
    """
    number, _, name = text.strip().partition(" ")
    parsed, target = product_of(name), product_of(unit)
    if parsed is None or target is None or parsed[1] != target[1]:
        return None
    try:
        return float(number) * parsed[0] / target[0]
    except ValueError:
        return None


def factor_between(unit: str, wanted: str) -> float | None:
    """Return the number of a wanted unit in one unit; None where they measure different things.

    Examples
    --------
    >>> factor_between("J", "uJ")
    1e6
    """
    first, second = _core.unit_of(unit), _core.unit_of(wanted)
    if first is not None and second is not None:
        return first[1] / second[1] if first[0] == second[0] else None
    parsed, target = product_of(unit), product_of(wanted)
    if parsed is None or target is None or parsed[1] != target[1]:
        return None
    return parsed[0] / target[0]


def product_of(name: str) -> tuple[float, dict[str, float]] | None:
    """Return the factor of a product of units and its powers of metre, newton and joule."""
    parts = name.translate(SIGNS).replace("(", "").replace(")", "").split("/")
    factor, powers = 1.0, dict.fromkeys(("m", "N", "J"), 0.0)
    for sign, part in zip([1, *[-1] * (len(parts) - 1)], parts, strict=True):
        for word in part.split():
            match = FACTOR.fullmatch(word)
            if not match:
                return None
            energy = ENERGIES.get(match[1])
            unit = _core.unit_of(match[1]) if energy is None else ("energy", energy)
            if unit is None or unit[0] not in DIMENSIONS:
                return None
            power = sign * float(match[2] or 1)
            factor *= unit[1] ** power
            for base, exponent in DIMENSIONS[unit[0]].items():
                powers[base] += exponent * power
    return factor, powers
