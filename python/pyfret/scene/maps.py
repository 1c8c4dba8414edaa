"""Treatment of a measured map before it becomes a shape: form, filters, points, statistics.

Heights are z(x, y) on an even grid of points, out of the body. Filters and resampling are products
of two matrices, z' = A z B^T, one along each axis.
"""

from __future__ import annotations

import math
from numbers import Integral
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from pyfret._core import SurfaceMap
from pyfret._util.attributes import missing_attribute
from pyfret._util.csv_table import check_path
from pyfret._util.numbers import length
from pyfret._util.window import wrap
from pyfret.quantities import Length, as_number, quantities

if TYPE_CHECKING:
    import os

    import xarray as xr
    from numpy.typing import NDArray

    Field = NDArray[np.float64]

__all__ = ["Form", "FormName", "Statistics"]

FormName = Literal["plane", "sphere", "paraboloid", "cubic"]

#: Powers (i, j) of x and y of a form, the plane first.
POWERS: dict[str, tuple[tuple[int, int], ...]] = {
    "plane": ((0, 0), (1, 0), (0, 1)),
    "paraboloid": ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)),
    "cubic": tuple((i, j) for i in range(4) for j in range(4 - i)),
}
#: A map is called curved if a sphere explains this part of its variance beside a plane.
CURVED = 0.5
#: sqrt(ln 2/pi): a Gaussian filter passes half of a wave of its cut-off (ISO 16610-21, eq. 2).
ALPHA = math.sqrt(math.log(2.0) / math.pi)
#: Points of a resampled map along a side.
FEWEST, MOST = 2, 8192


class Form(NamedTuple):
    """A smooth form fitted to a map by least squares."""

    #: "plane", "sphere", "paraboloid" or "cubic".
    name: str
    #: Slopes along x and y in the middle.
    slopes: tuple[float, float]
    #: Principal radii along x and y [m], positive for a hill; infinite without curvature.
    radii: tuple[float, float]
    #: Part of the variance beside the mean plane that the form explains.
    explained: float
    #: Heights of the form [m].
    heights: Field

    def __str__(self) -> str:
        """Return name, radii and tilt as text."""
        slope = math.hypot(*self.slopes)
        tilt = f"tilt {math.degrees(math.atan(slope)):.3g} deg" if slope > LEVEL else "no tilt"
        if self.name == "plane":
            return f"plane, {tilt}"
        if self.name == "sphere":
            return f"sphere of R = {length(self.radii[0])}, {tilt}"
        return f"{self.name}, R_x = {length(self.radii[0])}, R_y = {length(self.radii[1])}, {tilt}"


#: Slope that is rounding.
LEVEL = 1e-12


class Statistics(NamedTuple):
    """Parameters of the heights after ISO 25178-2."""

    #: Root mean square of the heights [m].
    S_q: float
    #: Mean of the absolute heights [m].
    S_a: float
    #: Largest less smallest height [m].
    S_z: float
    #: Skewness.
    S_sk: float
    #: Kurtosis; 3 for normally distributed heights.
    S_ku: float
    #: Root mean square of the slope from point to point.
    S_dq: float
    #: Pitch at which the slope was taken [m]: it grows as the pitch falls.
    S_dq_length: float

    def __getattr__(self, name: str) -> float:
        """Return a parameter by its name in the standard, such as ``Sq``."""
        word = f"S_{name[1:]}"
        if name[:1] == "S" and word in self._fields:
            return float(tuple.__getitem__(self, self._fields.index(word)))
        missing_attribute(self, name)


def parameter(statistics: Statistics, key: object) -> Any:
    """Return a parameter by its name, ``"S_q"`` or ``"Sq"``, or by its place."""
    if not isinstance(key, str):
        return tuple.__getitem__(statistics, key)  # type: ignore[call-overload]
    try:
        return getattr(statistics, key) if key[:1] == "S" else missing_attribute(statistics, key)
    except AttributeError as error:
        raise KeyError(str(error)) from None


if not TYPE_CHECKING:
    Statistics.__getitem__ = parameter


def coordinates(surface: SurfaceMap) -> tuple[Field, Field]:
    """Return x and y of the points [m], from the middle."""
    shape = surface.values.shape
    x, y = (d * (np.arange(n) - 0.5 * (n - 1)) for n, d in zip(shape, surface.spacing, strict=True))
    return x[:, None], y[None, :]


def fit_form(surface: SurfaceMap, name: FormName) -> Form:
    """Fit a form to the heights by least squares."""
    if name != "sphere" and name not in POWERS:
        allowed = ", ".join(repr(word) for word in ("plane", "sphere", "paraboloid", "cubic"))
        raise ValueError(f"form: {name!r}: must be one of {allowed}")
    z = np.asarray(surface.values, dtype=float)
    x, y = coordinates(surface)
    scale = max(float(abs(x).max()), float(abs(y).max())) or 1.0
    u, v = x / scale, y / scale
    plane = [u**i * v**j for i, j in POWERS["plane"]]
    if name == "sphere":
        columns = [*plane, u**2 + v**2]
    else:
        columns = [u**i * v**j for i, j in POWERS[name]]
    if z.size <= len(columns):
        raise ValueError(f"form: {z.size} points are too few for a {name}")
    heights, factors = least_squares(z, columns)
    flat, _ = least_squares(z, plane)
    variance = float((z - flat).var())
    residual = float((z - heights).var())
    explained = 1.0 - residual / variance if variance > 0 else 0.0
    if name == "sphere":
        tilt, curvature = factors[1:3], (2 * factors[3], 2 * factors[3])
    else:
        by_power = dict(zip(POWERS[name], factors, strict=True))
        tilt = np.array([by_power[1, 0], by_power[0, 1]])
        curvature = (2 * by_power.get((2, 0), 0.0), 2 * by_power.get((0, 2), 0.0))
    slope_x, slope_y = (float(slope) / scale for slope in tilt)
    radius_x, radius_y = (-(scale**2) / float(k) if k else math.inf for k in curvature)
    return Form(name, (slope_x, slope_y), (radius_x, radius_y), explained, heights)


def least_squares(z: Field, columns: list[Field]) -> tuple[Field, Field]:
    """Return the sum of the columns nearest to the heights, and their factors."""
    matrix = np.stack([np.broadcast_to(column, z.shape).ravel() for column in columns], axis=1)
    # The normal equations of a few columns: no copy of the matrix of a large map.
    factors = np.asarray(np.linalg.solve(matrix.T @ matrix, matrix.T @ z.ravel()), dtype=float)
    fitted: Field = (matrix @ factors).reshape(z.shape)
    return fitted, factors


def level(surface: SurfaceMap, name: FormName) -> SurfaceMap:
    """Return the map without a form."""
    return replace(surface, np.asarray(surface.values) - fit_form(surface, name).heights)


def replace(
    surface: SurfaceMap, heights: Field, spacing: tuple[float, float] | None = None
) -> SurfaceMap:
    """Return a map of other heights, on points of the same or of another spacing."""
    return SurfaceMap(heights, spacing=spacing or surface.spacing)


@quantities
def filter_waves(
    surface: SurfaceMap, short: Length | None = None, long: Length | None = None
) -> SurfaceMap:
    """Remove waves shorter and longer than cut-offs, by Gaussian filters (ISO 16610-61)."""
    short, long = as_number(short), as_number(long)
    if short is None and long is None:
        raise ValueError("filter: needs short= or long=, a cut-off wavelength in m")
    if short is not None and long is not None and not short < long:
        raise ValueError(f"filter: short={short!r} must be below long={long!r}")
    z = np.asarray(surface.values, dtype=float)
    for cut_off in (short, long):
        check_cut_off(surface, cut_off)
    if short is not None:
        z = smooth(z, surface.spacing, short)
    if long is not None:
        z = z - smooth(z, surface.spacing, long)
    return replace(surface, z)


def check_cut_off(surface: SurfaceMap, cut_off: float | None) -> None:
    """Refuse a cut-off that lets everything or nothing pass."""
    sides = [n * d for n, d in zip(surface.values.shape, surface.spacing, strict=True)]
    shortest, longest = 2 * min(surface.spacing), max(sides)
    if cut_off is not None and not shortest <= cut_off <= longest:
        raise ValueError(
            f"filter: a cut-off of {length(cut_off)} must be {length(shortest)} (two points) to "
            f"{length(longest)} (the longer side of the map)"
        )


def smooth(z: Field, spacing: tuple[float, float], cut_off: float) -> Field:
    """Return the waves longer than a cut-off; at the border the weights are normalised.

    The weights are exp(-pi (x/(alpha cut_off))^2), alpha = sqrt(ln 2/pi).
    """
    along_x, along_y = (
        gaussian_weights(n, d / (ALPHA * cut_off)) for n, d in zip(z.shape, spacing, strict=True)
    )
    smoothed: Field = along_x @ z @ along_y.T
    return smoothed


def gaussian_weights(count: int, step: float) -> Field:
    """Return the matrix of the weights along one axis, each row of the sum 1."""
    offsets = step * (np.arange(count)[:, None] - np.arange(count)[None, :])
    weights: Field = np.exp(-np.pi * offsets**2)
    normalised: Field = weights / weights.sum(axis=1, keepdims=True)
    return normalised


def resample(
    surface: SurfaceMap,
    spacing: float | tuple[float, float] | None = None,
    n: int | tuple[int, int] | None = None,
) -> SurfaceMap:
    """Return the map on other points, by the cosine series of its heights.

    The series runs through all points, and is cut where the new points cannot carry its waves. A
    mirror image continues the heights beyond the border, so that they have no step there.
    """
    if (spacing is None) == (n is None):
        raise ValueError("resample: needs one of spacing= in m and n=, the number of points")
    shape = surface.values.shape
    sides = [count * d for count, d in zip(shape, surface.spacing, strict=True)]
    if spacing is not None:
        steps = (spacing, spacing) if isinstance(spacing, float) else spacing
        counts = tuple(max(1, round(side / d)) for side, d in zip(sides, steps, strict=True))
    else:
        counts = two_counts(n)
    if not all(FEWEST <= count <= MOST for count in counts):
        raise ValueError(
            f"resample: {counts[0]} x {counts[1]} points: must be {FEWEST} to {MOST} each way"
        )
    along_x, along_y = (cosine_matrix(a, b) for a, b in zip(shape, counts, strict=True))
    z = along_x @ np.asarray(surface.values, dtype=float) @ along_y.T
    step_x, step_y = (side / count for side, count in zip(sides, counts, strict=True))
    return replace(surface, z, (step_x, step_y))


def two_counts(n: int | tuple[int, int] | None) -> tuple[int, int]:
    """Return the numbers of points along x and y; a TypeError for what is no whole number."""
    pair = (n, n) if isinstance(n, Integral) else n
    if not isinstance(pair, (tuple, list)) or len(pair) != 2:
        raise TypeError(f"resample: n = {n!r}: must be a whole number, or two")
    for count in pair:
        if isinstance(count, bool) or not isinstance(count, Integral):
            raise TypeError(f"resample: n = {n!r}: must be a whole number, or two")
    return int(pair[0]), int(pair[1])


def cosine_matrix(count: int, wanted: int) -> Field:
    """Return the matrix from values at `count` points to those at `wanted` points of one side."""
    waves = np.arange(min(count, wanted))[None, :]
    before = np.cos(np.pi * waves * (np.arange(count)[:, None] + 0.5) / count)
    after = np.cos(np.pi * waves * (np.arange(wanted)[:, None] + 0.5) / wanted)
    weights = np.where(waves == 0, 1.0, 2.0) / count
    matrix: Field = (after * weights) @ before.T
    return matrix


def topography(surface: SurfaceMap) -> object:
    """Return the map as SurfaceTopography has it."""
    try:
        from SurfaceTopography import Topography
    except ImportError as missing:
        raise ImportError(
            'the parameters of a map need SurfaceTopography: pip install "fretting[surfaces]"'
        ) from missing
    sides = tuple(n * d for n, d in zip(surface.values.shape, surface.spacing, strict=True))
    return Topography(np.asarray(surface.values, dtype=float), sides, unit="m")


def statistics(surface: SurfaceMap) -> Statistics:
    """Return the parameters of the heights about their mean, form and waves included."""
    z = np.asarray(surface.values, dtype=float)
    z = z - z.mean()
    s_q = float(surface.rms)
    scaled = z / s_q if s_q > 0 else z
    return Statistics(
        S_q=s_q,
        S_a=float(abs(z).mean()),
        S_z=float(np.ptp(z)),
        S_sk=float((scaled**3).mean()),
        S_ku=float((scaled**4).mean()),
        S_dq=float(topography(surface).rms_gradient()),  # type: ignore[attr-defined]
        S_dq_length=max(surface.spacing),
    )


def roughness(surface: SurfaceMap, name: str) -> float:
    """Return a parameter of the heights by its name in the standard, such as ``Sq``."""
    if name[:1] != "S" or f"S_{name.removeprefix('S').removeprefix('_')}" not in Statistics._fields:
        missing_attribute(surface, name)
    return float(getattr(statistics(surface), name))


if not TYPE_CHECKING:
    SurfaceMap.__getattr__ = roughness


def spectrum(surface: SurfaceMap) -> xr.DataArray:
    """Return the power spectral density of the heights, the mean over all directions [m^4]."""
    import xarray as xr

    q, density = topography(surface).power_spectrum_from_area()  # type: ignore[attr-defined]
    finite = np.isfinite(q) & np.isfinite(density) & (np.asarray(q) > 0)
    return xr.DataArray(
        np.asarray(density)[finite],
        dims="q",
        coords={"q": ("q", np.asarray(q)[finite], {"units": "rad/m", "long_name": "wave number"})},
        name="psd",
        attrs={"units": "m^4", "long_name": "power spectral density of the heights"},
    )


def write_heights(surface: SurfaceMap, path: str | os.PathLike[str]) -> None:
    """Write x, y and z of every point [m] as a table of text."""
    x, y = coordinates(surface)
    z = np.asarray(surface.values, dtype=float)
    columns = [np.broadcast_to(values, z.shape).ravel() for values in (x, y, z)]
    check_path(path)
    np.savetxt(
        path, np.column_stack(columns), "%.17g", ",", header="x [m],y [m],z [m]", comments=""
    )


def summarize_map(surface: SurfaceMap) -> str:
    """Return points, pitch, size, form and parameters of a map as text."""
    shape = surface.values.shape
    points = " x ".join(str(count) for count in shape)
    pitch = " x ".join(length(step) for step in surface.spacing)
    sides = " x ".join(length(n * d) for n, d in zip(shape, surface.spacing, strict=True))
    lines = [f"{points} points, pitch {pitch}, size {sides}"]
    if surface.filled:
        lines.append(
            f"{surface.filled} points were not measured: each is the mean of its neighbours"
        )
    roughness = surface
    if min(shape) > 3:
        plane, sphere = fit_form(surface, "plane"), fit_form(surface, "sphere")
        form = sphere if sphere.explained > CURVED else plane
        lines.append(f"form: {form}")
        if form is sphere:
            radius, share = sphere.radii[0], 100 * sphere.explained
            lines.append(
                f"the heights are curved like a sphere ({share:.1f} % of their variance): "
                f'use the map as the whole shape, or level("sphere") + Sphere(R={radius:.4g})'
            )
        roughness = replace(surface, np.asarray(surface.values) - form.heights)
    parameters = statistics(roughness)
    heights = ", ".join(
        f"{name} {length(getattr(parameters, name))}" for name in ("S_q", "S_a", "S_z")
    )
    # A skewness that is rounded to zero has no sign.
    skewness, kurtosis = (round(value, 2) + 0.0 for value in (parameters.S_sk, parameters.S_ku))
    lines.append(f"without the form: {heights}")
    lines.append(
        f"  S_sk {skewness:.2f}, S_ku {kurtosis:.2f}, S_dq {parameters.S_dq:.3g} "
        f"at {length(parameters.S_dq_length)}"
    )
    return wrap("\n".join(lines))
