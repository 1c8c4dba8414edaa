"""The state of one increment, and all that follows from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Literal

from pyfret._util.figures import Figured, Figures
from pyfret._util.tables import as_table
from pyfret.export.write import write as export
from pyfret.quantities import (
    Angle,
    LayerStresses,
    Length,
    Lengths,
    as_layers,
    as_number,
    quantities,
)
from pyfret.run import State
from pyfret.run.tables import state_html
from pyfret.subsurface import contact
from pyfret.subsurface.line import fields_on
from pyfret.subsurface.plastic import PlasticState
from pyfret.subsurface.tensor import LABELS
from pyfret.subsurface.zones import Zone, zone

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    import xarray as xr
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from pyfret._util.csv_table import Tables
    from pyfret._util.labelled_table import Table
    from pyfret.export.frame import Frame
    from pyfret.subsurface.tensor import Stress

__all__ = ["Overview", "Shows", "Snapshot"]


class Overview(Figures):
    """The figures of a run or of an increment; called itself, six of them in one."""

    def __call__(
        self,
        *,
        units: Literal["auto", "dimensionless", "SI"] = "auto",
        width: Literal["column", "page"] | None = None,
    ) -> Figure:
        """Draw six panels in one figure: :func:`pyfret.plot.overview`."""
        figure: Figure = super().__call__(units=units, width=width)
        return figure


class Shows(Figured):
    """A state that six panels show in one figure."""

    figure = "overview"

    @property
    def plot(self) -> Overview:
        """Its figures: ``result.plot()``, ``result.plot.fretting_loop()``, ``.stick_slip()``."""
        return Overview(self)


class Snapshot(State, Shows):
    """The contact at the end of one increment: its scalars and its fields.

    Every variable of :attr:`dataset` is an attribute as well, e.g. ``snapshot.p``; :attr:`plot` has
    the figures that show it.
    """

    #: End of the refusal of an argument of its tables.
    keyword_hint: ClassVar[str] = "; a line is written by snapshot.along(y=0.0).to_csv(path)"

    def _repr_html_(self) -> str:
        """Return tables for notebooks."""
        return state_html(self)

    def _elsewhere(self, name: str) -> dict[str, str]:
        """Return where a name is found that this object does not have."""
        profile = "snapshot.along(y=0.0) has its fields on a line, snapshot.to_csv(path, "
        lines = dict.fromkeys(
            ("profile", "profiles", "section", "slice", "cut"),
            f'{profile}of="profile") writes those through the middle',
        )
        stresses = {measure: f"it is a stress, snapshot.stress().{measure}" for measure in LABELS}
        return {**lines, **stresses, **super()._elsewhere(name)}

    @property
    def plastic(self) -> PlasticState:
        """The plastic strain of the body that yields, the stress there and the imprint.

        Of the lower body if both yield; ``state.plastic(body_number=1)`` belongs to the upper one.

        Raises
        ------
        ValueError
            Both bodies stay elastic.

        Examples
        --------
        >>> result.at(-1).plastic.volume()  # doctest: +SKIP
        >>> result.at(-1).plastic.dataset.residual_stress  # doctest: +SKIP
        """
        return PlasticState(self)

    def _tables(self) -> Tables:
        """Return what makes the tables: all cells, and the profile on the line of :meth:`along`."""
        return {**super()._tables(), "profile": lambda: (self.along(), None)}

    @quantities
    def along(
        self, *, x: Length | None = None, y: Length | None = None, azimuth: Angle | None = None
    ) -> Table:
        """Fields on a line of the surface, linear between the centres of the cells.

        Parameters
        ----------
        x, y : float, optional
            With `y`, the line along x at that y [m]; with `x`, that along y. Where nothing is
            given, the line along the shear, through the centre of the contact: :attr:`outline`.
        azimuth : float, optional
            The line at this angle to the x axis [rad], through `x` and `y` (default: the centre of
            the contact).

        Returns
        -------
        xarray.Dataset
            Over x, y or, on an oblique line, s [m]. An oblique line has `q_s` and `q_t`, the shear
            along s and to the left of it [Pa].

        Raises
        ------
        ValueError
            x and y are given without an azimuth.
        """
        if x is not None and y is not None and azimuth is None:
            raise ValueError("give x or y, or an azimuth as well: a point is no line")
        line = contact.line_below(self, None, as_number(x), as_number(y), as_number(azimuth))[0]
        fields = fields_on(self, line)
        first = [name for name in ("p", "q_x", "q_y", "q_s", "q_t") if name in fields]
        return as_table(fields[[*first, *(name for name in fields if name not in first)]])

    @quantities
    def stress(
        self,
        z: Lengths | None = None,
        *,
        x: Length | None = None,
        y: Length | None = None,
        azimuth: Angle | None = None,
        body_number: int = 2,
        bulk: bool = True,
        residual: LayerStresses | None = None,
    ) -> Stress:
        """Stress below the contact, in the lower body unless `body_number` is 1.

        The stress of the tractions and, in a body that has yielded, the residual stress of its
        plastic strain.

        Parameters
        ----------
        z : float or array, optional
            Depths [m]; those on an interface appear twice, once in each layer (default: those that
            the layers ask for, down to twice :attr:`length`).
        x, y : float, optional
            With `y`, the section along x at that y; with `x`, that along y; with both, the line
            below a point. With neither, the whole plane at every depth given. Where nothing is
            given, the section along the shear, through the centre of the contact: :attr:`outline`.
        azimuth : float, optional
            The section at this angle to the x axis [rad], through `x` and `y` (default: the centre
            of the contact).
        body_number : 1 or 2
            The body.
        bulk : bool
            Whether its bulk stress is part of the stress.
        residual : sequence, optional
            Residual stress of every layer from the surface down, the substrate's last, in place of
            the body's. Each is a stress [Pa] or a table over depth, as :class:`Body` takes
            it.

        Warns
        -----
        SceneWarning
            The first interface is nearer to the surface than a cell is long.

        Examples
        --------
        >>> below = result.at(-1).stress()  # doctest: +SKIP
        >>> below.maximum("von_mises")  # doctest: +SKIP
        """
        return contact.stress_below(
            self,
            z,
            x=as_number(x),
            y=as_number(y),
            azimuth=as_number(azimuth),
            body_number=body_number,
            bulk=bulk,
            residual=as_layers(residual),
        )

    @quantities
    def displacement(
        self,
        z: Lengths | None = None,
        *,
        x: Length | None = None,
        y: Length | None = None,
        azimuth: Angle | None = None,
        body_number: int = 2,
    ) -> xr.Dataset:
        """Displacements u_x, u_y, u_z of a body below the contact [m], as in :meth:`stress`."""
        return contact.displacement_below(
            self,
            z,
            x=as_number(x),
            y=as_number(y),
            azimuth=as_number(azimuth),
            body_number=body_number,
        )

    @quantities
    def stick_zone(self, *, y: Length = 0.0) -> Zone:
        """Return the ends of the stick zone along a line of constant `y` [m], within the cells.

        Its ``left`` and ``right`` border and its ``middle``, the offset that a bulk stress gives
        it, in m; NaN where nothing sticks.
        """
        return zone(self, "stick", as_number(y))

    @quantities
    def contact_zone(self, *, y: Length = 0.0) -> Zone:
        """Return the ends of the contact along a line of constant `y`, as :meth:`stick_zone`."""
        return zone(self, "contact", as_number(y))

    @quantities
    def write_volume(
        self,
        out: str | os.PathLike[str],
        z: Lengths | None = None,
        *,
        of: Sequence[str] = ("von_mises",),
        body_number: int = 2,
        bulk: bool = True,
        residual: LayerStresses | None = None,
    ) -> None:
        """Write stress, displacement in the volume: :func:`pyfret.subsurface.write_volume`."""
        contact.write_below(
            self, out, z, of=of, body_number=body_number, bulk=bulk, residual=as_layers(residual)
        )

    def export(
        self,
        path: str | os.PathLike[str],
        *,
        frame: Frame | None = None,
        body_number: int = 2,
        form: Literal["csv", "abaqus", "aster"] = "csv",
        of: Literal["p", "q_x", "q_y"] = "p",
        mesh: str | os.PathLike[str] | None = None,
        points: ArrayLike | None = None,
    ) -> None:
        """Write tractions, forces on a mesh or stress at points: :func:`pyfret.export.write`."""
        export(
            self,
            path,
            frame=frame,
            body_number=body_number,
            form=form,
            of=of,
            mesh=mesh,
            points=points,
        )
