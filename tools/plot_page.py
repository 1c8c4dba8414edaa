"""Write the page of all figures, docs/reference/figures.md, with a picture of each.

    python tools/plot_page.py

The code above a picture is the one that drew it.
"""

from __future__ import annotations

import inspect
import io
import re
import warnings
from pathlib import Path
from typing import Any
from unittest.mock import patch

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import pyfret as fret
from pyfret import plot
from pyfret.plot import sizes

DOCS = Path(__file__).parents[1] / "docs"
PICTURES = DOCS / "figures" / "plots"
#: Pixels of a picture for one inch of its figure, the most across, and its colours.
PIXELS, WIDTH, COLOURS = 110, 900, 160

#: What is drawn of what, by what a reader looks for.
FIGURES: dict[str, dict[str, str]] = {
    "A run": {
        "overview": "result.plot()",
        "fretting_loop": "fret.plot.fretting_loop(result)",
        "loop_evolution": "fret.plot.loop_evolution(many)",
        "stick_ratio": "fret.plot.stick_ratio(result)",
        "load_path": "fret.plot.load_path(result)",
    },
    "The contact": {
        "stick_slip": "fret.plot.stick_slip(result.at(-1))",
        "pressure_map": "fret.plot.pressure_map(result.at(-1))",
        "slip_map": "fret.plot.slip_map(result.at(-1))",
        "shear_streamlines": "fret.plot.shear_streamlines(result.at(-1))",
        "pressure_profile": "fret.plot.pressure_profile(result.at(-1))",
        "shear_profile": "fret.plot.shear_profile(result.at(-1), bound=True)",
        "shear_profiles": "fret.plot.shear_profiles(result)",
    },
    "Rough contacts": {
        "surface_heights": "fret.plot.surface_heights(heights)",
        "spots": "fret.plot.spots(rough)",
        "gap_map": "fret.plot.gap_map(rough)",
        "pressure_histogram": "fret.plot.pressure_histogram(rough)",
        "area_over_load": "fret.plot.area_over_load(rough)",
    },
    "Stress below": {
        "stress_map": "fret.plot.stress_map(result.at(-1).stress())",
        "stress_along_depth": "fret.plot.stress_along_depth(result.at(-1).stress(x=0.0, y=0.0))",
        "section_map": "fret.plot.section_map(result.at(-1).stress().s_xx)",
        "envelope_maps": "fret.plot.envelope_maps(result.envelope(y=0.0))",
        "stress_history": "fret.plot.stress_history(rig.envelope(y=0.0))",
        "stress_maps": "fret.plot.stress_maps(by_ratio)",
    },
    "Bodies that yield": {
        "plastic_zone": "fret.plot.plastic_zone(yielding.at(4))",
        "residual_stress": "fret.plot.residual_stress(yielding)",
    },
    "Fatigue, yield, cracks": {
        "criterion_map": "fret.plot.criterion_map(life)",
        "load_factor_map": "fret.plot.load_factor_map(rig.load_factors(880e6))",
        "critical_plane_rose": "fret.plot.critical_plane_rose(history, criterion)",
        "dang_van_diagram": 'fret.plot.dang_van_diagram(history, material="titanium_6Al4V")',
        "haigh_diagram": "fret.plot.haigh_diagram(life)",
        "life_over_distance": "fret.plot.life_over_distance(life.over_distance(lengths))",
        "crack_arrest": "fret.plot.crack_arrest(cracks, threshold)",
        "kitagawa": "fret.plot.kitagawa(cracks, threshold)",
        "intensity": "fret.plot.intensity(cracks)",
        "intensity_history": "fret.plot.intensity_history(cracks, 1e-4)",
        "crack_panels": "fret.plot.crack_panels(rig, cracks, threshold)",
    },
    "Load histories": {
        "load_history": "fret.plot.load_history(measured)",
        "loop_histogram": "fret.plot.loop_histogram(measured.count())",
        "damage_map": "fret.plot.damage_map(damage)",
        "damage_contributions": "fret.plot.damage_contributions(damage)",
    },
    "Wear and heat": {
        "wear_history": "fret.plot.wear_history(worn)",
        "wear_profiles": "fret.plot.wear_profiles(worn)",
        "wear_loops": "fret.plot.wear_loops(worn)",
        "depth_map": "fret.plot.depth_map(worn)",
        "third_body": "fret.plot.third_body(oxidised)",
        "temperature": "fret.plot.temperature(hot)",
        "temperature_map": 'fret.plot.temperature_map(hot, of="flash")',
    },
    "Many runs": {
        "comparison": "fret.plot.comparison(compared)",
        "study_line": 'fret.plot.study_line(study, "loop_energy")',
        "study_map": 'fret.plot.study_map(study, "loop_energy")',
        "running_map": "fret.plot.running_map(table)",
        "fretting_map": "fret.plot.fretting_map(table)",
        "arrest_map": "fret.plot.arrest_map(stopping)",
        "design_chart": (
            'fret.plot.design_chart(first, "friction.mu", "body2.coatings.0.thickness")'
        ),
    },
}
#: Names of the module that draw no figure of their own.
OTHERS = {
    "crack_path": "draws a crack into the figure of a section, as `crack_panels` does",
    "animate": "writes a film of a path: loop, zones and shear, as `.gif` or `.mp4`",
    "paper_figures": "writes figures 4 to 13 of the paper from its four runs",
    "style": "sets the look inside a `with` block, for figures of your own beside these",
}


def oxidised() -> Any:
    """A scar of titanium whose middle oxygen does not reach."""
    titanium = fret.Elastic(E=119e9, nu=0.29)
    path = fret.LoadPath.start().normal(1.066e6)
    scene = fret.Scene(
        body1=fret.Body(titanium, shape=fret.Cylinder(R=80e-3)),
        body2=fret.Body(titanium),
        friction=0.6,
        grid=fret.Grid.strip(extent=5.5e-3, n=160),
        path=path.displace(delta_x=75e-6).displace(delta_x=-75e-6).displace(delta_x=75e-6),
    )
    law = fret.wear.DissipatedEnergy(alpha=2.25e-13, starved=4e-14)
    return fret.wear.solve(
        scene,
        cycles=5000,
        body1=law,
        body2=law,
        frequency=3.0,
        air=fret.wear.Air(distance=1.753e-3, power_density=24e3, power_exponent=0.94),
        bed=fret.wear.DebrisBed(kappa=4.444e-3, starved_yield=0.75),
        tolerance=0.05,
        progress=False,
    )


def yielding() -> Any:
    """A hard film on titanium that yields, pressed and let go."""
    titanium = fret.Elastic(E=115e9, nu=0.32, plastic=fret.Plastic(s_y=900e6, hardening=2e9))
    film = fret.Coating(fret.Elastic(E=460e9, nu=0.2), thickness=30e-6)
    scene = fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(titanium, coatings=film),
        friction=0.0,
        grid=fret.Grid.centred(width=7.2e-4, n=32),
    )
    path = fret.LoadPath.start().normal(340.0, increments=4).normal(0.5, increments=2)
    return fret.solve(scene, path, progress=False)


def rough() -> dict[str, Any]:
    """A ground ball on a flat, and the map of its roughness."""
    steel, n, pitch = fret.Elastic(E=210e9, nu=0.3), 128, 2e-6
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.fftfreq(n)[None, :])
    amplitude = np.where((k > 0) & (k < 0.12), np.maximum(k, 0.03) ** -1.8, 0.0)
    white = np.fft.fft2(np.random.default_rng(2).standard_normal((n, n)))
    z = np.fft.ifft2(white * amplitude).real
    heights = fret.SurfaceMap(1.5e-7 * z / z.std(), spacing=pitch)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=8e-3) + heights),
        body2=fret.Body(steel),
        friction=0.0,
        grid=fret.Grid.from_spacing((n, n), (pitch, pitch)),
    )
    path = fret.LoadPath.start().normal(4.0, increments=10)
    return {"heights": heights, "rough": fret.solve(scene, path, progress=False)}


def names() -> dict[str, Any]:
    """What the code of the figures draws."""
    steel, hard = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=420e9, nu=0.25)
    R, W, mu = 5e-3, 10.0, 0.3
    a = fret.reference.hertz(R=R, bodies=(steel, steel), W=W).a
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R)),
        body2=fret.Body(steel, coatings=fret.Coating(hard, thickness=0.5 * a)),
        friction=mu,
        grid=fret.Grid.centred(width=2.4 * a, n=48),
    )
    pressed = fret.LoadPath.start().normal(W, increments=1)
    path = pressed.cycles(1, T_x=0.8 * mu * W, increments=16)
    result = fret.solve(scene, path, save="all", progress=False)
    small = scene.replace(grid=fret.Grid.centred(width=2.4 * a, n=24))
    bare = small.replace(body2=fret.Body(steel))
    # Friction that rises as the surfaces rub.
    rising = fret.Friction(mu, history=(fret.History.SLIP, [(0.0, 0.6), (2e-6, 1.2)]))
    many = fret.solve(
        small.replace(friction=rising),
        pressed.cycles(8, delta_x=2.5e-7, increments=12),
        progress=False,
    )
    by_ratio = {2.0: result}
    for ratio in (0.5, 4.0):
        film = fret.Coating(fret.Elastic(E=ratio * 210e9, nu=0.3), thickness=0.5 * a)
        by_ratio[ratio] = fret.solve(
            scene.replace(body2=fret.Body(steel, coatings=film)),
            pressed.cycles(1, T_x=0.8 * mu * W, increments=8),
            progress=False,
        )

    titanium = fret.material("titanium_6Al4V")
    line = fret.Scene(
        body1=fret.Body(titanium, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(titanium),
        friction=0.6,
        grid=fret.Grid.strip(extent=1.6e-3, n=96),
    )
    rig_path = fret.LoadPath.start().force(W=4e5, increments=1)
    for sign in (1, -1, 1, -1, 1):
        rig_path = rig_path.force(T_x=sign * 1.2e5, sigma_B=sign * 1e8, increments=8)
    rig = fret.solve(line, rig_path, save="all", progress=False)
    table = fret.fatigue.Materials()
    life = rig.life(table["titanium_6Al4V"], "smith_watson_topper")
    worst = life.worst
    history = fret.fatigue.history(rig, [worst.z], y=0.0)
    history = history.sel(x=worst.x, method="nearest").isel(depth=0)

    slid = pressed.displace(delta_x=[4e-6, -4e-6, 4e-6], increments=12)
    hot = fret.solve(bare, slid, save="all", progress=False).temperature(
        table["titanium_6Al4V"], table["titanium_6Al4V"], frequency=60.0
    )
    wearing = fret.Friction(mu, history=(fret.History.CYCLES, [(0.0, 1.0), (2e4, 1.5)]))
    wide = bare.replace(grid=fret.Grid.centred(width=4.5 * a, n=32), friction=wearing)
    worn = fret.wear.solve(
        wide,
        path=pressed.cycles(1, delta_x=4e-6, increments=8),
        cycles=3e4,
        body2=fret.wear.Archard(2e-15),
        progress=False,
    )
    study = fret.study.run(
        small.replace(path=pressed.cycles(1, T_x=0.5 * mu * W, increments=2)),
        {
            "body2.coatings.0.thickness": (a * np.geomspace(0.1, 1.0, 6)).tolist(),
            "body2.coatings.0.E": [1e11, 1.5e11, 2e11, 2.5e11, 3e11, 4e11],
        },
        measure="loop_energy",
        executor=1,
        progress=False,
    )
    threshold = fret.fracture.Threshold(dK_th=2.5e6, dS_0=300e6)
    stopping = fret.study.arrest_map(
        line,
        W=4e5,
        T=np.linspace(2e4, 2.2e5, 9),
        sigma_B=np.linspace(0.0, 3.5e8, 8),
        arrest=fret.study.Arrest(threshold),
    )
    nitride = fret.Coating(fret.Elastic(E=450e9, nu=0.25), thickness=2e-5)
    pulled = fret.LoadPath.start().force(W=4e5, increments=1)
    for T, bulk in ((1e5, 1.6e8), (-1e5, 0.0), (1e5, 1.6e8)):
        pulled = pulled.force(T_x=T, sigma_B=bulk, increments=3)
    first = fret.study.run(
        line.replace(body2=fret.Body(titanium, coatings=nitride), path=pulled, save="all"),
        {
            "friction.mu": [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9],
            "body2.coatings.0.thickness": [1e-5, 1.6e-5, 2.5e-5, 4e-5, 6.3e-5],
        },
        measure=fret.study.FirstToFail(
            toughness=90.0,
            peel_strength=80e6,
            shear_strength=120e6,
            threshold=fret.fracture.Threshold(dK_th=4.5e6, dS_0=540e6),
            residual=[-5e8, 0.0],
            x=-6.3e-4,
        ),
        executor=1,
        progress=False,
    ).dataset
    running = fret.study.running_conditions(
        bare, W=np.linspace(2, W, 5), delta=np.geomspace(0.05e-6, 1.2e-6, 6), executor=1
    )
    coated = fret.Body(titanium, coatings=nitride)
    compared = fret.compare(
        {
            "bare": fret.study.Candidate(line.body2, materials=table["titanium_6Al4V"]),
            "nitride": fret.study.Candidate(
                coated, mu=0.5, materials=table["titanium_6Al4V"], toughness=90.0
            ),
        },
        line,
        rig_path,
        executor=1,
        progress=False,
    )
    band = ([40.0, 60.0, 120.0], [0.02 * (0.2 * mu * W) ** 2, 0.01 * (0.2 * mu * W) ** 2, 0.0])
    measured = fret.LoadHistory.from_spectrum(band, 20.0, mean=0.2 * mu * W).sample(seed=2)
    damage = fret.fatigue.damage(
        bare.replace(path=pressed), measured, table["steel_42CrMo4"], "smith_watson_topper"
    )
    return {
        "fret": fret,
        "result": result,
        "measured": measured,
        "damage": damage,
        "yielding": yielding(),
        **rough(),
        "many": many,
        "by_ratio": by_ratio,
        "rig": rig,
        "life": life,
        "lengths": np.geomspace(5e-6, 1e-4, 9),
        "history": history,
        "criterion": table["titanium_6Al4V"].assessment("smith_watson_topper").criterion,
        "cracks": rig.crack(),
        "threshold": fret.fracture.Threshold(dK_th=4e6, dS_0=500e6),
        "worn": worn,
        "oxidised": oxidised(),
        "hot": hot,
        "study": study,
        "table": running,
        "stopping": stopping,
        "compared": compared,
        "first": first,
    }


def picture(drawn: Any, place: Path, pixels: float = PIXELS) -> None:
    """A picture of a figure at the size at which it is read, of few colours."""
    figure = drawn if hasattr(drawn, "savefig") else drawn.get_figure()
    file = io.BytesIO()
    figure.savefig(file, dpi=min(pixels, WIDTH / figure.get_size_inches()[0]))
    plt.close(figure)
    # Colours of few pixels, such as those of marks, are kept.
    few = Image.open(file).convert("RGB").quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE)
    few.save(place, optimize=True)


#: Figures of the landing page, each half as wide as its text: letters have 12 pixels and more.
CARDS = ("stick_slip", "stress_map", "fretting_map", "wear_profiles")
#: Size of the text of cards [points], and their pixels per inch.
TEXT_OF_CARDS, PIXELS_OF_CARDS = 9.0, 220


def draw_cards(given: dict[str, Any]) -> None:
    """Draw the cards of the landing page: figures of a column with larger text."""
    place = PICTURES.parent / "cards"
    place.mkdir(exist_ok=True)
    codes = {name: code for figures in FIGURES.values() for name, code in figures.items()}
    with patch.object(sizes, "TEXT_OF_COLUMNS", TEXT_OF_CARDS):
        for name in CARDS:
            drawn = eval(codes[name].removesuffix(")") + ', width="column")', given)
            picture(drawn, place / f"{name}.png", PIXELS_OF_CARDS)


def summary(name: str) -> str:
    """The first sentence of what a figure shows."""
    text = inspect.getdoc(getattr(plot, name)) or ""
    first = re.sub(":math:`([^`]*)`", r"$\1$", " ".join(text.split("\n\n")[0].split()))
    # What stands behind is where its parameters are.
    return first.replace("``", "`").split("; parameters")[0].rstrip(".") + "."


def page() -> str:
    """The page."""
    lines = [
        "# All figures",
        "",
        '`width="column"` draws a figure for a column of 85 mm, `width="page"` for 170 mm.',
        "A figure of one panel takes `ax=`, to be drawn into a figure of yours. Figures over",
        "a_H and p_H take `units=`. A figure of a result is also a method of it:",
        "`result.plot.fretting_loop()`, `worn.plot.wear_history()`. Figures of plain arrays,",
        "datasets and tables are functions alone. A figure of one panel returns its axes, one of",
        'several panels the figure: `.figure.savefig("name.png")` writes either. Parameters are in',
        "the [reference](plot.md). Each picture stands below its code. `result` is the run of a",
        "coated ball, `rig` the run of a cylinder on titanium with a bulk stress. Written by",
        "`tools/plot_page.py`.",
    ]
    for title, figures in FIGURES.items():
        lines += ["", f"## {title}"]
        for name, code in figures.items():
            lines += ["", f"### {name}", "", summary(name), ""]
            lines += ["```py", code, "```", "", f"![{name}](../figures/plots/{name}.png)"]
    lines += ["", "## And", "", "| function | what it does |", "|---|---|"]
    lines += [f"| `{name}` | {says} |" for name, says in OTHERS.items()]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Draw the pictures and write the page."""
    mpl.use("agg")
    warnings.simplefilter("ignore")
    PICTURES.mkdir(parents=True, exist_ok=True)
    given = names()
    plot.animate(given["result"], PICTURES.parent / "contact.gif", fps=4, dpi=100)
    draw_cards(given)
    for figures in FIGURES.values():
        for name, code in figures.items():
            picture(eval(code, given), PICTURES / f"{name}.png")
    (DOCS / "reference" / "figures.md").write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
