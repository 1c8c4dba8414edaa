"""Stress and displacement under any tractions, and envelopes over a load path."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core
from pyfret._util.arrays import plain
from pyfret._util.lazy import xr
from pyfret.quantities import (
    Angle,
    BulkStress,
    LayerStresses,
    Length,
    Lengths,
    Numbers,
    as_layers,
    as_number,
    quantities,
)
from pyfret.subsurface.line import Line
from pyfret.subsurface.plastic import eigenstress
from pyfret.subsurface.tensor import COMPONENTS, DISPLACEMENTS, LABELS, Stress

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Sequence

    from numpy.typing import ArrayLike, NDArray

    from pyfret._core import Body, Grid, Scene
    from pyfret.run import State

__all__ = ["Stress", "displacement", "envelope", "stress", "write_volume"]

#: Most depths that are taken at once.
MOST_DEPTHS = 1_000_000


def choose_depths(
    body: Body, z: ArrayLike | None, half_width: float
) -> tuple[list[float], list[int]]:
    """Return depths [m] and their layers: `z`, or chosen from layers and half-width."""
    if z is None:
        return _core.chosen_depths(body, a=half_width, deepest=2.0 * half_width)
    wanted_depths = np.atleast_1d(plain(z, "z"))
    if wanted_depths.size > MOST_DEPTHS:
        raise ValueError(f"z has {wanted_depths.size} depths: must be at most {MOST_DEPTHS}")
    depths = wanted_depths.tolist()
    if not depths:
        raise ValueError("z is empty: give depths in m, or leave it out for depths from the layers")
    return _core.depths(body, depths)


def loaded_length(grid: Grid, *loads: ArrayLike | None) -> float:
    """Return half the longer side of the box around the loaded cells, or of the grid [m]."""
    loaded_cells = [plain(load, "a traction") != 0.0 for load in loads if load is not None]
    if not any(load.any() for load in loaded_cells):
        return grid.nx * grid.dx / 2
    loaded = np.logical_or.reduce(loaded_cells)
    along_x, along_y = (np.ptp(np.flatnonzero(loaded.any(axis=axis))) + 1 for axis in (1, 0))
    sides = (along_x * grid.dx, 0.0 if grid.plane_strain else along_y * grid.dy)
    return float(max(sides)) / 2


def interfaces(body: Body) -> list[float]:
    """Depths of the interfaces of a body [m], from the surface down."""
    return [float(depth) for depth in np.cumsum([c.thickness for c in body.coatings])]


def coordinates(
    grid: Grid,
    z: list[float],
    layer: list[int],
    x: float | None,
    y: float | None,
    azimuth: Angle | None = None,
) -> dict[str, object]:
    """Return depths with their layers, and x and y: of the cells, or constant."""
    metres = {"units": "m"}
    coords: dict[str, object] = {
        "z": ("depth", z, {"units": "m", "long_name": "depth below the surface"}),
        "layer": ("depth", layer, {"long_name": "layer from the surface down"}),
    }
    if azimuth is not None:
        s, places = _core.line_places(grid, x=x, y=y, azimuth=azimuth)
        long_name = "place along the section, from its given point"
        coords["s"] = ("s", s, {**metres, "long_name": long_name})
        coords["azimuth"] = ((), azimuth, {"units": "rad"})
        for name, values in zip(("x", "y"), np.transpose(places), strict=True):
            coords[name] = ("s", values, metres)
        return coords
    for name, at, cells in (("x", x, grid.x), ("y", y, grid.y)):
        coords[name] = (name, cells, metres) if at is None else ((), at, metres)
    return coords


def subsurface(
    body: Body,
    grid: Grid,
    loads: tuple[ArrayLike | None, ArrayLike | None, ArrayLike | None],
    body_number: int,
    sigma_B: BulkStress = 0.0,
    residual: Sequence[ArrayLike] | None = None,
    *,
    left: Sequence[_core.Eigenstress | None] | None = None,
    rim: bool = False,
    stick: ArrayLike | None = None,
) -> _core.Subsurface:
    """Return a body under the tractions p, q_x, q_y, with bulk and residual stress."""
    p, q_x, q_y = loads
    return _core.Subsurface(
        body,
        grid,
        p=p,
        q_x=q_x,
        q_y=q_y,
        body_number=body_number,
        sigma_B=sigma_B,
        residual=residual,
        eigenstress=left,
        rim=rim,
        stick=None if stick is None else np.asarray(stick, dtype=bool),
    )


@quantities
def stress(
    body: Body,
    grid: Grid,
    z: Lengths | None = None,
    *,
    p: Numbers | None = None,
    q_x: Numbers | None = None,
    q_y: Numbers | None = None,
    x: Length | None = None,
    y: Length | None = None,
    azimuth: Angle | None = None,
    body_number: int = 2,
    sigma_B: BulkStress = 0.0,
    rim: bool = False,
    stick: ArrayLike | None = None,
    length: Length | None = None,
    residual: LayerStresses | None = None,
) -> Stress:
    """Stress in a body under tractions on its surface.

    Parameters
    ----------
    body : Body
        The body; its shape does not matter.
    grid : Grid
        Cells on which the tractions are constant.
    z : float or array, optional
        Depths [m] (default: those that the layers ask for, down to twice `length`, both sides of
        every interface among them).
    p, q_x, q_y : array of shape (nx, ny), optional
        Pressure, and shear tractions on body 2 [Pa] (default: none).
    x, y : float, optional
        With `y`, the section along x at that y. With `x`, that along y. With both, the line below a
        point. With neither, the whole plane at every given depth, or without depths the section at
        y = 0.
    azimuth : float, optional
        With `x` and `y`, the section through this point at this angle to the x axis [rad].
    body_number : 1 or 2
        Whether `body` is the upper one, on which the shear acts reversed, or the lower one.
    sigma_B : float
        Bulk stress along x of its substrate [Pa]; coatings are stretched with it.
    rim : bool
        Whether the tractions belong to a contact (default: no). They then vary within the cells
        and vanish at the rim like a root. This changes the stress near the surface, beside the rim
        and the stick zone.
    stick : array of shape (nx, ny), optional
        With `rim`, the cells that stick (default: those at the rim slip).
    length : float, optional
        Radius of the contact [m], for the choice of depths (default: half the longer side of the
        box around the cells that are loaded).
    residual : sequence, optional
        Residual stress of every layer from the surface down, the substrate's last, in place of that
        of the body. Each is a stress [Pa] or a table over depth, as :class:`pyfret.Body` takes it.

    Returns
    -------
    Stress
        Of dims (depth, x), (depth, y), (depth) or (depth, x, y).
    """
    loads = (p, q_x, q_y)
    below = subsurface(
        body, grid, loads, body_number, sigma_B, as_layers(residual), rim=rim, stick=stick
    )
    length = loaded_length(grid, *loads) if length is None else as_number(length)
    return sampled_stress(
        below, body, grid, z, Line(as_number(x), as_number(y), as_number(azimuth)), length
    )


def sampled_stress(
    below: _core.Subsurface, body: Body, grid: Grid, z: ArrayLike | None, at: Line, length: float
) -> Stress:
    """Return the stress under the loads on planes, below a line or below a point."""
    line = Line(*_line(z, at.x, at.y), at.azimuth)
    sampled = _sampled(below, body, grid, choose_depths(body, z, length), line, displacement=False)
    materials = [*(coating.material for coating in body.coatings), body.substrate]
    attributed = sampled.assign_attrs(interfaces=interfaces(body), length=length)
    return Stress(attributed, below, materials)


def _line(
    z: ArrayLike | None, x: float | None, y: float | None
) -> tuple[float | None, float | None]:
    """The line or point asked for; without a word, where no depths are given, y = 0."""
    return (x, 0.0) if z is None and x is None and y is None else (x, y)


@quantities
def displacement(
    body: Body,
    grid: Grid,
    z: Lengths | None = None,
    *,
    p: Numbers | None = None,
    q_x: Numbers | None = None,
    q_y: Numbers | None = None,
    x: Length | None = None,
    y: Length | None = None,
    azimuth: Angle | None = None,
    body_number: int = 2,
    length: Length | None = None,
) -> xr.Dataset:
    """Displacements u_x, u_y, u_z in a body relative to infinity [m], as in :func:`stress`.

    They are those that the tractions cause; what a bulk stress stretches comes on top.
    """
    below = subsurface(body, grid, (p, q_x, q_y), body_number)
    length = loaded_length(grid, p, q_x, q_y) if length is None else as_number(length)
    line = Line(*_line(z, as_number(x), as_number(y)), as_number(azimuth))
    return _sampled(below, body, grid, choose_depths(body, z, length), line, displacement=True)


def _sampled(
    below: _core.Subsurface,
    body: Body,
    grid: Grid,
    depths_and_layers: tuple[list[float], list[int]],
    at: Line,
    *,
    displacement: bool,
) -> xr.Dataset:
    """Return stress or displacement on planes, below a line or below a point."""
    depths, layers = depths_and_layers
    pairs = list(zip(depths, layers, strict=True))
    x, y, azimuth = at
    if x is not None and y is not None and azimuth is None:
        values = below.points([(x, y, *d) for d in pairs], displacement=displacement).T
    elif x is None and y is None:
        planes = [below.slice(*d, displacement=displacement) for d in pairs]
        values = np.stack([np.stack(plane) for plane in planes], axis=1)
    else:
        values = below.section(depths, layers, x=x, y=y, azimuth=azimuth, displacement=displacement)
    coords = coordinates(grid, depths, layers, x, y, azimuth)
    dims = ["depth", *(k for k in ("s", "x", "y") if k in coords and coords[k][0] == k)]  # type: ignore[index]
    labels = DISPLACEMENTS if displacement else {name: LABELS[name] for name in COMPONENTS}
    variables = {
        name: (dims, values_of_field, {"units": units, "long_name": meaning})
        for (name, (units, meaning)), values_of_field in zip(labels.items(), values, strict=True)
    }
    return xr.Dataset(variables, coords=coords)


@quantities
def write_volume(
    body: Body,
    grid: Grid,
    out: str | os.PathLike[str],
    z: Lengths | None = None,
    *,
    p: Numbers | None = None,
    q_x: Numbers | None = None,
    q_y: Numbers | None = None,
    of: Sequence[str] = ("von_mises",),
    body_number: int = 2,
    sigma_B: BulkStress = 0.0,
    residual: LayerStresses | None = None,
    rim: bool = False,
    stick: ArrayLike | None = None,
    title: str = "",
) -> None:
    """Write stress and displacement under the grid, plane by plane while they are computed.

    Parameters
    ----------
    body, grid, z, p, q_x, q_y, body_number, sigma_B, residual, rim, stick
        As in :func:`stress`. On an interface it is the value of the upper layer.
    out : path
        A ``.vti`` file (VTK image data for ParaView and PyVista; depths evenly spaced) or a Zarr
        folder. It must not exist.
    of : sequence of str
        Measures, as in :class:`Stress`, and displacements ``u_x``, ``u_y``, ``u_z``.
    title : str
        What the Zarr group calls itself.
    """
    loads = (p, q_x, q_y)
    below = subsurface(
        body, grid, loads, body_number, sigma_B, as_layers(residual), rim=rim, stick=stick
    )
    write(below, body, out, z, loaded_length(grid, *loads), of, title)


def write(
    below: _core.Subsurface,
    body: Body,
    out: str | os.PathLike[str],
    z: ArrayLike | None,
    length: float,
    of: Sequence[str],
    title: str,
) -> None:
    """Write measures of the stress, plane by plane."""
    depths, layers = choose_depths(body, z, length)
    once = [n for n, depth in enumerate(depths) if n == 0 or depth != depths[n - 1]]
    z_once, layer_once = [depths[n] for n in once], [layers[n] for n in once]
    below.volume(out, z_once, layer_once, of=list(of), title=title)


@quantities
def envelope(
    scene: Scene,
    increments: Iterable[State],
    z: Lengths | None = None,
    *,
    x: Length | None = None,
    y: Length | None = None,
    azimuth: Angle | None = None,
    of: Sequence[str] = ("von_mises",),
    body_number: int = 2,
    bulk: bool = True,
    residual: LayerStresses | None = None,
) -> xr.Dataset:
    """Extremes of stress over a load path, none of whose increments is kept.

    Parameters
    ----------
    scene : Scene
        With the load path that the increments are of.
    increments : iterable of Snapshot
        What :func:`pyfret.march` yields, or some snapshots of a result.
    z, x, y, azimuth, body_number
        The section, as in :func:`stress`: `x` or `y`, or both and its direction. Without depths and
        place it is the section along x at y = 0, with depths alone whole planes.
    of : sequence of str
        Measures, as in :class:`Stress`.
    bulk : bool
        Whether the body's bulk stress is part of the stress.
    residual : sequence, optional
        Residual stress of the layers, as in :func:`stress`.

    Returns
    -------
    xarray.Dataset
        For each measure over depth and x or y: ``<name>_max``, ``<name>_min`` and
        ``<name>_increment`` (of the largest value). Over cycle, depth and x, y or s:
        ``<name>_amplitude`` and ``<name>_mean``. A cycle is the closed piece of the path between
        ``first_branch`` and ``last_branch``. On a section also over ``increment``: the largest
        value on it, ``<name>_largest``, and where it is between the samples, ``<name>_largest_x``
        (``_y``, ``_s``), ``<name>_largest_z`` and ``<name>_largest_layer``. At the rims of the
        contact and the borders of the stick zone it is evaluated. Elsewhere it is the error of a
        parabola between the samples, with the error ``<name>_largest_error``.
    """
    if (x is not None and y is not None) != (azimuth is not None):
        raise ValueError("give x or y for a section, both with its azimuth, or neither for planes")
    if isinstance(of, str):
        of = (of,)
    body = scene.body1 if body_number == 1 else scene.body2
    hertz, grid = scene.hertz, scene.grid
    # Without a yardstick, what a grid of the usual 2.4 radii has room for.
    side = grid.nx * grid.dx if grid.plane_strain else min(grid.nx * grid.dx, grid.ny * grid.dy)
    length = side / 2.4 if hertz is None else hertz.a
    x, y = _line(z, as_number(x), as_number(y))
    depths, layers = choose_depths(body, z, length)
    stream = _core.Envelope(
        body,
        scene.grid,
        scene.path,
        depths,
        layers,
        of=list(of),
        x=x,
        y=y,
        azimuth=azimuth,
        body_number=body_number,
        residual=as_layers(residual),
    )
    for snapshot in increments:
        fields = {k: snapshot.dataset[k].values for k in ("p", "q_x", "q_y")}
        stick = snapshot.dataset["stick"].values.astype(bool)
        number, branch = (int(snapshot.dataset[k]) for k in ("increment", "branch_of_increment"))
        sigma_B = snapshot.bulk_stress(body_number) if bulk else 0.0
        eigenstress_of_state = next(iter(eigenstress(snapshot, body_number)), None)
        stream.push(
            number, branch, stick=stick, sigma_B=sigma_B, eigenstress=eigenstress_of_state, **fields
        )
    result = xr.Dataset(coords=coordinates(scene.grid, depths, layers, x, y, azimuth))
    free = [name for name, at in (("x", x), ("y", y)) if at is None]
    along = free if azimuth is None else ["s"]
    dims = ("depth", *along)
    shape = tuple(result.sizes[name] for name in dims)
    for name, kept in stream.finish().items():
        meaning = LABELS[name][1]
        for key in ("max", "min"):
            attrs = {"units": "Pa", "long_name": f"{key} over the path: {meaning}"}
            result[f"{name}_{key}"] = (dims, kept[key].reshape(shape), attrs)
        attrs = {"long_name": f"increment of the largest {name}, from 1"}
        when = kept["increment"].astype(int).reshape(shape)
        result[f"{name}_increment"] = (dims, when, attrs)
        for key in ("amplitude", "mean"):
            values = np.array(kept[key]).reshape(-1, *shape)
            attrs = {"units": "Pa", "long_name": f"{key} over a cycle: {meaning}"}
            result[f"{name}_{key}"] = (("cycle", *dims), values, attrs)
        if len(along) == 1:
            result = result.merge(_largest(name, kept["largest"], along[0]))
    result.attrs |= {"length": length, "interfaces": interfaces(body)}
    if hertz is not None:
        result.attrs |= {"a_H": hertz.a, "p_H": hertz.p0}
    if stream.cycles:
        first, last = np.array(stream.cycles).T
        result = result.assign_coords(first_branch=("cycle", first), last_branch=("cycle", last))
    return result


def _largest(name: str, rows: NDArray[np.float64], along: str) -> xr.Dataset:
    """Give the largest value of a measure on a section at every increment, and its place."""
    increment, value, x, z, layer, error = rows.T
    meaning = f"largest {name} on the section"
    columns = {
        name + "_largest": (value, "Pa", meaning),
        f"{name}_largest_{along}": (x, "m", f"{along} of the {meaning}"),
        name + "_largest_z": (z, "m", f"depth of the {meaning}"),
        name + "_largest_layer": (layer.astype(int), "1", f"layer of the {meaning}"),
        name + "_largest_error": (error, "Pa", f"error of the samples of the {meaning}"),
    }
    return xr.Dataset(
        {
            key: ("increment", values, {"units": units, "long_name": text})
            for key, (values, units, text) in columns.items()
        },
        coords={"increment": increment.astype(int)},
    )
