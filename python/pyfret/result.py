"""The result of a run: the datum, and all that follows from it."""

from __future__ import annotations

import json
from os import fspath
from typing import TYPE_CHECKING, Literal

from pyfret import _core, fatigue, fracture
from pyfret import heat as heating
from pyfret._core import StoreError
from pyfret._util import files
from pyfret.export.write import write as export
from pyfret.report.page import report
from pyfret.run import Run
from pyfret.run.summary import summary
from pyfret.run.tables import run_html
from pyfret.snapshot import Figures, Snapshot
from pyfret.subsurface import fields
from pyfret.subsurface.moments import lines_of

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    import xarray as xr
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from pyfret.export.frame import Frame
    from pyfret.fatigue.criteria import CriterionName
    from pyfret.fatigue.factors import LoadFactors, YieldStresses
    from pyfret.fatigue.lives import Life, Materials
    from pyfret.fatigue.section import SectionOptions
    from pyfret.wear.result import WearResult

__all__ = ["Result", "open"]


class Result(Run):
    """The result of a run.

    Its ``dataset`` has scalars over ``increment`` and fields over (``saved``, ``x``, ``y``) for the
    increments whose fields were kept; ``attrs`` holds the scene, the version, ``a_H``, ``p_H`` and
    ``mu``. Every variable carries ``units`` and ``long_name``. Its scalars are attributes as well,
    e.g. ``result.T_x``; fields are those of an increment, e.g. ``result.at(-1).p``.
    """

    @property
    def plot(self) -> Figures:
        """The figures that show a run: ``result.plot()``, ``result.plot.fretting_loop()``."""
        return Figures(self)

    def at(self, which: float) -> Snapshot:
        """Give the contact at the end of one increment whose fields were kept.

        Parameters
        ----------
        which : int or float
            An integer counts increments from 1; negative ones count the kept increments from the
            last. A float is a path time t.

        Raises
        ------
        KeyError
            The fields of that increment were not kept; the message lists those that were.
        """
        return Snapshot(*self._kept(which))

    def envelope(
        self,
        z: ArrayLike | None = None,
        *,
        x: float | None = None,
        y: float | None = None,
        azimuth: float | None = None,
        of: Sequence[str] = ("von_mises",),
        body_number: int = 2,
        bulk: bool = True,
        residual: Sequence[float] | None = None,
    ) -> xr.Dataset:
        """Extremes of stress over the increments whose fields were kept, on a section or on planes.

        Use :func:`pyfret.subsurface.envelope` with :func:`pyfret.march` for all increments of a
        path without keeping their fields; parameters and result are those of that function. Without
        depths and place the section stands along the shear of these increments, through the centre
        of the largest contact.
        """
        saved = self.dataset.saved_increment.values
        if z is None and x is None and y is None and azimuth is None:
            x, y, azimuth = lines_of(self, saved, body_number)[0]
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

    def life(
        self,
        materials: Materials,
        criterion: CriterionName,
        z: ArrayLike | None = None,
        *,
        tolerance: float = 1e-3,
        **section: Unpack[SectionOptions],
    ) -> Life:
        """Judge a section below the contact, or several, over a closed cycle by a criterion.

        Parameters and result are those of :func:`pyfret.fatigue.life`.
        """
        return fatigue.life(self, materials, criterion, z, tolerance=tolerance, **section)

    def load_factors(
        self,
        s_y: YieldStresses,
        z: ArrayLike | None = None,
        **section: Unpack[SectionOptions],
    ) -> LoadFactors:
        """Give load factors of first yield and shakedown below the contact over a closed cycle.

        Parameters and result are those of :func:`pyfret.fatigue.load_factors`.
        """
        return fatigue.load_factors(self, s_y, z, **section)

    def crack(
        self,
        x: float | None = None,
        *,
        lengths: ArrayLike | None = None,
        angle: float = 0.0,
        kink: tuple[float, float] | None = None,
        azimuth: float | None = None,
        aspect: float | None = None,
        friction: float = 0.0,
        body_number: int = 2,
        cycle: int | None = -1,
        residual: Sequence[float] | None = None,
    ) -> fracture.Cracks:
        """Take the stress of a closed cycle to the tips of cracks of several lengths.

        Parameters and result are those of :func:`pyfret.fracture.crack`.
        """
        return fracture.crack(
            self,
            x,
            lengths=lengths,
            angle=angle,
            kink=kink,
            azimuth=azimuth,
            aspect=aspect,
            friction=friction,
            body_number=body_number,
            cycle=cycle,
            residual=residual,
        )

    def grow_crack(
        self,
        x: float | None = None,
        *,
        start: float | None = None,
        end: float | None = None,
        angle: float = 0.0,
        azimuth: float | None = None,
        direction: Literal["tangential_stress", "opening_intensity"] = "tangential_stress",
        tolerance: float = 1e-2,
        friction: float = 0.0,
        body_number: int = 2,
        cycle: int | None = -1,
        residual: Sequence[float] | None = None,
    ) -> fracture.Cracks:
        """Let a crack grow in the direction of the largest range over a closed cycle.

        Parameters and result are those of :func:`pyfret.fracture.grow`.
        """
        return fracture.grow(
            self,
            x,
            start=start,
            end=end,
            angle=angle,
            azimuth=azimuth,
            direction=direction,
            tolerance=tolerance,
            friction=friction,
            body_number=body_number,
            cycle=cycle,
            residual=residual,
        )

    def temperature(
        self,
        conductor1: heating.Conductors,
        conductor2: heating.Conductors,
        *,
        frequency: float,
        bulk: float | tuple[float, float] = 0.0,
        wave: Literal["sine", "linear"] = "sine",
        harmonics: int | None = None,
        cycle: int = -1,
    ) -> xr.Dataset:
        """Give the surface temperature under the frictional heat of a closed cycle.

        Parameters and result are those of :func:`pyfret.heat.temperature`.
        """
        return heating.temperature(
            self,
            conductor1,
            conductor2,
            frequency=frequency,
            bulk=bulk,
            wave=wave,
            harmonics=harmonics,
            cycle=cycle,
        )

    def summary(self) -> str:
        """Tabulate what the run ended with: a line per branch, then one per cycle.

        Over a_H and p_H, or in um and MPa; in plane strain a is half the width of the contact.
        """
        return summary(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``).

        :func:`pyfret.open` opens both. The place must be free. NetCDF needs the package h5netcdf or
        netCDF4: ``pip install "fretting[netcdf]"``.

        Parameters
        ----------
        path : path
            Where to write; its ending says in which format.

        Raises
        ------
        FileExistsError
            There is something at the place.
        ValueError
            The ending is another.
        """
        files.write(self.dataset, path)

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
        points: ArrayLike | None = None,
    ) -> None:
        """Write an increment for another program: :func:`pyfret.export.write`.

        `at` says which, as in :meth:`at`; by default the last whose fields were kept.
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

    def report(
        self,
        path: str | os.PathLike[str],
        *,
        wear: WearResult | None = None,
        crack: fracture.Cracks | None = None,
        threshold: fracture.Threshold | None = None,
        figures: Mapping[str, Figure] | None = None,
    ) -> None:
        """Write one page for a browser, for people without pyfret: :meth:`pyfret.Result.report`."""
        report(self, path, wear=wear, crack=crack, threshold=threshold, figures=figures)

    def _repr_html_(self) -> str:
        """Tables for notebooks."""
        return run_html(self)


def open(path: str | os.PathLike[str]) -> Result:
    """Open a result: a Zarr store, or what :meth:`Result.save` wrote (``.zarr``, ``.nc``).

    Fields are read when they are asked for. Every file of a store is checked before: what is read
    is what was written. What :meth:`Result.save` wrote has no checksums and is not checked.

    Raises
    ------
    StoreError
        There is no store, or a file of it is missing or damaged; the message names both.
    """
    files.checked(path)
    # Zarr reads the attributes of the group from a file that no checksum covers.
    attributes = {} if files.is_copy(path) else json.loads(_core.verify(path))
    dataset = files.opened(path)
    if "scene" not in dataset.attrs or "increment" not in dataset.sizes:
        raise StoreError(f"{fspath(path)}: is no result of pyfret: it has no scene or no increment")
    kept = {name: value for name, value in attributes.items() if name in dataset.attrs}
    return Result(dataset.assign_attrs(kept))
