"""Files of the corpus that were cut, changed in a byte, or given another head.

Each is refused by its name, or read as before. A format without a checksum hides a changed byte of
a number: the result may differ in values, but not in shape. A text that states no number of its
lines hides that its end is missing: the result may have fewer points.
"""

from __future__ import annotations

import random
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from test_real_files import CORPUS, ROWS, read

pytestmark = pytest.mark.solves

#: Damages of each file.
OF_EACH = 5
#: Seconds that a damaged file may take.
LONGEST = 5.0
#: Formats with checksums: no other result than the right one is allowed.
CHECKED = ("X3P", "NumPy archive", "Excel")
#: Texts that state no number of lines: the end may be missing.
WITHOUT_COUNT = ("text", "points x, y, z", "Abaqus keywords")
READABLE = [row for row in ROWS if "refused" not in row]


def damage(content: bytes, rng: random.Random) -> bytes:
    """Cut a file, change a byte, or overwrite its head."""
    kind = rng.randrange(4)
    if kind == 0:
        return content[: rng.randrange(len(content))]
    changed = bytearray(content)
    if kind < 3:
        at = rng.randrange(len(changed))
        changed[at] ^= 1 << rng.randrange(8)
    else:
        at = rng.randrange(min(64, len(changed)))
        changed[at : at + 8] = rng.randbytes(min(8, len(changed) - at))
    return bytes(changed)


def attempt(row: dict[str, Any]) -> Any:
    """Read a file, or return why it is refused; any other exception is a fault."""
    try:
        return read(row)
    except (ValueError, fret.errors.StoreError) as refusal:
        return str(refusal)


def summary(result: Any) -> tuple[tuple[int, ...], np.ndarray]:
    """Return the shape and the numbers of a result."""
    if isinstance(result, fret.SurfaceMap):
        return result.values.shape, np.r_[result.values.ravel(), result.spacing]
    if isinstance(result, fret.fit.Loops):
        return (0,), np.r_[result.delta, result.T]
    if isinstance(result, float):
        return (), np.array([result])
    return (len(result.points),), result.points.ravel()


@pytest.mark.parametrize("row", READABLE, ids=[row["file"] for row in READABLE])
def test_damaged_files_are_refused_by_name_or_read(
    row: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rng = random.Random(row["file"])
    content = (CORPUS / row["file"]).read_bytes()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        shape, right = summary(read(row))
    monkeypatch.setattr("test_real_files.CORPUS", tmp_path)
    path = tmp_path / row["file"]
    for _ in range(OF_EACH):
        path.write_bytes(damage(content, rng))
        begin = time.process_time()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = attempt(row)
        assert time.process_time() - begin < LONGEST
        if isinstance(result, str):
            assert row["file"] in result
            assert "\n" not in result
            continue
        new_shape, numbers = summary(result)
        whole = new_shape == shape and numbers.size == right.size
        if not whole:
            assert row["format"] in WITHOUT_COUNT
            assert numbers.size < right.size
        same = whole and np.allclose(numbers, right, rtol=1e-6, atol=1e-15)
        if row["format"] in CHECKED and not same:
            assert caught, "another result without a word"
