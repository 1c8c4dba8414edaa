"""All public callables, found by introspection, with good arguments for each and hostile ones.

A callable is found in the modules whose names ``pyfret.__all__`` and their ``__all__`` hold:
functions, constructors, and the methods of public classes. Good arguments follow from the name of
a parameter (:data:`GOOD`), or from that and the name of the callable (:data:`OF`).
"""

from __future__ import annotations

import inspect
import math
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from follows import CYCLE, FINDLEY, HISTORY
from values import COATED, FIELD, FLOATS, GRID, HERTZ, INTS, PAIR, PATH, STEEL, TOML, Liar, hostile
from values import scene as small

import pyfret as fret
from pyfret import fatigue, fracture

FOLDER = Path(tempfile.mkdtemp(prefix="hostile-"))
#: Callables that are not called, and why.
LEFT_OUT = {
    "explore": "serves until it is stopped",
    "verify": "solves contacts for seconds and takes a function alone",
    "plot.paper_figures": "draws the paper's figures from its four runs",
    "plot.animate": "writes a film",
    "plot.stress_maps": "takes the stress at 256 depths",
    "fatigue.to_pylife": "needs a package that may be absent",
    "plot.style": "takes nothing",
    "fit.fit": "solves for a quarter of a minute",
    "plot.overview": "draws six panels",
    "Settings.of": "reads what `document` gave",
    "study.Comparison.from_study": "made by `compare`",
    "subsurface.Stress.assign_attrs": "xarray's own",
    "fatigue.OverDistance.from_ranges": "made by `over_distance`",
}
#: Classes of results: pyfret makes them, nobody else.
RESULTS = (tuple, BaseException, *(getattr(fret.study, n) for n in ("Limits", "ThresholdLoad")))
MADE = {
    *(
        "Posterior",
        "FitResult",
        "CrackArrest",
        "CrackLife",
        "Comparison",
        "Experiment",
        "Criterion",
    ),
    *("Life", "LoadFactors", "OverDistance", "Preset", "Check", "Verification"),
}


def cycled(*, coated: bool = True) -> fret.Scene:
    """A small contact with a cycle."""
    body2 = COATED if coated else fret.Body(STEEL)
    return small(body2=body2, path=CYCLE)


RUN = fret.solve(cycled(), save="all", progress=False)
BARE = fret.solve(cycled(coated=False), save="all", progress=False)
STATE = RUN.at(-1)
MATERIALS = fatigue.Materials()
ALLOY = MATERIALS["7075"]
THRESHOLD = fracture.Threshold(dK_th=2e6, dS_0=1e8)
WEAR = fret.wear.Wear(
    cycles=10.0, body2=fret.wear.Archard(1e-14), first_branch=2, cycling="march", jumps=1
)
WORN = fret.wear.solve(small(path=CYCLE), WEAR, progress=False)
LIFE = BARE.life(ALLOY, "smith_watson_topper", z=[1e-6, 2e-5], y=0.0)
FACTORS = BARE.load_factors(3e8, z=[1e-6, 2e-5], y=0.0)
COLUMN = STATE.stress(z=[0.0, 1e-5, 4e-5], x=0.0, y=0.0)
STRESS = STATE.stress(z=[0.0, 1e-5, 4e-5], y=0.0)
ENVELOPE = RUN.envelope([0.0, 1e-5], y=0.0)
LENGTHS = np.array([2e-6, 4e-6, 7e-6, 1e-5])
CRACKS = BARE.crack(0.0, lengths=LENGTHS)
STUDY = fret.study.run(
    small(),
    {"mu": [0.2, 0.3], "body1.shape.sphere.R": [0.01, 0.012]},
    measure=["p_max", "stick_ratio"],
    executor=ThreadPoolExecutor(1),
    progress=False,
)
CONDUCTOR = fret.heat.Conductor(conductivity=40.0, heat_capacity=3.6e6)
HEAT = RUN.temperature(CONDUCTOR, CONDUCTOR, frequency=10.0)
LOOPS = fret.fit.Loops.from_arrays(
    delta=np.array([0.0, 1e-6, 2e-6, 1e-6, 0.0, -1e-6, 0.0]),
    T=np.array([0.0, 3.0, 5.0, 0.0, -4.0, -5.0, 0.0]),
    W=100.0,
)
VIBRATION = fret.LoadHistory.from_array(T_x=[5.0, -5.0, 3.0, -2.0, 5.0])
SPECTRUM = fret.history.Spectrum.from_arrays([1.0, 50.0], [1.0, 1.0])
BAND = fret.LoadHistory.from_spectrum(SPECTRUM, 10.0)
PRESSED = small(body2=fret.Body(STEEL)).replace(path=CYCLE)
DAMAGE = fatigue.damage(PRESSED, VIBRATION, ALLOY, "smith_watson_topper", [0.0], y=0.0)
SWT = ALLOY.assessment("smith_watson_topper")
HISTORY_TOML = "[history.matrix]\nrange = [2.0]\nmean = [0.0]\ncounts = [1.0]\n"
LINE = fret.reference.line_contact(R=0.01, bodies=PAIR, W=1e5)
CATTANEO = fret.reference.CattaneoMindlin(HERTZ, bodies=PAIR, mu=0.3)
LUBKIN = fret.reference.Lubkin(HERTZ, bodies=PAIR, mu=0.3)
DEPTHS = [0.0, 1e-5, 2e-5]
ARREST = fret.study.Arrest(THRESHOLD, lengths=[*LENGTHS])
ARRESTS = fret.study.arrest_map(
    cycled(coated=False),
    W=100.0,
    T=[1.0],
    sigma_B=[1e6],
    arrest=ARREST,
    executor=ThreadPoolExecutor(1),
)
RUNNING = fret.study.running_conditions(
    cycled(coated=False), W=[100.0], T=[5.0], executor=ThreadPoolExecutor(1)
)
POINTS = np.array([[0.0, 0.0, 1e-5], [1e-5, 0.0, 2e-5]])
FRAME = fret.export.Frame()


def flat_stress(points: Any) -> Any:
    """A pulsating tension below a crack."""
    return np.ones((3, *np.shape(points)[:-1])) * 1e7


def written(name: str, text: str) -> Path:
    """A file of a text."""
    (FOLDER / name).write_text(text)
    return FOLDER / name


STORE = FOLDER / "run.zarr"
fret.solve(small(), out=STORE, progress=False)
WORN.save(FOLDER / "worn.zarr")
TABLE = written("table.csv", "delta [um],T [N]\n0,0\n1,3\n2,5\n1,0\n0,-4\n-1,-5\n0,0\n")
MAP = fret.SurfaceMap(np.arange(64.0).reshape(8, 8) * 1e-9, spacing=1e-5)
SURFACE = written("surface.txt", "0 1 2\n1 2 3\n2 3 4\n")

#: Good arguments by the name of the parameter.
GOOD: dict[str, Any] = {
    **{"C": 1e-11, "m": 3.0, "E": 2e11, "nu": 0.3, "E_star": 1e11, "K_max": np.ones(4) * 1e6},
    **{"K_min": np.zeros(4), "L": 2e-5, "M_z": 1e-4, "R": 0.01, "R_x": 0.01, "R_y": 0.02},
    **{"T": 1.0, "T_m": 5.0, "T_x": 1.0, "T_y": 1.0, "W": 100.0, "a": 1e-4, "alpha": 1e-14},
    **{"alpha_substrate": 1e-5, "amplitude": 1e-8, "wavelength": 1e-4, "aspect": 0.5},
    **{"beta": 0.2, "between": (0.2, 0.4), "bodies": PAIR, "body": COATED, "body1": COATED},
    **{"body2": COATED, "bottom": 2e9, "top": 1e9, "c": 5e-5, "cell": (1e-5, 1e-5)},
    **{"coating": COATED.coatings[0], "coatings": COATED.coatings, "conductivity": 40.0},
    **{"conductor1": CONDUCTOR, "conductor2": CONDUCTOR, "cracks": CRACKS, "criteria": ["ruiz"]},
    **{"criterion": "smith_watson_topper", "crown": 1.0, "cycles": 10.0, "dK_th": 2e6},
    **{"dataset": RUN.dataset, "delta": LOOPS.delta, "delta_x": 1e-6, "delta_z": 1e-6},
    **{"depth": 1e-5, "dx": 1e-5, "dy": 1e-5, "edge": 0.01, "end": 1e-5, "eps_x": 1e-5},
    **{
        "envelope": ENVELOPE,
        "exponent": 2.0,
        "extent": 8e-4,
        "width": 8e-4,
        "factor": 2.0,
        "factors": FACTORS,
    },
    **{
        "force": 1.0,
        "temperatures": HEAT,
        "friction": 0.3,
        "frequency": 10.0,
        "grid": GRID,
        "heat_capacity": 3.6e6,
    },
    **{"hertz": HERTZ, "hurst": 0.8, "increments": 2, "indenter": STEEL, "k": 1e-14},
    **{"k_x": np.array([1e3, 2e3]), "k_y": np.array([1e3, 2e3]), "layers": 3, "length": 1e-5},
    **{"lengths": LENGTHS, "life": LIFE, "longest": 2e-4, "shortest": 1.5e-4, "rms": 1e-8},
    **{"material": STEEL, "materials": ALLOY, "measure": "p_max", "mu": 0.3, "n": 8},
    **{"name": "steel", "nx": 6, "ny": 5, "of": "von_mises", "p": FIELD, "q_x": FIELD * 0.1},
    **{"q_y": FIELD * 0.1, "parts": [fret.Sphere(R=0.01)], "path": PATH, "p0": 1e9},
    **{"paris": fracture.Paris(C=1e-30, m=3.0), "peel_strength": 1e9, "shear_strength": 1e9},
    **{"point": (0.0, 1e-5, 1e-5), "points": POINTS, "r": np.array([0.0, 5e-5]), "result": BARE},
    **{"results": {1.0: RUN}, "s_y": 3e8, "scene": small(), "settings": fret.Settings()},
    **{"shown": STATE, "sigma_B": 1e6, "signal": np.array([0.0, 1.0, 0.0, 2.0]), "slope": 0.01},
    **{"spacing": (1e-6, 1e-6), "start": 2e-6, "state": STATE, "stick": FIELD > 2e6},
    **{"stiffness": 1e7, "store": STORE, "stress": 1e8, "study": STUDY, "substrate": STEEL},
    **{"table": STUDY.dataset, "temperature_change": -100.0, "text": TOML, "thickness": 1e-5},
    **{"threshold": THRESHOLD, "to": 1e-7, "toughness": 10.0, "unit": "um", "radius": 1e-4},
    **{"unknown": {"friction.mu": (0.2, 0.5)}, "value": 1.0, "values": np.zeros((20, 20))},
    **{"wear": WEAR, "which": -1, "width": 1e-4, "x": 1e-5, "y": 0.0, "z": [0.0, 1e-5]},
    **{"rolled": 1e-4, "t": 9.0, "phi_x": 1e-9, "legs": [(1e-5, 0.0)], "vectors": POINTS},
    **{"bond": fret.Bond(), "arrest": ARREST},
    **{"form": "plane", "short": 2.5e-5, "long": 3.5e-5, "surface": MAP},
    **{"below": STEEL, "frame": FRAME, "family": "steel", "faces": [np.array([0, 1, 0])]},
    **{
        "data": LOOPS,
        "tests": [(lambda _: cycled(coated=False), 1.0)],
        "down": [True, True, False],
    },
    **{"cycle": -1, "tolerance": 1e-2, "angle": 0.1, "azimuth": 0.0, "body_number": 2, "set": []},
    **{name: STEEL for name in ("ball", "flat", "cylinder", "first", "second", "pad", "rough")},
    **{"surface": fret.shapes.Rough(rms=1e-8, hurst=0.8, longest=2e-4, shortest=1.5e-4)},
    **{"kinetic": 0.2, "friction": 0.1, "residual": [-1e8], "save": "all", "harmonics": 4},
    **{"constant": (0.0,) * 6, "bulk": 0.0, "error": 0.1, "room": 1.2, "noise": 1e-8},
    **{"sigma_B1": 1e6, "bulk_ratio": 0.0, "scatter": 2.0, "walker": 0.5, "Y": 1.0, "dS_0": 1e8},
    **{
        "kink": (1e-6, 0.2),
        "event_depth_fraction": 0.1,
        "share1": 0.5,
        "debris_kept": 0.1,
        "jumps": 1,
    },
    **{"s": 1.0, "missing": "refuse", "seed": 1, "phase": 0.1, "aliases": 0, "enlargement": 2},
    **{"max_alternations": 60, "max_iterations": 1000, "kernel_tolerance": 1e-6, "normal": 1e-12},
    **{"limit": 1e8, "stress_amplitude": 1e8, "skip": 0, "tilt": False, "first_branch": 2},
    **{"path_tolerance": 0.1, "hardening": 1e9, "kinematic": 1e9, "turns": 1, "drift": (0.0, 0.0)},
    **{"conductor": CONDUCTOR, "origin": (0.0, 0.0, 0.0), "part": 1.0, "checkpoint": 5.0},
    **{"shear": 1e-12, "workers": 1, "levels": 5, "lines": 3, "rig_stiffness": 1e7, "mu_y": 0.3},
    **{"frf": lambda x, y: fret.kernels.surface_frf(fret.Body(STEEL), x, y)},
}
#: Good arguments by the callable and the name of the parameter.
OF: dict[str, dict[str, Any]] = {
    "compare": {"bodies": {"bare": fret.Body(STEEL)}, "scene": cycled(), "path": None},
    "study.compare": {"bodies": {"bare": fret.Body(STEEL)}, "scene": cycled(), "path": None},
    "open": {"path": STORE},
    "read_surface": {"path": SURFACE, "spacing": 1e-6, "unit": "um"},
    "SurfaceMap.from_file": {"path": SURFACE, "spacing": 1e-6, "unit": "um"},
    "LoadPath": {"branches": []},
    "LoadPath.cycles": {"n": 1, "T_x": 1.0},
    "LoadPath.repeats": {"period": 1.0},
    "LoadPath.sine": {"periods": 1, "T_x": 1.0},
    "LoadPath.from_function": {"function": lambda t: {"T_x": math.sin(t)}, "period": math.tau},
    "LoadPath.displace": {"delta_x": 1e-7},
    "Grid.for_contact": {"body1": small().body1, "body2": COATED},
    "Snapshot.stress": {"bulk": True, "z": [0.0, 1e-5]},
    "plot.arrest_map": {"table": ARRESTS},
    "plot.running_map": {"table": RUNNING},
    "plot.fretting_map": {"table": RUNNING},
    "plot.critical_plane_rose": {"stress": HISTORY[:, 0], "criterion": FINDLEY},
    "plot.dang_van_diagram": {"stress": HISTORY[:, 0], "material": None},
    "plot.crack_path": {"cracks": CRACKS, "ax": None},
    "fatigue.Assessment": {"criterion": FINDLEY, "limit": 1e8},
    "fatigue.Material.number": {"name": "E"},
    "fatigue.Material.estimate_of": {"names": ["dK_th"]},
    "fatigue.Material.assessment": {"criterion": "smith_watson_topper"},
    "fatigue.Materials.get": {"key": "7075", "default": None},
    "fatigue.Life.margin_of": {"layer": 0},
    "fatigue.Life.section": {"place": 0.0},
    "fatigue.Life.range_of": {"layer": 0},
    "fatigue.Life.worst_of": {"layer": 0},
    "fatigue.LoadFactors.least_of": {"layer": 0},
    "fit.Loops.from_arrays": {"T": LOOPS.T},
    "fit.Indentation.from_arrays": {"W": np.array([1.0, 2.0]), "delta_z": np.array([1e-6, 2e-6])},
    "fit.Scar.from_arrays": {"x": LENGTHS, "depth": LENGTHS, "wear": {"cycles": 10}},
    "fracture.Crack.grow": {"end": 2e-5, "stress": flat_stress},
    "fracture.Crack.intensity": {"stress": np.ones((3, 40)) * 1e7},
    "fracture.Paris": {"short": False},
    "fracture.Paris.from_material": {"material": ALLOY},
    "heat.Conductor.from_material": {"material": ALLOY},
    "export.Frame.contact_stress": {"stress": np.ones((2, 3, 3))},
    "export.Frame.stress": {"stress": np.ones((2, 3, 3))},
    "export.nodal_forces": {"faces": [np.array([[0, 1, 0]])]},
    "reference.Springs": {"largest": HERTZ, "n": 20},
    "reference.HertzStress.pressure": {"x": 1e-5, "y": 0.0, "z": 1e-5},
    "reference.HertzStress.shear": {"x": 1e-5, "y": 0.0, "z": 1e-5},
    "reference.LineContact.stress": {"x": 1e-5, "z": 1e-5},
    "wear.WearResult.cycles_to": {"depth": 1e-9},
    "wear.WearResult.error_of": {"quantity": "depth"},
    "wear.WearResult.save": {"path": FOLDER / "w.zarr"},
    "study.Study.save": {"path": FOLDER / "s.zarr"},
    "LoadPath.from_csv": {"path": written("path.csv", "W\n1\n2\n")},
    "LoadHistory": {"channels": {"T_x": np.array([0.0, 1.0])}, "t": np.array([0.0, 1.0])},
    "LoadHistory.from_csv": {"path": written("rig.csv", "t [s];T_x [N]\n0;1\n1;2\n2;1\n")},
    "LoadHistory.from_array": {"T_x": [0.0, 1.0], "t": [0.0, 1.0], "frequency": None},
    "LoadHistory.from_matrix": {
        "range": [2.0],
        "mean": [0.0],
        "counts": [1.0],
        "duration": None,
    },
    "LoadHistory.from_spectrum": {"psd": SPECTRUM, "duration": 10.0, "mean": 0.0},
    "LoadHistory.sample": {"self": BAND, "seed": 1, "duration": None},
    "LoadHistory.equivalent_amplitude": {"exponent": 3.0},
    "LoadHistory.path": {"scene": PRESSED},
    "fatigue.rainflow": {"signal": [0.0, 1.0, 0.0]},
    "fatigue.Damage": {"dataset": DAMAGE.dataset},
    "fatigue.Damage.contributions": {"bins": 4},
    "fatigue.Damage.save": {"path": FOLDER / "d.zarr"},
    "fatigue.DamageLaw": {"exponent": None},
    "fatigue.damage": {
        "contact": PRESSED,
        "history": VIBRATION,
        "materials": ALLOY,
        "criterion": "smith_watson_topper",
        "z": [0.0],
    },
    "fatigue.damage_of_loops": {"values": [1e6], "counts": [1.0], "assessment": SWT},
    "fatigue.add_damages": {"damages": [DAMAGE, DAMAGE], "passes": [1.0, 2.0]},
    "fatigue.equivalent_amplitude": {"history": VIBRATION, "exponent": 3.0},
    "history.read_history": {"scene": written("vibration.toml", HISTORY_TOML), "changes": None},
    "fracture.BlockGrowth": {"dataset": DAMAGE.dataset},
    "fracture.grow_by_history": {
        "contact": PRESSED,
        "history": VIBRATION,
        "growth": fracture.Paris(C=1e-11, m=3.0),
        "x": 0.0,
        "lengths": LENGTHS,
    },
    "plot.load_history": {"history": VIBRATION},
    "plot.loop_histogram": {"loops": VIBRATION.count()},
    "plot.damage_map": {"damage": DAMAGE},
    "plot.damage_contributions": {"damage": DAMAGE},
    "LoadPath.ellipse": {"increments": 4},
    "LoadPath.waypoints": {"increments": 2},
    "LoadPath.from_table": {"increments": 2},
    "LoadPath.tangential": {"T_x": [1.0]},
    "LoadPath.torsion": {"M_z": [1e-4]},
    "Scene.from_file": {"path": written("scene.toml", TOML)},
    **{
        f"Scene.{name}": {"cycles": 2, "quiet": True, "error": 0.2}
        for name in ("ball_on_flat", "cylinder_on_flat", "crossed_cylinders", "flat_pad")
    },
    "Scene.rough_on_flat": {"cycles": 2, "quiet": True, "error": 0.2, "n": 24},
    "Scene.save": {"path": FOLDER / "saved.toml"},
    "Scene.length": {"p": 1e-3},
    "Scene": {"grid": fret.Grid.centred(width=8e-4, n=12)},
    "Profile.table": {"points": [(0.0, 1e9), (1.0, 2e9)]},
    "graded": {"E": fret.Profile.linear(top=1e9, bottom=2e9), "nu": fret.Profile.constant(0.3)},
    "SurfaceOperator": {},
    "fatigue.Materials": {"file": None},
    "fatigue.Material": {"numbers": {"E": (2e11, "measured")}},
    "fatigue.evaluate_criterion": {"stress": HISTORY, "criterion": FINDLEY},
    "fatigue.evaluate_margin": {"stress": HISTORY, "material": ALLOY},
    "fatigue.average": {"material": ALLOY},
    "fatigue.critical_distance": {"material": MATERIALS["aluminium_4Cu"]},
    "fatigue.mean_stress_slope": {"material": ALLOY},
    "fatigue.dang_van_path": {"stress": HISTORY[:, 0]},
    "fatigue.first_yield": {"stress": HISTORY},
    "fatigue.moving_load": {"stress": HISTORY},
    "fatigue.lives": {"criteria": ["smith_watson_topper"]},
    "fit.fit": {"posterior": 0},
    "fit.read_loops": {"path": TABLE},
    "fit.read_indentation": {"path": written("push.csv", "W [N],delta_z [um]\n1,1\n2,2\n3,3\n")},
    "fit.read_scar": {
        "path": written("scar.csv", "x [um],depth [um]\n0,1\n1,2\n2,1\n"),
        "wear": {"cycles": 10},
    },
    "fit.read_lives": {
        "path": written("lives.csv", "cycles,W [N]\n1e4,1\n"),
        "wear": {"cycles": 10},
    },
    "plot.comparison": {"of": None},
    "plot.temperature": {"temperatures": HEAT},
    "plot.temperature_map": {"of": "largest"},
    "plot.section_map": {"aspect": "auto", "values": STRESS.von_mises},
    "plot.stress_map": {"aspect": "auto", "stress": STRESS},
    "plot.stress_along_depth": {"stress": COLUMN, "of": ("s_xx",)},
    "plot.life_over_distance": {"of": LIFE.over_distance([1e-5, 2e-5])},
    "plot.load_path": {"path": CYCLE},
    "plot.load_factor_map": {"of": "von_mises"},
    "plot.wear_history": {"result": WORN},
    "plot.wear_loops": {"result": WORN},
    "plot.wear_profiles": {"result": WORN, "of": "body2"},
    "plot.depth_map": {"result": WORN, "of": "body2"},
    "plot.third_body": {"result": WORN},
    "plot.design_chart": {"x": "mu", "y": "body1.shape.sphere.R"},
    "plot.study_line": {"of": "p_max", "along": "mu"},
    "plot.study_map": {"of": "p_max"},
    "plot.shear_profile": {"of": "q_x"},
    "export.write": {"path": FOLDER / "t.csv", "of": "p"},
    "export.tractions": {"path": FOLDER / "t.csv", "of": "p"},
    "export.image": {"path": FOLDER / "i.vti"},
    "export.loads": {"path": FOLDER / "l.inp", "mesh": SURFACE},
    "export.stress": {"bulk": True, "path": FOLDER / "s.csv"},
    "export.bulk_stress": {"path": SURFACE, "field": "stress"},
    "export.compliance": {"path": SURFACE, "field": "displacement"},
    "subsurface.envelope": {
        "bulk": True,
        "scene": cycled(),
        "increments": [STATE],
        "of": ("von_mises",),
    },
    "subsurface.write_volume": {"out": FOLDER / "v.vti", "of": ("von_mises",), "z": DEPTHS},
    "subsurface.thermal_stress": {"coating": STEEL, "alpha_coating": 1e-5},
    "study.run": {
        "parameters": {"mu": [0.3]},
        "executor": ThreadPoolExecutor(1),
        "measure": "p_max",
    },
    "solve": {"error": False},
    "fit.Loops": {"T": LOOPS.T, "down": LOOPS.down, "cycle": LOOPS.cycle},
    "fit.Indentation": {"W": LENGTHS, "delta_z": LENGTHS},
    "fit.Scar": {"x": LENGTHS, "depth": LENGTHS, "wear": {"cycles": 10}},
    "fit.Lives": {"cycles": LENGTHS, "settings": [{}] * 4, "wear": {"cycles": 10}},
    "study.threshold": {
        "error": True,
        "parameter": "friction.mu",
        "scene": small(grid=fret.Grid.centred(width=8e-4, n=28)),
        "measure": lambda r: 3 * float(r.scene.mu),
    },
    "study.arrest_map": {"T": [1.0], "sigma_B": [1e6], "executor": ThreadPoolExecutor(1)},
    "study.running_conditions": {
        "cycles": 1,
        "W": [100.0],
        "T": [5.0],
        "executor": ThreadPoolExecutor(1),
    },
    "study.Cracking": {},
    "study.Averaged": {"material": ALLOY},
    "study.LargestStress": {"stress": "s_1", "increments": [-1]},
    "study.Candidate": {"mu": 0.3},
    "study.fit_limits": {"material": ALLOY},
    "wear.Air": {"distance": 1e-3, "power_density": 1e4, "power_exponent": 0.9},
    "wear.Archard": {"threshold": 0.0},
    "wear.DebrisBed": {"kappa": 1e-3, "volume_ratio": 1.0},
    "wear.DissipatedEnergy": {"threshold": 0.0},
    "wear.resume": {"store": FOLDER / "worn.zarr"},
    "wear.solve": {"scene": small(path=CYCLE), "path": None, "wear": WEAR},
    "wear.Wear": {"body1": None, "body2": fret.wear.Archard(1e-14)},
    "study.WornDepth": {"body1": None, "body2": fret.wear.Archard(1e-14)},
    "wear.Wear.from_settings": {"settings": {}},
    "experiments.table": {"name": "baydoun2019"},
    "experiments.baydoun2019": {"n": 1},
    "experiments.fouvry2007": {"coating": "TiC"},
    "experiments.fouvry2017": {"test": "R_1"},
    "experiments.icf13": {"test": "PF_1", "n": 16},
    "experiments.vanpeteghem2011": {"test": 1},
    "fracture.Threshold": {"table": [(0.0, 2e6), (1e-3, 3e6)]},
    "fracture.Threshold.from_material": {"material": MATERIALS["aluminium_4Cu"]},
    "fracture.crack": {"x": 0.0},
    "fracture.grow": {"x": 0.0},
    "fracture.buckling_release": {"stress": -1e9, "half_width": 1e-3},
    "fracture.edge_release": {"stress": -1e9},
    "fracture.film_intensity": {"depth": 5e-6},
    "fracture.first_to_fail": {"result": RUN, "x": 0.0},
    "fracture.over_cycle": {"result": RUN, "x": None},
    "heat.temperature": {"result": RUN},
    "Result.crack": {"x": 0.0},
    "Result.life": {"materials": ALLOY},
    "Result.envelope": {"bulk": True, "of": ("von_mises",)},
    "Result.report": {"path": FOLDER / "r.html"},
    "Result.save": {"path": FOLDER / "r.zarr"},
    "Result.export": {"path": FOLDER / "r.csv", "of": "p"},
    "Snapshot.write_volume": {
        "bulk": True,
        "out": FOLDER / "v.vti",
        "of": ("von_mises",),
        "z": DEPTHS,
    },
    "Snapshot.export": {"path": FOLDER / "e.csv", "of": "p"},
    "settings.Settings": {},
    "subsurface.Stress.measure": {"name": "von_mises"},
    "fatigue.Material.estimated": {"name": "x", "E": 2e11, "family": "steel"},
    "fatigue.Life.over_distance": {"L": [1e-5, 2e-5]},
    "kernels.stress_coefficients": {"z": 1e-5, "layer": 0},
    "kernels.stress_at": {"layer": 0},
    "kernels.EigenstrainOperator": {"depth": 2e-5, "height": 1e-5},
}
#: Instances whose methods are called.
INSTANCES: dict[str, Any] = {
    "Result": BARE,
    "Snapshot": STATE,
    "LoadPath": PATH,
    "Scene": small(),
    "Grid": GRID,
    "Body": COATED,
    "Coating": COATED.coatings[0],
    "Elastic": STEEL,
    "Sphere": fret.Sphere(R=0.01),
    "Cylinder": fret.Cylinder(R=0.01),
    "Settings": fret.Settings(),
    "Bond": fret.Bond(),
    "Friction": fret.Friction(0.3),
    "SurfaceMap": fret.SurfaceMap(np.zeros((4, 4)), spacing=(1e-5, 1e-5)),
    "SurfaceOperator": fret.SurfaceOperator(COATED, COATED, GRID),
    "Life": LIFE,
    "LoadFactors": FACTORS,
    "Material": ALLOY,
    "Materials": MATERIALS,
    "Cracks": CRACKS,
    "Threshold": THRESHOLD,
    "Study": STUDY,
    "WearResult": WORN,
    "Wear": WEAR,
    "Loops": LOOPS,
    "Stress": STRESS,
    "Frame": FRAME,
    "CattaneoMindlin": CATTANEO,
    "Lubkin": LUBKIN,
    "LineContact": LINE,
    "HertzStress": fret.reference.HertzStress(a=1e-4, nu=0.3),
    "Hertz": HERTZ,
    "CoupledIndentation": fret.reference.coupled_indentation(beta=0.2, mu=0.3),
    "Crack": fracture.Crack(legs=[(1e-5, 0.0)]),
}


def close() -> None:
    """Close all figures."""
    plt.close("all")


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Every public callable and its name: functions, constructors and methods."""
    seen: set[int] = set()

    def callables_of(module: Any, prefix: str) -> Iterator[tuple[str, Callable[..., Any]]]:
        for name in module.__all__:
            attribute = getattr(module, name)
            if inspect.ismodule(attribute) and id(attribute) not in seen:
                seen.add(id(attribute))
                yield from callables_of(attribute, f"{prefix}{name}.")
            elif inspect.isclass(attribute) and id(attribute) not in seen:
                seen.add(id(attribute))
                if issubclass(attribute, RESULTS):
                    continue
                if name not in MADE:
                    yield f"{prefix}{name}", attribute
                yield from methods(attribute, f"{prefix}{name}.")
            elif callable(attribute) and not inspect.isclass(attribute):
                yield f"{prefix}{name}", attribute

    yield from callables_of(fret, "")


def methods(cls: type, prefix: str) -> Iterator[tuple[str, Callable[..., Any]]]:
    """The public methods of a class, bound to an instance or to the class."""
    instance = INSTANCES.get(cls.__name__)
    for name in sorted(n for n in dir(cls) if not n.startswith("_")):
        static = inspect.getattr_static(cls, name)
        made = isinstance(static, (staticmethod, classmethod)) or inspect.isbuiltin(
            getattr(cls, name)
        )
        if made or (instance is not None and callable(getattr(cls, name))):
            yield f"{prefix}{name}", getattr(cls if made else instance, name)


def good(name: str, call: Callable[..., Any]) -> tuple[dict[str, Any], list[str]] | None:
    """Good arguments of a call by name, and the parameters that may be passed.

    None where the signature is unknown.
    """
    try:
        parameters = inspect.signature(call).parameters.values()
    except (TypeError, ValueError):
        return None
    item = OF.get(name, {})
    needed, free = {}, []
    for element in parameters:
        if element.kind in (element.VAR_POSITIONAL, element.VAR_KEYWORD):
            continue
        if element.name in item:
            needed[element.name] = item[element.name]
        elif element.default is element.empty:
            if element.name not in GOOD:
                return None
            needed[element.name] = GOOD[element.name]
        if element.name in needed or element.name in GOOD:
            free.append(element.name)
    return needed, free


def invoked(call: Callable[..., Any], arguments: dict[str, Any]) -> Any:
    """Call with arguments by name, those by position alone in their places."""
    parameters = inspect.signature(call).parameters
    places = [n for n, p in parameters.items() if p.kind is p.POSITIONAL_ONLY and n in arguments]
    remainder = {n: v for n, v in arguments.items() if n not in places}
    return call(*(arguments[n] for n in places), **remainder)


def never(value: Any) -> list[Any]:
    """Values that are no numbers, to be refused wherever a number like `value` is expected."""
    if isinstance(value, float):
        return [True, float("nan"), np.True_, 1j, "x", np.ma.masked]
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        torn = value.copy()
        torn.flat[0] = np.nan
        return [torn, np.ma.array(value, mask=torn != torn), value > 0, value + 1j, "x"]
    return []


def nested(levels: int) -> list[Any]:
    """A list within a list, so many deep."""
    value: list[Any] = []
    for _ in range(levels):
        value = [value]
    return value


#: Functions of the user that another function calls, which fail by themselves.
FUNCTIONS = {
    "kernels.convert(frf)",
    "fracture.Crack.grow(stress)",
    "fracture.Crack.intensity(friction)",
}
#: What makes values of classes that no parameter takes.
OF_NO_CLASS: list[Callable[[], Any]] = [
    object,
    lambda: 3 + 4j,
    lambda: b"bytes",
    lambda: 10**400,
    lambda: {1, 2},
    lambda: {"a": 1},
    lambda: nested(3000),
    lambda: int,
    lambda: len,
    lambda: np.array([object()]),
    lambda: np.datetime64("2026-01-01"),
    lambda: fret.Sphere(R=1.0),
]


def unlike(value: Any) -> list[Any]:
    """Hostile values in the place of `value`, of its type and of some other types."""
    computed = [*hostile(value), *never(value), None, object(), {}, [], "", Liar([1.0]), b"x"]
    if isinstance(value, np.ndarray) and value.ndim:
        axes = [f"a{n}" for n in range(value.ndim)]
        computed += [xr.DataArray(value, dims=axes), xr.DataArray(value.T, dims=axes[::-1])]
    if isinstance(value, (Path, str)):
        computed += [FOLDER, FOLDER / "nothing.csv", "\0", "a" * 5000]
    return [*computed, *FLOATS[:5], *INTS[-3:]]


def free_of(name: str, key: str) -> bool:
    """Whether a parameter takes other things than numbers, or holes, or is looked at later."""
    return key in OTHERS.get(name, ())


#: Parameters of which a value that is no number is not refused at once.
OTHERS: dict[str, set[str]] = {
    # Refused by name with the scene or the body that they go into.
    "LoadPath": {"rig_stiffness"},
    "LoadPath.rig": {"stiffness"},
    "LoadPath.ellipse": {"T_x", "T_y"},
    "Profile.constant": {"value"},
    "Profile.exponential": {"top", "bottom"},
    "Profile.linear": {"top", "bottom"},
    "Profile.power": {"top", "bottom", "exponent"},
    # Missing values are holes: their rows are left out.
    "fit.Loops.from_arrays": {"delta", "T"},
    "fit.Indentation.from_arrays": {"W", "delta_z"},
    "fit.Scar.from_arrays": {"x", "depth"},
    # Names of columns.
    "fit.read_scar": {"x", "depth"},
    # A yield stress for each layer is a list.
    "Result.load_factors": {"s_y"},
}
