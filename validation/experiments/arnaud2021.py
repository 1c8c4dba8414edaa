"""The U-shaped profile of Ti-6Al-4V."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import experiments
from validation.experiments.page import Claim, Page, drawn

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["page"]

#: Parts of the debris that stay: the paper's, and none.
KEPT = (0.85, 0.0)
#: Depth that can be read off the measured profile [m].
READ = 5e-6


def at_half(x: Array, depth: Array) -> float:
    """Half of the width at half of the depth [m]."""
    inside = x[depth >= 0.5 * depth.max()]
    return float(np.ptp(inside) / 2)


def edge(x: Array, depth: Array) -> tuple[float, float]:
    """Half-width of the scar, between the last depth that can be read and the next place [m]."""
    places = np.unique(np.abs(x))
    worn = np.abs(x[depth >= READ]).max()
    beyond = places[places > worn + 1e-9].min()
    return (worn + beyond) / 2, (beyond - worn) / 2


def page(out: Path) -> Page:
    """The profile with the paper's part of the debris, and without debris."""
    test = experiments.arnaud2021()
    x, depth = np.array(test.row["x"]), np.array(test.row["depth"])
    profiles, errors = {}, {}
    for kept in KEPT:
        worn = experiments.arnaud2021(debris_kept=kept).wear()
        of = worn.worn[-1].isel(y=0)
        profiles[kept] = (np.asarray(of.x), np.asarray(of))
        errors[kept] = float(worn.dataset.depth_error[-1])

    fine = np.linspace(x.min(), x.max(), 2001)
    measured = np.interp(fine, x, depth)
    ours = {kept: np.interp(fine, *profiles[kept]) for kept in KEPT}
    ratio = {kept: float(ours[kept].max() / measured.max()) for kept in KEPT}
    width = {kept: at_half(fine, ours[kept]) / at_half(fine, measured) for kept in KEPT}
    half, unsure = edge(x, depth)
    widest = {kept: float(np.ptp(at[of > 0.0]) / 2) for kept, (at, of) in profiles.items()}
    rms = {
        kept: float(np.sqrt(np.mean((np.interp(x, *profiles[kept]) - depth) ** 2))) for kept in KEPT
    }

    def draw(ax: Any) -> None:
        for kept, (at, of) in profiles.items():
            (curve,) = ax.plot(1e3 * at, 1e6 * of, label=f"predicted, debris kept {kept:g}")
            error = errors[kept]
            low, high = 1e6 * of * (1 - error), 1e6 * of * (1 + error)
            ax.fill_between(1e3 * at, low, high, color=curve.get_color(), alpha=0.3, lw=0)
        ax.plot(1e3 * x, 1e6 * depth, "o", color="k", ms=4, label="measured")
        ax.invert_yaxis()
        ax.set(xlabel="x [mm]", ylabel="worn off both bodies [µm]", xlim=(-3, 3))
        ax.legend(loc="lower right", fontsize="small")

    kept, none = KEPT
    return Page(
        name="experiment_arnaud2021",
        title="A worn profile of Ti-6Al-4V",
        test=test,
        conditions="The test RP_f_20 of [Fouvry and others 2017](experiment_fouvry2017.md): "
        "cylinder, R = 80 mm, on flat, 1066 N/mm, +-75 um, 5000 cycles at 0.11 Hz. The profile is "
        "the depth that both bodies together have lost. `fret.experiments.arnaud2021()` is the "
        "scene, with the profile in `row`.",
        fitted="energy (7150 J) and volume (2.87 mm^3) are taken from the test; the part of the "
        f"debris that stays, {kept}, from the paper.",
        predicted="the shape: depth, width, profile.",
        comparison=[
            drawn(out, "experiment_arnaud2021", draw),
            f"Largest depth {1e6 * ours[kept].max():.0f} +- "
            f"{1e6 * ours[kept].max() * errors[kept]:.0f} um against {1e6 * depth.max():.0f} um "
            f"measured; half-width of the scar {1e3 * widest[kept]:.2f} mm against "
            f"{1e3 * half:.1f} +- {1e3 * unsure:.1f} mm. A scar in which the worn surfaces fit is "
            "b^2/2R deep, 23 um for the measured width: the rest is filled by debris.",
        ],
        claims=[
            Claim(
                "largest depth",
                "within 20 %",
                f"{ratio[kept]:.2f} of the measured",
                abs(ratio[kept] - 1) <= 0.2,
            ),
            Claim(
                "half-width of the scar",
                "within 15 %",
                f"{widest[kept] / half:.2f} of the measured",
                abs(widest[kept] / half - 1) <= 0.15,
            ),
            Claim("profile, rms", "below 0.02 mm", f"{1e3 * rms[kept]:.3f} mm", rms[kept] < 2e-5),
        ],
        verdict=f"Depth and rms hold narrowly. At half of the depth the predicted scar is "
        f"{width[kept]:.2f} times as wide as the measured one, which is deeper in the middle and "
        "flatter at its ends: the part of the debris that stays is not the same everywhere, as "
        "the model has it. Without debris the same volume is "
        f"{ratio[none]:.2f} times as deep as measured and {width[none]:.2f} times as wide at half "
        f"of the depth (rms {1e3 * rms[none]:.3f} mm). The part of the debris was found by the "
        "paper on tests like this one: the profile tests the model, not the number.",
    )
