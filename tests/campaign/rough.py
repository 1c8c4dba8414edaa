"""Rough balls beside the theorem of Ciavarella and Jaeger, and beside finer points.

    python tests/campaign/rough.py theorem FIRST COUNT
    python tests/campaign/rough.py points FIRST COUNT
    python tests/campaign/rough.py cycle FIRST COUNT
    python tests/campaign/rough.py presets FIRST COUNT

`theorem`: like bodies with nu = 0 under a cycle of T_x, on 128 x 128 points. With the approach d(W)
of pressing alone, its elastic energy U(W) and its real area A(W),

    q = mu (p(W) - p(W - T/mu)),  delta_x = mu (d(W) - d(W - T/mu)),
    stick ratio = A(W - T/mu)/A(W),

(M. Ciavarella, Int. J. Solids Struct. 35 (1998) 2349; J. Jaeger, Arch. Appl. Mech. 65 (1995) 478),
and by Masing's rule a cycle dissipates

    8 (T delta_x/2 - mu^2 (d(W) T/mu - C(W) + C(W - T/mu))),  C = W d - U.

`points`: the same band-limited surface on 128, 256 and 512 points. Real area, largest pressure and
approach of the first two lie within 1.5 of their errors of the third.

`cycle`: processor time of a cycle of shear over the pressing before it, on 512 x 512 points of
self-affine surfaces, in one increment per branch.

`presets`: processor time of pressing, from the scene to the pressure, over the time with the preset
`spinu2020`; medians of repetitions in turn, on 128, 256 and 512 points of self-affine surfaces.
Surfaces whose contact leaves the map are left out.
"""

from __future__ import annotations

import sys
import time
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import pyfret as fret

sys.path.insert(0, str(Path(__file__).parents[1]))
from rough_balls import band_limited, scene, surface

MU = 0.4
#: Ratio of a true error to its bar that counts as covered.
MOST = 1.5

Row = dict[str, float]


def pressed(z: np.ndarray, pitch: float, W: float, **parts: object) -> fret.Result:
    """The ball under a force alone."""
    made = scene(z, pitch, **parts)
    return fret.solve(made, fret.LoadPath.start().normal(W, increments=1), progress=False)


def theorem(seed: int) -> Iterator[Row]:
    """Largest deviations of a cycle from the theorem, over their sizes."""
    z, pitch, W = band_limited(seed, 128)
    T = MU * W * float(np.random.default_rng([seed, 85]).uniform(0.2, 0.9))
    exact = fret.Settings(tolerance=1e-8)
    parts = {"nu": 0.0, "settings": exact}
    path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=1)
    made = scene(z, pitch, friction=MU, **parts)
    result = fret.solve(made, path, error=True, progress=False)
    ends = [pressed(z, pitch, load, **parts) for load in (W, W - T / MU)]
    full, reduced = (np.asarray(end.at(-1).p) for end in ends)
    d, U, A = (
        [float(end.dataset[name][-1]) for end in ends]
        for name in ("delta_z", "elastic", "real_area")
    )
    at, numbers = result.at(-1), result.dataset
    shift = MU * (d[0] - d[1])
    C = [load * d[k] - U[k] for k, load in enumerate((W, W - T / MU))]
    lost = 8 * (0.5 * T * shift - MU**2 * (d[0] * T / MU - C[0] + C[1]))
    bars = result.error_bars().sel(part="total")
    ratio = A[1] / A[0]
    dissipated = float(numbers.dissipated[-2:].sum())
    yield {
        "T/(mu W)": T / (MU * W),
        "q": float(np.abs(np.asarray(at.q_x) - MU * (full - reduced)).max() / (MU * full.max())),
        "delta_x": abs(float(numbers.delta_x[-1]) / shift - 1),
        "loop": abs(dissipated / lost - 1),
        "stick ratio": abs(float(numbers.stick_ratio[-1]) - ratio) / float(bars.stick_ratio[-1]),
        "stick ratio, difference": abs(float(numbers.stick_ratio[-1]) - ratio),
    }


def points(seed: int) -> Iterator[Row]:
    """True errors over the printed ones, on 128 and 256 points."""
    truth = pressed(*band_limited(seed, 512)).dataset.isel(increment=-1)
    for n in (128, 256):
        z, pitch, W = band_limited(seed, n)
        path = fret.LoadPath.start().normal(W, increments=1)
        result = fret.solve(scene(z, pitch), path, error=True, progress=False)
        row, bars = result.dataset.isel(increment=-1), result.error_bars().sel(part="total")
        errors = {
            "real_area": float(np.hypot(row.real_area_error, truth.real_area_error)),
            "p_max": float(bars.p_max[-1]),
            "delta_z": float(bars.delta_z[-1]),
        }
        ratios = {k: abs(float(row[k] - truth[k])) / error for k, error in errors.items()}
        yield {"points": n, **ratios}


def cycle(seed: int) -> Iterator[Row]:
    """Processor time of two branches of a cycle over the time of the pressing."""
    z, pitch, W = surface(seed, 512)
    T = 0.5 * MU * W
    path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=1)
    march = fret._core.March(scene(z, pitch, friction=MU).replace(path=path))
    spent = []
    for _ in range(4):
        begun = time.process_time()
        next(march)
        spent.append(time.process_time() - begun)
    yield {"pressing [s]": spent[0], "cycle over pressing": sum(spent[2:]) / spent[0]}


def presets(seed: int) -> Iterator[Row]:
    """Processor time of pressing with the preset `fast` over the time with `spinu2020`."""
    row: Row = {}
    for n, repetitions in ((128, 15), (256, 7), (512, 3)):
        z, pitch, W = surface(seed, n)
        path = fret.LoadPath.start().normal(W, increments=1)
        marches = {
            name: scene(z, pitch, settings=fret.Settings(preset=name, tolerance=1e-6)).replace(
                path=path
            )
            for name in ("fast", "spinu2020")
        }
        spent: dict[str, list[float]] = {name: [] for name in marches}
        for _ in range(repetitions):
            for name, made in marches.items():
                begun = time.process_time()
                try:
                    next(fret._core.March(made))
                except fret.errors.OffGridError:
                    return
                spent[name].append(time.process_time() - begun)
        row[f"{n}"] = float(np.median(spent["fast"]) / np.median(spent["spinu2020"]))
    yield row


PARTS = {"theorem": theorem, "points": points, "cycle": cycle, "presets": presets}


def main() -> None:
    """Print a line for each surface, and the largest ratios."""
    part, first, count = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    rows: list[Row] = []
    for seed in range(first, first + count):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for row in PARTS[part](seed):
                rows.append(row)
                print(seed, *(f"{k} {v:.3g}" for k, v in row.items()), flush=True)
    for name in rows[0]:
        values = np.array([row[name] for row in rows])
        print(f"{name}: median {np.median(values):.3g}, largest {values.max():.3g}", end=", ")
        print(f"{np.mean(values <= MOST):.0%} below {MOST}")


if __name__ == "__main__":
    main()
