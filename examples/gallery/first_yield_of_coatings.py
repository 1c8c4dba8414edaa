"""
First yield below coated balls
==============================

Pressure p_H at which yield begins (von Mises) over the yield stress, under a ball without
friction: coatings of E1 on a substrate of E2 and of the same yield stress, h thick. p_H and a_H are
those of the uncoated pair at that load. Without a coating it is 1.61.
"""

from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
W = 10.0
a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W).a


def scene(ratio: float, thickness: float) -> fret.Scene:
    """A ball on a flat with a coating of `ratio` times its modulus, `thickness` over a_H."""
    coating = fret.Coating(fret.Elastic(E=ratio * steel.E, nu=0.3), thickness=thickness * a)
    return fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(steel, coatings=coating),
        friction=0.0,
        grid=fret.Grid.centred(width=3.6 * a, n=24),
        path=fret.LoadPath.start().normal(W, increments=1),
    )


def first_yield(result: fret.Result) -> float:
    """p_H over the yield stress when yield begins; the stress grows with the load."""
    return result.p_H / result.at(-1).stress().maximum("von_mises").value


study = fret.study.run(
    lambda values: scene(values["ratio"], values["thickness"]),
    {"ratio": np.geomspace(0.25, 4.0, 7).tolist(), "thickness": np.geomspace(0.1, 1.6, 7).tolist()},
    measure=first_yield,
    executor=ThreadPoolExecutor(1),
    progress=False,
)

figure, ax = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
fret.plot.study_map(study, colorbar=False, ax=ax)
ax.set(xlabel="E1/E2", ylabel="h/a_H")
ax.set_title("p_H over the yield stress at first yield")
