"""The usual contacts, each in one call: ``Scene.ball_on_flat(...)`` and its like."""

from __future__ import annotations

import math
import os
import warnings
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from pyfret._core import (
    CELLS_PER_FILM,
    Body,
    Cylinder,
    Elastic,
    Flat,
    FlatPunch,
    Grid,
    LoadPath,
    Rough,
    Scene,
    Sphere,
    Sum,
    SurfaceMap,
)
from pyfret._util.numbers import length
from pyfret._util.parameters import opposite
from pyfret.grids import for_contact
from pyfret.material_table import material
from pyfret.quantities import (
    Angle,
    BulkStress,
    FrictionCoefficient,
    Length,
    Quantity,
    Radius,
    as_number,
    quantities,
)
from pyfret.scene.surfaces import read_surface

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = [
    "ball_on_flat",
    "crossed_cylinders",
    "cylinder_on_flat",
    "flat_pad",
    "offer",
    "rough_on_flat",
]

#: A body without a shape, its material, or the name of its material.
Part: TypeAlias = "Body | Elastic | str"
#: Most cells along a side of the grid that a film asks for, and of a strip.
MOST_FOR_FILM, MOST_OF_STRIP = 512, 4096


@quantities
def ball_on_flat(
    ball: Part,
    flat: Part,
    *,
    R: Radius,
    W: Quantity,
    mu: FrictionCoefficient,
    T: Quantity | None = None,
    shift: Length | None = None,
    sigma_B: BulkStress | None = None,
    cycles: int = 2,
    wear: Mapping[str, Any] | None = None,
    error: float = 0.02,
    n: int | None = None,
    grid: Grid | None = None,
    quiet: bool = False,
) -> Scene:
    """Make the scene of a ball on a flat: bodies, path and a grid that fits them.

    Parameters
    ----------
    ball, flat : Body, Elastic or str
        The bodies: the name of a material of the table, a material, or a body with coatings.
    R : float
        Radius of the ball [m].
    W : float
        Normal force [N].
    mu : float
        Friction coefficient.
    T, shift : float, optional
        Amplitude of the tangential force [N], or of the shift of the bodies [m], along x
        (default: the ball is pressed alone).
    sigma_B : float, optional
        Amplitude of the bulk stress of the lower body along x [Pa], in phase with the
        force or the shift (default: none).
    cycles : int
        Cycles of the force or of the shift (default 2).
    wear : dict, optional
        What wears, as keywords of :func:`pyfret.wear.solve`: the grid holds the scar of all
        cycles.
    error : float
        Error that is wanted of the pressure (default 2 %).
    n : int, optional
        Cells along the shorter side, in place of those that `error` and a film take.
    grid : Grid, optional
        Grid in place of the one that is chosen.
    quiet : bool
        Whether the line about the grid is not printed (default False).

    Returns
    -------
    Scene
        For ``fret.solve(scene)``. An outermost coating has two cells in its thickness where
        that takes at most 512 cells along a side, 4096 of a line contact. The printed line has
        the cells of the grid, what they resolve and what they do not.

    Examples
    --------
    >>> scene = Scene.ball_on_flat(
    ...     "100Cr6", "Ti6Al4V", R=5e-3, W=10.0, mu=0.6, T=3.0
    ... )  # doctest: +SKIP
    >>> fret.solve(scene).summary()  # doctest: +SKIP
    """
    bodies = shaped(ball, Sphere(R=as_number(R)), "ball"), shaped(flat, Flat(), "flat")
    path = path_of(W, T, shift, sigma_B, cycles, "N")
    return fitted(bodies, path, mu, wear=wear, error=error, n=n, grid=grid, quiet=quiet)


@quantities
def cylinder_on_flat(
    cylinder: Part,
    flat: Part,
    *,
    R: Radius,
    W: Quantity,
    mu: FrictionCoefficient,
    T: Quantity | None = None,
    shift: Length | None = None,
    sigma_B: BulkStress | None = None,
    cycles: int = 2,
    wear: Mapping[str, Any] | None = None,
    error: float = 0.02,
    n: int | None = None,
    grid: Grid | None = None,
    quiet: bool = False,
) -> Scene:
    """Make the scene of a long cylinder on a flat, a line contact in plane strain.

    The axis of the cylinder is y. Forces are per metre of its length [N/m]: `W` and `T`.
    For the other parameters see :func:`ball_on_flat`.
    """
    bodies = shaped(cylinder, Cylinder(as_number(R)), "cylinder"), shaped(flat, Flat(), "flat")
    path = path_of(W, T, shift, sigma_B, cycles, "N/m")
    return fitted(bodies, path, mu, plane=True, wear=wear, error=error, n=n, grid=grid, quiet=quiet)


@quantities
def crossed_cylinders(
    first: Part,
    second: Part,
    *,
    R: Radius,
    R2: Radius | None = None,
    angle: Angle = math.pi / 2,
    W: Quantity,
    mu: FrictionCoefficient,
    T: Quantity | None = None,
    shift: Length | None = None,
    sigma_B: BulkStress | None = None,
    cycles: int = 2,
    wear: Mapping[str, Any] | None = None,
    error: float = 0.02,
    n: int | None = None,
    grid: Grid | None = None,
    quiet: bool = False,
) -> Scene:
    """Make the scene of two crossed cylinders, as of wires and of many rigs.

    Parameters
    ----------
    first, second : Body, Elastic or str
        The upper cylinder, whose axis is y, and the lower one.
    R, R2 : float
        Their radii [m] (default of the second: the first radius).
    angle : float
        Angle between the axes [rad], such as ``"90 deg"`` (default: a right angle).
    W, mu, T, shift, sigma_B, cycles, wear, error, n, grid, quiet
        As in :func:`ball_on_flat`.
    """
    radius = as_number(R)
    second_radius = radius if R2 is None else as_number(R2)
    bodies = (
        shaped(first, Cylinder(radius), "first"),
        shaped(second, Cylinder(second_radius, angle=as_number(angle)), "second"),
    )
    path = path_of(W, T, shift, sigma_B, cycles, "N")
    return fitted(bodies, path, mu, wear=wear, error=error, n=n, grid=grid, quiet=quiet)


@quantities
def flat_pad(
    pad: Part,
    flat: Part,
    *,
    width: Length,
    edge: Radius,
    W: Quantity,
    mu: FrictionCoefficient,
    T: Quantity | None = None,
    shift: Length | None = None,
    sigma_B: BulkStress | None = None,
    cycles: int = 2,
    wear: Mapping[str, Any] | None = None,
    error: float = 0.02,
    n: int | None = None,
    grid: Grid | None = None,
    quiet: bool = False,
) -> Scene:
    """Make the scene of a flat pad with rounded edges on a flat: a line contact.

    Parameters
    ----------
    pad, flat : Body, Elastic or str
        As in :func:`ball_on_flat`.
    width : float
        Width of the flat of the pad [m], without its rounded edges.
    edge : float
        Radius of the edges [m].
    W, T : float
        Forces per metre [N/m].
    mu, shift, sigma_B, cycles, wear, error, n, grid, quiet
        As in :func:`ball_on_flat`.
    """
    shape = FlatPunch(radius=0.5 * as_number(width), edge=as_number(edge))
    bodies = shaped(pad, shape, "pad"), shaped(flat, Flat(), "flat")
    path = path_of(W, T, shift, sigma_B, cycles, "N/m")
    return fitted(bodies, path, mu, plane=True, wear=wear, error=error, n=n, grid=grid, quiet=quiet)


@quantities
def rough_on_flat(
    rough: Part,
    flat: Part,
    *,
    surface: SurfaceMap | Rough | str | os.PathLike[str],
    R: Radius,
    W: Quantity,
    mu: FrictionCoefficient,
    T: Quantity | None = None,
    shift: Length | None = None,
    sigma_B: BulkStress | None = None,
    cycles: int = 2,
    wear: Mapping[str, Any] | None = None,
    error: float = 0.05,
    n: int | None = None,
    grid: Grid | None = None,
    quiet: bool = False,
) -> Scene:
    """Make the scene of a rough ball on a flat.

    Parameters
    ----------
    rough, flat : Body, Elastic or str
        The ball with the rough surface, and the flat.
    surface : SurfaceMap, Rough or path
        Measured heights, a random surface, or the file of an instrument.
    R : float
        Radius of the ball [m]: flats would touch over the whole grid.
    W, mu, T, shift, sigma_B, cycles, wear, error, n, grid, quiet
        As in :func:`ball_on_flat`; `error` is 5 % by default.
    """
    if isinstance(surface, SurfaceMap | Rough):
        heights: Any = surface
    elif isinstance(surface, str | os.PathLike):
        heights = read_surface(surface)
    else:
        raise TypeError(f"surface = {surface!r:.60}: must be a SurfaceMap, a Rough or a path")
    shape = Sum([Sphere(R=as_number(R)), heights])
    bodies = shaped(rough, shape, "rough"), shaped(flat, Flat(), "flat")
    path = path_of(W, T, shift, sigma_B, cycles, "N")
    return fitted(bodies, path, mu, wear=wear, error=error, n=n, grid=grid, quiet=quiet)


def shaped(part: Any, shape: Any, name: str) -> Body:
    """Return a body with a shape from a material (or its name) or a body without a shape.

    Raises
    ------
    TypeError
        It is neither a body, nor a material, nor the name of one.
    ValueError
        It is a body that has a shape already.
    """
    if isinstance(part, str):
        part = material(part)
    if isinstance(part, Elastic):
        return Body(part, shape=shape)
    if not isinstance(part, Body):
        allowed = "a Body, an Elastic or the name of a material, such as 'steel'"
        raise TypeError(f"{name} = {part!r:.60}: must be {allowed}")
    if part.shape != Flat():
        raise ValueError(
            f"{name}: has a shape already, {part.shape!r}; give a body without one. A rough flat: "
            "Scene.rough_on_flat(..., surface=...), or a Scene whose body has Sphere(...) + surface"
        )
    return part.replace(shape=shape)


def path_of(W: Any, T: Any, shift: Any, sigma_B: Any, cycles: int, unit: str) -> LoadPath:
    """Build the load path: pressed to W, then cycles of a force or a shift, and of a bulk stress.

    Raises
    ------
    ValueError
        Both a force and a shift are given, or a number has no meaning.
    """
    if T is not None and shift is not None:
        raise ValueError(f"T and shift: give one of them, a force [{unit}] or a motion [m]")
    if cycles < 1:
        raise ValueError(f"cycles = {cycles}: must be 1 or more")
    pressed = LoadPath.start().normal(W)
    if sigma_B is None:
        if T is not None:
            return pressed.cycles(cycles, T_x=T)
        return pressed if shift is None else pressed.cycles(cycles, delta_x=shift)
    signs = [1.0, *[-1.0, 1.0] * cycles]
    stresses = [sign * as_number(sigma_B) for sign in signs]
    if shift is not None:
        shifts = [sign * as_number(shift) for sign in signs]
        return pressed.waypoints(increments="auto", delta_x=shifts, sigma_B=stresses)
    for sign, stress in zip(signs, stresses, strict=True):
        force = {} if T is None else {"T_x": T if sign > 0.0 else opposite(T)}
        pressed = pressed.force(sigma_B=stress, **force)
    return pressed


def fitted(
    bodies: tuple[Body, Body],
    path: LoadPath,
    mu: float,
    *,
    wear: Mapping[str, Any] | None,
    error: float,
    n: int | None,
    grid: Grid | None,
    quiet: bool,
    plane: bool = False,
) -> Scene:
    """Build the scene on a grid for its contact, its scar and its films, and print the grid."""
    film = min((b.coatings[0].thickness for b in bodies if b.coatings), default=math.inf)
    if grid is not None and n is not None:
        raise ValueError("n and grid: give one of them")
    if grid is None:
        with warnings.catch_warnings():
            # The printed line has what is not resolved.
            warnings.simplefilter("ignore")
            grid = for_contact(
                *bodies,
                path,
                error=error,
                plane_strain=plane,
                wear=wear,
                mu=mu if wear is not None else None,
                n=n,
            )
        if n is None:
            grid = with_cells_of(grid, film / CELLS_PER_FILM)
    scene = Scene(body1=bodies[0], body2=bodies[1], friction=mu, grid=grid, path=path)
    if not quiet:
        print(grid_in_words(scene, film))
    return scene


def with_cells_of(grid: Grid, cell: float) -> Grid:
    """Refine a grid to cells of at most a size [m], up to the number that is allowed."""
    if min(grid.dx, grid.dy) <= cell or (grid.plane_strain and grid.dx <= cell):
        return grid
    sides = grid.nx * grid.dx, grid.ny * grid.dy
    along = math.ceil(sides[0] / cell)
    if grid.plane_strain:
        return grid if along > MOST_OF_STRIP else Grid.strip(extent=sides[0], n=along)
    across = math.ceil(sides[1] / cell)
    if max(along, across) > MOST_FOR_FILM:
        return grid
    return Grid.from_spacing((along, across), (sides[0] / along, sides[1] / across))


def grid_in_words(scene: Scene, film: float) -> str:
    """Describe a grid: its cells, its side, the contact, a film that is not resolved."""
    grid, hertz = scene.grid, scene.hertz
    cells = f"{grid.nx}" if grid.plane_strain else f"{grid.nx} x {grid.ny}"
    text = f"grid: {cells} cells of {length(grid.dx)}, {length(grid.nx * grid.dx)} long"
    if hertz is not None:
        count = hertz.a / grid.dx
        text += f"; uncoated contact: radius {length(hertz.a)}, {count:.0f} cells"
    cell = grid.dx if grid.plane_strain else min(grid.dx, grid.dy)
    if np.isfinite(film):
        share = film / cell
        text += f"; film: {length(film)}, {share:.2g} cells"
        if share < CELLS_PER_FILM:
            need = math.ceil(CELLS_PER_FILM * grid.nx * grid.dx / film)
            text += f" (its stresses are averages over a cell; n={need} resolves it)"
    return text.replace("µ", "u")


def offer() -> None:
    """Let the scene have them: ``Scene.ball_on_flat(...)``."""
    for make in (ball_on_flat, cylinder_on_flat, crossed_cylinders, flat_pad, rough_on_flat):
        setattr(Scene, make.__name__, staticmethod(make))
