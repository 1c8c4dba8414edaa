"""The store of a study: a Zarr group that is laid out first and filled point by point.

It is laid out beside its place and put there at once, and has one writer. A point counts once its
line stands in the ledger, after its values: whoever is killed leaves points that are done or open.
"""

from __future__ import annotations

import json
import os
import shutil
import time
import zlib
from dataclasses import replace
from os import fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import StoreError, __version__
from pyfret._util.files import UNFINISHED, clear_leftovers, deflate, leftover
from pyfret._util.lazy import xr
from pyfret._util.stores import check_heads, check_store
from pyfret.study.design import TOGETHER
from pyfret.study.ledger import FILE, Ledger, attributes, checksum
from pyfret.study.measures import measure_names
from pyfret.study.point import FAILED, MEANINGS, OPEN, PARTLY, Outcome

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pyfret.study.design import Design
    from pyfret.study.measures import Measure

__all__ = ["Store", "read_study"]

#: Version of the layout.
SCHEMA = 2
#: Attempts to read a store while it is written.
ATTEMPTS = 20
#: Seconds between two comparisons of heads.
PAUSE = 0.05
#: Characters of a reason that are kept.
REASON = 800
#: Variables of every study beside its measures: type, value of an open point, unit, meaning.
POINT_VARIABLES: dict[str, tuple[str, Any, str, str]] = {
    "nx": ("int32", 0, "1", "cells along x that the point took"),
    "ny": ("int32", 0, "1", "cells along y that the point took"),
    "seconds": ("float64", np.nan, "s", "processor time of the point"),
    "reason": (
        f"<U{REASON}",
        "",
        "1",
        "why the point failed, or its measures have no number",
    ),
    "status": ("int8", OPEN, "1", "what became of the point"),
}


class Store:
    """A running study in a folder that :meth:`prepare` has made.

    Parameters
    ----------
    place : path
        Folder.
    design : Design
        The points.
    said : dict of str to str
        Attributes that distinguish the study (``study``, ``measures``) or its title.
    """

    def __init__(
        self, place: str | os.PathLike[str], design: Design, study_attrs: dict[str, str]
    ) -> None:
        self.place, self.design = Path(place), design
        remove_partial_files(self.place)
        self.check(study_attrs)
        point_dims = set(design.sizes)
        self.ledger = Ledger(self.place)
        stored = read_study(self.place)
        self.shapes: dict[str, dict[str, int]] = {
            str(name): {str(k): n for k, n in variable.sizes.items() if k not in point_dims}
            for name, variable in stored.data_vars.items()
        }
        self.attrs = attributes(stored)
        last = self.ledger.last
        if (
            last is not None
            and stored["status"].values.ravel()[last] != self.ledger.points[last][0]
        ):
            # A killed process has written the line and not the status.
            self.write_status(last, self.ledger.points[last][0])

    @staticmethod
    def prepare(place: str | os.PathLike[str], design: Design, study_attrs: dict[str, str]) -> None:
        """Lay out the store of a study where there is nothing."""
        target = Path(place)
        clear_leftovers(target)
        if target.exists():
            return
        unfinished = leftover(target, UNFINISHED)
        shutil.rmtree(unfinished, ignore_errors=True)
        try:
            empty_study = empty_dataset(design, {**study_attrs, **Store.marks()}, POINT_VARIABLES)
            shape = tuple(design.sizes.values())
            encoding: dict[str, Any] = {str(name): deflate() for name in empty_study.variables}
            encoding |= {
                name: {"chunks": shape, "_FillValue": None, **deflate()} for name in POINT_VARIABLES
            }
            empty_study.to_zarr(
                unfinished, mode="w-", zarr_format=2, consolidated=True, encoding=encoding
            )
            Ledger.begin(unfinished, layout_checksum(load_folder(unfinished)))
            try:
                unfinished.rename(target)
            except OSError:
                # Another process may have been faster.
                if not target.exists():
                    raise
        finally:
            shutil.rmtree(unfinished, ignore_errors=True)

    @staticmethod
    def marks() -> dict[str, Any]:
        """Attributes of every store of a study."""
        return {"kind": "study", "schema": SCHEMA, "version": __version__}

    def check(self, study_attrs: dict[str, str]) -> None:
        """Reject a store of another study."""
        stored = read_study(self.place).attrs
        for name in ("study", "measures"):
            if stored.get(name) != study_attrs[name]:
                raise StoreError(
                    f"{self.place}: is the store of another study; "
                    f"{describe_difference(stored, study_attrs)}. "
                    "Give another place, or the same study to go on with it"
                )

    def make_room(self, measures: dict[str, xr.Variable]) -> None:
        """Lay out the arrays of the measures of the first point that is done."""
        new_measures = {
            name: variable for name, variable in measures.items() if name not in self.shapes
        }
        if not new_measures:
            return
        for name in new_measures:
            # A killed process may have left a part of it.
            shutil.rmtree(self.place / name, ignore_errors=True)
        sizes = self.design.sizes
        new_arrays, encoding = xr.Dataset(attrs=read_study(self.place).attrs), {}
        for name, variable in new_measures.items():
            # A field has a chunk for each point, scalars of all points share one.
            chunk = tuple(1 for _ in sizes) if variable.ndim else tuple(sizes.values())
            values = np.full((*sizes.values(), *variable.shape), np.nan)
            new_arrays[name] = ((*sizes, *variable.dims), values, variable.attrs)
            encoding[name] = {
                "chunks": (*chunk, *variable.shape),
                "_FillValue": np.nan,
                **deflate(),
            }
        new_arrays.to_zarr(
            self.place, mode="a", zarr_format=2, consolidated=True, encoding=encoding
        )
        self.shapes |= {
            name: {str(k): n for k, n in variable.sizes.items()}
            for name, variable in new_measures.items()
        }
        self.attrs = attributes(load_folder(self.place))

    def write(self, n: int, outcome: Outcome) -> None:
        """Write the outcome of the n-th point, its status last."""
        if n in self.ledger.points:
            self.ledger.add(n, OPEN, {}, {})
            self.write_status(n, OPEN)
        outcome = reject_misfits(outcome, self.design, self.shapes)
        self.make_room(outcome.measures)
        numbers = {
            "nx": np.int32(outcome.nx),
            "ny": np.int32(outcome.ny),
            "seconds": outcome.seconds,
        }
        values = {name: xr.Variable((), value) for name, value in numbers.items()}
        if outcome.status in (FAILED, PARTLY):
            values["reason"] = xr.Variable((), np.array(outcome.reason, f"<U{REASON}"))
        written = {**values, **outcome.measures}
        self.write_region(n, written)
        # Times differ from run to run: without them the same study gives the same ledger.
        stored = {k: v for k, v in self.as_stored(written).items() if k != "seconds"}
        self.ledger.add(n, outcome.status, stored, self.attrs)
        self.write_status(n, outcome.status)

    def write_status(self, n: int, status: int) -> None:
        """Write the status of the n-th point."""
        self.write_region(n, {"status": xr.Variable((), np.int8(status))})

    def as_stored(self, written: dict[str, xr.Variable]) -> dict[str, xr.Variable]:
        """Convert written values to the types of the arrays."""
        kinds = {name: column[0] for name, column in POINT_VARIABLES.items()}
        return {
            name: xr.Variable(
                variable.dims, np.asarray(variable.values).astype(kinds.get(name, "float64"))
            )
            for name, variable in written.items()
        }

    def write_region(self, n: int, values: dict[str, xr.Variable]) -> None:
        """Write variables of one point."""
        if not values:
            return
        index = dict(zip(self.design.sizes, self.design.place(n), strict=True))
        point_dataset = xr.Dataset(
            {
                name: (
                    (*index, *variable.dims),
                    variable.values.reshape((1,) * len(index) + variable.shape),
                )
                for name, variable in values.items()
            }
        )
        point_dataset.to_zarr(
            self.place,
            mode="r+",
            zarr_format=2,
            consolidated=True,
            region={dim: slice(i, i + 1) for dim, i in index.items()},
        )

    def open_points(self, *, again: bool) -> list[int]:
        """Return the points to solve: open ones, and with `again` failed and partly done ones."""
        statuses = (OPEN, FAILED, PARTLY) if again else (OPEN,)
        status_of = {n: status for n, (status, _) in self.ledger.points.items()}
        return [n for n in range(len(self.design)) if status_of.get(n, OPEN) in statuses]


def remove_partial_files(place: Path) -> None:
    """Remove the files that a killed process began to write; Zarr moves a file when it is whole."""
    for path in place.rglob("*.partial"):
        path.unlink(missing_ok=True)


def reject_misfits(outcome: Outcome, design: Design, shapes: dict[str, dict[str, int]]) -> Outcome:
    """Return the outcome, as failed if a measure does not fit the study.

    A measure fails if the study itself uses its name, or the name of one of its dimensions. A field
    fails if its shape differs from the other points, `shapes`.
    """
    taken = {*POINT_VARIABLES, *design.parameters, *design.sizes}

    def failed(reason: str) -> Outcome:
        """Return the outcome as failed for a reason."""
        return replace(outcome, status=FAILED, reason=reason, measures={})

    for name, variable in outcome.measures.items():
        sizes = {str(dim): n for dim, n in variable.sizes.items()}
        for word, kind in [(name, "name"), *((dim, "dimension") for dim in sizes)]:
            if why := why_invalid(word, taken):
                return failed(f"{name}: the {kind} {word!r} {why}")
        if name in shapes and sizes != shapes[name]:
            return failed(
                f"{name} is a field of {sizes}, at other points one of {shapes[name]}; "
                "interpolate it, or keep the grid with grow=False"
            )
    return outcome


def why_invalid(name: str, taken: Iterable[str]) -> str:
    """Return why a measure cannot have a name; an empty text if it can."""
    if name in taken:
        return "is one that the study has itself: give another"
    if not name or name.startswith((".", "_")) or "/" in name or "\\" in name:
        return "must name an array in a store: not empty, no . or _ first, no / or \\ in it"
    if not name.isprintable() or len(name.encode()) > LONGEST:
        return f"must name a folder: at most {LONGEST} bytes, all of them printed"
    return ""


#: Longest name of an array of a store, as file systems have it [bytes].
LONGEST = 250


def check_names(design: Design, measures: Sequence[Measure]) -> None:
    """Reject names of parameters and measures that the store of the study needs itself."""
    for key in design.parameters:
        if why := why_invalid(key, {*POINT_VARIABLES, TOGETHER}):
            raise ValueError(f"parameter {key!r}: {why}")
    for name in measure_names(measures):
        if why := why_invalid(name, {*POINT_VARIABLES, *design.parameters, *design.sizes}):
            raise ValueError(f"measure {name!r} {why}")


def describe_difference(stored: dict[Any, Any], study_attrs: dict[str, str]) -> str:
    """Describe the difference of two studies."""
    if stored.get("measures") != study_attrs["measures"]:
        return f"it measures {stored.get('measures')}, not {study_attrs['measures']}"
    theirs, ours = json.loads(stored.get("study", "{}")), json.loads(study_attrs["study"])
    # A store without measures that are functions has no code.
    parts = [
        name for name in ours if ours[name] != theirs.get(name, {} if name == "code" else None)
    ]
    if parts == ["code"]:
        old_checksums = theirs.get("code") or {}
        changed = [
            name for name, sum_of in ours["code"].items() if old_checksums.get(name) != sum_of
        ]
        return (
            f"the code of the measure {', '.join(changed)}, what it refers to, or the version of "
            "Python is another"
        )
    if parts == ["files"]:
        old_checksums = theirs.get("files") or {}
        changed = [name for name, crc in ours["files"].items() if old_checksums.get(name) != crc]
        return f"{', '.join(changed or old_checksums)} has changed since"
    return f"they differ in {' and '.join(parts)}"


def empty_dataset(
    design: Design, attrs: dict[str, Any], variables: dict[str, tuple[str, Any, str, str]]
) -> xr.Dataset:
    """Make an empty study: coordinates, and variables without values."""
    dataset = xr.Dataset(coords=design.coords(), attrs=attrs)
    shape = tuple(design.sizes.values())
    for name, (kind, empty, unit, meaning) in variables.items():
        variable_attrs: dict[str, Any] = {"units": unit, "long_name": meaning}
        if name == "status":
            variable_attrs |= {"flag_values": [0, 1, 2], "flag_meanings": MEANINGS}
        dataset[name] = (tuple(design.sizes), np.full(shape, empty, dtype=kind), variable_attrs)
    return dataset


def layout_checksum(dataset: xr.Dataset) -> int:
    """Compute a checksum of the attributes and coordinates of a study."""
    attrs = json.dumps(dict(sorted(dataset.attrs.items())), default=str)
    attrs_of = attributes(dataset)
    sums = {
        str(name): checksum(coordinate.variable, attrs_of[str(name)])
        for name, coordinate in sorted(dataset.coords.items())
    }
    return zlib.crc32(json.dumps([attrs, sums]).encode())


def load_folder(place: str | os.PathLike[str]) -> xr.Dataset:
    """Read the dataset of a folder into memory."""
    with xr.open_zarr(place, chunks=None) as lazy:
        dataset: xr.Dataset = lazy.load()
    return dataset


def read_study(place: str | os.PathLike[str]) -> xr.Dataset:
    """Read the dataset of a study into memory and check it.

    Raises
    ------
    StoreError
        There is no study there, or a part of it is missing or damaged; the message names it.
    """
    folder = Path(place)
    if folder.is_dir():
        check_store(folder)
        check_heads_in_time(folder)
    if not (folder / FILE).exists():
        raise StoreError(f"{fspath(place)}: is not the store of a study: it has no file {FILE}")
    for _ in range(ATTEMPTS):
        ledger = Ledger(folder)
        try:
            dataset = load_folder(place)
        except Exception as error:
            message = " ".join(str(error).split())
            raise StoreError(f"{fspath(place)}: {type(error).__name__}: {message}") from error
        if dataset.attrs.get("kind") != "study":
            raise StoreError(f"{fspath(place)}: is not the store of a study")
        try:
            ledger.check(layout_checksum(dataset), dataset, point_dims(dataset))
            return dataset
        except StoreError:
            # Another process may have written meanwhile.
            if Ledger(folder).length == ledger.length:
                raise
    raise StoreError(f"{fspath(place)}: is being written too fast to be read")


def check_heads_in_time(folder: Path) -> None:
    """Compare the heads of the arrays, again if another process lays out arrays meanwhile."""
    for attempt in range(ATTEMPTS):
        try:
            check_heads(folder)
            return
        except StoreError:
            if attempt + 1 == ATTEMPTS:
                raise
            time.sleep(PAUSE)


def point_dims(dataset: xr.Dataset) -> list[str]:
    """Return the dimensions of the points."""
    if "status" not in dataset:
        raise StoreError("status: is missing")
    return [str(dim) for dim in dataset["status"].dims]
