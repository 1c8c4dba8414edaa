"""The U-shaped profile of Ti-6Al-4V, with a bed of debris, a kept part of it, and none."""

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

#: Models of the debris: a bed that spreads, the part that stays by the paper, and none.
BED, KEPT, NONE = "bed of debris", "debris kept 0.85", "no debris"
MODELS: dict[str, dict[str, Any]] = {
    BED: {"bed": True},
    KEPT: {"debris_kept": 0.85},
    NONE: {"debris_kept": 0.0},
}
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
    """Compare the profiles of three models of the debris with the measured one."""
    test = experiments.arnaud2021(bed=True)
    x, depth = np.array(test.row["x"]), np.array(test.row["depth"])
    profiles, errors = {}, {}
    for model, debris in MODELS.items():
        worn = experiments.arnaud2021(**debris).wear()
        total = worn.worn[-1].isel(y=0)
        profiles[model] = (np.asarray(total.x), np.asarray(total))
        errors[model] = float(worn.dataset.depth_error[-1])

    fine = np.linspace(x.min(), x.max(), 2001)
    measured = np.interp(fine, x, depth)
    ours = {model: np.interp(fine, *profile) for model, profile in profiles.items()}
    ratio = {model: float(ours[model].max() / measured.max()) for model in MODELS}
    width = {model: at_half(fine, ours[model]) / at_half(fine, measured) for model in MODELS}
    half, unsure = edge(x, depth)
    # A scar ends where its depth can be read, as the measured one.
    widest = {model: float(np.abs(fine[ours[model] >= READ]).max()) for model in MODELS}
    rms = {
        model: float(np.sqrt(np.mean((np.interp(x, *profile) - depth) ** 2)))
        for model, profile in profiles.items()
    }

    def draw(ax: Any) -> None:
        for model, (at, total) in profiles.items():
            (curve,) = ax.plot(1e3 * at, 1e6 * total, label=f"predicted, {model}")
            error = errors[model]
            low, high = 1e6 * total * (1 - error), 1e6 * total * (1 + error)
            ax.fill_between(1e3 * at, low, high, color=curve.get_color(), alpha=0.3, lw=0)
        ax.plot(1e3 * x, 1e6 * depth, "o", color="k", ms=4, label="measured")
        ax.invert_yaxis()
        ax.set(xlabel="x [mm]", ylabel="worn off both bodies [µm]", xlim=(-3, 3))
        ax.legend(loc="lower right", fontsize="small")

    return Page(
        name="experiment_arnaud2021",
        title="A worn profile of Ti-6Al-4V",
        test=test,
        conditions="The test RP_f_20 of [Fouvry and others 2017](experiment_fouvry2017.md): "
        "cylinder, R = 80 mm, on flat, 1066 N/mm, +-75 um, 5000 cycles at 0.11 Hz. The profile is "
        "the depth that both bodies together have lost. `fret.experiments.arnaud2021(bed=True)` is "
        "the scene, with the profile in `row`.",
        fitted="energy (7150 J) and volume (2.87 mm^3) are taken from the test. The transport of "
        "the bed, kappa = 4.444e-3, is fitted on this profile: one number. At 0.11 Hz oxygen "
        "arrives everywhere. The part of the debris that stays in the simple model, 0.85, comes "
        "from the paper.",
        predicted="the shape: depth, width, profile.",
        comparison=[
            drawn(out, "experiment_arnaud2021", draw),
            f"Largest depth {1e6 * ours[BED].max():.0f} +- "
            f"{1e6 * ours[BED].max() * errors[BED]:.0f} um against {1e6 * depth.max():.0f} um "
            f"measured; half-width of the scar, where it is {1e6 * READ:.0f} um deep, "
            f"{1e3 * widest[BED]:.2f} mm against {1e3 * half:.1f} +- {1e3 * unsure:.1f} mm. A scar "
            "in which the worn surfaces fit is b^2/2R deep, 23 um for the measured width. Debris "
            "fills the rest.",
        ],
        claims=[
            Claim(
                "largest depth, bed",
                "within 8 %",
                f"{ratio[BED]:.2f} of the measured",
                abs(ratio[BED] - 1) <= 0.08,
            ),
            Claim(
                "half-width of the scar, bed",
                "within 15 %",
                f"{widest[BED] / half:.2f} of the measured",
                abs(widest[BED] / half - 1) <= 0.15,
            ),
            Claim(
                "profile, rms, bed",
                "below 0.006 mm",
                f"{1e3 * rms[BED]:.4f} mm",
                rms[BED] < 6e-6,
            ),
            Claim(
                "largest depth, debris kept",
                "within 20 %",
                f"{ratio[KEPT]:.2f} of the measured",
                abs(ratio[KEPT] - 1) <= 0.2,
            ),
            Claim(
                "profile, rms, debris kept",
                "below 0.02 mm",
                f"{1e3 * rms[KEPT]:.3f} mm",
                rms[KEPT] < 2e-5,
            ),
        ],
        verdict=f"The bed has the shape: at half of its depth the predicted scar is "
        f"{width[BED]:.2f} times as wide as the measured one. A kept part that is the same "
        f"everywhere gives {width[KEPT]:.2f} times the width and {ratio[KEPT]:.2f} of the depth. "
        f"Without debris the same volume is {ratio[NONE]:.2f} times as deep as measured and "
        f"{width[NONE]:.2f} times as wide at half of the depth (rms {1e3 * rms[NONE]:.3f} mm). "
        "The bed spreads debris from the middle to the border, where it leaves: more of it stays "
        "in the middle. kappa is fitted on this profile, so that its depth is no prediction. The "
        "shape is.",
    )
