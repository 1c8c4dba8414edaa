"""Cracks below a contact: the stress of a cycle taken to the tip."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Literal
from zlib import crc32

import numpy as np

from pyfret import _core
from pyfret._util.arrays import plain
from pyfret._util.lazy import xr
from pyfret._util.parameter import Remedy
from pyfret.fatigue.cycle_section import sections_of_cycle
from pyfret.fatigue.cycles import cycle_increments
from pyfret.fatigue.section import Section
from pyfret.fracture.growth import Cracks
from pyfret.quantities import (
    Angle,
    CrackLengths,
    FrictionCoefficient,
    LayerStresses,
    Length,
    as_layers,
    as_number,
    quantities,
)
from pyfret.subsurface.moments import states_of_increments

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret.run import Run, State
    from pyfret.subsurface.line import Line

__all__ = ["crack", "grow"]

#: Lengths of cracks over half the width of the contact, by default.
SHORTEST, LONGEST, LENGTHS = 0.01, 2.0, 24
#: Shortest crack by default that has come through coatings, over their thickness.
BEYOND = 1.5
#: Relative error of Newman and Raju's fit.
FIT = 0.05
#: Error of the place of a rim [cells].
RIM = 0.1

#: Most memory of the prepared contact that cracks of a run share, and its part of a cell and
#: increment [bytes].
MOST_SHARED, BYTES = 128e6, 170.0

#: What to do with a material in place of the position.
OF_MATERIAL = Remedy(
    'a crack grows by the loads alone; result.grow_crack(x).life("Al 7075") counts its cycles'
)
UNITS = {"units": "Pa m^0.5"}


@quantities
def crack(
    result: Run,
    x: Length | None = None,
    *,
    lengths: CrackLengths | None = None,
    angle: Angle = 0.0,
    kink: tuple[float, float] | None = None,
    azimuth: Angle | None = None,
    offset: Length | None = None,
    aspect: float | None = None,
    friction: FrictionCoefficient = 0.0,
    body_number: int = 2,
    cycle: int | None = -1,
    residual: LayerStresses | None = None,
) -> Cracks:
    """Take the stress of a closed cycle to the tips of cracks of several lengths.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle; the fields in the plane of
        the crack are taken for plane strain.
    x : float, optional
        Place of the mouth along the plane of the crack [m]. By default it is the outermost place
        of the contact in the cycle, on the side with the larger range of K.
    lengths : array, optional
        Lengths of the crack [m] (default: 24 from 0.01 to 2 times half the width of the contact; of
        a coated body from 1.5 times the thickness of its coatings where that is longer).
    angle : float
        Angle from the inward normal, positive towards +x [rad].
    kink : (float, float), optional
        Length [m] after which cracks go on at another angle [rad]; by default they are straight.
    azimuth : float, optional
        Angle of the plane of the crack about the z axis from the x axis [rad], 0 in plane strain
        (default: the direction of the shear; where the contact is not round, or sheared in several
        directions, or bulk or residual stress have another direction, the angle of the largest
        range of K in steps of 30 degrees from it).
    offset : float, optional
        Distance of that plane from the z axis, to the left of its direction [m]; the y of a plane
        along x (default: through the centre of the largest contact of the cycle).
    aspect : float, optional
        Depth over half-length of a semi-elliptic crack, above 0 and up to 1. K is then an estimate
        for its deepest point, the plane value times :func:`ellipse_factor`. The error has 5 % more
        for the fit. It has nothing for stress that falls along the front, where K is too high.
    friction : float
        Coefficient of friction between faces in contact, over the history of the cycle.
    body_number, cycle, residual
        As in :func:`pyfret.fatigue.life`.

    Returns
    -------
    Cracks
        K over (increment, length), for the homogeneous half-plane. Its ``error`` has the part of
        the quadrature and the change of K by tractions on cells twice as large. Where the mouth is
        not given, it has the change of K by the error of the rim. Where layers differ, it has the
        change of K of published cracks in films.

    Raises
    ------
    ValueError
        There is no closed cycle, too few of its increments were kept, or the crack has no meaning.
    """
    cycle_of = Cycle(result, cycle, body_number, as_layers(residual))
    angle = as_number(angle)
    at_rim = x is None
    plane = as_number(azimuth), as_number(offset)
    x, azimuth, offset = cycle_of.place(as_number(x), plane, angle, friction)
    if lengths is None:
        lengths = cycle_of.lengths
    lengths = np.sort(np.atleast_1d(plain(lengths, "lengths")))

    intensity = cycle_of.contact.intensity(
        x=x,
        lengths=lengths.tolist(),
        angle=angle,
        kink=kink,
        azimuth=azimuth,
        offset=offset,
        friction=friction,
        mouth_error=cycle_of.error_of_rim(azimuth) if at_rim else None,
    )
    sin, cos = np.sin(angle), np.cos(angle)
    tips = {"x": x + lengths * sin, "z": lengths * cos}
    if kink is not None:
        first, turned = np.minimum(lengths, kink[0]), np.maximum(lengths - kink[0], 0.0)
        tips["x"] = x + first * sin + turned * np.sin(kink[1])
        tips["z"] = first * cos + turned * np.cos(kink[1])
    about = {"x": x, "angle": angle, "azimuth": azimuth, "offset": offset, "friction": friction}
    cracks = labelled(intensity, cycle_of, lengths, tips, about)
    if aspect is None:
        return cracks
    estimate = cracks.scaled(_core.ellipse_factor(aspect))
    K = np.hypot(estimate.dataset.K_I, estimate.dataset.K_II)
    error = estimate.dataset.error + FIT * K
    error.attrs = estimate.dataset.error.attrs
    return Cracks(estimate.dataset.assign(error=error).assign_attrs(aspect=aspect))


@quantities
def grow(
    result: Run,
    x: Annotated[Length, OF_MATERIAL] | None = None,
    *,
    start: Length | None = None,
    end: Length | None = None,
    angle: Angle = 0.0,
    azimuth: Angle | None = None,
    offset: Length | None = None,
    direction: Literal["tangential_stress", "opening_intensity"] = "tangential_stress",
    tolerance: float = 1e-2,
    friction: FrictionCoefficient = 0.0,
    body_number: int = 2,
    cycle: int | None = -1,
    residual: LayerStresses | None = None,
) -> Cracks:
    """Let a crack grow below a contact in the direction of the largest range over a closed cycle.

    The crack is made of curved pieces. At the end of each piece it has no reason to turn. The
    number of pieces doubles until the last tip moves less than the tolerance.

    Parameters
    ----------
    result, x, azimuth, offset, friction, body_number, cycle, residual
        As in :func:`crack`.
    start, end : float, optional
        Lengths of the first crack, which is straight, and of the last [m] (default: 0.02 times half
        the width of the contact, of a coated body 1.5 times the thickness of its coatings where
        that is longer; and half the width of the contact).
    angle : float
        Angle of the first crack from the inward normal, positive towards +x [rad].
    direction : {"tangential_stress", "opening_intensity"}
        Largest range of the tangential stress ahead of the tip (Erdogan and Sih 1963), or of K_I of
        a small kink (Amestoy and Leblond 1992).
    tolerance : float
        Distance by which the last tip may be off sideways, over the length grown.

    Returns
    -------
    Cracks
        K over (increment, length) with the tip at each end of a piece, and ``x`` and ``z`` of the
        tips [m]. The attribute ``path_error`` is how far the last tip may be off [m]. The attribute
        ``end`` is the reason for which the crack ends. "reached": it has its length. "closed":
        nothing opens it. "surface": it comes back to the surface. "kinks": its direction jumps by
        more than 0.5 rad.

    Raises
    ------
    ValueError
        As :func:`crack`.
    """
    cycle_of = Cycle(result, cycle, body_number, as_layers(residual))
    angle = as_number(angle)
    plane = as_number(azimuth), as_number(offset)
    x, azimuth, offset = cycle_of.place(as_number(x), plane, angle, friction)
    growth = cycle_of.contact.growth(
        x=x,
        start=cycle_of.shortest_crack(0.02) if start is None else as_number(start),
        end=cycle_of.half_width if end is None else as_number(end),
        direction=direction,
        tolerance=tolerance,
        angle=angle,
        azimuth=azimuth,
        offset=offset,
        friction=friction,
    )
    about: dict[str, Any] = {"x": x, "angle": angle, "azimuth": azimuth, "offset": offset}
    about["friction"] = friction
    about |= {"direction": direction, "path_error": growth["path_error"], "end": growth["end"]}
    return labelled(growth, cycle_of, growth["length"], growth, about)


@dataclass(frozen=True)
class Cycle:
    """The kept increments of a closed cycle, below which cracks run in one of the bodies."""

    result: Run
    cycle: int | None
    body_number: int
    residual: Sequence[ArrayLike] | None

    @cached_property
    def increments(self) -> NDArray[np.int64]:
        """Return the kept increments of the cycle."""
        return cycle_increments(self.result, self.cycle)

    @cached_property
    def states(self) -> list[State]:
        """Return the state of each increment."""
        return [self.result.at(int(n)) for n in self.increments]

    @cached_property
    def largest(self) -> _core.Outline:
        """Return the outline of the largest contact of the cycle."""
        outlines = [now.outline for now in self.states if now.outline is not None]
        if not outlines:
            raise ValueError("no increment of the cycle has contact: give the place x of the crack")
        return max(outlines, key=lambda outline: sum(spot[2] for spot in outline.spots))

    def outermost(self, azimuth: float) -> tuple[float, float]:
        """Return the outermost places that the contact reaches in the cycle, in a plane [m]."""
        sin, cos = np.sin(azimuth), np.cos(azimuth)
        outlines = [now.outline for now in self.states if now.outline is not None]
        if not outlines:
            raise ValueError("no increment of the cycle has contact: give the place x of the crack")
        middles = [float(cos * line.centre[0] + sin * line.centre[1]) for line in outlines]
        ends = [line.border(azimuth) for line in outlines]
        low = min(middle + end[0] for middle, end in zip(middles, ends, strict=True))
        return low, max(middle + end[1] for middle, end in zip(middles, ends, strict=True))

    def error_of_rim(self, azimuth: float) -> float:
        """Return the error of the place of the rim along a plane [m]."""
        grid = self.result.scene.grid
        dy = 0.0 if grid.plane_strain else grid.dy
        return RIM * float(np.hypot(np.cos(azimuth) * grid.dx, np.sin(azimuth) * dy))

    @property
    def half_width(self) -> float:
        """Half the largest width of the contact along the shear [m]."""
        return self.largest.half_width(self.lines[0].angle)

    def shortest_crack(self, part: float) -> float:
        """Return the length of a shortest crack [m]: a part of half the width of the contact.

        It is longer than BEYOND times the thickness of the coatings.
        """
        thickness = sum(coating.thickness for coating in self.body.coatings)
        return max(part * self.half_width, BEYOND * thickness)

    @property
    def lengths(self) -> NDArray[np.float64]:
        """Return the default lengths of cracks [m]."""
        shortest = self.shortest_crack(SHORTEST)
        longest = max(LONGEST * self.half_width, 2.0 * shortest)
        return np.geomspace(shortest, longest, LENGTHS)

    @cached_property
    def lines(self) -> list[Line]:
        """The sections of the cycle by default, the first along the shear."""
        section = Section(cycle=self.cycle, body_number=self.body_number, residual=self.residual)
        return [
            section_of_cycle.line for section_of_cycle in sections_of_cycle(self.result, section)
        ]

    @cached_property
    def shared(self) -> tuple[_core.ContactForCracks, dict[tuple[object, ...], int]]:
        """The prepared contact and the mouths chosen before, which all cracks of a run share.

        A run keeps one cycle of each body, about 128 MB at most.
        """
        d = self.result.dataset
        size = BYTES * self.increments.size * d.sizes["x"] * d.sizes["y"]
        if self.residual is not None or self.body.yields or size > MOST_SHARED:
            return self.prepare(), {}
        last = d.variables["p"].isel(saved=-1).values
        key = self.increments.tobytes(), crc32(np.ascontiguousarray(last).tobytes())
        name = f"cracks in body {self.body_number}"
        kept = self.result.shared.get(name)
        if kept is None or kept[0] != key:
            kept = self.result.shared[name] = (key, (self.prepare(), {}))
        shared: tuple[_core.ContactForCracks, dict[tuple[object, ...], int]] = kept[1]
        return shared

    @property
    def contact(self) -> _core.ContactForCracks:
        """Return the states in the form of the core, prepared for cracks."""
        return self.shared[0]

    @property
    def body(self) -> _core.Body:
        """Return the body with the crack."""
        scene = self.result.scene
        return scene.body1 if self.body_number == 1 else scene.body2

    def prepare(self) -> _core.ContactForCracks:
        """Prepare the states for cracks."""
        return _core.ContactForCracks(
            self.body,
            states_of_increments(self.result, self.increments.tolist(), self.body_number),
            residual=None if self.residual is None else list(self.residual),
            body_number=self.body_number,
        )

    def offset_of_centre(self, azimuth: float) -> float:
        """Distance of the plane through the centre of the contact from the z axis [m]."""
        if all(now.outline is None for now in self.states):
            return 0.0
        X, Y = self.largest.centre
        return float(Y * np.cos(azimuth) - X * np.sin(azimuth))

    def place(
        self,
        x: float | None,
        plane: tuple[float | None, float | None],
        angle: float,
        friction: float,
    ) -> tuple[float, float, float]:
        """Return mouth [m], angle [rad] and offset [m] of the plane of cracks.

        By default they are the ones with the largest range of K of short cracks.
        """
        azimuth, offset = plane
        if azimuth is not None:
            angles = [float(azimuth)]
        elif len(self.lines) == 1:
            angles = [self.lines[0].angle]
        else:
            angles = (self.lines[0].angle + np.radians(np.arange(0.0, 180.0, 30.0))).tolist()
        places = []
        for phi in angles:
            away = self.offset_of_centre(phi) if offset is None else float(offset)
            if x is not None:
                places.append((float(x), phi, away))
                continue
            places += [(end, phi, away) for end in self.outermost(phi)]
        if len(places) == 1:
            return places[0]
        lengths = (self.half_width * np.array([0.05, 0.1, 0.2, 0.4])).tolist()
        contact, chosen = self.shared
        key = (*places, *lengths, angle, friction)
        if key not in chosen:
            options = {"lengths": lengths, "angle": angle, "friction": friction}
            chosen[key] = contact.widest_range(places, **options)
        return places[chosen[key]]


def labelled(
    found: dict[str, Any],
    cycle: Cycle,
    lengths: NDArray[np.float64],
    tips: dict[str, Any],
    about: dict[str, Any],
) -> Cracks:
    """Label K over (increment, length) with coordinates, units and what it belongs to."""
    names = {
        "K_I": "opening stress intensity",
        "K_II": "shear stress intensity",
        "K_I_linear": "opening stress intensity, faces pass through each other",
        "K_II_linear": "shear stress intensity, faces pass through each other",
        "error": "error bar of K",
    }
    dims = ("increment", "length")
    variables = {
        name: (dims, found[name], {**UNITS, "long_name": long}) for name, long in names.items()
    }
    open_share = {"units": "1", "long_name": "open share of the crack"}
    variables["open"] = (dims, found["open"], open_share)
    metre = {"units": "m"}
    coordinates = {
        "increment": cycle.increments,
        "length": ("length", lengths, {**metre, "long_name": "crack length"}),
        "x": ("length", tips["x"], {**metre, "long_name": "place of the tip"}),
        "z": ("length", tips["z"], {**metre, "long_name": "depth of the tip"}),
    }
    about |= {"body_number": cycle.body_number, "half_width": cycle.half_width}
    of_run = cycle.result.dataset.attrs
    about |= {name: of_run[name] for name in ("a_H", "p_H", "scene") if name in of_run}
    return Cracks(xr.Dataset(variables, coords=coordinates, attrs=about))
