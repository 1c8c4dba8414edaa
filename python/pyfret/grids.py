"""A grid for a contact: as long as the contact that comes out, as fine as the wanted error."""

from __future__ import annotations

import math
import re
import warnings
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from pyfret import _core
from pyfret._core import (
    CELLS_PER_FILM,
    Cylinder,
    Ellipsoid,
    Flat,
    Grid,
    InvalidSceneError,
    LoadPath,
    OffGridError,
    Rough,
    Scene,
    Sphere,
    Sum,
    SurfaceMap,
)
from pyfret._util.numbers import length
from pyfret._util.scene_warnings import warn
from pyfret.quantities import FrictionCoefficient, Length, as_number, quantities
from pyfret.solution import solve
from pyfret.wear.runs import solve as wear_off

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from pyfret._core import Body, Friction
    from pyfret.result import Result

__all__ = ["for_contact", "offer"]

#: Cells along a side of the grid that the size of the contact is found on.
COARSE = 32
#: How much longer roughness makes a contact.
ROUGH = 1.15
#: How often the extent is tried anew: from a kilometre to a nanometre by fours.
TRIES = 24
#: Cells across the contact times the error of its pressure (L2), from docs/validation/hertz.md.
CELLS_TIMES_ERROR = 0.31
#: Cells in the shortest wave of a rough or a wavy surface.
IN_A_WAVE = 8
#: Cells across the contact before it wears, on the grid and on the trial grid, and most cells
#: along a side of that one: a scar thirty times as long as the contact is none of this rig.
IN_A_FIRST, IN_A_TRIAL, MOST_OF_TRIAL = 16, 8, 256
#: Cells along the length of a contact that is too long for square cells.
IN_A_LENGTH = 128
#: How much longer the grid of a trial gets that the scar leaves, and the tolerance of its jumps.
LONGER, ROUGHLY = 1.5, 0.05
#: Part of the mean square slope of a measured map in waves that are not resolved.
UNSEEN = 0.01
#: Most cells of a grid on which it is tried whether numbers still change.
MOST_TRIED = 512 * 512
#: How much longer a grid gets that the contact reaches, and how often.
WIDER, WIDER_TIMES = 1.2, 4
#: Fewest and most cells along a side.
FEWEST, MOST = 24, 4096
#: What an error may be asked of, and the numbers in which two grids agree then.
Number: TypeAlias = Literal["p", "p_max", "s_xx", "loop"]
NUMBERS: dict[Number, str] = {
    "p": "area or largest pressure",
    "p_max": "area or largest pressure",
    "s_xx": "the largest tension along x",
    "loop": "the energy or a range of the loop",
}


@quantities
def for_contact(
    body1: Body,
    body2: Body,
    path: LoadPath,
    *,
    error: float = 0.005,
    room: float = 1.2,
    start: Length | None = None,
    plane_strain: bool = False,
    wear: Mapping[str, Any] | None = None,
    mu: FrictionCoefficient | Friction | None = None,
    of: Literal["p", "p_max", "s_xx", "loop"] = "p",
    n: int | None = None,
) -> Grid:
    """Choose a grid for the contact that comes out of two bodies and a load path.

    The contact under the largest normal load of the path is solved without friction and
    roughness on 32 cells a side. The grid is `room` times as long, on rough surfaces 15 %
    longer. It has as many cells as a smooth contact takes for `error`. The cells are square;
    along a contact that would take more than 4096 of them they are oblong, 128 at least. It
    has eight cells in the shortest wave of a rough, wavy or measured surface. On measured
    surfaces, on waves and where a body has edges, the number of cells is doubled. The last
    changes of area and
    largest pressure foretell the next ones: the doubling ends where these are below
    `error`.

    Parameters
    ----------
    body1, body2 : Body
        The upper and the lower body.
    path : LoadPath
        The loads.
    error : float
        Error that is wanted of the number that `of` names. Of the pressure it is the root mean
        square over the error of the pressure; radius and approach have a tenth of it.
    room : float
        Side of the grid over the length of the contact: 1.2 (default), 2 or more where wear or
        rolling makes the contact longer.
    start : float, optional
        Side to begin with [m] (default: from the Hertz contact, else a millimetre).
    plane_strain : bool
        Whether it is a line contact: a strip one metre wide.
    wear : dict, optional
        What wears, as keywords of :func:`pyfret.wear.solve`: cycles and laws at least. The
        run is done on few cells, and the grid holds the scar at its end, strokes included.
        `error` then belongs to the contact at the end, and the first contact has eight cells
        in its radius.
    mu : float or Friction, optional
        Coefficient of friction, which decides where wear slips: to be given with `wear`, and
        with ``of="s_xx"`` or ``of="loop"``.
    of : "p", "p_max", "s_xx" or "loop"
        What `error` is of. ``"p"``: the pressure as a field. The others are solved on grids
        of twice as many cells each until they agree to `error`. ``"p_max"``: the largest
        pressure and the area. ``"s_xx"``: the largest tension along x in the lower body at
        the end of the path. ``"loop"``: the dissipated energy and the ranges of forces and
        shifts.
    n : int, optional
        Cells along the shorter side, in place of those that `error` takes; they are square.

    Raises
    ------
    ValueError
        Nothing is pressed together, no size was found that fits, as of two flats, or `wear`,
        ``"s_xx"`` or ``"loop"`` comes without `mu`.

    Warns
    -----
    SceneWarning
        The numbers still change by more than `error` on 512 x 512 cells, or an outermost
        coating is thinner than a cell.

    Examples
    --------
    >>> steel = Elastic(E=210e9, nu=0.3)  # doctest: +SKIP
    >>> ball, flat = Body(steel, shape=Sphere(R=5e-3)), Body(steel)  # doctest: +SKIP
    >>> path = LoadPath.start().normal(10.0).cycles(1, T_x=1.0)  # doctest: +SKIP
    >>> grid = Grid.for_contact(ball, flat, path)  # doctest: +SKIP
    >>> law = Archard(k=1e-15)  # doctest: +SKIP
    >>> wear = {"cycles": 1e5, "body2": law}  # doctest: +SKIP
    >>> worn = Grid.for_contact(ball, flat, path, wear=wear, mu=0.3)  # doctest: +SKIP
    """
    if not 0.0 < error < 1.0:
        raise ValueError(f"error = {error}: must be a part of the pressure, such as 0.005")
    if not room >= 1.1:
        raise ValueError(f"room = {room}: must be 1.1 or more, or the contact reaches its border")
    if of not in NUMBERS:
        raise ValueError(f"of = {of!r}: must be one of {', '.join(NUMBERS)}")
    if of in ("s_xx", "loop") and mu is None:
        raise ValueError(f"mu: must be given with of = {of!r}, which depends on it")
    if n is not None and not 2 <= n <= MOST:
        raise ValueError(f"n = {n}: must be 2 to {MOST} cells along the shorter side")
    pressed = _pressed(path)
    smooth1, smooth2 = (body.replace(shape=_smooth(body.shape)) for body in (body1, body2))
    limits = _size_of_maps(body1, body2)
    lengths = _lengths(
        smooth1, smooth2, pressed, as_number(start), limits, plane_strain=plane_strain
    )
    rough = smooth1 != body1 or smooth2 != body2
    first = min(lengths)
    if wear is not None:
        if mu is None:
            raise ValueError("mu: must be given with wear, since only what slips wears")
        scene = Scene(body1=smooth1, body2=smooth2, friction=mu, grid=_square(first), path=path)
        lengths = _scar(scene, lengths, dict(wear), plane_strain=plane_strain)
    longer = (ROUGH if rough else 1.0) * room
    sides = [min(longer * span, side) for span, side in zip(lengths, limits, strict=True)]
    cells = CELLS_TIMES_ERROR / error * room
    wave = min((_shortest(body.shape) for body in (body1, body2)), default=math.inf)
    shortest = min(sides)
    if n is not None:
        return _grid_of_sides(body1, body2, sides, n, plane_strain=plane_strain)
    # Square cells, as many as the shorter side of the contact takes.
    size = min(shortest / max(cells, FEWEST), wave / IN_A_WAVE)
    if wear is not None:
        size = min(size, first / IN_A_FIRST)
    along = [2 * math.ceil(side / size / 2) for side in sides]
    if max(along) > MOST and math.isinf(wave) and not plane_strain:
        # A long contact changes along its length at its ends alone: oblong cells.
        along = [min(count, max(IN_A_LENGTH, 2 * math.ceil(cells / 2))) for count in along]
    plain = _is_plain(body1.shape) and _is_plain(body2.shape)
    if wear is None and max(along) <= MOST and not (plain and of == "p"):
        if of != "p":
            along = [max(FEWEST, 2 * math.ceil(cells / 4)) for cells in along]
        whole = of in ("s_xx", "loop")
        scene = Scene(
            body1=body1,
            body2=body2,
            friction=mu if whole and mu is not None else 0.0,
            grid=_square(sides[0], plane_strain=plane_strain),
            path=path if whole else pressed,
        )
        sides, along = _refined(scene, sides, along, error, of)
    _doubt_films(body1, body2, [side / n_cells for side, n_cells in zip(sides, along, strict=True)])
    if max(along) > MOST:
        raise ValueError(
            f"{max(along)} cells along a side: the contact is {max(lengths):.3g} m long. A larger "
            f"error than {error:g}, or roughness of longer waves, takes fewer. Grid.from_spacing "
            "takes cells that are longer along one axis"
        )
    if plane_strain:
        return Grid.strip(extent=sides[0], n=along[0])
    return Grid.from_spacing((along[0], along[1]), (sides[0] / along[0], sides[1] / along[1]))


def _grid_of_sides(
    body1: Body, body2: Body, sides: list[float], n: int, *, plane_strain: bool
) -> Grid:
    """Build a grid of square cells on sides [m], `n` of them along the shorter one."""
    size = min(sides) / n
    _doubt_films(body1, body2, [size])
    if plane_strain:
        return Grid.strip(extent=sides[0], n=n)
    along = [max(n, math.ceil(side / size * (1.0 - 1e-9))) for side in sides]
    if max(along) > MOST:
        raise ValueError(f"n = {n}: makes {max(along)} cells along the longer side: at most {MOST}")
    return Grid.from_spacing((along[0], along[1]), (size, size))


def _pressed(path: LoadPath) -> LoadPath:
    """Return a path to the largest normal load or approach of another path.

    Where moments tilt the bodies, it goes on to each branch with one, since the contact moves.
    """
    tilted = [b for b in path.branches if b.W and (b.M_x or b.M_y)]
    if tilted:
        normal_path = LoadPath.start().normal(max(b.W for b in path.branches if b.W), increments=1)
        for b in tilted:
            normal_path = normal_path.force(W=b.W, M_x=b.M_x or 0.0, M_y=b.M_y or 0.0, increments=1)
        return normal_path
    loads = [b.W for b in path.branches if b.W]
    shifts = [b.delta_z for b in path.branches if b.delta_z]
    if loads:
        return LoadPath.start().normal(max(loads), increments=1)
    if shifts:
        return LoadPath.start().displace(delta_z=max(shifts), increments=1)
    raise ValueError("the path presses nothing: it must give W or delta_z")


def _scene(
    body1: Body, body2: Body, path: LoadPath, sides: tuple[float, float], *, plane_strain: bool
) -> Scene:
    """Build the scene without friction on a coarse grid."""
    if plane_strain:
        grid = _square(sides[0], plane_strain=True)
    else:
        grid = Grid.from_spacing((COARSE, COARSE), (sides[0] / COARSE, sides[1] / COARSE))
    return Scene(body1=body1, body2=body2, friction=0.0, grid=grid, path=path)


def _size_of_maps(*bodies: Body) -> tuple[float, float]:
    """Sides of the smallest measured map of bodies along x and y [m]; infinite without one."""
    sides = [math.inf, math.inf]
    for part in (part for body in bodies for part in _parts(body.shape)):
        if isinstance(part, SurfaceMap):
            spacing = part.spacing if isinstance(part.spacing, tuple) else (part.spacing,) * 2
            for k, (count, step) in enumerate(zip(part.values.shape, spacing, strict=True)):
                if count > 1:
                    sides[k] = min(sides[k], count * step)
    return sides[0], sides[1]


def _map_too_small(scene: Scene) -> ValueError:
    """Return the refusal of a contact that is longer than the map of its surface."""
    grid, W = scene.grid, scene.path.W[-1]
    size = f"{length(grid.nx * grid.dx)} x {length(grid.ny * grid.dy)}"
    text = f"the map of heights is {size}, and the contact reaches its border"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            solve(scene, progress=False)
    except OffGridError as error:
        needed = max(map(float, re.findall(r"([\d.e+-]+) m\b", str(error).rpartition("about")[2])))
        text += f": it must be about {length(needed)} long"
        if W > 0.0:
            # Hertz: the size of a contact grows with W^(1/3), of a line contact with W^(1/2).
            power = 2 if grid.plane_strain else 3
            least = W * (min(grid.nx * grid.dx, grid.ny * grid.dy) / needed) ** power
            text += f", or W about {_core.rough(least)} {grid.unit_of('N')} in place of {W:g}"
    return ValueError(f"{text}. Give a larger map, a smaller load or a smaller radius")


def _lengths(
    body1: Body,
    body2: Body,
    path: LoadPath,
    start: float | None,
    limits: tuple[float, float],
    *,
    plane_strain: bool,
) -> tuple[float, float]:
    """Lengths of the box around the contact along x and y [m], centred on the grid.

    Each side of the grid is looked for by itself, since a roller is much longer than its contact is
    wide. A side grows while the contact reaches the border, up to the side of a map of heights. It
    gets shorter while the contact fills few of its cells.
    """
    guess = _scene(body1, body2, path, (1e-3, 1e-3), plane_strain=plane_strain)
    hertz = guess.hertz
    first = start or (2.4 * hertz.a if hertz is not None else 1e-3)
    first = min(first, *limits)
    axes = [0] if plane_strain else [0, 1]
    # Sides that were too short, and the last ones that the contact fitted.
    extent, too_short, fits = [first, first], [0.0, 0.0], [math.inf, math.inf]
    for _ in range(TRIES * len(axes)):
        scene = _scene(body1, body2, path, (extent[0], extent[1]), plane_strain=plane_strain)
        before = list(extent)
        box = _box(scene)
        if box is None:
            # The sides that became shorter since it fitted are too short; else any.
            shorter = [k for k in axes if extent[k] < fits[k] < math.inf]
            for k in shorter or axes:
                if shorter or len(axes) == 1:
                    too_short[k] = extent[k]
                extent[k] = math.sqrt(extent[k] * fits[k]) if shorter else 2 * extent[k]
        else:
            fits = list(extent)
            if max(box) <= 0.0:
                # Too few cells in it: one side shorter, which has not been found to be long.
                free = [k for k in axes if too_short[k] == 0.0] or axes
                k = max(free, key=lambda k: extent[k])
                extent[k] = max(extent[k] / 4, math.sqrt(extent[k] * too_short[k]))
                box = None
            elif all(0.4 * extent[k] <= box[k] <= 0.97 * extent[k] for k in axes):
                return box
            else:
                for k in axes:
                    if box[k] > 0.97 * extent[k]:
                        too_short[k], extent[k] = extent[k], 2 * extent[k]
                    elif box[k] < 0.4 * extent[k]:
                        wanted_extent = 1.5 * box[k]
                        above = wanted_extent > too_short[k]
                        extent[k] = wanted_extent if above else math.sqrt(extent[k] * too_short[k])
        extent = [min(side, limit) for side, limit in zip(extent, limits, strict=True)]
        reaches_border = box is None or any(box[k] > 0.97 * before[k] for k in axes)
        if extent == before and reaches_border and any(map(math.isfinite, limits)):
            raise _map_too_small(scene)
        if all(too_short[k] > 0.0 and fits[k] < 1.05 * too_short[k] for k in axes):
            return box or (extent[0], extent[1])
    raise ValueError(
        "found no grid that the contact fits: flat surfaces touch all over; give start= of about "
        "its length, or make the grid yourself"
    )


def _box(scene: Scene) -> tuple[float, float] | None:
    """Return twice the reach of the contact from the middle; None if it reaches the border [m]."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            fields, _ = _core.solve_in_memory(scene.replace(save="branches"))
    except OffGridError:
        return None
    except InvalidSceneError as error:
        if "wide" in str(error) or "border" in str(error):
            return None
        if "cells across" in str(error):
            return 0.0, 0.0
        raise
    p, x, y = (np.asarray(fields[name][1]) for name in ("p", "x", "y"))
    contact: NDArray[np.bool_] = np.any(p > 0, axis=0)
    if not contact.any():
        return 0.0, 0.0
    return _reach(contact, (x, y), scene.grid)


def _reach(
    touched: NDArray[np.bool_],
    places_of_cells: tuple[NDArray[np.float64], NDArray[np.float64]],
    grid: Grid,
) -> tuple[float, float]:
    """Return twice the reach of touched cells from the middle of a grid, along x and y [m]."""
    reach = []
    for along, axis, cell in zip(places_of_cells, (1, 0), (grid.dx, grid.dy), strict=True):
        places = np.abs(along[touched.any(axis=axis)])
        reach.append(2 * float(places.max()) + cell)
    return reach[0], reach[0] if grid.plane_strain else reach[1]


def _square(extent: float, least: float = 0.0, *, plane_strain: bool = False) -> Grid:
    """Build the grid of a trial, with `least` or more cells along a side."""
    if plane_strain:
        return Grid.strip(extent=extent, n=max(4 * COARSE, math.ceil(least)))
    return Grid.centred(width=extent, n=max(COARSE, math.ceil(least)))


def _scar(
    scene: Scene, first: tuple[float, float], wear: dict[str, Any], *, plane_strain: bool
) -> tuple[float, float]:
    """Return the lengths of the box around contact and scar, by a run of wear on few cells [m]."""
    fixed = {"tolerance", "jumps", "explicit_jumps"} & wear.keys()
    how = wear if fixed else {**wear, "tolerance": ROUGHLY}
    laws = [wear.get(name) for name in ("body1", "body2")]
    if any(isinstance(law, (list, tuple)) and None not in law for law in laws):
        # Every layer has its law: the scar belongs to all cycles.
        how = {"worn_through": "go_on", **how}
    extent = 2.0 * max(first)
    for _ in range(TRIES):
        cells = IN_A_TRIAL * extent / min(first)
        if cells > MOST_OF_TRIAL:
            break
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                grid = _square(extent, cells, plane_strain=plane_strain)
                worn = wear_off(scene.replace(grid=grid), **how, progress=False)
        except OffGridError:
            extent *= LONGER
            continue
        d = worn.dataset
        touched = ((d.p > 0) | (d.worn1 > 0) | (d.worn2 > 0)).any("block").values
        reach = _reach(touched, (d.x.values, d.y.values), grid)
        return reach if max(reach) < extent else (extent, extent)
    raise ValueError(
        f"the scar is longer than {extent / LONGER:.3g} m, {MOST_OF_TRIAL // IN_A_TRIAL} times the "
        "contact before it. k is in m^2/N, alpha in m^3/J. If it is so long, give the grid yourself"
    )


def _smooth(shape: Any) -> Any:
    """Return a surface without its roughness."""
    if not isinstance(shape, Sum):
        return shape
    kept = [part for part in shape.parts if not isinstance(part, Rough)]
    return Sum(kept) if len(kept) > 1 else kept[0] if kept else shape


def _parts(shape: object) -> list[Any]:
    """The surfaces that add up to one."""
    return list(getattr(shape, "parts", None) or [shape])


def _shortest(shape: object) -> float:
    """The shortest wave of a surface [m]; infinite for a smooth one."""
    return min(map(_wave, _parts(shape)))


def _wave(part: Any) -> float:
    """Return the shortest wave of a part of a surface [m]; infinite if it has none."""
    if isinstance(part, SurfaceMap):
        return _wave_of_map(part)
    return float(getattr(part, "shortest", None) or getattr(part, "wavelength", None) or math.inf)


def _wave_of_map(part: SurfaceMap) -> float:
    """Return the wavelength [m] above which a measured map holds nearly all of its slope.

    The map is tapered by Hann's window; its spectrum of slopes is summed up from the longest wave
    on. No wave is shorter than two points.
    """
    heights = np.asarray(part.values, dtype=float)
    spacing = part.spacing if isinstance(part.spacing, tuple) else (part.spacing, part.spacing)
    heights = heights - heights.mean()
    for axis, count in enumerate(heights.shape):
        if count > 2:
            shape = [1, 1]
            shape[axis] = count
            heights = heights * np.hanning(count).reshape(shape)
    k = [np.fft.fftfreq(count, d) for count, d in zip(heights.shape, spacing, strict=True)]
    wave_number = np.hypot(*np.meshgrid(*k, indexing="ij")).ravel()
    slope = (np.abs(np.fft.fft2(heights)).ravel() * wave_number) ** 2
    if not slope.any():
        return math.inf
    order = np.argsort(wave_number)
    summed = np.cumsum(slope[order])
    last = wave_number[order][int(np.searchsorted(summed, (1.0 - UNSEEN) * summed[-1]))]
    return max(1.0 / float(last), 2.0 * min(spacing))


def _is_plain(shape: object) -> bool:
    """Return whether a surface has neither edges nor measured heights."""
    return all(
        isinstance(part, (Flat, Sphere, Ellipsoid, Rough))
        or (isinstance(part, Cylinder) and math.isinf(part.length))
        for part in _parts(shape)
    )


def _numbers(result: Result, of: Number) -> NDArray[np.float64]:
    """Return the numbers of a run in which two grids have to agree."""
    if of == "loop":
        d = result.dataset
        ranges = [float(np.ptp(d[name].values)) for name in ("T_x", "T_y", "delta_x", "delta_y")]
        sizes = np.array([float(d.dissipated.sum()), *ranges])
        return sizes[sizes > 1e-6 * np.abs(sizes).max()] if sizes.any() else np.ones(1)
    at = result.at(-1)
    if of == "s_xx":
        return np.array([at.stress().maximum("s_xx").value])
    return np.array([float(at.contact_area), float(at.p_max)])


def _refined(
    scene: Scene, sides: list[float], n: list[int], error: float, of: Number
) -> tuple[list[float], list[int]]:
    """Sides and cells along them, doubled until the numbers asked for agree to `error`.

    The change c to twice as many cells goes on as a geometric series. Its ratio r is taken from the
    last two changes: c r/(1 - r) remains. Of the first change r is unknown, and half of `error` is
    allowed. Sides that the contact reaches grow. Where no grid of at most MOST_TRIED cells agrees,
    the finest one is given, with a warning.
    """
    flat = scene.grid.plane_strain
    axes = 1 if flat else 2
    max_cells = MOST if flat else MOST_TRIED

    def numbers(cells: list[int]) -> NDArray[np.float64]:
        """Solve on a grid of these cells and return the numbers to compare."""
        if flat:
            grid = Grid.strip(extent=sides[0], n=cells[0])
        else:
            grid = Grid.from_spacing(
                (cells[0], cells[1]), (sides[0] / cells[0], sides[1] / cells[1])
            )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return _numbers(solve(scene.replace(grid=grid), progress=False), of)

    def too_many(cells: list[int]) -> bool:
        """Return whether a grid has more cells than the limit."""
        return max(cells) > MOST or math.prod(cells[:axes]) > max_cells

    if too_many([2 * cells for cells in n]):
        # No finer grid is tried: a coarser one gives the error of the cells.
        n = [max(FEWEST // 2, 2 * math.ceil(cells / 4)) for cells in n]
    before, change, last, grown = None, math.inf, math.inf, 0
    while True:
        try:
            now = numbers(n)
        except OffGridError:
            # Ends and edges are wider than the coarse grid shows.
            if grown == WIDER_TIMES:
                raise
            grown += 1
            sides = [WIDER * side for side in sides]
            n = [min(2 * math.ceil(WIDER * cells / 2), MOST) for cells in n]
            before, change = None, math.inf
            continue
        except InvalidSceneError as refused:
            if "cells" not in str(refused):
                raise
            now = None
        if now is not None and before is not None and now.shape == before.shape:
            last, change = change, float(np.abs(now / before - 1.0).max())
            ratio = change / last if math.isfinite(last) else 0.0
            remaining = change * ratio / (1.0 - ratio) if ratio < 1.0 else math.inf
            allowed = error if math.isfinite(last) else error / 2.0
            if change <= allowed and remaining <= error:
                return sides, n
        finer = [2 * cells for cells in n]
        if too_many(finer):
            break
        before, n = now, finer
    changes = (
        f"changes by {100 * change:.2g} % from half as many cells to"
        if math.isfinite(change)
        else "is not known from another grid to be right on"
    )
    if not change <= error / 2.0:
        warn(
            f"{NUMBERS[of]} still {changes} {n[0]}, where error = {error:g} was asked for: an edge "
            "or short waves need more cells",
        )
    return sides, n


def _doubt_films(body1: Body, body2: Body, cells: list[float]) -> None:
    """Warn of an outermost coating that is thinner than a cell."""
    for number, body in enumerate((body1, body2), start=1):
        thickness = body.coatings[0].thickness if body.coatings else math.inf
        if thickness < min(cells):
            warn(
                f"the outermost coating of body {number} is {thickness / min(cells):.2g} of a cell "
                "thick. Stresses in it are averages over a cell. For these, use cells of "
                f"{thickness / CELLS_PER_FILM:.2e} m, {CELLS_PER_FILM:g} in its thickness",
            )


def offer() -> None:
    """Let the grid have it: ``Grid.for_contact(...)``."""
    setattr(Grid, "for_contact", staticmethod(for_contact))  # noqa: B010
