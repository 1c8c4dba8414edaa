"""The published sets, one function each."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass, field
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from pyfret import reference
from pyfret import wear as wearing
from pyfret._core import Body, Coating, Cylinder, Elastic, Grid, LoadPath, Scene, Sphere
from pyfret.quantities import FrictionCoefficient, Length, LineForce, as_number, quantities
from pyfret.shapes import FlatPunch

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = [
    "NAMES",
    "Experiment",
    "arnaud2021",
    "baydoun2019",
    "fouvry2007",
    "fouvry2017",
    "icf13",
    "table",
    "vanpeteghem2011",
]

#: Files of numbers.
NAMES = (
    "arnaud2021_alpha",
    "arnaud2021_profiles",
    "baydoun2019",
    "baydoun2020_distance",
    "fouvry2007_coatings",
    "fouvry2007_mos2_lives",
    "fouvry2007_tic_depth",
    "fouvry2007_tic_lives",
    "fouvry2007_tic_volume",
    "fouvry2007_tin_lives",
    "fouvry2017_ti64",
    "icf13_952_thresholds",
    "vanpeteghem2011",
)
#: Ti-6Al-4V of the cylinders and flats of Fouvry's group.
TI64 = Elastic(E=119e9, nu=0.29)
#: Part of the debris that stays between Ti-6Al-4V (Arnaud, Baydoun, Fouvry 2021).
KEPT = 0.85
#: Oxygen between Ti-6Al-4V: 218.64 1/s at 0.024 W/mm^2, exponent 0.94 (Arnaud and others 2021).
#: The oxygen distance enters for D/r: 1.753 mm, lambda 0.1353 mm.
TI64_AIR = wearing.Air(distance=1.753e-3, power_density=24e3, power_exponent=0.94)
#: Bed of debris of Ti-6Al-4V: kappa fitted on the U-shaped profile of Arnaud and others 2021. It
#: takes up 0.75 of the volume that is worn without oxygen.
TI64_BED = wearing.DebrisBed(kappa=4.444e-3, starved_yield=0.75)
#: Oxygen between flats of 34NiCrMo16: 1.51 mm (f/1 Hz)^-0.22 (p/100 MPa)^-0.32 (S. Baydoun, S.
#: Fouvry, Tribol. Int. 147 (2020) 106266, arXiv 2101.12014).
STEEL_AIR = wearing.Air(
    distance=1.51e-3,
    pressure=1e8,
    pressure_exponent=0.64,
    frequency=1.0,
    frequency_exponent=0.44,
)
#: Coefficients of cylinder and plane, of half of the energy each, in air (Arnaud and others 2021).
#: Without oxygen 0.7 times the published 0.9e-13 and 1.4e-13: least squares of ln V over the ten
#: tests of :data:`TI64_CARRIED`.
TI64_LAWS = (
    wearing.DissipatedEnergy(alpha=4.1e-13, starved=0.63e-13),
    wearing.DissipatedEnergy(alpha=5.1e-13, starved=0.98e-13),
)
#: Tests of Fouvry and others 2017 under a constant force that one set of constants carries: R = 80
#: mm, and p_H of 371 MPa and more. The contacts of R_1, R_3, P_4 and P_5 are small. At 5 Hz they
#: wear up to 5.6 times less than computed.
TI64_CARRIED = ("P_2", "f_1", "f_2", "f_4", "f_5", "f_7", "f_8", "RP_f_15", "RP_f_20", "RP_f_31")
ARNAUD = (
    "P. Arnaud, S. Baydoun, S. Fouvry, Tribol. Int. 161 (2021) 107077, "
    "doi:10.1016/j.triboint.2021.107077"
)


@dataclass(frozen=True)
class Experiment:
    """A published test.

    Attributes
    ----------
    citation : str
        Where it was published.
    scene : Scene
        The contact and its path.
    row : dict
        The numbers of the test, SI units, named as in its table.
    arguments : dict
        Arguments of :func:`pyfret.wear.solve`; empty where nothing wears.
    remarks : tuple of str
        Misprints, and what was derived or chosen.
    """

    citation: str
    scene: Scene
    row: Mapping[str, Any]
    arguments: Mapping[str, Any] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()

    def wear(self, **changes: Any) -> wearing.WearResult:
        """Wear the scene as in the test, with changes of its arguments."""
        if not self.arguments:
            raise ValueError("nothing wears in this test: solve its scene")
        return wearing.solve(self.scene, progress=False, **{**self.arguments, **changes})


@quantities
def table(name: str) -> list[dict[str, Any]]:
    """Rows of a file of :data:`NAMES`: numbers where they are, else texts; None where empty."""
    if name not in NAMES:
        raise ValueError(f"{name!r}: must be one of {', '.join(NAMES)}")
    text = files("pyfret.experiments").joinpath("data", f"{name}.csv").read_text(encoding="utf-8")
    return [{k: number(v) for k, v in row.items()} for row in csv.DictReader(text.splitlines())]


def number(text: str) -> float | str | None:
    """Read a cell of a table as a number, a text, or None if it is empty."""
    try:
        return float(text) if text else None
    except ValueError:
        return text


def row_of(name: str, key: str, value: str) -> dict[str, Any]:
    """Return the row of the test `name` whose column `key` has this value."""
    rows = table(name)
    for row in rows:
        if row[key] == value:
            return row
    raise ValueError(f"{value!r}: must be one of {', '.join(str(row[key]) for row in rows)}")


def to_and_fro(W: float, slip: float, *, W_end: float | None = None) -> LoadPath:
    """Press, then slide between -slip and slip; with `W_end` the ends have that force."""
    path = LoadPath.start().normal(W).displace(delta_x=slip)
    if W_end is None:
        return path.displace(delta_x=-slip).displace(delta_x=slip)
    branches = path.displace(delta_x=-slip).displace(delta_x=slip).branches
    branches[2] = branches[2].replace(W=W_end)
    return LoadPath(branches)


def line(R: float, W: float, slip: float, mu: float, half_width: float, n: int = 192) -> Scene:
    """Build the scene of a cylinder on a flat of Ti-6Al-4V, on a grid for scar and stroke."""
    return Scene(
        body1=Body(TI64, shape=Cylinder(R=R)),
        body2=Body(TI64),
        friction=mu,
        grid=Grid.strip(extent=2.5 * half_width + 4 * slip, n=n),
        path=to_and_fro(W, slip),
    )


def bed_half_width(R: float, area: float, cycles: float, transport: float) -> float:
    """Return the half-width [m] that the scar of a rigid cylinder does not exceed.

    The worn `area` [m^2] is 2 b^3/(3 R) (1 + b b'/K), b' being the growth per cycle and K the
    `transport` of debris [m^2]. Either term alone bounds b.
    """
    without_debris = (1.5 * R * area) ** (1 / 3)
    slow_debris = (15 / 4 * R * transport * area * cycles) ** (1 / 5)
    return float(min(without_debris, slow_debris))


@quantities
def fouvry2007(
    coating: str = "TiC", *, slip: Length = 75e-6, mu: FrictionCoefficient = 0.45
) -> Experiment:
    """Alumina ball on a hard coating in gross slip, 100 N: S. Fouvry, C. Paulin, T. Liskiewicz.

    Parameters
    ----------
    coating : str
        One of the table ``fouvry2007_coatings``.
    slip, mu : float
        Amplitude of the slip [m] and coefficient of friction: the values of single tests are not
        in the tables. Depth over energy hardly depends on either.
    """
    row, slip = row_of("fouvry2007_coatings", "coating", coating), as_number(slip)
    nu = 0.2 if row["nu"] is None else row["nu"]
    layer = Coating(Elastic(E=row["E_Pa"], nu=nu), thickness=row["thickness_m"])
    scene = Scene(
        title=f"Fouvry 2007, alumina on {coating}",
        body1=Body(Elastic(E=370e9, nu=0.27), shape=Sphere(R=12.7e-3)),
        body2=Body(Elastic(E=230e9, nu=0.3), coatings=[layer]),
        friction=mu,
        grid=Grid.centred(width=2 * (2.2 * 183.3e-6 + slip), n=64),
        path=to_and_fro(100.0, slip),
    )
    energy = 4 * mu * 100.0 * slip
    if not energy > 0.0:
        raise ValueError(f"slip = {slip}, mu = {mu}: both must be positive")
    law = wearing.DissipatedEnergy(row["alpha_m3_per_J"])
    return Experiment(
        "S. Fouvry, C. Paulin, T. Liskiewicz, Tribol. Int. 40 (2007) 1428-1440, "
        "doi:10.1016/j.triboint.2007.02.011",
        scene,
        row,
        {"cycles": 420.0 / energy, "cycling": "sliding", "body2": law},
        (
            "table 3 has a head 10^3 um^3/J: text and figure 3 have 415 um^3/J, the 10^3 is void",
            "table 4 has a head 10^3 J/um^2: it is 10^-3",
            "figure 16a: ticks 50000 and 3000 are 5000 and 30000",
            "the energy density at the centre of figure 13 is the energy over pi a_H^2 (matched "
            "with "
            "figure 3)",
            "strokes, friction and energies of the single tests are not in the tables",
        ),
    )


@quantities
def fouvry2017(test: str, *, debris_kept: float = KEPT, third_body: bool = False) -> Experiment:
    """Ti-6Al-4V cylinder on flat, gross slip of 75 um: a row of S. Fouvry and others' appendix A.

    The coefficient of friction follows from the row's energy, E = 4 mu W slip N; both bodies share
    its V/E equally.

    Parameters
    ----------
    test : str
        A row of the table ``fouvry2017_ti64``.
    debris_kept : float
        Part of the debris that stays in the contact, 0 to 1; the grid is as long as the scar
        that follows needs.
    third_body : bool
        Whether oxygen and a bed of debris are computed, with one set of constants for all tests.
        Then `debris_kept` and V/E of the row are not used.
    """
    row = row_of("fouvry2017_ti64", "test", test)
    slip, W, cycles, length = 75e-6, row["W_max_N_per_m"], row["cycles"], row["L_m"]
    volume = 2.25e-9 if test == "f_4" else row["worn_volume_m3"]
    energy, swing = row["accumulated_energy_J"], row["W_min_over_W_max"]
    mean = 0.5 * (1 + swing) * W
    mu = energy / (4 * mean * slip * cycles * length)
    alpha = volume / energy
    if third_body:
        # The volume that all energy wears in air, and the scar of a rigid cylinder with it.
        area = 0.5 * sum(law.alpha for law in TI64_LAWS) * energy / length
        wide = bed_half_width(row["R_m"], area, cycles, TI64_BED.kappa * slip**2)
    else:
        wide = (1.5 * row["R_m"] * (1 - debris_kept) * volume / length) ** (1 / 3)
    wide = max(wide, 3e-4)
    hertz = row["p_H_Pa"] * 2 * row["R_m"] * 2 * (1 - 0.29**2) / 119e9
    scene = line(row["R_m"], W, slip, mu, 1.25 * max(wide, hertz))
    if swing < 1:
        scene = scene.replace(path=to_and_fro(W, slip, W_end=swing * W))
    law = wearing.DissipatedEnergy(alpha)
    law1, law2 = TI64_LAWS if third_body else (law, law)
    debris: dict[str, Any] = (
        {"air": TI64_AIR, "bed": TI64_BED} if third_body else {"debris_kept": debris_kept}
    )
    return Experiment(
        "S. Fouvry, P. Arnaud, A. Mignot, P. Neubauer, Tribol. Int. 113 (2017) 460-473, "
        "doi:10.1016/j.triboint.2016.12.049, appendix A",
        scene,
        row,
        {
            "cycles": cycles,
            "cycling": "sliding",
            "body1": law1,
            "body2": law2,
            "share1": 0.5,
            "share2": 0.5,
            **debris,
            "frequency": row["frequency_Hz"],
        },
        (
            "the load's head N/m is N/mm; f_4 prints V = alpha = 0 (2.25 mm^3 read off figure 7)",
            "the power density of one test differs between series: worn areas follow from each",
            "where W swings with the shift its waveform is not given: linear from W to W_min and "
            "back",
        ),
    )


@quantities
def arnaud2021(*, debris_kept: float = KEPT, bed: bool = False) -> Experiment:
    """Worn profile of Ti-6Al-4V, U-shaped: P. Arnaud, S. Baydoun, S. Fouvry.

    It is the test RP_f_20 of :func:`fouvry2017`; ``row`` has ``x`` and ``depth`` [m], the depth
    that both bodies together have lost.

    Parameters
    ----------
    debris_kept : float
        Part of the debris that stays in the contact, 0 to 1.
    bed : bool
        Whether a bed of debris is computed in place of `debris_kept`. At 0.11 Hz oxygen is
        everywhere, and the coefficient is V/E of the test.
    """
    test = fouvry2017("RP_f_20", debris_kept=debris_kept)
    arguments = dict(test.arguments)
    if bed:
        del arguments["debris_kept"]
        arguments["bed"] = TI64_BED
    rows = [r for r in table("arnaud2021_profiles") if r["profile"] == "U_0.1Hz_measured"]
    row = {
        **test.row,
        "x": [r["x_m"] for r in rows],
        "depth": [r["total_worn_thickness_m"] for r in rows],
    }
    remarks = (
        "axes W/mm3 are W/mm2; eps 11 mm2/W; alpha_c,ad 1.0e-5 (table), not 0.5e-5",
        "the profile holds 2.81 mm^3, the one of RP_f_20 2.87",
    )
    return Experiment(ARNAUD, test.scene, row, arguments, remarks)


@quantities
def baydoun2019(n: int, *, third_body: bool = False) -> Experiment:
    """Square steel flat on flat, 5 x 5 mm: the n-th row of S. Baydoun and others, from 0.

    Friction mu_e = 0.70, alpha = 4.383e-14 m^3/J.

    Parameters
    ----------
    n : int
        The row of the table ``baydoun2019``.
    third_body : bool
        Whether oxygen is computed, with the distance of Baydoun and Fouvry 2020 (table
        ``baydoun2020_distance``). Without oxygen alpha is then zero: no number is published.
    """
    rows = table("baydoun2019")
    if not 0 <= n < len(rows):
        raise ValueError(f"{n}: must be 0 to {len(rows) - 1}")
    row = rows[n]
    steel, side, slip = Elastic(E=205e9, nu=0.3), 5e-3, row["slip_amplitude_m"]
    scene = Scene(
        body1=Body(steel, shape=FlatPunch(radius=side / math.sqrt(math.pi), edge=0.05)),
        body2=Body(steel),
        friction=0.70,
        grid=Grid.centred(width=2.4 * side, n=72),
        path=to_and_fro(row["pressure_Pa"] * side**2, slip),
    )
    law = wearing.DissipatedEnergy(4.383e-14, starved=0.0 if third_body else None)
    air = {"air": STEEL_AIR} if third_body else {}
    return Experiment(
        "S. Baydoun, S. Fouvry, S. Descartes, P. Arnaud, Wear 426-427 (2019) 676-693, "
        "doi:10.1016/j.wear.2018.12.022",
        scene,
        row,
        {
            "cycles": row["cycles"],
            "cycling": "sliding",
            "body2": law,
            "frequency": row["frequency_Hz"],
            **air,
        },
        (
            "the punch of the model is round, of the same area",
            "the caption of figure 13 omits 150 um",
            "K_s = 0.0132 N/m has no unit that fits",
        ),
    )


@quantities
def icf13(test: str, *, Q: LineForce | None = None, n: int = 256) -> Experiment:
    """Crack threshold of a steel cylinder on a flat in partial slip, with or without bulk stress.

    Parameters
    ----------
    test : str
        A row of ``icf13_952_thresholds``: PF without, FF with bulk stress.
    Q : float, optional
        Amplitude of the shear force [N/m] (default: the measured threshold).
    n : int
        Cells along x.
    """
    row = row_of("icf13_952_thresholds", "test", test)
    steel = Elastic(E=205e9, nu=0.3)
    W, mu = row["W_N_per_m"], 0.8
    amplitude = row["Q_threshold_N_per_m"] if Q is None else as_number(Q)
    most = row["sigma_bulk_max_Pa"]
    least = most * (row["R_bulk"] if row["R_bulk"] is not None else 1.0)
    a = reference.line_contact(R=row["R_m"], bodies=(steel, steel), W=W).a
    path = LoadPath.start().normal(W, increments=1)
    for sign in (1, -1, 1, -1, 1):
        sigma = 0.5 * (most + least) + 0.5 * sign * (most - least)
        path = path.force(T_x=sign * amplitude, sigma_B=sigma, increments=8)
    scene = Scene(
        title=f"ICF13 {test}",
        body1=Body(steel, shape=Cylinder(R=row["R_m"])),
        body2=Body(steel),
        friction=mu,
        grid=Grid.strip(extent=2.4 * a, n=n),
        path=path,
    ).replace(save="all")
    return Experiment(
        "13th Int. Conf. on Fracture, Beijing (2013), paper 952, table 2, "
        "icfweb.org/Proceedings/ICF13B/952",
        scene,
        row,
        {},
        (
            "steel cylinder on steel flat: E = 205 GPa follows from a and p_H, yield 940 to 985 "
            "MPa from "
            "the last column",
            "mu = 0.8 follows from the stick widths of all rows",
        ),
    )


@quantities
def vanpeteghem2011(test: int) -> Experiment:
    """Ti-6Al-4V cylinder on flat, R = 80 mm, force constant: B. Van Peteghem, S. Fouvry, J. Petit.

    Friction mu_e = 0.55 for all rows, with which the energies of the tests under a constant force
    are on average those measured (without test 6, whose stroke is suspect); alpha that of the
    frequency.
    """
    row = next((r for r in table("vanpeteghem2011") if r["test"] == test), None)
    if row is None:
        raise ValueError(f"{test}: must be a test of the table vanpeteghem2011")
    slip, W = 0.5 * row["slip_stroke_m"], 8523 / 8e-3
    alpha = 5.349e-13 if row["frequency_Hz"] < 0.5 else 9.75e-14
    scene = line(0.08, W, slip, 0.55, 2.6e-3)
    law = wearing.DissipatedEnergy(alpha)
    return Experiment(
        "B. Van Peteghem, S. Fouvry, J. Petit, Wear 271 (2011) 1535-1542, "
        "doi:10.1016/j.wear.2011.01.060, table 3",
        scene,
        row,
        {
            "cycles": row["cycles"],
            "cycling": "sliding",
            "body1": law,
            "body2": law,
            "share1": 0.5,
            "share2": 0.5,
            "debris_kept": KEPT,
        },
        (
            "the head of the volumes, m^3, is um^3; test 7 is one decade low; test 6 needs mu_e = "
            "0.95",
            "tests with a variable force open the contact every cycle: they need their waveform",
        ),
    )
