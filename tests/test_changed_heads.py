"""The heads of the arrays of stores: a changed one is refused, or changes no number."""

from __future__ import annotations

import json
import shutil
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret

pytestmark = pytest.mark.solves

#: Arrays whose heads are changed: a field, a number of the increments, a coordinate, a measure.
ARRAYS = ("p", "W", "x", "p_max", "status", "depth2")
#: The collected metadata repeat the heads: two arrays show it.
COLLECTED = ("p", "p_max")
#: Other values of the entries of a head.
OTHERS = {"C": "F", "<f8": "<i8", "<i4": "<f4", "|b1": "|i1", "|i1": "|b1", "|u1": "|i1"}


def changed(value: Any) -> Any:
    """Return another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + 1
    if isinstance(value, str):
        return OTHERS.get(value, f"{value}x")
    if isinstance(value, list) and value:
        return [changed(value[0]), *value[1:]]
    if isinstance(value, dict) and value:
        last = sorted(value)[-1]
        return {**value, last: changed(value[last])}
    return 1


@pytest.fixture(scope="module")
def stores(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """A run, a copy of it, and a study."""
    folder = tmp_path_factory.mktemp("heads")
    steel = fret.Elastic(E=210e9, nu=0.3)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=0.01)),
        body2=fret.Body(steel),
        friction=0.3,
        grid=fret.Grid.from_spacing((16, 14), (5e-5, 5e-5)),
        path=fret.LoadPath.start().normal(100.0, increments=2),
    )
    fret.solve(scene, out=folder / "run.zarr", progress=False).save(folder / "copy.zarr")
    fret.study.run(
        scene,
        {"mu": [0.2, 0.4]},
        measure="p_max",
        executor=ThreadPoolExecutor(1),
        out=folder / "study.zarr",
        progress=False,
    )
    return {path.stem: path for path in folder.iterdir()}


@pytest.mark.parametrize("kind", ["run", "copy", "study"])
def test_a_changed_head_is_refused_or_changes_nothing(
    kind: str, stores: dict[str, Path], tmp_path: Path
) -> None:
    """Every entry of the heads of some arrays, in their files and in the collected metadata."""
    store = tmp_path / f"{kind}.zarr"
    shutil.copytree(stores[kind], store)
    expected = fret.open(store).dataset.load()
    collected = store / ".zmetadata"
    whole = collected.read_bytes()
    wrong, refused = [], 0
    for head in (store / name / ".zarray" for name in ARRAYS):
        if not head.exists():
            continue
        written = head.read_bytes()
        for key, value in json.loads(written).items():
            document = json.loads(written) | {key: changed(value)}
            for collects in (False, True)[: 1 + (head.parent.name in COLLECTED)]:
                head.write_text(json.dumps(document))
                if collects:
                    documents = json.loads(whole)
                    documents["metadata"][head.relative_to(store).as_posix()] = document
                    collected.write_text(json.dumps(documents))
                text = f"{head.parent.name}: {key} = {document[key]!r}, collected {collects}"
                try:
                    opened = fret.open(store).dataset.load()
                    if not collects:
                        wrong.append(f"{text}: is not noticed")
                    for name, variable in expected.items():
                        np.testing.assert_array_equal(opened[name], variable, text)
                except fret.errors.StoreError as error:
                    refused += 1
                    if "\n" in str(error) or not str(error).strip():
                        wrong.append(f"{text}: {error}")
                finally:
                    head.write_bytes(written)
                    collected.write_bytes(whole)
    assert not wrong, "\n".join(wrong)
    assert refused > 20
