"""The door for arrays: what a caller gives becomes an array of finite numbers, or is refused.

One rule for every module:

- Booleans, complex numbers, texts, dates and objects are no numbers.
- A masked value and a NaN are the same, a missing value. It is refused, or, where a function states
  so, a hole. Infinity is refused.
- An array with labels (xarray, pandas) is taken by its labels: axes by the names of its
  dimensions, components by their names, points by their index. Where a label has no meaning, an
  array of more than one axis is refused: its order is unknown. An array without labels is taken by
  place.
- What came in with labels goes out with them.
- The length that a sequence claims is not trusted.
"""

from __future__ import annotations

from collections.abc import Mapping, Sized
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from pyfret._util.lazy import xr

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Sequence

    from numpy.typing import ArrayLike, NDArray

__all__ = ["COMPONENTS", "Histories", "histories", "items", "number", "plain", "together"]

T = TypeVar("T")
#: The last axis of a stress history.
COMPONENTS = ("s_xx", "s_yy", "s_zz", "s_xy", "s_xz", "s_yz")
#: Names of the axis of a history along which time passes.
TIMES = ("increment", "time", "t", "instant", "saved", "saved_increment", "moment", "load_step")
#: Axes of a field on the grid, in the order of arrays without labels.
PLANE = ("x", "y")
#: Part of the distance of points by which they may lie off an even grid.
UNEVEN = 1e-3
#: Kinds of numpy's types that are numbers: integers and floating point.
NUMBERS = "iuf"


def number(value: object, name: str) -> float:
    """A finite number; a TypeError for what is none, a ValueError for one that is missing."""
    single = plain(value, name)  # type: ignore[arg-type]
    if single.ndim:
        raise TypeError(f"{name}: must be a number, not an array of the shape {single.shape}")
    return float(single)


def items(values: Iterable[T], name: str) -> list[T]:
    """Return the items of a sequence one by one, without trust in its ``len``.

    Raises
    ------
    TypeError
        It is a text, a mapping or no sequence.
    ValueError
        It gives more items than its ``len``.
    """
    if isinstance(values, (str, bytes, Mapping)) or not hasattr(values, "__iter__"):
        raise TypeError(f"{name} = {values!r:.60}: must be a list")
    length = len(values) if isinstance(values, Sized) else None
    collected: list[T] = []
    for value in values:
        if len(collected) == length:
            raise ValueError(f"{name}: has the length {length} and yields more values")
        collected.append(value)
    return collected


def plain(values: ArrayLike, name: str, *, holes: bool = False) -> NDArray[np.float64]:
    """Return the numbers of an array, by the rules of this module.

    `name` is the name of the argument. With `holes` missing values are allowed and become NaN. A
    field with the labels x and y gets the shape (x, y), both axes ascending.
    """
    if sorted(map(str, labels(values))) == list(PLANE):
        ordered: Any = values
        values = ordered.transpose(*PLANE).sortby([a for a in PLANE if a in ordered.coords])
    elif labels(values) and np.ndim(values) > 1:
        raise TypeError(
            f"{name} has the axes {', '.join(map(str, labels(values)))}, whose order is not known "
            f"here: put the axes in order and give {name}.values"
        )
    try:
        return numbers(values, name, holes=holes)
    except RecursionError:
        raise TypeError(f"{name}: lists lie too deep in it") from None


def numbers(values: ArrayLike, name: str, *, holes: bool = False) -> NDArray[np.float64]:
    """Return the numbers of an array whose labels have been checked."""
    masked = np.ma.isMaskedArray(values) and np.ma.is_masked(values)
    if masked and not holes:
        hidden: Any = np.ma.getmaskarray(np.ma.asarray(values))
        raise ValueError(
            f"{name} has {np.count_nonzero(hidden)} masked values of {hidden.size}: must have a "
            "number everywhere; leave them out, or fill them"
        )
    data: Any = values
    if masked:
        data = np.ma.MaskedArray(values, dtype=float).filled(np.nan)
    if contains_booleans(data):
        raise TypeError(f"{name}: True and False are no numbers")
    try:
        array = np.asarray(data)
        if array.dtype.kind not in NUMBERS and array.size:
            kind = "texts or objects" if array.dtype.kind in "OSU" else f"of the type {array.dtype}"
            raise TypeError(f"the values are {kind}")
        array = array.astype(float, copy=False)
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"{name}: must be an array of numbers: {error}") from error
    with np.errstate(over="ignore", invalid="ignore"):
        # A sum is a number where all terms are: one pass, without a copy. An array that repeats its
        # values has more of them than memory.
        if 0 not in array.strides and np.isfinite(array.sum()):
            return array
    bad = np.isinf(array) if holes else ~np.isfinite(array)
    if bad.any():
        where = [int(n) for n in np.argwhere(bad)[0]]
        at = f"[{', '.join(map(str, where))}]" if where else ""
        raise ValueError(f"{name}{at} = {array[tuple(where)]}: must be a finite number")
    return array


def contains_booleans(values: Any) -> bool:
    """Whether some of the values are booleans."""
    if isinstance(values, (list, tuple)):
        return any(map(contains_booleans, values))
    if isinstance(values, (bool, np.bool_)):
        return True
    return getattr(getattr(values, "dtype", None), "kind", "") == "b"


def labels(values: object) -> tuple[Hashable, ...]:
    """Return the names of the axes of an array with labels; none of another array."""
    if hasattr(values, "dims") and hasattr(values, "sizes"):
        return tuple(values.dims)
    if hasattr(values, "iloc") and hasattr(values, "index"):
        return ("index", "columns")[: getattr(values, "ndim", 1)]
    return ()


def pitch(values: Any, name: str) -> tuple[float | None, float | None]:
    """Return the spacing of a field along x and y [m], each None where it has no labels.

    Raises
    ------
    ValueError
        They lie on no even grid.
    """
    spacings: list[float | None] = []
    for axis in PLANE:
        at = values.coords[axis].values if axis in labels(values) and axis in values.coords else ()
        if len(at) < 2:
            spacings.append(None)
            continue
        steps = np.diff(np.sort(plain(at, f"coordinates of {name} along {axis}")))
        step = float(np.mean(steps))
        if not step > 0.0 or np.ptp(steps) > UNEVEN * step:
            raise ValueError(
                f"{name}: its coordinates along {axis} lie {steps.min():g} to {steps.max():g} m "
                "apart: must be evenly spaced"
            )
        spacings.append(step)
    return spacings[0], spacings[1]


def index(values: Any) -> NDArray[Any] | None:
    """Return the index along the axis of a labelled array of one dimension; None without one."""
    if not labels(values) or np.ndim(values) != 1:
        return None
    if hasattr(values, "iloc"):
        return np.asarray(values.index)
    axis = values.dims[0]
    coords = getattr(values, "coords", {})
    return np.asarray(coords[axis].values) if axis in coords else None


def together(*, holes: bool = False, **arrays: ArrayLike) -> tuple[NDArray[np.float64], ...]:
    """Arrays whose values belong together one by one, as rows of a table, in one dimension.

    Where several have labels, their dimensions and their indices must be the same: nothing is
    paired by place that has a name. With `holes` rows with a missing value are left out.
    """
    columns = {name: plain(values, name, holes=holes).ravel() for name, values in arrays.items()}
    first, *others = columns
    for other in others:
        if columns[other].size != columns[first].size:
            sizes = f"{columns[first].size} values of {first} and {columns[other].size} of {other}"
            raise ValueError(f"{sizes}: must be as many")
    indices = [(name, labels(values), index(values)) for name, values in arrays.items()]
    labelled = [(name, axes, at) for name, axes, at in indices if axes]
    for (first_name, axes, at), (other, other_axes, other_at) in pairwise(labelled):
        unlike = at is not None and other_at is not None and not np.array_equal(at, other_at)
        if axes != other_axes or unlike:
            raise ValueError(
                f"{first_name} and {other} have other labels, along {axes[0]} and {other_axes[0]}: "
                "must belong to the same points in the same order"
            )
    rows = np.stack(list(columns.values()))
    whole = ~np.isnan(rows).any(axis=0)
    return tuple(rows[:, whole])


@dataclass(frozen=True)
class Histories:
    """Stress over time at points.

    Attributes
    ----------
    values : array of shape (time, points, 6)
        Stress [Pa], the points in C order.
    shape : tuple of int
        Numbers of points along their axes.
    dims : tuple of str
        Names of these axes, ``dim_0``, ``dim_1``, ... without labels.
    coords : dict
        Coordinates of the points, where they came with some.
    """

    values: NDArray[np.float64]
    shape: tuple[int, ...]
    dims: tuple[Hashable, ...]
    coords: Mapping[Hashable, Any]

    def whole(self) -> NDArray[np.float64]:
        """Stress of the shape (time, ..., 6)."""
        return self.values.reshape(len(self.values), *self.shape, len(COMPONENTS))

    def labelled(
        self,
        values: NDArray[np.float64],
        units: str,
        long_name: str,
        more: tuple[str, ...] = (),
    ) -> xr.DataArray:
        """Return an array (points, ...) with labels of its points; `more` names other axes."""
        shape = (*self.shape, *values.shape[1:])
        attrs = {"units": units, "long_name": long_name}
        return xr.DataArray(
            values.reshape(shape), dims=(*self.dims, *more), coords=self.coords, attrs=attrs
        )


def histories(
    stress: ArrayLike, name: str = "stress", components: Sequence[str] = COMPONENTS
) -> Histories:
    """Read the history of a stress, or of a tensor with other names of components.

    Without labels its shape is (time, ..., 6). With labels one dimension is a time and one is
    ``component`` with the names of the six components, in any order.
    """
    axes = labels(stress)
    coords: dict[Hashable, Any] = {}
    dims: tuple[Hashable, ...] | None = None
    data: Any = stress
    if axes:
        data, dims, coords = in_order(data, name, components)
    values = numbers(data, name)
    if values.ndim < 2 or values.shape[-1] != len(COMPONENTS):
        raise ValueError(
            f"{name} has the shape {values.shape}: must be (time, ..., 6), "
            "the last axis xx, yy, zz, xy, xz, yz"
        )
    shape = values.shape[1:-1]
    if dims is None:
        dims = tuple(f"dim_{n}" for n in range(len(shape)))
    return Histories(values.reshape(len(values), -1, len(COMPONENTS)), shape, dims, coords)


def in_order(
    stress: Any, name: str, components: Sequence[str]
) -> tuple[NDArray[np.float64], tuple[Hashable, ...], dict[Hashable, Any]]:
    """Return a labelled history as (time, ..., component), and names and coordinates of points."""
    axes = labels(stress)
    times = [axis for axis in axes if axis in TIMES]
    has_names = "component" in getattr(stress, "coords", {})
    if len(times) != 1 or "component" not in axes or not has_names:
        raise ValueError(
            f"{name} has the axes {', '.join(map(str, axes))}: must have one of time "
            f"({', '.join(TIMES)}) and `component` with the names {', '.join(components)}; or give "
            f"{name}.values of the shape (time, ..., 6)"
        )
    present = [str(c) for c in stress.coords["component"].values]
    if sorted(present) != sorted(components):
        raise ValueError(
            f"{name} has the components {', '.join(present)}: must be {', '.join(components)}"
        )
    others = tuple(axis for axis in axes if axis not in (times[0], "component"))
    ordered = stress.transpose(times[0], *others, "component")
    ordered = ordered.isel(component=[present.index(c) for c in components])
    coords = {
        key: coordinate
        for key, coordinate in stress.coords.items()
        if set(coordinate.dims) <= set(others) and key not in axes
    }
    coords |= {axis: stress.coords[axis] for axis in others if axis in stress.coords}
    return ordered.values, others, coords
