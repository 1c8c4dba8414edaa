"""The runs that take longer: wear, a study, a fit to measured loops and scars."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import wear
from pyfret._core import Grid, LoadPath, OffGridError, with_range
from pyfret._util.numbers import in_words
from pyfret.study.loop import run as run_points
from pyfret.workbench.answers import PageNumber, number_with_error
from pyfret.workbench.figures import graph_objects
from pyfret.workbench.theme import CURVES, axis, layout

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from pyfret._core import Scene
    from pyfret.wear import WearResult

__all__ = ["law_of", "loop_path", "run_fit", "run_study", "run_wear"]

#: Range of a wear coefficient that is searched [m^3/J], and of a rig's stiffness [N/m].
ALPHAS, RIGS = (1e-17, 1e-14, 1e-11), (1e5, 1e7, 1e9)
#: Range of a friction coefficient that is searched.
FRICTIONS = (0.05, 0.5, 1.8)


def law_of(body_number: int, alpha: float) -> dict[str, Any]:
    """Return the law of wear of a body as a keyword of :func:`pyfret.wear.solve`."""
    return {f"body{body_number}": wear.DissipatedEnergy(alpha=alpha)}


def run_wear(scene: Scene, order: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Wear a body over many cycles."""
    number, alpha, cycles = order["body"], order["alpha"], order["cycles"]
    return outcome_of_wear(wear_off(scene, cycles, law_of(number, alpha)), number)


def wear_off(scene: Scene, cycles: float, law: dict[str, Any]) -> WearResult:
    """Wear a scene; where the scar leaves the grid, on a grid that holds it at its end."""
    try:
        return wear.solve(scene, cycles=cycles, **law)
    except OffGridError:
        grid = Grid.for_contact(
            scene.body1,
            scene.body2,
            scene.path,
            plane_strain=scene.grid.plane_strain,
            wear={"cycles": cycles, **law},
            mu=scene.friction,
            n=scene.grid.nx,
        )
        return wear.solve(scene.replace(grid=grid), cycles=cycles, **law)


def outcome_of_wear(worn: WearResult, number: int) -> dict[str, Any]:
    """Return depth and volume with their errors, and the worn profile."""
    d = worn.dataset
    depth, volume = float(d[f"depth{number}"][-1]), float(d[f"volume{number}"][-1])
    unit = str(d[f"volume{number}"].attrs["units"])
    factor, shown = (1e18, "µm³") if unit == "m^3" else (1e12, "µm²")
    field = d[f"worn{number}"][-1]
    i, j = np.unravel_index(int(field.values.argmax()), field.shape)
    note = f"deepest at x = {1e6 * float(d.x[i]):.3g} µm, y = {1e6 * float(d.y[j]):.3g} µm"
    error = 1e6 * depth * worn.error_of("depth")
    numbers = [
        number_with_error("worn depth", 1e6 * depth, error, "µm", note),
        number_with_error(
            "worn volume", factor * volume, factor * volume * worn.error_of("volume"), shown
        ),
        PageNumber("cycles", f"{float(d.cycles[-1]):.6g}", "", float(d.cycles[-1])),
    ]
    cut = worn.along()
    along = str(cut[f"worn{number}"].dims[-1])
    profile = curve(1e6 * cut[along].values, 1e6 * cut[f"worn{number}"][-1].values, "worn depth")
    figure = draw([profile], f"{along} [µm]", "worn depth [µm]", downwards=True)
    return {
        "numbers": [n.as_row() for n in numbers],
        "doubts": worn.doubts,
        "figures": [("Worn profile along the shear.", figure)],
    }


def run_study(scene: Scene, order: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Solve the scene for several values of a field."""
    key, values, measure = order["key"], order["values"], order["measure"]
    study = run_points(scene, {key: values}, measure=[measure], executor=1)
    d = study.dataset
    answers, attrs = d[measure].values.astype(float), d[measure].attrs
    scale, label = order["scale"], order["label"]
    bars: dict[str, Any] = {}
    if f"{measure}_low" in d:
        low, high = (d[f"{measure}_{side}"].values.astype(float) for side in ("low", "high"))
        up, down = np.nan_to_num(high - answers), np.nan_to_num(answers - low)
        error = {"type": "data", "symmetric": False}
        bars = {"error_y": {**error, "array": up.tolist(), "arrayminus": down.tolist()}}
    unit = str(attrs.get("units", "1"))
    meaning = str(attrs.get("long_name", measure))
    x = [float(value) / scale for value in values]
    points = curve(x, answers, measure) | {"mode": "lines+markers", **bars}
    figure = draw([points], label, meaning + ("" if unit == "1" else f" [{unit}]"))
    rows = []
    for n, value in enumerate(x):
        text = "no answer" if not math.isfinite(answers[n]) else in_words(answers[n])
        bottom: float | None = None
        top: float | None = None
        if bars and math.isfinite(answers[n]):
            bottom, top = float(low[n]), float(high[n])
            text = with_range(answers[n], bottom, top)
        name = f"at {label.partition(' [')[0]} = {value:g}"
        best = float(answers[n]) if math.isfinite(answers[n]) else None
        rows.append(PageNumber(name, text, "" if unit == "1" else unit, best, bottom, top))
    doubts = [f"{value}: {reason}" for value, reason in study.failed()]
    return {
        "numbers": [row.as_row() for row in rows],
        "doubts": doubts,
        "figures": [(f"{meaning} over {label}.", figure)],
    }


def loop_path(scene: Scene, reach: float) -> LoadPath:
    """Return the path of a measured loop: the scene's normal force, cycles of the shift."""
    W = max(abs(branch.W) for branch in scene.path.branches if branch.W)
    return LoadPath.start().normal(W).cycles(1, delta_x=reach)


def run_fit(scene: Scene, order: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Fit friction to a loop, the wear coefficient to a scar, and predict a depth from both."""
    from pyfret import fit

    numbers: list[PageNumber] = []
    figures, doubts = [], []
    body = order.get("body", 2)
    if order.get("loop"):
        loops = fit.read_loops(order["loop"])
        reach = 0.5 * float(np.ptp(loops.delta))
        unknown: dict[str, tuple[float, ...]] = {"mu": FRICTIONS}
        scene = scene.replace(path=loop_path(scene, reach))
        if order.get("rig"):
            unknown["rig.stiffness"] = RIGS
        outcome = fit.fit(scene, loops, unknown=unknown, executor=1)
        scene = outcome.scene
        numbers += fitted(outcome, {"mu": ("friction coefficient", 1.0, "")})
        numbers += fitted(outcome, {"rig.stiffness": ("stiffness of the rig", 1e-6, "N/µm")})
        doubts += list(outcome.doubts)
        measured = curve(1e6 * loops.delta, loops.T, "measured") | {"mode": "markers"}
        computed = curve(1e6 * loops.delta, outcome.computed[0], "computed", 1)
        figure = draw([measured, computed], "shift [µm]", "force [N]")
        figures.append(("The measured loop, and the one of the fit.", figure))
    alpha = order.get("alpha")
    if order.get("scar"):
        start = {"cycles": order["cycles"], **law_of(body, ALPHAS[1])}
        scar = fit.read_scar(order["scar"], wear=start, body_number=body)
        key = f"wear.body{body}.alpha"
        outcome = fit.fit(scene, scar, unknown={key: ALPHAS}, executor=1)
        numbers += fitted(outcome, {key: ("wear coefficient", 1.0, "m^3/J")})
        doubts += list(outcome.doubts)
        alpha = outcome.known[key].value
        measured = curve(1e6 * scar.x, 1e6 * scar.depth, "measured") | {"mode": "markers"}
        computed = curve(1e6 * scar.x, 1e6 * outcome.computed[0], "computed", 1)
        figure = draw([measured, computed], "x [µm]", "depth [µm]", downwards=True)
        figures.append(("The measured scar, and the one of the fit.", figure))
    if order.get("predict") and alpha:
        worn = wear_off(scene, order["predict"], law_of(body, alpha))
        predicted = outcome_of_wear(worn, body)
        numbers += [PageNumber(**row) for row in predicted["numbers"]]
        figures += predicted["figures"]
        doubts += predicted["doubts"]
    return {
        "numbers": [number.as_row() for number in numbers],
        "doubts": list(dict.fromkeys(map(str, doubts))),
        "figures": figures,
        "scene": scene.to_toml(),
    }


def fitted(outcome: Any, names: Mapping[str, tuple[str, float, str]]) -> list[PageNumber]:
    """Return fitted values with their confidence of 95 %."""
    numbers = []
    for key, (name, factor, unit) in names.items():
        if key not in outcome.known:
            continue
        interval = outcome.known[key]
        value, low, high = (factor * v for v in (interval.value, interval.low, interval.high))
        text = with_range(value, low, high)
        numbers.append(PageNumber(name, text, unit, value, low, high, "95 % confidence"))
    return numbers


def curve(x: Any, y: Any, name: str, n: int = 0) -> dict[str, Any]:
    """Return a curve for plotly."""
    line = {"color": CURVES[n], "width": 2}
    values = [None if not math.isfinite(v) else float(v) for v in np.asarray(y, dtype=float)]
    x_values = np.asarray(x, dtype=float).tolist()
    return {"x": x_values, "y": values, "mode": "lines", "name": name, "line": line}


def draw(
    curves: list[dict[str, Any]], across: str, up: str, *, downwards: bool = False
) -> dict[str, Any]:
    """Return a figure of curves as plain data."""
    go = graph_objects()
    options = {"autorange": "reversed"} if downwards else {}
    look = layout(axis(across), axis(up, **options), legend=len(curves) > 1)
    figure: dict[str, Any] = go.Figure([go.Scatter(**c) for c in curves], look).to_plotly_json()
    return figure
