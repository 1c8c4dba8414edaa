"""The store of a study: a Zarr group that is laid out first and filled point by point.

It is laid out beside its place and put there at once, and has one writer. A point counts once its
line stands in the ledger, after its values: whoever is killed leaves points that are done or open.
"""

from __future__ import annotations

import json
import os
import shutil
import zlib
from dataclasses import replace
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import StoreError, __version__
from pyfret._util.files import gzip
from pyfret._util.lazy import xr
from pyfret._util.stores import check_store
from pyfret.study.design import TOGETHER
from pyfret.study.ledger import FILE, Ledger, attributes, checksum
from pyfret.study.measures import names_of
from pyfret.study.point import FAILED, MEANINGS, OPEN, Outcome

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pyfret.study.design import Design
    from pyfret.study.measures import Measure

__all__ = ["Store", "read"]

#: Version of the layout.
SCHEMA = 2
#: How often a store that is being written is looked at again.
ATTEMPTS = 20
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
    """A study on its way, in a folder that :meth:`prepare` has made.

    Parameters
    ----------
    place : path
        Folder.
    design : Design
        The points.
    said : dict of str to str
        Attributes that tell the study from others (``study``, ``measures``) or its title.
    """

    def __init__(self, place: str | os.PathLike[str], design: Design, said: dict[str, str]) -> None:
        self.place, self.design = Path(place), design
        self.check(said)
        own = set(design.sizes)
        self.ledger = Ledger(self.place)
        there = read(self.place)
        self.shapes: dict[str, dict[str, int]] = {
            str(name): {str(k): n for k, n in of.sizes.items() if k not in own}
            for name, of in there.data_vars.items()
        }
        self.attrs = attributes(there)
        last = self.ledger.last
        if last is not None and there["status"].values.ravel()[last] != self.ledger.points[last][0]:
            # A killed process has written the line and not the status.
            self.write_status(last, self.ledger.points[last][0])

    @staticmethod
    def prepare(place: str | os.PathLike[str], design: Design, said: dict[str, str]) -> None:
        """Lay out the store of a study where there is nothing."""
        target = Path(place)
        if target.exists():
            return
        beside = target.with_name(f".{target.name}.{os.getpid()}.unfinished")
        shutil.rmtree(beside, ignore_errors=True)
        try:
            begun = template(design, {**said, **Store.marks()}, OWN)
            shape = tuple(design.sizes.values())
            encoding: dict[str, Any] = {str(name): gzip() for name in begun.variables}
            encoding |= {name: {"chunks": shape, "_FillValue": None, **gzip()} for name in OWN}
            begun.to_zarr(beside, mode="w-", zarr_format=2, consolidated=True, encoding=encoding)
            Ledger.begin(beside, layout_of(opened(beside)))
            try:
                beside.rename(target)
            except OSError:
                # Another process may have been faster.
                if not target.exists():
                    raise
        finally:
            shutil.rmtree(beside, ignore_errors=True)

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

    def make_room(self, measures: dict[str, xr.Variable]) -> None:
        """Lay out what the first point that is done has measured."""
        new = {name: of for name, of in measures.items() if name not in self.shapes}
        if not new:
            return
        for name in new:
            # What a killed process has left of it.
            shutil.rmtree(self.place / name, ignore_errors=True)
        sizes = self.design.sizes
        room, encoding = xr.Dataset(attrs=read(self.place).attrs), {}
        for name, of in new.items():
            # A field has a chunk for each point, scalars of all points share one.
            alone = tuple(1 for _ in sizes) if of.ndim else tuple(sizes.values())
            values = np.full((*sizes.values(), *of.shape), np.nan)
            room[name] = ((*sizes, *of.dims), values, of.attrs)
            encoding[name] = {"chunks": (*alone, *of.shape), "_FillValue": np.nan, **gzip()}
        room.to_zarr(self.place, mode="a", zarr_format=2, consolidated=True, encoding=encoding)
        self.shapes |= {name: {str(k): n for k, n in of.sizes.items()} for name, of in new.items()}
        self.attrs = attributes(opened(self.place))

    def write(self, n: int, outcome: Outcome) -> None:
        """Write what became of the n-th point, its status last."""
        if n in self.ledger.points:
            self.ledger.add(n, OPEN, {}, {})
            self.write_status(n, OPEN)
        outcome = fitting(outcome, self.design, self.shapes)
        self.make_room(outcome.measures)
        numbers = {
            "nx": np.int32(outcome.nx),
            "ny": np.int32(outcome.ny),
            "seconds": outcome.seconds,
        }
        values = {name: xr.Variable((), value) for name, value in numbers.items()}
        if outcome.status == FAILED:
            values["reason"] = xr.Variable((), np.array(outcome.reason, f"<U{REASON}"))
        written = {**values, **outcome.measures}
        self.region(n, written)
        self.ledger.add(n, outcome.status, self.kept(written), self.attrs)
        self.write_status(n, outcome.status)

    def write_status(self, n: int, status: int) -> None:
        """Write the status of the n-th point."""
        self.region(n, {"status": xr.Variable((), np.int8(status))})

    def kept(self, written: dict[str, xr.Variable]) -> dict[str, xr.Variable]:
        """What the arrays, whose types may be others, hold of what was written."""
        kinds = {name: of[0] for name, of in OWN.items()}
        return {
            name: xr.Variable(of.dims, np.asarray(of.values).astype(kinds.get(name, "float64")))
            for name, of in written.items()
        }

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
        wanted = (OPEN, FAILED) if again else (OPEN,)
        of = {n: status for n, (status, _) in self.ledger.points.items()}
        return [n for n in range(len(self.design)) if of.get(n, OPEN) in wanted]


def fitting(outcome: Outcome, design: Design, shapes: dict[str, dict[str, int]]) -> Outcome:
    """The outcome, failed if a measure cannot stand beside the others.

    A measure fails if its name, or one of its dimensions, is that of the study itself. A field
    fails if its shape is not that of the other points, `shapes`.
    """
    taken = {*OWN, *design.parameters, *design.sizes}

    def failed(reason: str) -> Outcome:
        return replace(outcome, status=FAILED, reason=reason, measures={})

    for name, of in outcome.measures.items():
        sizes = {str(dim): n for dim, n in of.sizes.items()}
        for word, what in [(name, "name"), *((dim, "dimension") for dim in sizes)]:
            if why := refused_name(word, taken):
                return failed(f"{name}: the {what} {word!r} {why}")
        if name in shapes and sizes != shapes[name]:
            return failed(
                f"{name} is a field of {sizes}, that of other points one of {shapes[name]}; "
                "interpolate it, or keep the grid with grow=False"
            )
    return outcome


def refused_name(name: str, taken: Iterable[str]) -> str:
    """Why a measure cannot have a name; nothing if it can."""
    if name in taken:
        return "is one that the study has itself: give another"
    if not name or name.startswith((".", "_")) or "/" in name or "\\" in name:
        return "must be that of an array in a store: not empty, no . or _ first, no / or \\ in it"
    if not name.isprintable() or len(name.encode()) > LONGEST:
        return f"must be that of a folder: at most {LONGEST} bytes, all of them printed"
    return ""


#: Longest name of an array of a store, as file systems have it [bytes].
LONGEST = 250


def check_names(design: Design, measures: Sequence[Measure]) -> None:
    """Refuse names of parameters and measures that the store of the study needs itself."""
    for key in design.parameters:
        if why := refused_name(key, {*OWN, TOGETHER}):
            raise ValueError(f"parameter {key!r}: {why}")
    for name in names_of(measures):
        if why := refused_name(name, {*OWN, *design.parameters, *design.sizes}):
            raise ValueError(f"measure {name!r} {why}")


def difference(there: dict[Any, Any], said: dict[str, str]) -> str:
    """In what two studies differ."""
    if there.get("measures") != said["measures"]:
        return f"it measures {there.get('measures')}, not {said['measures']}"
    theirs, ours = json.loads(there.get("study", "{}")), json.loads(said["study"])
    # Stores of before have no code, which is right where no measure is a function.
    parts = [
        name for name in ours if ours[name] != theirs.get(name, {} if name == "code" else None)
    ]
    if parts == ["code"]:
        before = theirs.get("code") or {}
        changed = [name for name, sum_of in ours["code"].items() if before.get(name) != sum_of]
        return (
            f"the code of the measure {', '.join(changed)}, what it refers to, or the version of "
            "Python is another"
        )
    if parts == ["files"]:
        before = theirs.get("files") or {}
        changed = [name for name, crc in ours["files"].items() if before.get(name) != crc]
        return f"{', '.join(changed or before)} has changed since"
    return f"they differ in {' and '.join(parts)}"


def template(
    design: Design, attrs: dict[str, Any], own: dict[str, tuple[str, Any, str, str]]
) -> xr.Dataset:
    """A study without a point: coordinates, and variables without values."""
    dataset = xr.Dataset(coords=design.coords(), attrs=attrs)
    shape = tuple(design.sizes.values())
    for name, (kind, empty, unit, meaning) in own.items():
        of_one: dict[str, Any] = {"units": unit, "long_name": meaning}
        if name == "status":
            of_one |= {"flag_values": [0, 1, 2], "flag_meanings": MEANINGS}
        dataset[name] = (tuple(design.sizes), np.full(shape, empty, dtype=kind), of_one)
    return dataset


def layout_of(dataset: xr.Dataset) -> int:
    """Checksum of the attributes and coordinates of a study."""
    attrs = json.dumps(dict(sorted(dataset.attrs.items())), default=str)
    attrs_of = attributes(dataset)
    sums = {
        str(name): checksum(of.variable, attrs_of[str(name)])
        for name, of in sorted(dataset.coords.items())
    }
    return zlib.crc32(json.dumps([attrs, sums]).encode())


def opened(place: str | os.PathLike[str]) -> xr.Dataset:
    """The dataset of a folder, read into memory."""
    with xr.open_zarr(place, chunks=None) as lazy:
        dataset: xr.Dataset = lazy.load()
    return dataset


def read(place: str | os.PathLike[str]) -> xr.Dataset:
    """The dataset of a study, read into memory and checked.

    Raises
    ------
    StoreError
        There is no study there, or a part of it is missing or damaged; the message names it.
    """
    folder = Path(place)
    if folder.is_dir():
        check_store(folder)
    if not (folder / FILE).exists():
        raise StoreError(f"{fspath(place)}: is not the store of a study: it has no file {FILE}")
    for _ in range(ATTEMPTS):
        ledger = Ledger(folder)
        try:
            dataset = opened(place)
        except Exception as error:
            message = " ".join(str(error).split())
            raise StoreError(f"{fspath(place)}: {type(error).__name__}: {message}") from error
        if dataset.attrs.get("kind") != "study":
            raise StoreError(f"{fspath(place)}: is not the store of a study")
        try:
            ledger.check(layout_of(dataset), dataset, dims_of(dataset))
            return dataset
        except StoreError:
            # Another process may have written meanwhile.
            if Ledger(folder).length == ledger.length:
                raise
    raise StoreError(f"{fspath(place)}: is being written too fast to be read")


def dims_of(dataset: xr.Dataset) -> list[str]:
    """Dimensions of the points."""
    if "status" not in dataset:
        raise StoreError("status: is missing")
    return [str(dim) for dim in dataset["status"].dims]
