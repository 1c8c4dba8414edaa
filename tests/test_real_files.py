"""Files that other programs wrote: what comes out is right, or the file is refused by its name.

`data/corpus/table.json` has the right numbers of each file, and `data/corpus/make` the scripts that
write the files with the programs. `docs/files.md` is made of the table (`tools/files_page.py`).
"""

from __future__ import annotations

import json
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret.export.meshes import read_mesh

CORPUS = Path(__file__).parent / "data" / "corpus"
ROWS: list[dict[str, Any]] = json.loads((CORPUS / "table.json").read_text())
#: Heights of the maps at the points (x, y).
HEIGHTS = 1e-6 * np.add.outer(np.arange(5.0), 10.0 * np.arange(3))
#: The middle of the bar of finite elements, in mm.
FRAME = fret.export.Frame(origin=(1.0, 0.5, 0.5), unit="mm")
LARGEST = 30_000


def read(row: dict[str, Any]) -> Any:
    """Read a file of the table by the reader of its kind."""
    path, options = CORPUS / row["file"], dict(row["options"])
    if row["reader"] == "read_surface":
        if "spacing" in options:
            options["spacing"] = tuple(options["spacing"])
        return fret.read_surface(path, **options)
    if row["reader"] == "fit.read_loops":
        return fret.fit.read_loops(path, **options)
    if row["reader"] == "mesh":
        return read_mesh(path)
    return fret.export.bulk_stress(path, frame=FRAME, **options)


def check_map(surface: fret.SurfaceMap, right: dict[str, Any]) -> None:
    values, filled = surface.values, right.get("filled", 0)
    assert values.shape == tuple(right["shape"])
    np.testing.assert_allclose(surface.spacing, right["spacing"], rtol=1e-6)
    assert surface.filled == filled
    # A filled point has the mean of its neighbours: nearly a plane.
    tolerance = 2e-6 if filled else 2e-9
    np.testing.assert_allclose(
        values - values.mean(), HEIGHTS - HEIGHTS.mean(), atol=tolerance, rtol=0.0
    )
    assert surface.peak_to_valley == pytest.approx(right["range"], abs=2e-9)


def check(row: dict[str, Any], result: Any) -> None:
    right = row["right"]
    if row["reader"] == "read_surface":
        check_map(result, right)
    elif row["reader"] == "fit.read_loops":
        assert result.delta.size == right["points"]
        assert result.cycle.max() + 1 == right["cycles"]
        assert np.ptp(result.delta) == pytest.approx(right["shift"], rel=1e-4)
        assert np.abs(result.T).max() == pytest.approx(right["force"], rel=1e-3)
    elif row["reader"] == "mesh":
        assert sum(len(rows) for rows in result.volumes) == right["elements"]
        np.testing.assert_allclose(np.ptp(result.points, axis=0), right["size"])
    else:
        assert result == pytest.approx(right["stress"], rel=1e-3)


@pytest.mark.parametrize("row", ROWS, ids=[row["file"] for row in ROWS])
def test_files_are_read_right_or_refused(
    row: dict[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        if "refused" in row:
            with pytest.raises((ValueError, fret.errors.StoreError)) as refusal:
                read(row)
            assert re.search(row["refused"], str(refusal.value))
            assert row["file"] in str(refusal.value)
            return
        check(row, read(row))
    printed = capsys.readouterr().err + "".join(str(warning.message) for warning in caught)
    assert row.get("note", "") in printed
    if row["reader"] == "read_surface":
        assert "pitch 2 µm x 1 µm, size 10 µm x 3 µm, S_q" in printed


def test_the_corpus_is_whole() -> None:
    files = {path.name for path in CORPUS.iterdir() if path.is_file()}
    listed = {row["file"] for row in ROWS} | {"table.json", "README.md", "ccx_diverged.sta"}
    assert files == listed
    assert len({row["format"] for row in ROWS}) >= 20
    assert max((CORPUS / name).stat().st_size for name in files) <= LARGEST
