"""The result of a run: the datum, and all that follows from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from pyfret import fatigue, fracture
from pyfret import heat as heating
from pyfret._util import files
from pyfret._util.extras import application
from pyfret.export.write import write as export
from pyfret.quantities import (
    Angle,
    LayerStresses,
    Length,
    Lengths,
    Numbers,
    Unchecked,
    as_layers,
    quantities,
)
from pyfret.run import Run
from pyfret.run.opening import open_dataset
from pyfret.run.run import one_of
from pyfret.run.summary import summary
from pyfret.run.tables import run_html
from pyfret.snapshot import Shows, Snapshot
from pyfret.subsurface import fields
from pyfret.subsurface.moments import lines_of
from pyfret.subsurface.unloaded import Unloaded

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    import xarray as xr
    from matplotlib.figure import Figure

    from pyfret.export.frame import Frame
    from pyfret.fatigue.judged import Life
    from pyfret.fracture.growth import Cracks, Threshold
    from pyfret.wear.result import WearResult

__all__ = ["Result", "open_result"]


class Result(Run, Shows):
    """The result of a run.

    Its ``dataset`` has scalars over ``increment`` and fields over (``saved``, ``x``, ``y``) for the
    increments whose fields were kept. Its ``attrs`` hold the scene, the version, ``a_H``, ``p_H``
    and ``mu``. Every variable carries ``units`` and ``long_name``. Its scalars are attributes as
    well, e.g. ``result.T_x``; fields belong to an increment, e.g. ``result.at(-1).p``.
    """

    life = fatigue.life
    load_factors = fatigue.load_factors
    cyclic_response = fatigue.cyclic_response
    crack = fracture.crack
    grow_crack = fracture.grow
    temperature = heating.temperature
    summary = summary
    _repr_html_ = run_html

    @quantities
    def report(
        self,
        path: str | os.PathLike[str],
        *,
        wear: WearResult | None = None,
        crack: Cracks | None = None,
        threshold: Threshold | None = None,
        life: Life | Sequence[Life] | None = None,
        figures: Mapping[str, Figure] | None = None,
    ) -> None:
        """Write a result as one page for a browser, which needs neither pyfret nor a network.

        The page has the scene, what was left out, and numbers with their error bars. It has the
        loop, maps and profiles of every increment that kept its fields, and the stress below the
        last one. It has the sources to cite.

        Parameters
        ----------
        path : path
            File to write, ``.html``; one that is there is replaced.
        wear : WearResult, optional
            What many cycles wore off the same bodies.
        crack : Cracks, optional
            A crack of :meth:`Result.crack` or :meth:`Result.grow_crack`: its way in the section,
            K over the cycle.
        threshold : Threshold, optional
            Of its material: whether and where the crack stops, Kitagawa and Takahashi's diagram.
        life : Life or sequence of Life, optional
            Lives of :meth:`Result.life`, such as one for each criterion: range, worst points and
            a map.
        figures : mapping of str to Figure, optional
            Figures of matplotlib to append, by their captions.

        Raises
        ------
        ImportError
            If a package is missing: ``pip install "fretting[report]" fretting-apps``.
        ValueError
            The ending of the file is another, or a threshold is given without a crack. The wear or
            the crack belongs to other bodies, or has no bodies.
        """
        write_page = application("pyfret.report.page").write_page
        write_page(
            self,
            path,
            wear=wear,
            crack=crack,
            threshold=threshold,
            life=life,
            figures=figures,
        )

    @quantities
    def at(self, which: Unchecked | None = None, *, t: Unchecked | None = None) -> Snapshot:
        """Give the contact at the end of one increment whose fields were kept.

        Parameters
        ----------
        which : int or float
            An integer counts increments from 1; negative ones count the kept increments from the
            last. A float is a path time t.
        t : float, optional
            The path time instead: ``at(t=2)`` is ``at(2.0)``.

        Raises
        ------
        KeyError
            The fields of that increment were not kept; the message lists those that were.
        """
        return Snapshot(*self._kept(one_of(which, t)))

    def unloaded(self, which: float = -1) -> Unloaded:
        """Take the contact apart: residual stress, and the imprint as a shape.

        Parameters
        ----------
        which : int or float
            The increment, as in :meth:`at` (default: the last that kept its fields).

        Raises
        ------
        ValueError
            Both bodies stay elastic.

        Warns
        -----
        SceneWarning
            Taking the load off would yield in reverse.

        Examples
        --------
        >>> left = result.unloaded()  # doctest: +SKIP
        >>> left.stress(y=0.0).maximum("s_xx")  # doctest: +SKIP
        >>> scene.body2.replace(shape=left.shape(2))  # doctest: +SKIP
        """
        return Unloaded(self.at(which))

    @quantities
    def envelope(
        self,
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
        """Extremes of stress over the increments whose fields were kept, on a section or on planes.

        Use :func:`pyfret.subsurface.envelope` with :func:`pyfret.march` for all increments of a
        path without keeping their fields; parameters and result are the same.
        Without depths and place the section stands along the shear of these increments, through the
        centre of the largest contact.
        """
        saved = self.dataset.saved_increment.values
        if z is None and x is None and y is None and azimuth is None:
            x, y, azimuth = lines_of(self, saved, body_number, as_layers(residual))[0]
        kept = (self.at(int(n)) for n in saved)
        return fields.envelope(
            self.scene,
            kept,
            z,
            x=x,
            y=y,
            azimuth=azimuth,
            of=of,
            body_number=body_number,
            bulk=bulk,
            residual=residual,
        )

    @quantities
    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Write the result to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``).

        :func:`pyfret.open` opens both. NetCDF needs the package h5netcdf or
        netCDF4: ``pip install "fretting[netcdf]"``.

        Parameters
        ----------
        path : path
            The place to write to; its ending selects the format.
        overwrite : bool
            Whether what pyfret saved there is replaced (default: the place must be free).

        Raises
        ------
        FileExistsError
            There is something at the place.
        ValueError
            The ending is another.
        """
        files.write(self.dataset, path, overwrite=overwrite)

    @quantities
    def export(
        self,
        path: str | os.PathLike[str],
        *,
        at: float = -1,
        frame: Frame | None = None,
        body_number: int = 2,
        form: Literal["csv", "abaqus", "aster"] = "csv",
        of: Literal["p", "q_x", "q_y"] = "p",
        mesh: str | os.PathLike[str] | None = None,
        points: Numbers | None = None,
    ) -> None:
        """Write an increment for another program: :func:`pyfret.export.write`.

        `at` selects it, as in :meth:`at`; by default the last whose fields were kept.
        """
        export(
            self.at(at),
            path,
            frame=frame,
            body_number=body_number,
            form=form,
            of=of,
            mesh=mesh,
            points=points,
        )


@quantities
def open_result(path: str | os.PathLike[str]) -> Result:
    """Open a result: a Zarr store, or what :meth:`Result.save` wrote (``.zarr``, ``.nc``).

    Fields are read when they are asked for. A store of up to 64 MB is checked as a whole before.
    The fields of a larger one are checked when they are read: what is read is what was written.
    What :meth:`Result.save` wrote is checked up to 256 MB.

    Raises
    ------
    StoreError
        There is no store, or a file of it is missing or damaged; the message names both.
    """
    return Result(open_dataset(path))
