"""Unknowns found from measurements made with known values."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING

import numpy as np
import pytest

import pyfret as fret
from pyfret.fit.search import with_found

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
W = 20.0


def ball(n: int = 32, **coating: float) -> fret.Scene:
    """Give a ball on a flat, bare or coated."""
    layers = []
    if coating:
        material = fret.Elastic(E=coating["E"], nu=0.25)
        layers = [fret.Coating(material, thickness=coating["h"])]
    return fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(STEEL, coatings=layers),
        friction=0.5,
        grid=fret.Grid.centred(width=0.3e-3, n=n),
        path=fret.LoadPath.start().normal(W),
    )


def loop(scene: fret.Scene, reach: float, noise: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Measure a loop."""
    path = scene.path.displace(delta_x=[reach, -reach, reach], increments=80)
    d = fret.solve(scene, path, progress=False).dataset
    rng = np.random.default_rng(seed)
    shift, T = d.delta_x.values[-64:], d.T_x.values[-64:]
    return shift, T + rng.normal(0, noise * np.ptp(T), T.size)


def test_the_scene_of_a_fit_has_all_values_that_were_found() -> None:
    path = fret.LoadPath.start().normal(W).cycles(1, delta_x=6e-6)
    scene, fallback = ball().replace(path=path), ball()
    values = {"path.*.W": 25.0, "mu": 0.7, "rig.stiffness": 8e6, "wear.body2.alpha": 1e-15}
    unknowns = {key: SimpleNamespace(value=value) for key, value in values.items()}
    result = with_found(scene, SimpleNamespace(known=unknowns, scene=fallback))  # type: ignore[arg-type]
    assert [branch.W for branch in result.path.branches] == [25.0] * len(path.branches)
    assert [branch.delta_x for branch in result.path.branches] == [
        branch.delta_x for branch in path.branches
    ]
    assert (result.friction.mu, result.path.rig_stiffness) == (0.7, 8e6)
    unknowns = {"path.*.W": SimpleNamespace(value=-1.0)}
    assert with_found(scene, SimpleNamespace(known=unknowns, scene=fallback)) is fallback  # type: ignore[arg-type]


def test_mu_and_the_rig_are_found_from_a_german_file(tmp_path: Path) -> None:
    true = ball().replace({"mu": 0.62, "rig.stiffness": 8e6})
    shift, T = loop(true, 6e-6, 0.02, 1)
    rows = [
        f"{1e6 * x + 0.4:.4f};{f - 0.3:.3f}".replace(".", ",")
        for x, f in zip(shift, T, strict=True)
    ]
    file = tmp_path / "loop.csv"
    file.write_text("# Prüfstand 3\nWeg [µm];Kraft [N]\n" + "\n".join(rows), encoding="utf-8")
    loops = fret.fit.read_loops(file)
    cycle = fret.LoadPath.start().normal(W).cycles(1, delta_x=6e-6)
    scene = ball().replace(path=cycle)
    fitted = fret.fit(scene, loops, unknown={"mu": (0.2, 1.2), "rig.stiffness": (1e6, 1e8)})
    # The scene that is returned keeps its path, through the rig that was found.
    assert fitted.scene.path == cycle.rig(fitted.known["rig.stiffness"].value)
    for key, value in {"mu": 0.62, "rig.stiffness": 8e6}.items():
        unknown = fitted.known[key]
        assert unknown.low < value < unknown.high, f"{key}: {unknown}"
        assert unknown.high - unknown.low < 0.4 * value
    assert fitted.solves <= 40
    assert fitted.converged
    assert "95 %" in fitted.summary()
    assert fitted.plot().get_ylabel() == "force [N]"
    assert fitted.plot_residuals().get_xlabel() == "shift [um]"


def test_what_cannot_be_told_apart_is_said() -> None:
    # A loop that never slides knows the stiffness of rig and bodies together.
    true = ball().replace({"mu": 2.0, "rig.stiffness": 2e7})
    shift, T = loop(true, 1e-6, 0.01, 2)
    fitted = fret.fit(
        ball().replace({"mu": 2.0}),
        fret.fit.Loops.from_arrays(shift, T),
        unknown={"rig.stiffness": (2e6, 2e8), "body2.E": (5e10, 1e12)},
    )
    assert any("cannot be distinguished" in text for text in fitted.doubts)
    assert "rig.stiffness" in fitted.summary()


def test_a_coating_is_found_from_an_indentation_curve() -> None:
    true = ball(E=420e9, h=40e-6)
    path = fret.LoadPath.start()
    for force in np.linspace(0, W, 21)[1:]:
        path = path.normal(float(force), increments=1)
    d = fret.solve(true, path, progress=False).dataset
    noise = np.random.default_rng(3).normal(0, 2e-3 * float(d.delta_z[-1]), 20)
    curve = fret.fit.Indentation.from_arrays(d.W.values, d.delta_z.values + noise)
    fitted = fret.fit(ball(E=300e9, h=40e-6), curve, unknown={"body2.coatings.0.E": (1e11, 1e12)})
    unknown = fitted.known["body2.coatings.0.E"]
    assert unknown.low < 420e9 < unknown.high
    assert fitted.solves <= 30


def test_wear_and_debris_are_found_from_a_scar() -> None:
    path = fret.LoadPath.start().normal(18.5e3, increments=1)
    path = path.displace(delta_x=[5e-6, -5e-6, 5e-6], increments=3)
    line = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=6e-3)),
        body2=fret.Body(STEEL),
        friction=0.9,
        grid=fret.Grid.strip(extent=0.5e-3, n=64),
        path=path,
    )
    run = {
        "cycles": 2e4,
        "cycling": "sliding",
        "body2": fret.wear.Archard(1e-14),
        "tolerance": 0.05,
    }
    worn = fret.wear.solve(
        line,
        **{**run, "body2": fret.wear.Archard(4e-14)},
        debris_kept=0.7,
        progress=False,
    ).dataset
    depth = worn.worn2[-1].values[:, 0]
    noise = np.random.default_rng(4).normal(0, 0.02 * depth.max(), depth.size)
    scar = fret.fit.Scar.from_arrays(worn.x.values, depth + noise, wear=run)
    unknown = {"wear.body2.k": (1e-15, 1e-12), "wear.debris_kept": (0.0, 0.5, 0.95)}
    fitted = fret.fit(line, scar, unknown=unknown)
    for key, value in {"wear.body2.k": 4e-14, "wear.debris_kept": 0.7}.items():
        assert fitted.known[key].low < value < fitted.known[key].high, fitted.summary()
    assert fitted.solves <= 40


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1;2\n3;4\n", "must name the columns"),
        ("a [um];b [N]\n1;2;3\n", ":2: 3 numbers"),
        ("a [um];b [N]\n1;x\n", ":2: must be numbers"),
        ("a [furlong];b [N]\n1;2\n", "furlong"),
        ("a;b\n1;2\n", "unit of length"),
        ("a [um];b [N]\n1;2\n1;3\n", "turn twice"),
    ],
)
def test_files_that_are_no_loops_are_refused(tmp_path: Path, text: str, expected: str) -> None:
    file = tmp_path / "loop.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=expected):
        fret.fit.read_loops(file)


@pytest.mark.parametrize(
    "head", ["d [mm]\tT [kN]\n-1\t-2\n", "d_mm T_kN\n-1 -2\n", "d (mm),T (kN)\n-1,-2\n"]
)
def test_separators_and_units_are_seen(tmp_path: Path, head: str) -> None:
    file = tmp_path / "table.txt"
    file.write_text(head, encoding="utf-8")
    table = fret.fit.tables.read_table(file)
    assert np.allclose(table.numbers(0, 1), [[-1e-3], [-2e3]])
    assert table.names == ("d", "T")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
@pytest.mark.parametrize(
    ("head", "mark"),
    [
        ("Weg [µm];Kraft [N]", ";"),
        ("Weg;Kraft\nµm;N", ";"),
        ("delta_x\tT_x\n[µm]\t[N]", "\t"),
        ("delta T\nµm N", " "),
    ],
)
def test_loops_are_read_in_any_encoding_with_units_in_the_head_or_below_it(
    tmp_path: Path, encoding: str, head: str, mark: str
) -> None:
    file = tmp_path / "loop.csv"
    rows = ["-1,5 -2", "0 0,5", "1,5 2", "0 -0,5", "-1,5 -2,0"]
    file.write_text("\n".join([head, *(r.replace(" ", mark) for r in rows)]), encoding=encoding)
    loop = fret.fit.read_loops(file)
    np.testing.assert_allclose(loop.delta, [-1.5e-6, 0.0, 1.5e-6, 0.0, -1.5e-6])
    np.testing.assert_allclose(loop.T, [-2.0, 0.5, 2.0, -0.5, -2.0])


def test_several_loops_tell_their_drift() -> None:
    turn = np.linspace(0, 6 * np.pi, 300)
    loops = fret.fit.Loops.from_arrays(1e-6 * np.cos(turn), 5 * np.sin(turn) + 0.1 * turn)
    assert loops.cycle.max() == 2
    assert loops.drift[1] == pytest.approx(0.1 * 4 * np.pi, rel=0.1)


def test_turns_that_the_record_leaves_open_are_named() -> None:
    """Few points at uneven times leave the ends of the stroke open."""
    true = ball().replace({"mu": 0.62, "rig.stiffness": 8e6})
    path = true.path.displace(delta_x=[3e-6 * sign for sign in (1, -1, 1, -1, 1)], increments=450)
    d = fret.solve(true, path, progress=False).dataset
    shift, T = d.delta_x.values[-370:], d.T_x.values[-370:]
    few = np.sort(np.random.default_rng(1).choice(370, 48, replace=False))
    for points, is_open in ((few, True), (np.arange(370), False)):
        loops = fret.fit.Loops.from_arrays(shift[points], T[points], tilt=False, drift=False)
        fitted = fret.fit(ball(), loops, unknown={"mu": (0.2, 1.2), "rig.stiffness": (1e6, 1e8)})
        assert any("place of the turns" in doubt for doubt in fitted.doubts) == is_open
        assert fitted.known["mu"].low < 0.62 < fitted.known["mu"].high


def test_ranges_are_refused_by_name() -> None:
    data = fret.fit.Indentation.from_arrays([1.0, 2.0], [1e-7, 2e-7])
    with pytest.raises(ValueError, match="unknown: none"):
        fret.fit(ball(), data, unknown={})
    with pytest.raises(ValueError, match=r"mu = \(1, 0\.5\)"):
        fret.fit(ball(), data, unknown={"mu": (1, 0.5)})


def test_the_posterior_is_that_of_the_confidence_where_the_model_is_linear() -> None:
    true = ball().replace({"mu": 0.62, "rig.stiffness": 8e6})
    shift, T = loop(true, 6e-6, 0.02, 1)
    fitted = fret.fit(
        ball(),
        fret.fit.Loops.from_arrays(shift, T),
        unknown={"mu": (0.2, 1.2), "rig.stiffness": (1e6, 1e8)},
        posterior=4000,
    )
    posterior = fitted.posterior
    assert posterior is not None
    assert posterior.error < 0.2
    assert posterior.solves <= 12
    for key, value in {"mu": 0.62, "rig.stiffness": 8e6}.items():
        low, high = posterior.interval(key)
        assert low < value < high
        unknown = fitted.known[key]
        assert abs(unknown.value - np.median(posterior.samples[key])) < 0.2 * (high - low)
        # Both without the error of the solver.
        assert (high - low) == pytest.approx(2 * unknown.noise, rel=0.15)
    assert "95 % of the posterior" in fitted.summary()
    again = [np.corrcoef(*posterior.samples.values())[0, 1], fitted.correlation[0, 1]]
    assert abs(again[0] - again[1]) < 0.15


def test_a_tilt_drifts_and_offsets_are_found_beside_mu_and_the_rig() -> None:
    true = ball().replace({"mu": 0.55, "rig.stiffness": 9e6})
    path = true.path.displace(delta_x=[6e-6, -6e-6, 6e-6, -6e-6, 6e-6], increments=150)
    d = fret.solve(true, path, progress=False).dataset
    first = int(np.flatnonzero(d.branch_of_increment.values >= 2)[0]) - 1
    shift, T = d.delta_x.values[first:], d.T_x.values[first:]
    time, half = np.linspace(-0.5, 0.5, shift.size), 0.5 * np.ptp(T)
    tilt = 0.05 * half / 6e-6
    noise = np.random.default_rng(7).normal(0, 0.02 * np.ptp(T), T.size)
    loops = fret.fit.Loops.from_arrays(
        shift + 2e-6 + 3e-7 * time, T + tilt * shift + 1.0 + 0.1 * half * time + noise
    )
    fitted = fret.fit(ball(), loops, unknown={"mu": (0.2, 1.2), "rig.stiffness": (1e6, 1e8)})
    for key, value in {"mu": 0.55, "rig.stiffness": 9e6}.items():
        assert fitted.known[key].low < value < fitted.known[key].high, fitted.summary()
    for name, value in {
        "spring beside the contact [N/m]": tilt,
        "offset of the shift [m]": 2e-6,
        "offset of the force [N]": 1.0,
        "drift of the shift [m]": 3e-7,
        "drift of the force [N]": 0.1 * half,
    }.items():
        assert abs(fitted.offsets[name] - value) < 1.5 * fitted.offset_errors[name], name
    assert any("sliding branches rise" in text for text in fitted.doubts)


def test_the_frame_gives_way_under_an_indentation() -> None:
    path = fret.LoadPath.start()
    for force in np.linspace(0, W, 21)[1:]:
        path = path.normal(float(force), increments=1)
    d = fret.solve(ball(), path, progress=False).dataset
    approach = d.delta_z.values + 2e-9 * d.W.values + 1e-8
    curve = fret.fit.Indentation.from_arrays(d.W.values, approach, frame=True)
    fitted = fret.fit(ball(), curve, unknown={"body2.E": (5e10, 1e12)})
    unknown, name = fitted.known["body2.E"], "compliance of the frame [m/N]"
    assert unknown.low < 210e9 < unknown.high, fitted.summary()
    assert abs(fitted.offsets[name] - 2e-9) < fitted.offset_errors[name] < 2e-9


class ClosedForm:
    """A ball's loop by Mindlin and Deresiewicz (1953) with a rig in series, without a solve."""

    def __init__(self, mu: float, rig: float, reach: float) -> None:
        self.mu, self.rig, self.reach = mu, rig, reach
        a = fret.reference.hertz(R=5e-3, bodies=(STEEL, STEEL), W=W).a
        self.stuck = 2.0 * (2.0 - STEEL.nu) / STEEL.G / (8.0 * a)
        force = np.linspace(0.0, mu * W, 2001)
        self.turn = float(np.interp(reach, self.way(force), force))

    def way(self, force: np.ndarray) -> np.ndarray:
        """Shift of contact and rig under a force that grows from nothing."""
        part = np.clip(force / (self.mu * W), 0.0, 1.0)
        contact = 1.5 * self.mu * W * self.stuck * (1.0 - (1.0 - part) ** (2.0 / 3.0))
        return np.asarray(contact + force / self.rig)

    def down(self, shift: np.ndarray) -> np.ndarray:
        """The force on the way back, twice the first way (Masing)."""
        force = np.linspace(0.0, self.turn, 2001)
        back = np.interp((self.reach - shift) / 2.0, self.way(force), force)
        return np.asarray(self.turn - 2.0 * back)

    @staticmethod
    def solve(scene: fret.Scene, path: fret.LoadPath, **_: object) -> SimpleNamespace:
        """Return the loop in the form of :func:`pyfret.solve`."""
        rig = path.rig_stiffness
        assert rig is not None
        reach = max(float(branch.delta_x or 0.0) for branch in path.branches)
        item = ClosedForm(float(scene.mu), rig, reach)
        ways = np.linspace(reach, -reach, 25)
        branch = np.repeat([1, 2, 3], [1, 24, 24])
        shift = np.r_[ways, -ways[1:]]
        force = np.r_[item.down(ways), -item.down(ways)[1:]]
        columns = {"branch_of_increment": branch, "delta_x": shift, "T_x": force}
        values = {name: SimpleNamespace(values=v) for name, v in columns.items()}
        return SimpleNamespace(dataset=SimpleNamespace(**values))


@pytest.mark.slow
@pytest.mark.parametrize("wave", ["sine", "triangle"])
def test_ninety_of_a_hundred_records_lie_within_the_95_percent(
    monkeypatch: pytest.MonkeyPatch, wave: str
) -> None:
    """Records of 2.5 cycles from anywhere, 5 % tilt, drifts, offsets, 2 % noise."""
    monkeypatch.setattr(fret.fit.models, "solve", ClosedForm.solve)
    inside = {"mu": 0, "rig.stiffness": 0}
    for seed in range(100):
        random = np.random.default_rng(seed)
        true = {"mu": random.uniform(0.4, 0.8), "rig.stiffness": 10 ** random.uniform(6.6, 7.4)}
        stuck = ClosedForm(0.5, 1e7, 1e-6).stuck
        slides = true["mu"] * W * (1.5 * stuck + 1.0 / true["rig.stiffness"])
        item = ClosedForm(true["mu"], true["rig.stiffness"], slides * random.uniform(1.5, 3.0))
        phase = np.linspace(0.0, 2.5, 300) + random.uniform()
        along = 4.0 * np.abs(phase % 1.0 - 0.5) - 1.0
        shift = item.reach * (along if wave == "triangle" else np.cos(2.0 * np.pi * phase))
        force = np.where(phase % 1.0 < 0.5, item.down(shift), -item.down(-shift))
        time, half = np.linspace(-0.5, 0.5, 300), 0.5 * np.ptp(force)
        force = force + 0.05 * half / item.reach * shift + random.normal(0.0, 0.04 * half, 300)
        force += half * (random.uniform(-0.1, 0.1) + random.uniform(-0.1, 0.1) * time)
        shift = shift + item.reach * (
            random.uniform(-0.3, 0.3) + random.uniform(-0.05, 0.05) * time
        )
        ranges = {"mu": (0.2, 1.2), "rig.stiffness": (1e6, 1e8)}
        fitted = fret.fit(ball(16), fret.fit.Loops.from_arrays(shift, force), unknown=ranges)
        for key, value in true.items():
            inside[key] += fitted.known[key].low < value < fitted.known[key].high
    assert min(inside.values()) >= 90, inside
