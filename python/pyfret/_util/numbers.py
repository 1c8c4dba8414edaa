"""Numbers as people read them."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

__all__ = [
    "format_number",
    "in_letters",
    "in_powers",
    "in_words",
    "layer_index",
    "layer_name",
    "length",
    "place",
    "um",
]

#: Units of lengths, the largest first [m].
LENGTHS = ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))


def in_words(value: float, digits: int = 4) -> str:
    """Format a number with a few digits, without trailing zeros or a needless power of ten.

    Examples
    --------
    >>> in_words(10.000000000000004), in_words(400000.0), in_words(1.23456e-7)
    ('10', '400000', '1.235e-07')
    """
    if value == 0.0 or not math.isfinite(value):
        return f"{value + 0.0:g}"
    size = math.floor(math.log10(abs(value)))
    if not -4 <= size <= 6:
        return f"{value:.{digits}g}"
    text = f"{value:.{max(digits - 1 - size, 0)}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def format_number(value: object) -> str:
    """A number in a few digits, anything else as it is.

    Examples
    --------
    >>> format_number(5.0000000000000036), format_number(3), format_number("7075")
    ('5', '3', '7075')
    """
    return in_words(float(value)) if isinstance(value, float) else str(value)


def length(value: float) -> str:
    """A length [m] in the unit that its number is short in.

    Examples
    --------
    >>> length(0.005), length(2e-6), length(0.0)
    ('5 mm', '2 µm', '0 m')
    """
    size, unit = next(
        (entry for entry in LENGTHS if abs(value) >= entry[0] * (1 - 1e-9)), LENGTHS[-1]
    )
    return f"{in_words(value / size)} {unit}" if value else "0 m"


def um(value: float) -> str:
    """A length [m] in micrometres, in ASCII: lengths that stand beside each other have one unit.

    Examples
    --------
    >>> um(1.23456e-5), um(-3.3e-4)
    ('12.35 um', '-330 um')
    """
    return f"{in_words(1e6 * value)} um"


def in_letters(text: str) -> str:
    """A text in ASCII as pages and figures have it: "µm" and "±".

    Examples
    --------
    >>> in_letters("stops at 12 +- 1 um")
    'stops at 12 ± 1 µm'
    >>> in_letters("uJ")
    'µJ'
    """
    text = text.replace("+-", "±")
    return re.sub(r"(?<![A-Za-z])u([mJ])(?![A-Za-z])", r"µ\1", text)


def in_powers(text: str) -> str:
    r"""Write numbers such as 1.3e6 in a text as powers of ten for figures.

    Examples
    --------
    >>> print(in_powers("1.3e6 (1e+07 or more) cycles"))
    $1.3\times 10^{6}$ ($10^{7}$ or more) cycles
    >>> print(in_powers("(1.2 +- 0.1)e-8"))
    (1.2 +- 0.1)$\times 10^{-8}$
    """

    def power(match: re.Match[str]) -> str:
        """Return one number as a power of ten."""
        factor = "" if float(match[1]) == 1.0 else rf"{match[1].removesuffix('.0')}\times "
        return f"${factor}10^{{{int(match[2])}}}$"

    text = re.sub(r"(\d+(?:\.\d+)?)e([+-]?\d+)", power, text)
    # A number and its error have their power together.
    return re.sub(r"\)e([+-]?\d+)", lambda m: rf")$\times 10^{{{int(m[1])}}}$", text)


class Placed(Protocol):
    """What lies somewhere below a surface."""

    @property
    def x(self) -> float:
        """Place [m]."""

    @property
    def y(self) -> float:
        """Place [m]."""

    @property
    def z(self) -> float:
        """Depth [m]."""

    @property
    def layer(self) -> int:
        """Layer from the surface down."""


def place(of: Placed, coatings: int | None = None) -> str:
    """Describe a place in ASCII: short lengths with their units, and the layer.

    The layer is called by its name if the number of coatings is known, else by its number.
    """
    axes = ", ".join(f"{axis} = {length(getattr(of, axis))}" for axis in "xyz")
    where = f"layer = {of.layer}"
    if coatings is not None:
        where = f"in {layer_name(of.layer, coatings)}"
    return f"{axes}, {where}".replace("µ", "u")


def layer_name(layer: int, coatings: int) -> str:
    """What a layer is called, by its index from the surface down: coatings count from one.

    Examples
    --------
    >>> layer_name(0, 2), layer_name(2, 2)
    ('coating 1', 'the substrate')
    """
    return f"coating {layer + 1}" if layer < coatings else "the substrate"


def layer_index(
    layer: int | str, coatings: int, known: Collection[int], materials: Sequence[Any] = ()
) -> int:
    """Return the index of a layer by its number or its name: "coating", "substrate", "TiN".

    `materials` are those of the layers from the surface down, each an Elastic or a Material.

    Raises
    ------
    ValueError
        There is no such layer; the message has the layers with their names.
    """
    names = {layer_name(n, coatings).removeprefix("the "): n for n in range(coatings + 1)}
    if coatings == 1:
        names["coating"] = 0
    word = layer.strip().lower().removeprefix("the ") if isinstance(layer, str) else ""
    if isinstance(layer, str):
        from pyfret._util.layers import layers_made_of

        matching = [names[word]] if word in names else layers_made_of(layer, materials)
        number = matching[0] if len(matching) == 1 else -1
    else:
        number = layer
    if number not in known:
        listed = ", ".join(f"{n} ({layer_name(n, coatings)})" for n in sorted(known))
        raise ValueError(f"layer = {layer!r:.60}: must be one of {listed}, as a number or a name")
    return int(number)
