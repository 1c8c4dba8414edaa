"""Contacts that are moved, turned, mirrored, exchanged and rescaled: every public number stays.

``python tests/campaign/moved.py 0 40`` goes through the scenes of these seeds. Numbers are kept on
the result itself: columns and fields of its dataset, loops, every measure of stress, every
criterion of fatigue. ``tests/test_moved.py`` has one scene in every run.
"""

from __future__ import annotations

import random
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import pyfret as fret
from pyfret import fatigue
from pyfret.subsurface.tensor import COMPONENTS
from pyfret.subsurface.tensor import LABELS as ALL_LABELS

#: Measures of stress that do not depend on the axes.
LABELS = [name for name in ALL_LABELS if name not in COMPONENTS]
RADIUS, N, ROOM = 5e-3, 28, 8
#: Normal force at scale 1 [N].
LOAD = 30.0
#: Difference of two numbers that is within their cells, over the number.
ALLOWED = 5e-3
#: Part of the size of its unit below which a number is rounding.
ROUNDING = 1e-6
#: Numbers of a run that are no answers: counts, work, residuals, time.
WORK = (
    *("residual", "scatter", "quadrature", "convolutions", "iterations", "alternations"),
    *("parts", "seconds", "increment"),
)
STEEL = fatigue.Materials()["steel_42CrMo4"]


@dataclass(frozen=True)
class Drawn:
    """A ball on a flat whose body 2 has all that a body can have, and how it is turned."""

    E: tuple[float, float]
    coating: tuple[float, float] | None
    s_y: float | None
    residual: tuple[float, float] | None
    bulk: float
    mu: float
    part: float
    #: Angle of the shear [rad], place of the contact in cells, scale of all lengths.
    angle: float = 0.0
    offset: tuple[int, int] = (0, 0)
    scale: float = 1.0
    exchanged: bool = False
    mirrored: bool = False

    def scene(self) -> fret.Scene:
        """The contact."""
        ball, flat = self.materials
        a, cell = self.radius, self.cell
        n = N + ROOM
        at = (np.arange(n) - (n - 1) / 2) * cell
        X, Y = (cells * cell for cells in self.offset)
        x, y = np.meshgrid(at - X, at - Y, indexing="ij")
        round_ = fret.SurfaceMap(-(x**2 + y**2) / (2 * self.scale * RADIUS), spacing=(cell, cell))
        below = (
            flat
            if self.s_y is None
            else flat.replace(plastic=fret.Plastic(s_y=self.s_y, hardening=0.1 * self.E[1]))
        )
        options: dict[str, Any] = {}
        if self.residual is not None:
            s_xx, s_yy = self.residual
            options["residual"] = [[0.0, s_xx, s_yy], [1.0, s_xx, s_yy]]
            if self.coating is not None:
                options["coatings"] = []
        coatings = []
        if self.coating is not None:
            E, part = self.coating
            coatings.append(
                fret.Coating(fret.Elastic(E=E, nu=0.25), thickness=self.scale * part * a)
            )
        upper = fret.Body(ball, shape=round_)
        lower = fret.Body(below, **{**options, "coatings": coatings})
        force = self.scale**2 * LOAD
        T = self.part * self.mu * force
        sign = -1.0 if self.exchanged else 1.0
        x_of, y_of = sign * T * np.cos(self.angle), sign * T * np.sin(self.angle)
        if self.mirrored:
            y_of = -y_of
        bulk = {"sigma_B1" if self.exchanged else "sigma_B": self.bulk} if self.bulk else {}
        none = dict.fromkeys(bulk, 0.0)
        path = fret.LoadPath.start().normal(force, increments=2)
        for n_of, phase in enumerate((1.0, -1.0, 1.0)):
            loads = {name: value * (n_of != 1) for name, value in bulk.items()}
            path = path.force(T_x=phase * x_of, T_y=phase * y_of, increments=4, **(loads or none))
        bodies = (lower, upper) if self.exchanged else (upper, lower)
        return fret.Scene(
            body1=bodies[0],
            body2=bodies[1],
            friction=self.mu,
            grid=fret.Grid.centred(width=n * cell, n=n),
            path=path,
        )

    @property
    def materials(self) -> tuple[fret.Elastic, fret.Elastic]:
        """Ball and flat, both elastic."""
        ball, flat = (fret.Elastic(E=E, nu=0.3) for E in self.E)
        return ball, flat

    @property
    def radius(self) -> float:
        """Radius of the contact of bare bodies at scale 1 [m]."""
        return fret.reference.hertz(R=RADIUS, bodies=self.materials, W=LOAD).a

    @property
    def cell(self) -> float:
        """Side of a cell [m]."""
        return self.scale * 2.8 * self.radius / N

    @property
    def body_number(self) -> int:
        """The body that lies flat."""
        return 1 if self.exchanged else 2

    def others(self) -> Iterator[tuple[str, Drawn]]:
        """Yield the contact moved, turned, mirrored, exchanged and rescaled."""
        yield "beside the middle", replace(self, offset=(2, 3))
        yield "mirrored", replace(self, mirrored=True, offset=(0, -3))
        yield "bodies exchanged", replace(self, exchanged=True)
        yield "three times as large", replace(self, scale=3.0)
        if not self.bulk:
            swapped = None if self.residual is None else self.residual[::-1]
            yield (
                "turned by 90 degrees",
                replace(self, angle=self.angle + np.pi / 2, residual=swapped),
            )
        if not self.bulk and self.residual is None:
            yield "turned by 37 degrees", replace(self, angle=self.angle + np.radians(37.0))


def draw(seed: int) -> Drawn:
    """The contact of a seed."""
    rng = random.Random(f"moved {seed}")
    kind = rng.choice(["bare", "coated", "yields", "residual", "bulk"])
    E = 110e9 * 2 ** rng.uniform(0, 1)
    return Drawn(
        E=(E, E if rng.random() < 0.5 else 110e9 * 2 ** rng.uniform(0, 1)),
        coating=(E * 2 ** rng.uniform(-1, 1), rng.uniform(0.2, 0.6)) if kind == "coated" else None,
        s_y=rng.uniform(400e6, 800e6) if kind == "yields" else None,
        residual=(-200e6, rng.choice([-200e6, 300e6])) if kind == "residual" else None,
        bulk=rng.uniform(50e6, 150e6) if kind == "bulk" else 0.0,
        mu=rng.uniform(0.3, 0.6),
        part=rng.uniform(0.4, 0.8),
        angle=rng.choice([0.0, np.pi / 2]) if kind not in ("bulk",) else 0.0,
    )


#: Powers of the scale of lengths in the units of a number.
POWERS = {
    "m": 1,
    "m^2": 2,
    "m^3": 3,
    "N": 2,
    "J": 3,
    "N m": 3,
    "N/m": 1,
    "Pa m^0.5": 0.5,
    "J/m^2": 1,
}


def numbers(
    drawn: Drawn, criteria: Sequence[str] = tuple(fatigue.CRITERIA)
) -> dict[str, tuple[float, float]]:
    """Return every public number of the contact with its error, rescaled to scale 1."""
    kept: dict[str, tuple[float, float, str]] = {}
    result = fret.solve(drawn.scene(), save="all", error=True, progress=False)
    last, number = result.at(-1), drawn.body_number
    d = result.dataset

    # Moments about the place of the contact and its displacement. About the middle of the grid they
    # include the moment of W and the stretch by the bulk stress.
    X, Y = (cells * drawn.cell for cells in drawn.offset)
    stretch = (-1.0 if drawn.exchanged else 1.0) * drawn.bulk / drawn.E[1]
    about_contact = {
        "M_x": d.M_x - d.W * Y,
        "M_y": d.M_y + d.W * X,
        "delta_x": d.delta_x - stretch * X,
        "delta_y": d.delta_y + 0.3 * stretch * Y,
    }

    def keep(name: str, value: Any, unit: str, error: Any = 0.0) -> None:
        kept[name] = (float(value), abs(float(error or 0.0)), unit)

    scalars = {str(k): v for k, v in d.data_vars.items() if v.ndim == 1 and v.dtype.kind in "fi"}
    bars = result.error_bars().sel(part="total").isel(branch=-1)
    # A mean over the contact has the error of its area.
    of_area = printed_error(bars, "contact_area") / float(d.contact_area[-1])
    pairs = {k[:-2] for k in scalars if k.endswith("_x") and f"{k[:-2]}_y" in scalars}
    for name, values in scalars.items():
        if values.dims != d.p_max.dims or any(word in name for word in (*WORK, "_error")):
            continue
        unit = str(values.attrs.get("units", "1"))
        if name[:-2] in pairs and name[-2:] in ("_x", "_y"):
            parts = scalars | about_contact
            both = [f"{name[:-2]}_{k}" for k in "xy"]
            size = np.hypot(*(parts[part].values[-1] for part in both))
            keep(f"|{name[:-2]}|", size, unit, max(printed_error(bars, part) for part in both))
        elif name not in ("sigma_B", "sigma_B1", "M_z", "phi_z", "t", "branch"):
            error = printed_error(scalars, name) or printed_error(bars, name)
            if name == "mean_pressure":
                error = of_area * values.values[-1]
            keep(name, values.values[-1], unit, error)
    fields = {str(k): v for k, v in last.dataset.data_vars.items() if v.dims == ("x", "y")}
    for name, values in fields.items():
        unit, samples = str(values.attrs.get("units", "1")), values.values.astype(float)
        if name.endswith(("_x", "_y")):
            samples = np.hypot(*(fields[f"{name[:-2]}_{k}"].values for k in "xy"))
            name = f"|{name[:-2]}|"
        if (
            samples[last.contact.values].size
            and unit != "1"
            and not name.startswith("|u")
            and name != "u_z"
        ):
            mean = samples[last.contact.values].mean()
            keep(f"mean of {name} in the contact", mean, unit, of_area * abs(mean))
    direction = "y" if abs(np.sin(drawn.angle)) > 0.9 else "x"
    if min(abs(np.sin(drawn.angle)), abs(np.cos(drawn.angle))) < 1e-6:
        loops = result.loops(direction=direction)
        for name, values in loops.data_vars.items():
            if values.dtype.kind == "f" and not name.endswith("_error"):
                unit = str(values.attrs.get("units", "1"))
                keep(f"loop: {name}", values.values[-1], unit, printed_error(loops, name))
    below = last.stress(body_number=number)
    for measure in LABELS:
        if measure.startswith("interface") and drawn.coating is None:
            continue
        try:
            top = below.maximum(measure)
        except ValueError:
            keep(f"largest {measure}", np.nan, "Pa")
            continue
        keep(f"largest {measure}", top.value, "Pa", top.error)
        keep(f"depth of largest {measure}", top.z, "m", 0.1 * top.z + drawn.scale * 3e-6)
    substrate = [None, STEEL] if drawn.coating is not None else STEEL
    for criterion in criteria:
        _try(lambda c=criterion: _life(result, substrate, c, number), f"life by {criterion}", keep)
    if drawn.s_y is None:
        least = result.load_factors(
            [None, 900e6] if drawn.coating is not None else 900e6, body_number=number
        ).least("von_mises")
        keep("load factor", least.value, "1", least.error)
    else:
        unloaded = result.unloaded()
        keep("imprint", unloaded.depth(number), "m")
        for measure in ("von_mises", "s_1"):
            top = unloaded.stress(body_number=number).maximum(measure)
            keep(f"residual {measure}", top.value, "Pa", top.error)
    cracks = result.crack(body_number=number)
    keep("largest dK", cracks.dK().max(), "Pa m^0.5", cracks.dK_error()[int(cracks.dK().argmax())])
    half = cracks.dataset.attrs["half_width"]
    grown = result.grow_crack(body_number=number, start=0.1 * half, end=0.5 * half)
    keep("largest dK of a grown crack", grown.dK().max(), "Pa m^0.5", grown.dK_error()[-1])
    # What a number of each unit is compared with where it vanishes.
    W, approach = float(d.W[-1]), float(d.delta_z[-1])
    sizes = {"N": W, "N m": W * drawn.scale * drawn.radius, "m": approach, "J": W * approach}
    scaled = {}
    for name, (value, error, unit) in kept.items():
        by = drawn.scale ** POWERS.get(unit, 0)
        scaled[name] = (value / by, (error + ROUNDING * sizes.get(unit, 0.0)) / by)
    return scaled


def printed_error(columns: Any, name: str) -> float:
    """Return the last error of a column, under its name in error bars; 0 where there is none."""
    is_bars = "part" in getattr(columns, "coords", ())
    errors = columns.get(f"{name}_error", columns.get(name) if is_bars else None)
    return 0.0 if errors is None else float(np.nan_to_num(np.ravel(errors.values)[-1]))


def _life(result: fret.Result, material: Any, criterion: str, number: int) -> tuple[float, float]:
    worst = result.life(material, criterion, body_number=number).worst
    return worst.value, worst.error


def _try(ask: Callable[[], tuple[float, float]], name: str, keep: Callable[..., None]) -> None:
    """Keep an answer; one that is refused is refused for the moved contact as well."""
    try:
        value, error = ask()
    except ValueError:
        value, error = np.nan, 0.0
    keep(name, value, "1", error)


def compared(
    drawn: Drawn, ways: Sequence[str] | None = None, **options: Any
) -> Iterator[tuple[str, str, float, float, float]]:
    """Every number of the moved contacts: how moved, name, right one, kept one, and tolerance."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        right = numbers(drawn, **options)
        largest = max(
            abs(value) for name, (value, _) in right.items() if name.startswith("largest")
        )
        for how, moved_scene in drawn.others():
            if ways is not None and how not in ways:
                continue
            moved = numbers(moved_scene, **options)
            for name, (value, error) in right.items():
                # The nominal contact of a map is the whole grid: its mean gap depends on the place.
                if name in ("mean_gap", "rms_slope") and moved_scene.offset != drawn.offset:
                    continue
                # Loops are along an axis, and of the displacement at the origin.
                is_stretched = drawn.bulk and moved_scene.offset[0] != drawn.offset[0]
                if name.startswith("loop: ") and (is_stretched or name not in moved):
                    continue
                there, error_there = moved.get(name, (np.nan, 0.0))
                if np.isnan(value) and np.isnan(there):
                    continue
                floor = 1e-4 * largest if name.startswith(("largest", "residual")) else 1e-12
                allowed = max(ALLOWED * abs(value), error + error_there, floor)
                yield how, name, value, there, allowed


def main() -> int:
    """Go through the scenes of some seeds and print what differs."""
    first, last = map(int, sys.argv[1:3])
    count = wrong = 0
    for seed in range(first, last):
        for how, name, value, there, allowed in compared(draw(seed)):
            count += 1
            if not abs(there - value) <= allowed:
                wrong += 1
                print(
                    f"{seed}: {how}: {name} = {there:.5g}, right {value:.5g} +- {allowed:.2g}",
                    flush=True,
                )
        print(f"{seed}: {count - wrong} of {count} numbers agree", flush=True)
    return int(wrong > 0.01 * count)


if __name__ == "__main__":
    sys.exit(main())
