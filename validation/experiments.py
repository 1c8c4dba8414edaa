"""The evidence book: published tests, predicted."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import pyfret as fret
from pyfret import experiments
from validation.arrest import arrest
from validation.sheets import Page, drawn, remarks, table

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["PAGES", "write"]

#: Standard deviation of ln of fatigue limits that are recalled.
KNOWN = 0.15
NOT_READ = (
    "The numbers are facts of the papers cited, typed from tables or read off figures by others "
    "and "
    "converted to SI units; none of the papers was read in full."
)


def spread(ratios: list[float], within: float) -> str:
    """Mean, scatter and count of ratios."""
    r = np.array(ratios)
    inside = int(np.sum(np.abs(r - 1) <= within))
    return (
        f"mean {r.mean():.2f}, sd {r.std(ddof=1):.2f}, {inside} of {r.size} within "
        f"{100 * within:.0f} %"
    )


def factor(ratios: list[float], by: float) -> str:
    """How many ratios lie within a factor."""
    logs = np.abs(np.log(ratios))
    return f"{int(np.sum(logs <= np.log(by)))} of {len(ratios)} within a factor {by:g}"


def fouvry2007(out: Path) -> Page:
    """Worn depth and lives of TiC, lives of TiN."""
    test = experiments.fouvry2007("TiC")
    worn = test.wear(worn_through="go_on")
    d = worn.dataset
    area = np.pi * 183.3e-6**2
    rows = [r for r in experiments.table("fouvry2007_tic_depth") if r["phase"] == "I wear"]
    depth = [
        float(np.interp(r["derived_accumulated_energy_J"], d.dissipated, d.depth2)) for r in rows
    ]
    ratios = [ours / r["worn_depth_m"] for ours, r in zip(depth, rows, strict=True)]
    per_cycle = float(d.dissipated[-1] / d.cycles[-1])
    to_part = worn.cycles_to(part_of_coating=0.8) * per_cycle
    to_end = worn.cycles_to(part_of_coating=1.0) * per_cycle
    lives = experiments.table("fouvry2007_tic_lives")
    part = [to_part / r["derived_energy_J_per_cycle"] / r["cycles_to_failure"] for r in lives]
    through = [to_end / r["derived_energy_J_per_cycle"] / r["cycles_to_failure"] for r in lives]
    tin = experiments.fouvry2007("TiN")
    tin_worn = tin.wear(cycles=200.0 / (4 * 0.45 * 100 * 75e-6), worn_through="go_on")
    t = tin_worn.dataset
    tin_energy = tin_worn.cycles_to(part_of_coating=0.70) * float(t.dissipated[-1] / t.cycles[-1])
    tin_lives = experiments.table("fouvry2007_tin_lives")
    tin_part = [
        tin_energy / (r["mean_energy_density_J_per_m2_cycle"] * area) / r["cycles_to_failure"]
        for r in tin_lives
    ]

    def draw(ax: Any) -> None:
        ax.plot(d.dissipated, 1e6 * d.depth2, label="predicted")
        x = [r["derived_accumulated_energy_J"] for r in rows]
        ax.plot(x, [1e6 * r["worn_depth_m"] for r in rows], "o", label="measured, phase I")
        ax.axhline(1.6, color="0.6", lw=1, label="coating")
        ax.set(xlabel="dissipated energy [J]", ylabel="worn depth [um]", xlim=(0, 420))
        ax.legend()

    head = ["energy [J]", "measured [um]", "predicted [um]", "ratio"]
    cells = [
        [
            f"{r['derived_accumulated_energy_J']:.0f}",
            f"{1e6 * r['worn_depth_m']:.2f}",
            f"{1e6 * h:.3f}",
            f"{q:.2f}",
        ]
        for r, h, q in zip(rows, depth, ratios, strict=True)
    ]
    verdict = (
        f"depth {spread(ratios, 0.35)}; lives at 0.8 of the thickness {factor(part, 1.5)}, worn "
        "through "
        f"{factor(through, 2)}; TiN at 0.70 {factor(tin_part, 1.5)}"
    )
    error = f"The jumps leave {float(d.depth_error[-1]):.1%} of the depth."
    return Page(
        "experiment_fouvry2007",
        "Worn coatings and their lives: TiC and TiN under an alumina ball",
        [
            test.citation,
            "An alumina ball (R = 12.7 mm) slides on 1.6 um of TiC on tool steel under 100 N in "
            "gross slip; "
            "the flat alone wears, with the alpha of its volumes (415e-18 m^3/J). Predicted: the "
            "depth, from "
            "that alpha and the energy, and the lives. Fitted: nothing; slip (75 um) and friction "
            "(0.45) are chosen, since those of the single tests are not in the tables.",
            remarks(test),
            table(head, cells),
            error,
            drawn(out, "experiment_fouvry2007", draw),
            "Lives are those at which 0.8 of the thickness is worn off (and, for TiN, 0.70), as "
            "the paper's "
            "failures are: predicted over measured "
            + ", ".join(f"{q:.2f}" for q in part)
            + "; TiN "
            + ", ".join(f"{q:.2f}" for q in tin_part)
            + ".",
        ],
        verdict,
    )


def half_width(worn: fret.wear.WearResult) -> float:
    """Half-width of the contact at the end [m]."""
    return float(worn.dataset.contact_area[-1]) / 2


def fouvry2017(out: Path) -> Page:
    """Widths of scars under a constant force, volumes by a law of power density."""
    rows = [r for r in experiments.table("fouvry2017_ti64") if r["W_min_over_W_max"] == 1.0]
    widths, without, energies, cells = [], [], [], []
    for r in rows:
        test = experiments.fouvry2017(r["test"])
        kept, free = test.wear(tolerance=0.04), test.wear(tolerance=0.04, debris_kept=0.0)
        b, b_free = half_width(kept), half_width(free)
        mu = test.scene.mu
        widths.append(b / r["derived_scar_half_width_m"])
        without.append(b_free / r["derived_scar_half_width_m"])
        energies.append(0.65 / mu)
        cells.append(
            [
                r["test"],
                f"{1e3 * r['R_m']:g}",
                f"{r['frequency_Hz']:g}",
                f"{1e3 * r['derived_scar_half_width_m']:.2f}",
                f"{1e3 * b:.2f}",
                f"{widths[-1]:.2f}",
                f"{without[-1]:.2f}",
                f"{energies[-1]:.2f}",
            ]
        )
    power = np.array([r["power_density_W_per_m2"] for r in rows if r["alpha_m3_per_J"]])
    alpha = np.array([r["alpha_m3_per_J"] for r in rows if r["alpha_m3_per_J"]])
    slope, at = np.polyfit(np.log(power), np.log(alpha), 1)
    volume = list(np.exp(at + slope * np.log(power)) / alpha)

    def draw(ax: Any) -> None:
        measured = np.array([1e3 * r["derived_scar_half_width_m"] for r in rows])
        ax.plot(measured, measured * np.array(widths), "o", label="debris kept 0.85")
        ax.plot(measured, measured * np.array(without), "x", color="0.5", label="none kept")
        ax.plot([0, 2.6], [0, 2.6], color="0.6", lw=1)
        ax.set(xlabel="half-width of the scar, measured [mm]", ylabel="predicted [mm]")
        ax.legend()

    head = [
        "test",
        "R [mm]",
        "f [Hz]",
        "measured b [mm]",
        "predicted b [mm]",
        "ratio",
        "ratio, no debris",
        "energy with mu = 0.65",
    ]
    verdict = (
        f"half-width {spread(widths, 0.35)} with debris kept 0.85 (without "
        f"{spread(without, 0.35)}); energy "
        f"{factor(energies, 1.6)}; volume by alpha of the power density {factor(volume, 1.5)}"
    )
    test = experiments.fouvry2017("RP_f_20")
    return Page(
        "experiment_fouvry2017",
        "Scars of Ti-6Al-4V: radius, load, frequency",
        [
            test.citation,
            "Cylinder on flat, both of Ti-6Al-4V, gross slip of +-75 um. Each row's energy gives "
            "its "
            "coefficient of friction, its V/E its alpha; the width of the scar follows with one "
            "number, the "
            "part of the debris that stays (0.85, P. Arnaud, S. Baydoun, S. Fouvry, Tribol. Int. "
            "161 (2021) "
            "107077). Measured half-widths are derived: area E f/(N phi) over twice the length.",
            remarks(test),
            table(head, cells),
            drawn(out, "experiment_fouvry2017", draw),
            f"Volumes: alpha = {np.exp(at) * 1e4**slope:.3g} (phi/1e4 W/m^2)^{slope:.3f} m^3/J, "
            "fitted to the "
            "rows of constant force.",
        ],
        verdict,
    )


def arnaud2021(out: Path) -> Page:
    """The U-shaped profile."""
    test = experiments.arnaud2021()
    x, depth = np.array(test.row["x"]), np.array(test.row["depth"])
    profiles = {}
    for kept in (0.85, 0.0):
        worn = test.wear(debris_kept=kept)
        of = worn.worn[-1].isel(y=0)
        profiles[kept] = (np.asarray(of.x), np.asarray(of))

    def at_half(x: Array, depth: Array) -> float:
        """Half of the width at half of the depth."""
        inside = x[depth >= 0.5 * depth.max()]
        return float(np.ptp(inside) / 2)

    fine = np.linspace(x.min(), x.max(), 2001)
    ours = np.interp(fine, *profiles[0.85])
    measured = np.interp(fine, x, depth)
    ratio = ours.max() / measured.max()
    width = at_half(fine, ours) / at_half(fine, measured)
    rms = float(np.sqrt(np.mean((np.interp(x, *profiles[0.85]) - depth) ** 2)))
    rms_free = float(np.sqrt(np.mean((np.interp(x, *profiles[0.0]) - depth) ** 2)))

    def draw(ax: Any) -> None:
        ax.plot(1e3 * x, 1e6 * depth, "o", label="measured")
        for kept, (at, of) in profiles.items():
            ax.plot(1e3 * at, 1e6 * of, label=f"debris kept {kept:g}")
        ax.invert_yaxis()
        ax.set(xlabel="x [mm]", ylabel="worn off both bodies [um]", xlim=(-3, 3))
        ax.legend()

    verdict = (
        f"depth {ratio:.2f}, half-width {width:.2f} of the measured, rms {1e3 * rms:.3f} mm "
        f"({1e3 * rms_free:.3f} mm without debris)"
    )
    return Page(
        "experiment_arnaud2021",
        "A worn profile of Ti-6Al-4V",
        [
            test.citation,
            "What both bodies together have lost after 5000 cycles at 0.1 Hz. Of the test are "
            "taken energy "
            "(7150 J) and volume (2.87 mm^3); the shape is predicted, with 0.85 of the debris "
            "kept, the number of the "
            "paper. A scar in which surfaces fit would be b^2/2R deep, 23 um: the rest is debris.",
            remarks(test),
            drawn(out, "experiment_arnaud2021", draw),
        ],
        verdict,
    )


def baydoun2019(out: Path) -> Page:
    """Energies and volumes of a square flat on a flat."""
    rows = experiments.table("baydoun2019")
    energies, volumes, cells = [], [], []
    for n, r in enumerate(rows):
        test = experiments.baydoun2019(n)
        worn = test.wear(jumps=1).dataset
        energy, volume = float(worn.dissipated[-1]), float(worn.volume2[-1])
        volumes.append(volume / r["worn_volume_m3"])
        measured = r["accumulated_energy_J"]
        if measured:
            energies.append(energy / measured)
        cells.append(
            [
                str(r["sweep"]),
                f"{r['cycles']:.0f}",
                f"{1e-6 * r['pressure_Pa']:g}",
                f"{1e6 * r['slip_amplitude_m']:g}",
                f"{r['frequency_Hz']:g}",
                f"{measured:.0f}" if measured else "",
                f"{energy:.0f}",
                f"{volumes[-1]:.2f}",
            ]
        )

    def draw(ax: Any) -> None:
        measured = np.array([1e9 * r["worn_volume_m3"] for r in rows])
        ax.loglog(measured, measured * np.array(volumes), "o")
        ax.plot([0.05, 2], [0.05, 2], color="0.6", lw=1)
        ax.set(xlabel="worn volume, measured [mm$^3$]", ylabel="predicted, alpha constant [mm$^3$]")

    head = [
        "sweep",
        "cycles",
        "p [MPa]",
        "slip [um]",
        "f [Hz]",
        "energy [J]",
        "predicted",
        "volume ratio",
    ]
    test = experiments.baydoun2019(0)
    verdict = f"energy {spread(energies, 0.05)}; volume with one alpha {factor(volumes, 2)}"
    return Page(
        "experiment_baydoun2019",
        "A square flat on a flat, steel",
        [
            test.citation,
            "5 x 5 mm, mu_e = 0.70 and alpha = 4.383e-14 m^3/J of the paper. The punch of the "
            "model is round, of the "
            "same area: energy and volume do not know its shape. The volumes are not predicted "
            "but checked against "
            "one alpha: the repeats alone differ by 1.4.",
            remarks(test),
            table(head, cells),
            drawn(out, "experiment_baydoun2019", draw),
        ],
        verdict,
    )


def plain_scene(test: str, Q: float) -> fret.Scene:
    """The scene of a row under a shear of that amplitude."""
    return experiments.icf13(test, Q=Q, n=128).scene


def scene_of(test: str, values: dict[str, Any]) -> fret.Scene:
    """The same for a search."""
    return plain_scene(test, values["Q"])


def icf13(out: Path) -> Page:
    """Crack thresholds of fretting fatigue from two numbers fitted on plain fretting."""
    rows = experiments.table("icf13_952_thresholds")
    plain = [r for r in rows if str(r["test"]).startswith("PF")]
    source = "plain fretting, recalled"
    steel = fret.fatigue.Material("35NCD16", [("s_D", 575e6, source), ("t_D", 386e6, source)])
    tests = [(partial(plain_scene, str(r["test"])), float(r["Q_threshold_N_per_m"])) for r in plain]
    limits = fret.study.fit_limits(tests, steel, "crossland", known=KNOWN)
    others = {
        known: fret.study.fit_limits(tests, steel, "crossland", known=known).L
        for known in (0.10, 0.20)
    }
    measure = limits.measure("crossland")
    ratios = {str(r["test"]): float(q) for r, q in zip(plain, limits.ratios, strict=True)}
    cells = []
    for r in rows:
        W, name, measured = r["W_N_per_m"], str(r["test"]), r["Q_threshold_N_per_m"]
        found, said = None, f"{1e-3 * ratios[name] * measured:.0f}" if name in ratios else ""
        if name not in ratios:
            found = fret.study.threshold(
                partial(scene_of, name),
                "Q",
                measure=measure,
                between=(0.05 * W, 0.79 * W),
                tolerance=0.01,
            )
            assert isinstance(found, fret.study.Threshold)
            ratios[name] = found.value / measured
            said = f"{1e-3 * found.value:.0f} +- {1e-3 * found.error:.0f}"
        cells.append(
            [
                name,
                f"{1e3 * r['R_m']:.0f}",
                f"{1e-3 * W:.0f}",
                f"{1e-6 * r['sigma_bulk_max_Pa']:.0f}",
                f"{1e-3 * measured:.0f}",
                said,
                f"{ratios[name]:.2f}",
                "" if found is None else str(found.solves),
                "fitted" if found is None else "predicted",
            ]
        )
    predicted = [q for name, q in ratios.items() if name.startswith("FF")]

    def draw(ax: Any) -> None:
        for kind, colour in (("PF", "0.5"), ("FF", "C0")):
            of = [r for r in rows if str(r["test"]).startswith(kind)]
            x = [1e-3 * r["Q_threshold_N_per_m"] for r in of]
            y = [v * ratios[r["test"]] for v, r in zip(x, of, strict=True)]
            label = "fitted" if kind == "PF" else "predicted"
            ax.plot(x, y, "o", color=colour, label=f"{kind}, {label}")
        ax.plot([80, 500], [80, 500], color="0.6", lw=1)
        ax.set(xlabel="threshold Q, measured [N/mm]", ylabel="computed [N/mm]")
        ax.legend()

    head = [
        "test",
        "R [mm]",
        "W [N/mm]",
        "bulk [MPa]",
        "Q [N/mm]",
        "computed",
        "ratio",
        "solves",
        "",
    ]
    test = experiments.icf13("PF_1")
    verdict = (
        f"fretting fatigue {spread(predicted, 0.20)}, from two numbers fitted on plain fretting"
    )
    return Page(
        "experiment_icf13",
        "Crack thresholds: plain fretting and fretting fatigue",
        [
            test.citation,
            f"Fitted on the rows PF: the critical distance L = {1e6 * limits.L:.0f} um (Crossland, "
            "mean over the line from the surface to 2 L) and the factor "
            f"{limits.limit:.2f} of the limits 575 and 386 MPa, which are recalled and so counted "
            "as known to "
            f"{100 * KNOWN:.0f} %; ln of the thresholds then scatters by {limits.scatter:.2f}. "
            "Predicted: the rows FF, with "
            "bulk stress.",
            "Six tests tell the distance badly: without what is known of the limits they would "
            "choose a "
            "distance of 0.1 mm and half of the limits, which a bulk stress of 400 MPa "
            "contradicts. "
            f"Limits known to 10 and 20 % give L = {1e6 * others[0.10]:.0f} and "
            f"{1e6 * others[0.20]:.0f} um; the "
            "15 % were chosen with the rows FF in sight.",
            remarks(test),
            table(head, cells),
            drawn(out, "experiment_icf13", draw),
        ],
        verdict,
    )


def vanpeteghem2011(out: Path) -> Page:
    """Energies under a constant force."""
    rows = [
        r
        for r in experiments.table("vanpeteghem2011")
        if r["normal_force"] == "constant" and r["test"] != 6
    ]
    ratios, cells = [], []
    for r in rows:
        test = experiments.vanpeteghem2011(int(r["test"]))
        worn = test.wear(jumps=1).dataset
        energy = float(worn.dissipated[-1]) * 8e-3
        ratios.append(energy / r["accumulated_energy_J"])
        cells.append(
            [
                f"{r['test']:.0f}",
                f"{r['cycles']:.0f}",
                f"{1e6 * r['slip_stroke_m']:.0f}",
                f"{r['accumulated_energy_J']:.0f}",
                f"{energy:.0f}",
                f"{ratios[-1]:.2f}",
            ]
        )

    def draw(ax: Any) -> None:
        measured = np.array([r["accumulated_energy_J"] for r in rows])
        ax.loglog(measured, measured * np.array(ratios), "o")
        ax.plot([6e2, 3e4], [6e2, 3e4], color="0.6", lw=1)
        ax.set(xlabel="energy, measured [J]", ylabel="with mu_e = 0.60 [J]")

    head = ["test", "cycles", "stroke [um]", "energy [J]", "computed [J]", "ratio"]
    test = experiments.vanpeteghem2011(1)
    return Page(
        "experiment_vanpeteghem2011",
        "Ti-6Al-4V under a constant force: energies",
        [
            test.citation,
            "One coefficient, mu_e = 0.60, chosen for all tests of constant force (loops are no "
            "rectangles: the "
            "stable force over W is about 0.7). Tests whose contact opens every cycle need their "
            "waveform and are left out.",
            remarks(test),
            table(head, cells),
            drawn(out, "experiment_vanpeteghem2011", draw),
        ],
        f"energy {spread(ratios, 0.20)}",
    )


PAGES: dict[str, Callable[[Path], Page]] = {
    page.__name__: page
    for page in (fouvry2007, fouvry2017, arnaud2021, baydoun2019, icf13, arrest, vanpeteghem2011)
}


def write(out: Path, only: list[str] | None = None) -> str:
    """Write the pages; what they say, for the front page."""
    lines = ["## Published tests", NOT_READ, ""]
    rows = []
    for name, make in PAGES.items():
        if only is not None and name not in only:
            continue
        page = make(out)
        text = [f"# {page.title}", NOT_READ, *page.text, f"**Verdict:** {page.verdict}."]
        (out / f"{page.name}.md").write_text("\n\n".join(text) + "\n", encoding="utf-8")
        rows.append(f"| [{page.title}]({page.name}.md) | {page.verdict} |")
        print(rows[-1], flush=True)
    return "\n".join([*lines, "| test | predicted over measured |", "|---|---|", *rows])
