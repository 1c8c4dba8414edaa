"""Plastic strain below a contact, and what it leaves: residual stress and imprint."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret._util.lazy import xr

if TYPE_CHECKING:
    import xarray
    from numpy.typing import NDArray

    from pyfret._core import Scene
    from pyfret.run import State

__all__ = ["PlasticState", "body_of", "columns_of", "eigenstress", "plastic_points"]

COMPONENTS = ["xx", "yy", "zz", "xy", "xz", "yz"]
#: Columns of the points that have yielded, as a store has them.
YIELDED = tuple(_core.yielded_columns())
#: Bodies and residual stresses that are kept: one of each takes up to 100 and 10 MB.
KEPT_BODIES, KEPT_STRESSES = 2, 8


@dataclass(frozen=True)
class _Of:
    """A body of a run, known by the text of its scene."""

    text: str
    body_number: int
    scene: Scene = field(compare=False)


@dataclass(frozen=True)
class _Strained:
    """The points of a body that have yielded, known by a digest of their numbers."""

    of: _Of
    digest: bytes
    columns: list[NDArray[np.float64]] = field(compare=False)


@lru_cache(maxsize=KEPT_BODIES)
def _body(of: _Of) -> _core.PlasticBody:
    """The volume grid of a body."""
    return _core.PlasticBody(of.scene, of.body_number)


@lru_cache(maxsize=KEPT_STRESSES)
def _stress(strained: _Strained) -> _core.Eigenstress | None:
    """The residual stress of the points of a body."""
    return _body(strained.of).eigenstress(strained.columns)


def columns_of(state: State) -> list[NDArray[np.float64]]:
    """The points of both bodies that have yielded, as the core takes them."""
    return [np.asarray(state.dataset[name].values, dtype=float) for name in YIELDED]


def body_of(state: State, body_number: int) -> _core.PlasticBody:
    """The volume grid of a body; a ValueError where it stays elastic."""
    return _body(_identify(state, body_number))


def _identify(state: State, body_number: int) -> _Of:
    """Return what identifies a body of a state."""
    return _Of(str(state.dataset.attrs["scene"]), body_number, state.scene)


def _strained(state: State, body_number: int) -> _Strained:
    """Return the yielded points of a body as the core takes them."""
    columns = columns_of(state)
    in_body = columns[YIELDED.index("yielded_body")] == body_number
    columns = [np.ascontiguousarray(column[in_body]) for column in columns]
    # The increment is no part of what has yielded.
    digest = hashlib.sha256(b"".join(column.tobytes() for column in columns[1:])).digest()
    return _Strained(_identify(state, body_number), digest, columns)


def eigenstress(state: State, body_number: int) -> list[_core.Eigenstress | None]:
    """Return the eigenstress of a body of a state in the form of the core.

    Empty for a body that stays elastic; None stands for one that may yield and has not.
    """
    if not state.body(body_number).yields:
        return []
    return [_stress(_strained(state, body_number))]


def plastic_points(state: State, body_number: int) -> xarray.Dataset:
    """Return the yielded points of a body: strain, equivalent strain, place and layer."""
    strained = _strained(state, body_number)
    columns = dict(zip(YIELDED, strained.columns, strict=True))
    grid = body_of(state, body_number).grid(strained.columns)
    plane, cell = (columns[f"yielded_{name}"].astype(int) for name in ("plane", "cell"))
    i, j = np.divmod(grid["place"], grid["y"].size)
    strain = np.transpose([columns[f"plastic_strain_{name}"] for name in COMPONENTS])
    return xr.Dataset(
        {
            "strain": (("point", "component"), strain),
            "equivalent": ("point", columns["equivalent_plastic_strain"]),
            "plane": ("point", plane),
            "cell": ("point", cell),
            "x": ("point", grid["x"][i]),
            "y": ("point", grid["y"][j]),
            "z": ("point", grid["z"][plane]),
            "layer": ("point", grid["layer"][plane]),
        }
    )


class PlasticState:
    """The plastic state of a body after an increment, on the planes and cells of its volume grid.

    Planes go through the Gauss points: two in each element in depth. Tension is positive, z
    points into the body, components are in the axes of the scene. Called itself, it gives the state
    of the other body: ``state.plastic(body_number=1)``.

    Parameters
    ----------
    state : Snapshot
        The increment.
    body_number : 1 or 2, optional
        The body (default: the lower one, or the upper one where that alone yields).

    Raises
    ------
    ValueError
        No layer of the body yields.
    """

    def __init__(self, state: State, body_number: int | None = None) -> None:
        self._state = state
        if body_number is None:
            body_number = 1 if state.body(1).yields and not state.body(2).yields else 2
        self._of = _identify(state, body_number)
        #: The body, 1 or 2.
        self.body_number = body_number
        _body(self._of)

    def __call__(self, *, body_number: int = 2) -> PlasticState:
        """Give the plastic state of a body."""
        return PlasticState(self._state, body_number)

    @cached_property
    def _columns(self) -> list[NDArray[np.float64]]:
        """Columns :data:`YIELDED` of the yielded points of this body."""
        return _strained(self._state, self.body_number).columns

    @cached_property
    def _grid(self) -> dict[str, Any]:
        """Return the volume grid of the yielded points."""
        return _body(self._of).grid(self._columns)

    def _column(self, name: str) -> NDArray[np.float64]:
        """Return a column of the yielded points."""
        return self._columns[YIELDED.index(name)]

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """Equivalent plastic strain, plastic strain, stress and residual stress [Pa], imprint [m].

        Over (z, y, x), tensors over (z, component, y, x) as well; ``layer`` and ``height`` belong
        to z. The ``imprint`` is the growth of the gap by the plastic strain of both bodies, on the
        cells of the contact.
        """
        columns = self._columns
        sigma_B = self._state.bulk_stress(self.body_number)
        fields = _body(self._of).fields(columns, **self._state.tractions(), sigma_B=sigma_B)
        imprint = _body(self._of).imprint(columns_of(self._state))
        scalar, tensor = ("z", "y", "x"), ("z", "component", "y", "x")

        def over_y_x(name: str) -> NDArray[np.float64]:
            """Return a field of the core with y before x."""
            return np.swapaxes(fields[name], -1, -2)

        grid = self._grid
        of_state = self._state.dataset
        metre = {"units": "m"}
        labels = {
            "equivalent": ("1", "equivalent plastic strain, added up over the path"),
            "strain": ("1", "plastic strain"),
            "stress": ("Pa", "stress, residual and bulk stress included"),
            "residual_stress": ("Pa", "stress without the tractions of the contact"),
        }
        variables: dict[str, Any] = {
            name: (
                scalar if name == "equivalent" else tensor,
                over_y_x(name),
                {"units": unit, "long_name": meaning},
            )
            for name, (unit, meaning) in labels.items()
        }
        about = {**metre, "long_name": "growth of the gap by plastic strain"}
        variables["imprint"] = (("grid_y", "grid_x"), imprint["imprint"].T, about)
        return xr.Dataset(
            variables,
            coords={
                **{name: (name, grid[name], metre) for name in ("z", "y", "x")},
                "grid_y": ("grid_y", of_state.y.values, metre),
                "grid_x": ("grid_x", of_state.x.values, metre),
                "component": COMPONENTS,
                "layer": ("z", grid["layer"]),
                "height": ("z", grid["height"], metre),
            },
        )

    def largest(self) -> float:
        """Give the largest equivalent plastic strain, 0 where nothing has yielded.

        At the border of slip and at the rim of a soft layer it grows with every refinement.
        """
        return float(self._column("equivalent_plastic_strain").max(initial=0.0))

    def volume(self) -> float:
        """Give the volume that has yielded [m^3], per length in plane strain [m^2]."""
        planes = self._column("yielded_plane").astype(int)
        return float(np.sum(self._grid["height"][planes])) * float(self._grid["area"])

    def depth(self) -> float:
        """Give the depth of the lowest point that has yielded [m], 0 where none has."""
        planes = self._column("yielded_plane").astype(int)
        return float(self._grid["z"][planes].max(initial=0.0))

    def on_axis(self, name: str) -> xarray.DataArray:
        """Give a variable in the middle x = y = 0, continued there from the cells around it.

        Parameters
        ----------
        name : str
            "equivalent", "strain", "stress" or "residual_stress".
        """
        values = self.dataset[name]
        for side in ("x", "y"):
            n = values.sizes[side]
            if n == 1:
                values = values.isel({side: 0})
                continue
            # Even about the middle: 9/8 of the mean of the nearest two less 1/8 of the next.
            if n % 2 == 1 or n < 4:
                values = values.interp({side: 0.0})
                continue
            m = n // 2
            near = 0.5 * (values.isel({side: m}, drop=True) + values.isel({side: m - 1}, drop=True))
            far = 0.5 * (
                values.isel({side: m + 1}, drop=True) + values.isel({side: m - 2}, drop=True)
            )
            values = near + (near - far) / 8.0
        return values

    def __repr__(self) -> str:
        """Give the numbers of the zone."""
        unit = "m^2" if self._state.scene.grid.plane_strain else "m^3"
        return (
            f"PlasticState(body {self.body_number}, largest={self.largest():.3g}, "
            f"volume={self.volume():.3g} {unit}, depth={self.depth():.3g} m)"
        )
