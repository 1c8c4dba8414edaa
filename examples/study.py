"""A study on a cluster: coatings of every stiffness and thickness, a killed worker included.

    python examples/study.py --out out              # 200 points on two workers of this machine
    python examples/study.py --out out --kill       # the same, one worker killed in the middle

Needs ``pip install "fretting[cluster]"``. The same call takes a client of any Dask cluster.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import time
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from distributed import Client, LocalCluster

import pyfret as fret

#: Radius of the sphere [m], normal force [N], coefficient of friction.
R, W, MU = 0.018, 1e3, 0.3
MEASURES = ("loop_energy", "energy_ratio", "stick_ratio", "p_max")


def contact(cells: int) -> fret.Scene:
    """A steel sphere on coated steel, pressed and led through one fretting cycle."""
    steel = fret.Elastic(E=210e9, nu=0.3)
    a_H = fret.reference.hertz(R=R, bodies=(steel, steel), W=W).a
    T = 0.7 * MU * W
    return fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R)),
        body2=fret.Body(steel, coatings=[fret.Coating(steel, thickness=a_H)]),
        friction=MU,
        grid=fret.Grid.centred(width=2.4 * a_H, n=cells),
        path=fret.LoadPath.start().normal(W).tangential([T, -T, T]),
        title="Sphere on a coated half-space",
    )


def main() -> None:
    """Run the study, say what it took, and draw it."""
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    store = options.out / ("study_killed.zarr" if options.kill else "study.zarr")
    shutil.rmtree(store, ignore_errors=True)
    stiff, thick = options.points
    parameters = {
        "body2.coatings.0.E.E_substrate": np.geomspace(0.25, 4.0, stiff),
        "body2.coatings.0.thickness.a_H": np.geomspace(0.1, 2.0, thick),
    }
    cluster = LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    )
    with cluster, Client(cluster) as client:

        def on_point(done: int, total: int) -> None:
            if options.kill and done == total // 2:
                pid = next(iter(client.run(os.getpid).values()))
                os.kill(pid, signal.SIGKILL)
                print(f"{done} points done: worker {pid} killed")

        started = time.perf_counter()
        study = fret.study.run(
            contact(options.cells),
            parameters,
            measure=MEASURES,
            executor=client,
            out=store,
            on_point=on_point,
        )
        wall = time.perf_counter() - started
    alone = float(study.dataset["seconds"].sum())
    print(f"{study!r}\n{wall:.1f} s; the points alone take {alone:.1f} s of a processor")
    draw(study, options.out / "study.png")


def draw(study: fret.study.Study, file: Path) -> None:
    """Contours of every measure."""
    with fret.plot.style():
        figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.2), layout="constrained")
        for ax, measure in zip(axes.flat, MEASURES, strict=True):
            study.map(measure, ax=ax)
            ax.set_xlabel("$E_1/E_2$")
            ax.set_ylabel("$h/a_H$")
        figure.savefig(file, dpi=120)
    plt.close(figure)


def arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of the results")
    parser.add_argument("--kill", action="store_true", help="kill a worker in the middle")
    parser.add_argument("--cells", type=int, default=64, help="cells along a side")
    parser.add_argument(
        "--points", type=int, nargs=2, default=(20, 10), help="values of E1/E2 and of h/a_H"
    )
    return parser.parse_args()


if __name__ == "__main__":
    main()
