"""Every figure of every kind of scene: all shapes, all drives, in SI units and without."""

from __future__ import annotations

import numpy as np
import pytest

import pyfret as fret
from conftest import MU, R, W, sphere_on_flat

STEEL = fret.Elastic(E=210e9, nu=0.3)
HARD = fret.Elastic(E=420e9, nu=0.25)
A = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W).a
GRID = fret.Grid.centred(width=2.6 * A, n=16)
PRESSED = fret.LoadPath.start().normal(W, increments=2)
GENTLE = fret.LoadPath.start().normal(W / 5, increments=2).cycles(1, T_x=20.0, increments=6)
SHEARED = PRESSED.cycles(1, T_x=0.7 * MU * W, increments=6)


def scene(
    shape: object, path: fret.LoadPath = SHEARED, *, grid: fret.Grid = GRID, mu: float = MU
) -> fret.Scene:
    return fret.Scene(
        body1=fret.Body(STEEL, shape=shape),  # type: ignore[arg-type]
        body2=fret.Body(STEEL),
        friction=mu,
        grid=grid,
        path=path,
    )


def thin_layers() -> fret.Scene:
    layers = [fret.Coating(HARD, thickness=A / 30), fret.Coating(STEEL, thickness=A / 50)]
    ball = fret.Body(STEEL, shape=fret.Sphere(R=R))
    flat = fret.Body(STEEL, coatings=layers)
    return fret.Scene(body1=ball, body2=flat, friction=MU, grid=GRID, path=SHEARED)


ROUGH = fret.shapes.Rough(rms=1e-7, hurst=0.8, longest=A, shortest=0.4 * A, seed=2)
PUNCH = fret.shapes.FlatPunch(radius=0.6 * A, edge=R)
STRIP = fret.Grid.strip(extent=2.6 * A, n=32)
LINE_LOAD = 1e5
SCENES = {
    "coated ball": sphere_on_flat(ratio=2.0, n=16).replace(path=SHEARED),
    "thin layers": thin_layers(),
    "shift": scene(fret.Sphere(R), PRESSED.cycles(1, delta_x=4e-6, increments=6)),
    "along y": scene(fret.Sphere(R), PRESSED.cycles(1, T_y=0.5 * MU * W, increments=4)),
    "torsion": scene(fret.Sphere(R), PRESSED.cycles(1, phi_z=2e-3, increments=6)),
    "ellipsoid": scene(fret.shapes.Ellipsoid(R_x=0.8 * R, R_y=1.1 * R)),
    "rough flat under a punch": scene(PUNCH + ROUGH, GENTLE),
    "line": scene(
        fret.Cylinder(R=R),
        fret.LoadPath.start().normal(LINE_LOAD, increments=1).cycles(1, T_x=1e4, increments=3),
        grid=STRIP,
    ),
    "approach given": scene(
        fret.Sphere(R), fret.LoadPath.start().displace(delta_z=1e-5, increments=2)
    ),
    "frictionless": scene(fret.Sphere(R), PRESSED, mu=0.0),
    "never slips": scene(fret.Sphere(R), PRESSED.tangential(0.1 * W, increments=1), mu=np.inf),
    "crowned roller along a moment": scene(
        fret.shapes.CrownedRoller(R=R, length=0.5 * A, crown=R),
        PRESSED.cycles(1, M_z=1e-2, increments=4),
    ),
    "wedge": scene(
        fret.shapes.Wedge(slope=0.005) + fret.Sphere(R),
        fret.LoadPath.start().normal(W / 4, increments=2).cycles(1, delta_y=1e-7, increments=4),
    ),
    "wavy flat under a ball, shear that goes round": scene(
        fret.Sphere(R) + fret.shapes.Waviness(amplitude=2e-7, wavelength=0.7 * A),
        PRESSED.ellipse(T_x=0.3 * MU * W, T_y=0.2 * MU * W, increments=8),
    ),
    "measured surface": scene(
        fret.Sphere(R)
        + fret.SurfaceMap(1e-8 * np.random.default_rng(1).normal(size=(9, 9)), spacing=2.6 * A / 8),
        GENTLE,
    ),
    "bulk stress": scene(
        fret.Sphere(R), PRESSED.force(T_x=0.3 * MU * W, sigma_B=2e7, increments=3)
    ),
    "rolling": scene(fret.Sphere(R), PRESSED.force(rolled=2 * GRID.dx, T_x=50.0, increments=2)),
    "tilted": scene(PUNCH, GENTLE.displace(phi_y=1e-6, increments=1)),
    "cone": scene(fret.shapes.Cone(slope=0.01), fret.LoadPath.start().normal(W / 4, increments=2)),
}


@pytest.fixture(scope="module", params=SCENES, ids=str)
def result(request: pytest.FixtureRequest) -> fret.Result:
    return fret.solve(SCENES[request.param], progress=False)


pytestmark = [
    pytest.mark.solves,
    pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning"),
]


@pytest.mark.slow
@pytest.mark.parametrize("units", ["auto", "SI"])
def test_every_figure_is_drawn(result: fret.Result, units: fret.plot.Units) -> None:
    last = result.at(-1)
    below = last.stress()
    envelope = result.envelope(below.dataset.z.values[:1], y=0.0)
    figures = [
        fret.plot.fretting_loop(result, units=units),
        fret.plot.stick_ratio(result),
        fret.plot.load_path(result),
        fret.plot.load_path(result.scene.path),
        fret.plot.stick_slip(result, units=units),
        fret.plot.pressure_map(last, units=units),
        fret.plot.spots(last, units=units),
        fret.plot.gap_map(last, units=units),
        fret.plot.pressure_histogram(last, units=units),
        fret.plot.area_over_load(result),
        fret.plot.slip_map(last, units=units),
        fret.plot.shear_streamlines(last, units=units),
        fret.plot.pressure_profile(result, units=units),
        fret.plot.shear_profile(last, units=units),
        fret.plot.shear_profiles(result, units=units),
        fret.plot.stress_map(below, units=units),
        fret.plot.stress_along_depth(last.stress(x=0.0, y=0.0), units=units),
        fret.plot.stress_history(envelope, units=units),
        fret.plot.loop_evolution(result),
    ]
    result.plot(units=units).canvas.draw()
    # A figure without a curve shows the reason.
    assert all(ax.has_data() or ax.images or ax.texts for ax in figures)
    if units == "SI":
        for ax in figures:
            ax.get_figure().canvas.draw()


def test_every_number_is_told(result: fret.Result) -> None:
    assert "state" in result.summary()
    last = result.at(-1)
    assert last.length > 0.0
    assert last.stress().maximum().value > 0.0
    if "a_H" not in result.dataset.attrs:
        with pytest.raises(ValueError, match="no a_H: these bodies have no Hertz contact"):
            _ = result.a_H
        with pytest.raises(ValueError, match="there is no Hertz contact"):
            fret.plot.pressure_profile(result, units="dimensionless")
        assert result.summary().count("[MPa]") == 1


def test_a_summary_has_no_digits_of_rounding() -> None:
    result = fret.solve(SCENES["torsion"], progress=False)
    shifts = np.abs(result.delta_x.values)
    assert 0.0 < shifts.max() < 1e-9 * float(result.dataset.delta_z.max())
    titles, _, _, *rows = result.summary().partition("  t ")[2].splitlines()[:7]
    end = len("  t ") + titles.index("delta_x") + len("delta_x")
    assert len(rows) == 4
    assert all(row[:end].split()[-1] == "0" for row in rows)
    # A given number is printed as it is, however small.
    tiny = scene(fret.Sphere(R), PRESSED.tangential(1e-5, increments=1))
    assert " 1e-05 " in fret.solve(tiny, progress=False).summary()


def test_empty_axes_say_why() -> None:
    result = fret.solve(SCENES["cone"], progress=False)
    (text,) = fret.plot.fretting_loop(result).texts
    assert text.get_text() == "the path ends with the indentation"
    (text,) = fret.plot.loop_evolution(result).texts
    assert text.get_text() == "the path closes no cycle"
    assert fret.plot.slip_map(result).images[0].get_clim() == (0.0, 1.0)
    assert fret.plot.shear_streamlines(result).images[0].get_clim() == (0.0, 1.0)


def test_a_path_that_rolls_shows_it() -> None:
    labels = fret.plot.load_path(SCENES["rolling"].path).get_legend().get_texts()
    assert any("rolled" in label.get_text() for label in labels)


def test_envelopes_of_a_cycle_are_drawn() -> None:
    result = fret.solve(SCENES["thin layers"], progress=False)
    fret.plot.envelope_maps(result.envelope(y=0.0)).canvas.draw()


def test_a_legend_names_only_what_is_there() -> None:
    result = fret.solve(SCENES["frictionless"], progress=False)
    (label,) = fret.plot.stick_slip(result).get_legend().get_texts()
    assert label.get_text() in ("stick", "slip")


def test_thin_layers_have_room_on_the_axis_of_depth() -> None:
    result = fret.solve(SCENES["thin layers"], progress=False)
    ax = fret.plot.stress_map(result.at(-1).stress())
    to_pixels = ax.transData.transform
    depths = np.array([0.0, 1 / 30, 1 / 30 + 1 / 50, 2.0])
    pixels = to_pixels(np.column_stack([np.zeros(4), depths]))[:, 1]
    assert (-np.diff(pixels)).min() > 0.1 * (pixels[0] - pixels[-1])


def test_shifts_that_come_back_are_markers_on_their_first_visit() -> None:
    result = fret.solve(SCENES["shift"], progress=False)
    lines = fret.plot.shear_profiles(result).lines
    assert [line.get_marker() for line in lines] == ["None", "None", "None", "o"]


def test_the_legend_of_zones_lies_beside_the_map() -> None:
    ax = fret.plot.stick_slip(fret.solve(SCENES["line"], progress=False))
    ax.get_figure().canvas.draw()
    legend = ax.get_legend().get_window_extent()
    assert legend.y0 >= ax.get_window_extent().y1 - 1.0


def test_the_largest_stress_keeps_off_the_frame() -> None:
    result = fret.solve(SCENES["shift"], progress=False)
    ax = fret.plot.stress_history(result.envelope(y=0.0))
    assert ax.lines[0].get_ydata().max() < 0.95 * ax.get_ylim()[1]


@pytest.mark.usefixtures("without_layout")
@pytest.mark.parametrize(
    "name",
    ["coated ball", "line", "torsion", "approach given", "frictionless", "never slips", "rolling"],
)
def test_six_panels_in_one_figure(name: str) -> None:
    """`test_every_figure_is_drawn` has them of all scenes."""
    result = fret.solve(SCENES[name], progress=False)
    figure = result.plot()
    figure.canvas.draw()
    panels = [ax for ax in figure.axes if ax.get_subplotspec() is not None]
    assert len(panels) == 6
    assert all(ax.has_data() or ax.texts for ax in panels)


@pytest.mark.parametrize(
    ("name", "units"),
    [
        ("crowned roller along a moment", "auto"),
        ("thin layers", "SI"),
        ("line", "auto"),
        pytest.param("crowned roller along a moment", "SI", marks=pytest.mark.slow),
        pytest.param("thin layers", "auto", marks=pytest.mark.slow),
        pytest.param("line", "SI", marks=pytest.mark.slow),
    ],
)
def test_no_label_is_cut(name: str, units: fret.plot.Units) -> None:
    result = fret.solve(SCENES[name], progress=False)
    below = result.at(-1).stress()
    envelope = result.envelope(below.dataset.z.values, y=0.0)
    drawn = [
        fret.plot.stress_map(below, units=units).get_figure(),
        fret.plot.stress_map(below, of="s_xx", units=units).get_figure(),
        fret.plot.envelope_maps(envelope, units=units),
        fret.plot.pressure_map(result, units=units).get_figure(),
        fret.plot.slip_map(result, units=units).get_figure(),
        fret.plot.load_factor_map(
            result.load_factors([650e6] * (1 + len(result.scene.body2.coatings)), y=0.0),
            units=units,
        ).get_figure(),
        fret.plot.shear_profiles(result, units=units).get_figure(),
        result.plot(units=units),
    ]
    for figure in drawn:
        figure.draw_without_rendering()
        box, (wide, high) = figure.get_tightbbox(), figure.get_size_inches()
        # All of it is on the page, to a hundredth of an inch.
        assert min(box.x0, box.y0) > -0.01
        assert box.x1 < wide + 0.01
        assert box.y1 < high + 0.01


def test_line_contacts_are_drawn_along_x_in_units_per_metre() -> None:
    result = fret.solve(SCENES["line"], progress=False)
    assert fret.plot.fretting_loop(result).get_ylabel() == "$T_x$ [N/m]"
    for draw in (fret.plot.stick_slip, fret.plot.pressure_map, fret.plot.slip_map):
        ax = draw(result)
        assert not ax.images
        assert ax.get_ylabel()
        # The contact alone is in sight, of a strip three times as wide.
        assert ax.get_xlim()[1] < 1.6
    with pytest.raises(ValueError, match="has no approach"):
        fret.plot.fretting_loop(result, units="dimensionless")


def test_forces_of_a_line_contact_are_per_metre() -> None:
    result = fret.solve(SCENES["line"], progress=False)
    d, last = result.dataset, result.at(-1)
    units = {name: d[name].attrs["units"] for name in ("W", "dissipated", "M_z", "contact_area")}
    assert units == {"W": "N/m", "dissipated": "J/m", "M_z": "N m/m", "contact_area": "m^2/m"}
    assert result.loops().stiffness.attrs["units"] == "N/m per m"
    assert result.dissipated_energy.attrs["units"] == "J/m"
    assert d.attrs["R"] == pytest.approx(R, rel=1e-12)
    bodies = (result.scene.body1.substrate, result.scene.body2.substrate)
    hertz = fret.reference.line_contact(R=R, bodies=bodies, W=LINE_LOAD)
    np.testing.assert_allclose(last.half_width, hertz.a, rtol=0.01)
    with pytest.raises(AttributeError, match="half_width"):
        _ = last.contact_radius
    assert "[N/m]" in result.summary()
    assert "[mJ/m]" in result.summary()
    assert "half width" in result._repr_html_()
    marched = list(fret.march(SCENES["line"]))[-1]
    assert marched.dataset.W.attrs["units"] == "N/m"


def test_forces_on_a_strip_of_another_width_are_those_on_it() -> None:
    line = SCENES["line"]
    grid = fret.Grid.strip(extent=2.6 * A, n=32, width=0.01)
    path = fret.LoadPath.start().normal(0.01 * LINE_LOAD, increments=1)
    narrow = fret.solve(line.replace(grid=grid), path, progress=False)
    wide = fret.solve(line, fret.LoadPath.start().normal(LINE_LOAD, increments=1), progress=False)
    assert narrow.W.attrs["units"] == "N"
    np.testing.assert_allclose(narrow.half_width, wide.half_width, rtol=1e-9)


def test_the_load_path_alone_is_over_the_normal_force() -> None:
    path = SCENES["coated ball"].path
    labels = [t.get_text() for t in fret.plot.load_path(path).get_legend().get_texts()]
    assert "$T_x/W_\\mathrm{max}$" in labels
    labels = [t.get_text() for t in fret.plot.load_path(path, mu=MU).get_legend().get_texts()]
    assert r"$T_x/(\mu\, W_\mathrm{max})$" in labels


def test_many_increments_are_a_scale_of_colours_not_a_legend() -> None:
    many = fret.solve(
        SCENES["coated ball"],
        PRESSED.cycles(1, T_x=100.0, increments=24),
        save="all",
        progress=False,
    )
    ax = fret.plot.shear_profiles(many)
    assert ax.get_legend() is None
    assert len(ax.get_figure().axes) == 2
