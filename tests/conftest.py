"""Scenes that are small enough to be solved in a moment."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import pyfret as fret

#: Columns of the window that the tests are run in.
WINDOW = shutil.get_terminal_size().columns
# Tests compare texts in whole lines. `test_terminal.py` has the widths of windows.
os.environ["COLUMNS"] = "4000"


@pytest.hookimpl(trylast=True)
def pytest_configure(config: pytest.Config) -> None:
    """Keep the lines of pytest itself in the window."""
    if config.pluginmanager.has_plugin("terminalreporter"):
        config.get_terminal_writer().fullwidth = WINDOW


@pytest.fixture(autouse=True)
def _close_figures() -> Iterator[None]:
    yield
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")


@pytest.fixture
def without_layout(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw figures without the rounds of layout, which are most of the time of a small figure.

    `test_every_figure.py` and `test_figures.py` look at the layout.
    """
    import pyfret.plot  # noqa: F401

    # The package gives the function of this name.
    monkeypatch.setattr(sys.modules["pyfret.plot.style"], "settle", lambda *_: None)


@pytest.fixture
def without_overview(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the six panels out of pages: `test_report.py` draws them, which takes seconds."""
    from matplotlib.figure import Figure

    monkeypatch.setattr("pyfret.plot.overview", lambda *_, **__: Figure())


ROOT = Path(__file__).parents[1]

#: Computes the points of a study in this process. A process of its own imports the package anew.
SAME_PROCESS = ThreadPoolExecutor(1)

R, W, MU = 0.018, 1e3, 0.3
# Relative tolerance of the solutions, what the bounds of the tests are multiples of.
TOLERANCE = 1e-6
T_MAX = 0.9 * MU * W


def pair(nu: float) -> tuple[fret.Elastic, fret.Elastic]:
    """Two like bodies."""
    material = fret.Elastic(E=210e9, nu=nu)
    return material, material


def sphere_on_flat(*, nu: float = 0.3, ratio: float = 1.0, n: int = 32) -> fret.Scene:
    """The paper's geometry; a coating of `ratio` times the modulus unless it is 1."""
    steel, _ = pair(nu)
    a_H = fret.reference.hertz(R=R, bodies=(steel, steel), W=W).a
    coat = fret.Coating(fret.Elastic(E=ratio * steel.E, nu=nu), thickness=a_H)
    return fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R)),
        body2=fret.Body(steel, coatings=[] if ratio == 1.0 else [coat]),
        friction=MU,
        grid=fret.Grid.centred(width=2.4 * a_H, n=n),
        title=f"E1/E2 = {ratio:g}",
    )


def paper_path(indentation: int = 10, cycles: int = 45) -> fret.LoadPath:
    """The paper's load history: indentation, then two and a half cycles; t ends at 1."""
    path = fret.LoadPath.start().force(W=W, increments=indentation, t=0.1)
    for i, t in enumerate((0.2, 0.4, 0.6, 0.8, 1.0)):
        share = 1 if i == 0 else 2
        T = T_MAX if i % 2 == 0 else -T_MAX
        path = path.force(T_x=T, increments=share * cycles // 9, t=t)
    return path


@pytest.fixture(scope="session")
def coated() -> fret.Result:
    """The paper's scene with E1/E2 = 2 on a coarse grid, every tenth of the history kept."""
    path = paper_path()
    kept = [int(i) + 1 for i in range(len(path)) if abs(path.t[i] * 10 % 1) < 1e-9]
    settings = fret.Settings(tolerance=TOLERANCE)
    scene = sphere_on_flat(ratio=2.0).replace(settings=settings)
    return fret.solve(scene, path, save=kept, progress=False)


@pytest.fixture(scope="session")
def scene_file() -> Path:
    """The paper's scene as data."""
    return ROOT / "scenes" / "coated_fretting.toml"
