"""The store of a study: a Zarr group that is laid out first and filled point by point.

Only the process that runs the study writes. A point counts once its status is written, which is
last, and every file is replaced as a whole: whoever is killed leaves points that are done or open.
"""

from __future__ import annotations

import json
from dataclasses import replace
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import StoreError, __version__
from pyfret._util.lazy import xr
from pyfret.study.point import FAILED, MEANINGS, OPEN, Outcome

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

    from pyfret.study.design import Design

__all__ = ["Store", "read"]

#: Version of the layout.
SCHEMA = 1
#: Characters of a reason that are kept.
REASON = 240
#: Variables of every study beside its measures: type, value of an open point, unit, meaning.
OWN: dict[str, tuple[str, Any, str, str]] = {
    "nx": ("int32", 0, "1", "cells along x that the point took"),
    "ny": ("int32", 0, "1", "cells along y that the point took"),
    "seconds": ("float64", np.nan, "s", "processor time of the point"),
    "reason": (f"<U{REASON}", "", "1", "why the point failed, or what is to be doubted of it"),
    "status": ("int8", OPEN, "1", "what became of the point"),
}


class Store:
    """A study on its way.

    Parameters
    ----------
    place : path
        Folder; laid out if it does not exist.
    design : Design
        The points.
    said : dict of str to str
        Attributes that tell the study from others (``study``, ``measures``) or its title.
    """

    def __init__(self, place: str | os.PathLike[str], design: Design, said: dict[str, str]) -> None:
        self.place, self.design = Path(place), design
        if self.place.exists():
            self.check(said)
        else:
            template = xr.Dataset(coords=design.coords(), attrs={**said, **self.marks()})
            self.lay_out(template, OWN)
        own = set(design.sizes)
        self.shapes: dict[str, dict[str, int]] = {
            str(name): {str(k): n for k, n in of.sizes.items() if k not in own}
            for name, of in read(self.place).data_vars.items()
        }

    @staticmethod
    def marks() -> dict[str, Any]:
        """Attributes of every store of a study."""
        return {"kind": "study", "schema": SCHEMA, "version": __version__}

    def check(self, said: dict[str, str]) -> None:
        """Refuse a store of another study."""
        there = read(self.place).attrs
        for name in ("study", "measures"):
            if there.get(name) != said[name]:
                raise StoreError(
                    f"{self.place}: is the store of another study; {difference(there, said)}. "
                    "Give another place, or the same study to go on with it"
                )

    def lay_out(self, dataset: xr.Dataset, own: dict[str, tuple[str, Any, str, str]]) -> None:
        """Write the template: coordinates, and variables without values."""
        shape = tuple(self.design.sizes.values())
        for name, (kind, empty, unit, meaning) in own.items():
            attrs: dict[str, Any] = {"units": unit, "long_name": meaning}
            if name == "status":
                attrs |= {"flag_values": [0, 1, 2], "flag_meanings": MEANINGS}
            values = np.full(shape, empty, dtype=kind)
            dataset[name] = (tuple(self.design.sizes), values, attrs)
        encoding = {name: {"chunks": shape, "_FillValue": None} for name in own}
        dataset.to_zarr(self.place, mode="w-", zarr_format=2, consolidated=True, encoding=encoding)

    def make_room(self, measures: dict[str, xr.Variable]) -> None:
        """Lay out what the first point that is done has measured."""
        new = {name: of for name, of in measures.items() if name not in self.shapes}
        if not new:
            return
        sizes = self.design.sizes
        template, encoding = xr.Dataset(attrs=read(self.place).attrs), {}
        for name, of in new.items():
            # A field has a chunk for each point, scalars of all points share one.
            alone = tuple(1 for _ in sizes) if of.ndim else tuple(sizes.values())
            values = np.full((*sizes.values(), *of.shape), np.nan)
            template[name] = ((*sizes, *of.dims), values, of.attrs)
            encoding[name] = {"chunks": (*alone, *of.shape), "_FillValue": np.nan}
        template.to_zarr(self.place, mode="a", zarr_format=2, consolidated=True, encoding=encoding)
        self.shapes |= {name: {str(k): n for k, n in of.sizes.items()} for name, of in new.items()}

    def write(self, n: int, outcome: Outcome) -> None:
        """Write what became of the n-th point, its status last."""
        self.make_room(outcome.measures)
        outcome = self.fitting(outcome)
        numbers = {
            "nx": np.int32(outcome.nx),
            "ny": np.int32(outcome.ny),
            "seconds": outcome.seconds,
        }
        values = {name: xr.Variable((), value) for name, value in numbers.items()}
        if outcome.status == FAILED:
            values["reason"] = xr.Variable((), np.array(outcome.reason, f"<U{REASON}"))
        self.region(n, {**values, **outcome.measures})
        self.region(n, {"status": xr.Variable((), np.int8(outcome.status))})

    def fitting(self, outcome: Outcome) -> Outcome:
        """The outcome, failed if a field has another shape than those of the other points."""
        for name, of in outcome.measures.items():
            if dict(of.sizes) != self.shapes[name]:
                reason = (
                    f"{name} is a field of {dict(of.sizes)}, that of other points one of "
                    f"{self.shapes[name]}; interpolate it, or keep the grid with grow=False"
                )
                return replace(outcome, status=FAILED, reason=reason, measures={})
        return outcome

    def region(self, n: int, values: dict[str, xr.Variable]) -> None:
        """Write variables of one point."""
        if not values:
            return
        place = dict(zip(self.design.sizes, self.design.place(n), strict=True))
        one = xr.Dataset(
            {
                name: ((*place, *of.dims), of.values.reshape((1,) * len(place) + of.shape))
                for name, of in values.items()
            }
        )
        one.to_zarr(
            self.place,
            mode="r+",
            zarr_format=2,
            consolidated=True,
            region={dim: slice(i, i + 1) for dim, i in place.items()},
        )

    def open_points(self, *, again: bool) -> list[int]:
        """Points that are to be solved: open ones, and `again` those that failed."""
        status = read(self.place)["status"].values.ravel()
        wanted: Iterable[int] = (OPEN, FAILED) if again else (OPEN,)
        return [int(n) for n in np.flatnonzero(np.isin(status, list(wanted)))]


def difference(there: dict[Any, Any], said: dict[str, str]) -> str:
    """In what two studies differ."""
    if there.get("measures") != said["measures"]:
        return f"it measures {there.get('measures')}, not {said['measures']}"
    theirs, ours = json.loads(there.get("study", "{}")), json.loads(said["study"])
    parts = [name for name in ours if ours[name] != theirs.get(name)]
    return f"they differ in {' and '.join(parts)}"


def read(place: str | os.PathLike[str]) -> xr.Dataset:
    """The dataset of a study, read into memory.

    Raises
    ------
    StoreError
        There is no study there.
    """
    try:
        with xr.open_zarr(place, chunks=None) as lazy:
            dataset: xr.Dataset = lazy.load()
    except Exception as error:
        message = " ".join(str(error).split())
        raise StoreError(f"{fspath(place)}: {type(error).__name__}: {message}") from error
    if dataset.attrs.get("kind") != "study":
        raise StoreError(f"{fspath(place)}: is not the store of a study")
    return dataset
