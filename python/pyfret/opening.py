"""One door for what was saved: runs, runs of wear, studies, fits, cracks."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret._core import StoreError, read_bytes, shown
from pyfret._util import files
from pyfret.fatigue.damage import Damage
from pyfret.fatigue.distance import OverDistance
from pyfret.fatigue.judged import Life
from pyfret.fit.stored import fit_from_dataset
from pyfret.fracture.growth import Cracks
from pyfret.history.loops import CountedLoops
from pyfret.quantities import quantities
from pyfret.result import open_result
from pyfret.study.ledger import FILE
from pyfret.study.outcome import Study, open_study
from pyfret.wear.runs import open_run

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    import xarray as xr

__all__ = ["open"]

#: What `save` has written of things that have no store, by their kind.
COPIES: dict[Any, Callable[[xr.Dataset], Any]] = {
    "study": Study,
    "Study": Study,
    "CountedLoops": CountedLoops,
    "Cracks": Cracks,
    "Damage": Damage,
    "Life": Life.from_dataset,
    "OverDistance": OverDistance,
    "FitResult": fit_from_dataset,
}


@quantities
def open(path: str | os.PathLike[str]) -> Any:
    """Open what pyfret has saved: a run, wear, a study, a fit, cracks, lives.

    Fields are read when they are asked for. What is read is what was written: values have
    checksums. A store of up to 64 MB is checked as a whole when it is opened. The fields of a
    larger one are checked when they are read. What ``save`` wrote is checked up to 256 MB. What the
    metadata ask for beside being read is refused by name: a codec of another program, for instance.

    Returns
    -------
    Result, WearResult, Study, FitResult, Cracks, Life or OverDistance
        By what is there.

    Raises
    ------
    StoreError
        There is no store, or a file of it is missing or damaged; the message names both.
    """
    # The function that opens what is there looks at the chunks.
    files.checked(path, chunks=False)
    attributes = _attributes(Path(path))
    kind = attributes.get("kind")
    if kind == "study" and (Path(path) / FILE).exists():
        return open_study(path)
    if kind in COPIES:
        dataset = files.opened(path)
        if kind != "study":
            del dataset.attrs["kind"]
        try:
            return COPIES[kind](dataset)
        except StoreError as error:
            raise StoreError(shown(f"{path}: {error}")) from error
    if "wear" in attributes:
        return open_run(path)
    return open_result(path)


def _attributes(path: Path) -> dict[str, Any]:
    """Return the attributes of a store or a copy; none where they cannot be read."""
    if path.suffix == ".nc":
        with files.opened(path) as dataset:
            return dict(dataset.attrs)
    for name in ("zarr.json", ".zattrs"):
        try:
            document = json.loads(read_bytes(path / name))
        except (OSError, ValueError):
            continue
        if isinstance(document, dict):
            inner = document.get("attributes", document)
            return inner if isinstance(inner, dict) else {}
    return {}
