"""A store from somebody else is data: anything beside arrays to be read is refused by name."""

from __future__ import annotations

import json
import os
import shutil
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret._core import shown
from pyfret._util.text import html, literal

STEEL = fret.Elastic(E=210e9, nu=0.3)
EVIL = "a\x1b[2J\x1b]0;owned\x07b\u202ec\u2066$x_{"
SCENE = fret.Scene(
    body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(STEEL),
    friction=0.3,
    grid=fret.Grid.centred(width=2e-4, n=8),
    path=fret.LoadPath.start().normal(10.0, increments=1),
    title=EVIL,
)


@pytest.fixture(scope="module")
def sent(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run, a copy of it in each format, a study."""
    folder = tmp_path_factory.mktemp("sent")
    result = fret.solve(SCENE, out=folder / "run.zarr", progress=False)
    result.save(folder / "copy.zarr")
    with warnings.catch_warnings():
        # Zarr warns that format 3 has no consolidated metadata yet; xarray writes them.
        warnings.simplefilter("ignore")
        result.dataset.load().to_zarr(folder / "copy3.zarr", zarr_format=3)
    fret.study.run(
        SCENE,
        {"mu": [0.3]},
        measure="p_max",
        executor=SAME_PROCESS,
        progress=False,
        out=folder / "study.zarr",
    )
    return folder


def changed(store: Path, change: Callable[[dict[str, Any]], None]) -> None:
    """Change the metadata of an array, in its document and in the consolidated one."""
    own_values = store / "p_max" / (".zarray" if (store / ".zgroup").exists() else "zarr.json")
    document = json.loads(own_values.read_text())
    change(document)
    own_values.write_text(json.dumps(document))


def asks(version: int, what: str) -> Callable[[dict[str, Any]], None]:
    """A change that asks for something else."""

    def change(item: dict[str, Any]) -> None:
        if what == "codec" and version == 2:
            item["compressor"] = {"id": "pickle"}
        elif what == "codec":
            item["codecs"] = [{"name": "numcodecs.pickle", "configuration": {}}]
        elif what == "object" and version == 2:
            item |= {"dtype": "|O", "filters": [{"id": "vlen-utf8"}]}
        elif what == "object":
            item["data_type"] = "variable_length_bytes"
        else:
            item["shape"] = [1 << 40]

    return change


@pytest.mark.solves
@pytest.mark.parametrize("name", ["run", "copy", "copy3", "study"])
@pytest.mark.parametrize(
    ("what", "expected"),
    [("codec", "pickle"), ("object", "p_max"), ("size", "values by its shape")],
)
def test_what_pyfret_does_not_write_is_refused(
    sent: Path, tmp_path: Path, name: str, what: str, expected: str
) -> None:
    store = tmp_path / f"{name}.zarr"
    shutil.copytree(sent / f"{name}.zarr", store)
    assert fret.open(store) is not None
    changed(store, asks(3 if name == "copy3" else 2, what))
    with pytest.raises(fret.errors.StoreError, match=expected):
        fret.open(store)


@pytest.mark.skipif(os.name != "posix", reason="pipes of Unix")
def test_a_pipe_in_a_store_is_refused(sent: Path, tmp_path: Path) -> None:
    store = tmp_path / "run.zarr"
    shutil.copytree(sent / "run.zarr", store)
    (store / "p_max" / "0").unlink()
    os.mkfifo(store / "p_max" / "0")
    with pytest.raises(fret.errors.StoreError, match="is not a file"):
        fret.open(store)


def test_text_of_others_cannot_act(sent: Path) -> None:
    """Every way out: summary, repr, page, figure, progress, errors."""
    from pyfret._util.progress import Progress

    result = fret.open(sent / "run.zarr")
    bar = Progress(title=EVIL, shown=False)
    ways = {
        "summary": result.summary(),
        "repr": repr(result),
        "scene": repr(SCENE),
        "html of a run": result._repr_html_(),
        "html of a scene": SCENE._repr_html_(),  # type: ignore[attr-defined]
        "progress": bar.line(1.0),
        "html": html(EVIL),
        "figure": literal(EVIL),
        "shown": shown(EVIL),
    }
    with pytest.raises(fret.errors.StoreError) as raised:
        fret.fit.read_loops(sent / EVIL.replace("/", ""))
    ways["error"] = str(raised.value)
    for name, text in ways.items():
        acting = [c for c in text if (ord(c) < 32 and c not in "\n\t") or c in "\u202e\u2066"]
        assert not acting, f"{name}: {acting}"
