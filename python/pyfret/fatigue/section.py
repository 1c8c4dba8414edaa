"""Sections below a contact over a closed cycle, on which the stress is judged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias, TypedDict

import numpy as np

from pyfret._core import Material
from pyfret._util.arrays import items, plain
from pyfret.quantities import Angle, InSI, LayerStresses, Length, by_default, part
from pyfret.subsurface.line import Line

__all__ = ["Materials", "Section", "SectionOptions", "for_each_layer"]


#: The material of the substrate, or one for each layer from the surface down, the substrate's last;
#: layers of ``None`` are not judged.
Materials = Material | str | Sequence[Material | str | None]


if TYPE_CHECKING:
    Places: TypeAlias = Any
else:
    #: A place [m], or several.
    Places = Length | Sequence[Length] | None


class SectionOptions(TypedDict, total=False):
    """The fields of :class:`Section` as keywords of functions that judge a section."""

    x: Length | Sequence[Length] | None
    y: Length | Sequence[Length] | None
    azimuth: Angle | None
    body_number: int
    cycle: int | None
    residual: LayerStresses | None


@part(kw_only=True)
class Section:
    """A section of a body, or several side by side, over a closed cycle of the load path.

    Functions that judge one take these fields as keywords, such as ``result.life(..., y=0.0)``.
    """

    #: The section along y at this x [m], or sections at several.
    x: InSI[Places] = by_default(None)
    #: The section along x at this y [m], or sections at several (default: the section along the
    #: shear of the cycle, through the centre of its largest contact).
    y: InSI[Places] = by_default(None)
    #: The section at this angle to the x axis [rad], through `x` and `y`.
    azimuth: InSI[Angle | None] = by_default(None)
    #: The upper body (1) or the lower one (2).
    body_number: int = 2
    #: Which of the closed cycles, the last by default; None for all increments that were kept.
    cycle: int | None = -1
    #: Residual stress of every layer from the surface down, the substrate's last, in place of that
    #: of the body: each a stress [Pa] or a table over depth, as :class:`pyfret.Body` takes it.
    residual: LayerStresses | None = None

    def __post_init__(self) -> None:
        """Reject values that define no section."""
        if self.azimuth is not None:
            if not isinstance(self.x, (int, float)) or not isinstance(self.y, (int, float)):
                raise ValueError("azimuth: give x and y as well, one point of the section")
        elif self.x is not None and self.y is not None:
            raise ValueError("give x or y: a section is along y at an x, or along x at a y")
        if self.body_number not in (1, 2):
            raise ValueError(f"body_number = {self.body_number}: must be 1 or 2")
        if self.is_placed and np.size(self.places) == 0:
            raise ValueError(f"{self.cross_axis} = []: must be one place or more")

    @property
    def is_placed(self) -> bool:
        """Whether the section has a place."""
        return self.x is not None or self.y is not None

    @property
    def axis(self) -> str:
        """The axis that the section runs along, or "s" in another direction."""
        return "s" if self.azimuth is not None else "y" if self.y is None else "x"

    @property
    def cross_axis(self) -> str:
        """The axis on which the section has its place."""
        return "x" if self.y is None else "y"

    @property
    def places(self) -> float | Sequence[float]:
        """Return the place or places on that axis [m]; 0 in another direction."""
        if self.azimuth is not None:
            return 0.0
        places = self.x if self.y is None else self.y
        assert places is not None
        return places

    @property
    def place(self) -> float:
        """The one place of the section [m]; a ValueError where there are several."""
        if np.ndim(self.places) != 0:
            raise ValueError(f"{self.cross_axis} = {self.places}: must be one number here")
        return float(self.places)  # type: ignore[arg-type]

    def moved_to(self, place: float) -> Section:
        """Return the section at another place [m]."""
        return replace(self, y=place) if self.cross_axis == "y" else replace(self, x=place)

    @property
    def line(self) -> Line:
        """Return the line of the surface above the section."""
        if self.azimuth is None:
            place = self.place
            return Line(*((place, None) if self.cross_axis == "x" else (None, place)))
        return Line(self.x, self.y, self.azimuth)

    def moved_below(self, line: Line) -> Section:
        """Return the section below a line."""
        return replace(self, **line.named())

    def split(self) -> list[Section]:
        """Return the sections one by one."""
        if self.azimuth is not None:
            return [self]
        return [
            self.moved_to(position)
            for position in np.atleast_1d(plain(self.places, self.cross_axis)).tolist()
        ]


def for_each_layer(value: Any, layers: int, singular: str, plural: str) -> list[Any]:
    """Return a value for each layer from the surface down; None for layers that are not judged.

    One material alone belongs to the substrate: coatings are not judged. `singular` and `plural`
    name it in the ValueError for another number of layers, and where nothing is judged.
    """
    if isinstance(value, Material):
        value = [None] * (layers - 1) + [value]
    values = items(value, plural) if isinstance(value, Sequence) else [value] * layers
    if len(values) != layers:
        raise ValueError(
            f"{len(values)} {plural}: must be one, or one for each of the {layers} layers "
            "from the surface down, the substrate's last; None leaves a layer out"
        )
    if all(layer_value is None for layer_value in values):
        raise ValueError(f"no layer has a {singular}: nothing is judged")
    return values
