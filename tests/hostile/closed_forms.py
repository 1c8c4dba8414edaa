"""Calls of the closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
from values import ALUMINIUM, ARRAY, COATED, HERTZ, PAIR, STEEL, Call

import pyfret as fret
from pyfret import reference

MINDLIN = reference.CattaneoMindlin(HERTZ, bodies=PAIR, mu=0.3)
LUBKIN = reference.Lubkin(HERTZ, bodies=PAIR, mu=0.3)
LINE = reference.line_contact(R=0.01, bodies=PAIR, W=1e5)
HAMILTON = reference.HertzStress(a=1e-4, nu=0.3)
COATING = COATED.coatings[0]
INDENTED = reference.coated_indentation(
    R=0.01, indenter=STEEL, coating=fret.Coating(STEEL, thickness=1e-4), substrate=STEEL, W=10.0
)
INSIDE = np.linspace(0.1, 1.0, 5) * HERTZ.a


def springs(**changed: Any) -> object:
    """Springs, loaded."""
    made = {"R": 0.01, "bodies": PAIR, "mu": 0.3, "n": 10} | changed
    load = {"W": 50.0, "T": 5.0, "steps": 3}
    load |= {key: made.pop(key) for key in load if key in made}
    return reference.Springs(HERTZ, **made).load(**load)


CALLS: list[Call] = [
    ("hertz", reference.hertz, {"R": 0.01, "bodies": PAIR, "W": 10.0}),
    ("Hertz.p", HERTZ.p, {"0": ARRAY}),
    (
        "hertz_ellipse",
        reference.hertz_ellipse,
        {"R_x": 0.01, "R_y": 0.02, "E_star": 1e11, "W": 10.0},
    ),
    (
        "CattaneoMindlin",
        lambda **k: reference.CattaneoMindlin(HERTZ, **k).T_limit,
        {"bodies": PAIR, "mu": 0.3},
    ),
    ("stick_radius", MINDLIN.stick_radius, {"0": 5.0}),
    ("stick_radius_reversed", MINDLIN.stick_radius_reversed, {"0": 5.0, "T_m": 6.0}),
    ("q_loading", MINDLIN.q_loading, {"0": ARRAY, "T": 5.0}),
    ("q_unloading", MINDLIN.q_unloading, {"0": ARRAY, "T": 5.0, "T_m": 6.0}),
    ("q_reloading", MINDLIN.q_reloading, {"0": ARRAY, "T": 5.0, "T_m": 6.0}),
    ("shift_loading", MINDLIN.shift_loading, {"0": ARRAY}),
    ("shift_unloading", MINDLIN.shift_unloading, {"0": ARRAY, "T_m": 6.0}),
    ("shift_reloading", MINDLIN.shift_reloading, {"0": ARRAY, "T_m": 6.0}),
    ("loop_energy", MINDLIN.loop_energy, {"0": 5.0}),
    ("energy_ratio", MINDLIN.energy_ratio, {"0": 5.0}),
    ("Lubkin", lambda **k: reference.Lubkin(HERTZ, **k).M_limit, {"bodies": PAIR, "mu": 0.3}),
    ("Lubkin.phi", LUBKIN.phi, {"0": INSIDE}),
    ("Lubkin.M_z", LUBKIN.M_z, {"0": INSIDE}),
    ("Lubkin.stick_radius", LUBKIN.stick_radius, {"M_z": 1e-4}),
    ("Lubkin.q", LUBKIN.q, {"0": ARRAY, "c": 5e-5}),
    (
        "HertzStress",
        lambda **k: reference.HertzStress(**k).pressure(ARRAY, 0.0, 1e-5),
        {"a": 1e-4, "nu": 0.3},
    ),
    ("HertzStress.pressure", HAMILTON.pressure, {"0": ARRAY, "1": 0.0, "2": 1e-5}),
    ("HertzStress.shear", HAMILTON.shear, {"0": ARRAY, "1": 0.0, "2": 1e-5}),
    ("line_contact", reference.line_contact, {"R": 0.01, "bodies": PAIR, "W": 1e5}),
    ("LineContact.p", LINE.p, {"0": ARRAY}),
    ("stick_half_width", LINE.stick_half_width, {"T": 1e4, "mu": 0.3}),
    ("stick_middle", LINE.stick_middle, {"eps_x": 1e-5, "mu": 0.3}),
    ("LineContact.q", LINE.q, {"0": ARRAY, "T": 1e4, "mu": 0.3, "middle": 0.0}),
    ("LineContact.stress", LINE.stress, {"0": ARRAY, "1": 1e-5, "T": 1e4, "mu": 0.3}),
    ("Springs", springs, {"R": 0.01, "bodies": PAIR, "mu": 0.3, "n": 10}),
    ("Springs.load", springs, {"W": 50.0, "T": 5.0, "steps": 3}),
    ("dundurs_beta", reference.dundurs_beta, {"0": STEEL, "1": ALUMINIUM}),
    ("goodman_stick_ratio", reference.goodman_stick_ratio, {"beta": 0.1, "mu": 0.3}),
    ("coupled_indentation", reference.coupled_indentation, {"beta": 0.1, "mu": 0.3}),
    (
        "coated_indentation",
        reference.coated_indentation,
        {
            "R": 0.01,
            "indenter": STEEL,
            "coating": fret.Coating(ALUMINIUM, thickness=1e-4),
            "substrate": STEEL,
            "W": 10.0,
        },
    ),
    ("CoatedIndentation.p", INDENTED.p, {"0": ARRAY}),
]
