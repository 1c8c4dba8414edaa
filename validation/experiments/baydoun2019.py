"""Energies and volumes of a square flat on a flat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import experiments
from validation.experiments.page import Claim, Page, drawn, factor, spread, table

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["page"]

#: Part of the rows whose volume is to lie within a factor 2: 25 of the 28 of the whole set.
MOST = 25 / 28


def law(row: dict[str, Any]) -> float:
    """The paper's alpha over its constant one: powers of pressure, slip and frequency."""
    p, slip, f = row["pressure_Pa"] / 1e8, row["slip_amplitude_m"] / 1e-4, row["frequency_Hz"]
    return float(p**0.6 * slip**0.7 * f**-0.3)


def page(out: Path) -> Page:
    """All rows with one coefficient of friction and one alpha."""
    rows = experiments.table("baydoun2019")
    energies, volumes, cells = [], [], []
    for n, r in enumerate(rows):
        worn = experiments.baydoun2019(n).wear(jumps=1).dataset
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
                f"{1e9 * r['worn_volume_m3']:.2f}",
                f"{1e9 * volume:.2f}",
                f"{volumes[-1]:.2f}",
                f"{volumes[-1] * law(r):.2f}",
            ]
        )

    def draw(ax: Any) -> None:
        measured = np.array([1e9 * r["worn_volume_m3"] for r in rows])
        computed = measured * np.array(volumes)
        for sweep in dict.fromkeys(str(r["sweep"]) for r in rows):
            of = [str(r["sweep"]) == sweep for r in rows]
            ax.loglog(measured[of], computed[of], "o", ms=4, label=sweep)
        line = np.array([0.05, 2])
        ax.plot(line, line, color="0.6", lw=1)
        ax.fill_between(line, line / 2, 2 * line, color="0.9", lw=0, zorder=0)
        ax.set(xlabel="worn volume, measured [mm$^3$]", ylabel="with one alpha [mm$^3$]")
        ax.legend(fontsize="small")

    head = [
        "sweep",
        "cycles",
        "p [MPa]",
        "slip [um]",
        "f [Hz]",
        "energy [J]",
        "predicted [J]",
        "V [mm^3]",
        "with one alpha",
        "ratio",
        "ratio by the paper's law",
    ]
    within = float(np.mean(np.abs(np.log(volumes)) <= np.log(2)))
    by_law = [v * law(r) for v, r in zip(volumes, rows, strict=True)]
    off = np.abs(np.array(energies) - 1)
    return Page(
        name="experiment_baydoun2019",
        title="A square flat on a flat, steel",
        test=experiments.baydoun2019(0),
        conditions="5 x 5 mm, 35NCD16 on itself (205 GPa, 0.3), gross slip; sweeps of cycles, "
        "pressure, slip and frequency about 20 000 cycles, 100 MPa, 100 um, 1 Hz. "
        "`fret.experiments.baydoun2019(n)` is the scene of the n-th row.",
        fitted="nothing here: mu_e = 0.70 and alpha = 4.383e-14 m^3/J are the paper's.",
        predicted="the energies. The volumes check the constant alpha, not the contact: in gross "
        "slip energy and volume do not depend on the shape of the punch.",
        comparison=[
            table(head, cells),
            drawn(out, "experiment_baydoun2019", draw),
            "The shaded band is a factor 2; three repeats of one test differ by a factor 1.4. The "
            "energy is 4 mu_e W slip N; the solver adds less than 0.1 %.",
        ],
        claims=[
            Claim("energies", "within 5 %", spread(energies, 0.05), bool(off.max() <= 0.05)),
            Claim(
                "volumes by one alpha",
                "25 of 28 within 2",
                factor(volumes, 2),
                within >= MOST,
            ),
        ],
        verdict="The energy beyond 5 % is one of three repeats of a test, 13.8, 14.3 and 14.8 kJ; "
        "14.0 kJ is 2 % from their mean. A constant alpha fails at high frequencies; the paper's "
        "law, alpha (p/100 MPa)^0.6 (slip/100 um)^0.7 (f/1 Hz)^-0.3, has "
        f"{factor(by_law, 2)}, but it was fitted to these tests.",
    )
