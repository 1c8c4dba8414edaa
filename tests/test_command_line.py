"""The command line and Python: one solver, one answer; bad input."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import ROOT, W, sphere_on_flat

FRET = ROOT / "target" / "release" / "fret"


def fret_run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([FRET, *arguments], capture_output=True, text=True, check=False)


def test_the_same_scene_gives_the_same_bits(coated: fret.Result, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(coated.scene.to_toml())
    run = fret_run("run", tmp_path / "scene.toml", "-o", tmp_path / "out.zarr")
    assert run.returncode == 0, run.stderr
    assert fret.open(tmp_path / "out.zarr").dataset.identical(coated.dataset)


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("friction.mue=0.3", "unknown key"),
        ("friction.mu=-1.0", "friction.mu = -1: must be"),
        ("friction.mu=nan", "friction.mu = nan: must be"),
        ("body1.E=-210e9", "body1.E = -210000000000: must be"),
        ("body2.nu=0.51", "body2.nu = 0.51: must be"),
        ("body2.nu=-1.0", "body2.nu = -1: must be"),
        ("body2.coatings.0.thickness=0.0", "body2.coatings[0].thickness = 0: must be"),
        ("grid.n=0", "grid.n"),
        ("path.1.T_x.mu_W=1.01", "path[1].T_x = 303"),
        ("grid.extent=1e-5", "should be about"),
    ],
)
def test_a_bad_scene_is_refused_with_one_sentence(
    setting: str, expected: str, scene_file: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out.zarr"
    run = fret_run("run", scene_file, "--set", "grid.n=16", "--set", setting, "-o", out)
    assert run.returncode == 2, run.stderr
    assert expected in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1
    assert not out.exists()


def cells_of(line: str) -> set[str]:
    """Return the cells of a line of a table."""
    return set(re.split(r"\s{2,}", line.strip()))


@pytest.mark.parametrize(
    ("setting", "state"),
    [
        ("friction.mu=0.3", "partial slip"),
        ("friction.mu=0.0", "no friction"),
        ("path.1.T_x.mu_W=1.0", "gross slip"),
    ],
)
def test_both_summaries_of_a_run_have_the_same_cells(
    setting: str, state: str, scene_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "400")
    store = tmp_path / "out.zarr"
    without_shear = ["--set", "path.1.T_x=0.0", "--set", "path.2.T_x=0.0"] * (
        state == "no friction"
    )
    run = fret_run(
        "run", scene_file, "--set", "grid.n=16", "--set", setting, *without_shear, "-o", store
    )
    assert run.returncode == 0, run.stderr
    printed = [cells_of(line) for line in run.stdout.splitlines()]
    _, _, table = fret.open(store).summary().partition("-----\n")
    rows = table.splitlines()[: len(fret.open(store).scene.path.branches)]
    assert any(state in row for row in rows)
    for row in rows:
        assert any(cells_of(row) <= line for line in printed), (row, run.stdout)


def test_a_bad_file_names_the_line_and_the_nearest_key(scene_file: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.toml"
    lines = scene_file.read_text().replace("mu = 0.3", "mue = 0.3").splitlines()
    bad.write_text("\n".join(lines))
    run = fret_run("run", bad, "-o", tmp_path / "out.zarr")
    assert run.returncode == 2
    assert f"bad.toml:{lines.index('mue = 0.3') + 1}:" in run.stderr
    assert "nearest valid key is `friction.mu`" in run.stderr


def test_what_is_there_is_not_overwritten(scene_file: Path, tmp_path: Path) -> None:
    (tmp_path / "out.zarr").write_text("precious")
    run = fret_run("run", scene_file, "-o", tmp_path / "out.zarr")
    assert run.returncode == 2
    assert (tmp_path / "out.zarr").read_text() == "precious"


def test_tables_have_no_digits_of_rounding(tmp_path: Path) -> None:
    """Alike bodies under a force along y: along x nothing moves, up to rounding."""
    scene = sphere_on_flat(n=16).replace(
        path=fret.LoadPath.start().normal(W, increments=2).cycles(1, T_y=150.0, increments=4)
    )
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    run = fret_run("run", tmp_path / "scene.toml", "-o", tmp_path / "out.zarr")
    shifts = fret.open(tmp_path / "out.zarr").delta_x.values
    assert np.abs(shifts).max() > 0.0
    cells = [re.split(r"\s{2,}", line) for line in run.stdout.splitlines() if re.match(r"\d", line)]
    titles = next(line for line in run.stdout.splitlines() if "delta_x" in line).split()
    column = titles.index("delta_x")
    assert [row[column] for row in cells] == ["0"] * 4


def test_check_solves_nothing_and_says_what_is_skipped(scene_file: Path) -> None:
    run = fret_run("check", scene_file)
    assert run.returncode == 0, run.stderr
    for words in ("a_H", "p_H", "cells", "y < 0"):
        assert words in run.stdout


@pytest.mark.solves
def test_check_of_sliding_wear_has_the_places_of_its_stroke(tmp_path: Path) -> None:
    text = (ROOT / "scenes" / "wear_mccoll.toml").read_text(encoding="utf-8")
    assert 'cycling = "sliding"' in text
    lines = [line for line in text.splitlines() if not line.startswith("increments")]
    (tmp_path / "open.toml").write_text("\n".join(lines), encoding="utf-8")
    sliding = fret_run("check", tmp_path / "open.toml")
    assert sliding.returncode == 0, sliding.stderr
    assert "path error" not in sliding.stdout
    assert "some 12" not in sliding.stdout
    assert "in sliding: the mean pressure of every increment" in sliding.stdout
    least, upper = json.loads(fret_run("check", tmp_path / "open.toml", "--json").stdout)["path"][
        "increments"
    ]
    assert least == upper
    # Those that the run takes.
    out = tmp_path / "worn.zarr"
    worn = fret_run("wear", tmp_path / "open.toml", "-o", out, "--set", "wear.cycles=10", "-q")
    assert worn.returncode == 0, worn.stderr
    branches = fret.open(out).scene.path.branches
    assert least == sum(branch.increments or 0 for branch in branches)
    march = fret_run("check", tmp_path / "open.toml", "--set", "wear.cycling=march")
    assert "path error" in march.stdout


def test_the_summary_for_programs_has_the_error_bars(tmp_path: Path) -> None:
    path = fret.LoadPath.start().normal(W, increments=4)
    (tmp_path / "scene.toml").write_text(sphere_on_flat(n=32).replace(path=path).to_toml())
    out = tmp_path / "out.zarr"
    plain = fret_run("run", tmp_path / "scene.toml", "-o", out, "--json", "-q")
    assert json.loads(plain.stdout)["error_bars"] is None
    ran = fret_run("run", tmp_path / "scene.toml", "-o", out, "--overwrite", "--json", "--error")
    assert ran.returncode == 0, ran.stderr
    (branch,) = json.loads(ran.stdout)["error_bars"]
    bars = fret.open(out).error_bars().isel(branch=0)
    for number in ("p_max", "delta_z", "contact_radius"):
        assert branch[number]["total"] > 0.0
        assert branch[number]["total"] == float(getattr(bars, number).sel(part="total"))
    ran = fret_run(
        "run", tmp_path / "scene.toml", "-o", out, "--overwrite", "--json", "--error=coarser"
    )
    assert ran.returncode == 0, ran.stderr
    (branch,) = json.loads(ran.stdout)["error_bars"]
    result = fret.solve(tmp_path / "scene.toml", error="coarser", progress=False)
    of_python = result.error_bars().sel(part="total").isel(branch=0)
    assert branch["p_max"]["total"] == float(of_python.p_max)


@pytest.mark.solves
def test_stress_below_is_that_of_python(coated: fret.Result, tmp_path: Path) -> None:
    store = tmp_path / "out.zarr"
    result = fret.solve(coated.scene, out=store, progress=False)
    z = np.linspace(0.0, 2 * result.a_H, 17)
    item = ("von_mises", "s_xz")
    section = result.at(-1).stress(z, y=0.0)
    common = ("--depths", "17", "--of", ",".join(item))
    run = fret_run("stress", store, *common, "-o", tmp_path / "section.zarr")
    assert run.returncode == 0, run.stderr
    written = xr.open_zarr(tmp_path / "section.zarr", chunks=None)
    for name in item:
        np.testing.assert_array_equal(written[name], section.measure(name))
        # The largest value is looked for at the depths that the layers ask for as well.
        match = re.search(rf"largest {name} ([\d.]+) MPa", run.stdout)
        assert match is not None
        exact = 1e-6 * result.at(-1).stress().maximum(name).value
        assert float(match[1]) == pytest.approx(exact, rel=2e-3)
    for out in ("volume.zarr", "volume.vti"):
        run = fret_run("stress", store, "--volume", *common, "-o", tmp_path / out)
        assert run.returncode == 0, run.stderr
        snapshot = result.at(-1)
        snapshot.write_volume(tmp_path / f"python_{out}", z, of=item)
    assert (tmp_path / "volume.vti").read_bytes() == (tmp_path / "python_volume.vti").read_bytes()
    volume, ours = (
        xr.open_zarr(tmp_path / f"{n}volume.zarr", chunks=None) for n in ("", "python_")
    )
    for name in item:
        np.testing.assert_array_equal(volume[name], ours[name])
    pressed = result.at(-1).stress(z, y=0.0, residual=[-1e9, 2e8])
    out = tmp_path / "pressed.zarr"
    run = fret_run("stress", store, *common, "--residual=-1e9,2e8", "-o", out)
    assert run.returncode == 0, run.stderr
    for name in item:
        np.testing.assert_array_equal(xr.open_zarr(out, chunks=None)[name], pressed.measure(name))
    wrong = fret_run("stress", store, "--residual=1e8", "-o", tmp_path / "wrong.zarr")
    assert wrong.returncode == 2
    assert "one for each of the 2 layers" in wrong.stderr
    assert not (tmp_path / "wrong.zarr").exists()
    first = fret_run("stress", store, "--increment", "10", "--along-y", "0", "--body", "1")
    assert first.returncode == 0, first.stderr
    assert first.stdout.startswith("increment 10: largest von_mises")


@pytest.mark.solves
def test_stress_has_the_bulk_stress_unless_left_out(coated: fret.Result, tmp_path: Path) -> None:
    store = tmp_path / "out.zarr"
    path = fret.LoadPath.start().force(W=W, sigma_B=2e8, sigma_B1=-1e8, increments=3)
    result = fret.solve(coated.scene, path, save="branches", out=store, progress=False)
    snapshot = result.at(-1)
    z = [0.0, 1e-4, 2e-4]
    for body in (1, 2):
        for bulk in (True, False):
            out = tmp_path / f"{body}{bulk}.zarr"
            options = ("--body", str(body), *(() if bulk else ("--no-bulk",)))
            run = fret_run(
                "stress",
                store,
                "--depths",
                "3",
                "--depth",
                "2e-4",
                "--of",
                "s_xx",
                *options,
                "-o",
                out,
            )
            assert run.returncode == 0, run.stderr
            written = xr.open_zarr(out, chunks=None).s_xx
            ours = snapshot.stress(z, y=0.0, body_number=body, bulk=bulk).s_xx
            np.testing.assert_array_equal(written, ours)


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("--of", "mises"), "one of s_xx"),
        (("--increment", "3"), "one whose fields were kept"),
        (("--depth=-1.0",), "depth = -1: must be a positive length"),
        (("--along-x", "1.0"), "a place above the grid"),
        (("-o", "section.vti"), "image data (.vti) is of a --volume"),
    ],
)
def test_stress_that_is_not_there_is_refused(
    coated: fret.Result, tmp_path: Path, arguments: tuple[str, ...], expected: str
) -> None:
    store = tmp_path / "out.zarr"
    path = fret.LoadPath.start().normal(W, increments=4)
    fret.solve(coated.scene, path, save="branches", out=store, progress=False)
    run = fret_run("stress", store, "--depths", "3", *arguments)
    assert run.returncode == 2, run.stderr
    assert expected in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1


TEMPLATES = (
    "uncoated_ball",
    "coated_ball",
    "cylinder",
    "rough",
    "displacement",
    "many_layers",
    "wear",
)


@pytest.mark.solves
@pytest.mark.parametrize("template", TEMPLATES)
def test_a_new_scene_can_be_checked_and_solved(template: str, tmp_path: Path) -> None:
    scene = tmp_path / "scene.toml"
    written = fret_run("new", template, "-o", scene)
    assert written.returncode == 0, written.stderr
    assert fret_run("new", template, "-o", scene).returncode == 2, "what is there stays"
    assert fret_run("new", template).stdout.strip() == scene.read_text().strip()
    checked = fret_run("check", scene)
    assert checked.returncode == 0, checked.stderr
    assert "warning" not in checked.stderr
    for word in ("body 2", "work", "memory", "E = "):
        assert word in checked.stdout
    # Spots of a rough contact have a few cells each.
    n = {"cylinder": "[24, 1]", "rough": "96"}.get(template, "40")
    small = ["--set", f"grid.n={n}", *(f"--set=path.{i}.increments=3" for i in range(4))]
    if template == "rough":
        small.append("--set=body2.shape.rough.shortest=60e-6")
    run = fret_run("run", scene, *small, "-o", tmp_path / "out.zarr")
    assert run.returncode == 0, run.stderr
    assert max(len(line) for line in run.stdout.splitlines()) <= 100
    assert "cycle 1 (x): " in run.stdout
    assert "energy ratio" in run.stdout
    largest = fret_run("stress", tmp_path / "out.zarr")
    assert largest.returncode == 0, largest.stderr
    assert "largest von_mises" in largest.stdout
    assert re.search(r"largest von_mises [-+.\de]+ \S+ \+- \d", largest.stdout), largest.stdout


def test_a_scene_comes_from_the_standard_input() -> None:
    text = fret_run("new", "coated_ball").stdout
    run = subprocess.run(
        [FRET, "check", "-", "--json"], input=text, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    answer = json.loads(run.stdout)
    assert answer["title"] == "Alumina on DLC/Cr on titanium"
    assert "0.500 um" in answer["text"]["body 2"][0]


@pytest.mark.solves
def test_numbers_for_programs(coated: fret.Result, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(coated.scene.to_toml())
    run = fret_run("run", tmp_path / "scene.toml", "-o", tmp_path / "out.zarr", "--json")
    answer = json.loads(run.stdout)
    assert [b["T_x"] for b in answer["branches"]] == coated.branches().T_x.values.tolist()
    loops = coated.loops()
    assert [c["energy_ratio"] for c in answer["cycles"]] == loops.energy_ratio.values.tolist()
    assert {c["status"] for c in answer["cycles"]} == {"partial_slip"}
    stress = fret_run(
        "stress", tmp_path / "out.zarr", "--json", "--of", "von_mises,interface_shear"
    )
    mises, shear = (json.loads(line) for line in stress.stdout.splitlines())
    below = coated.at(-1).stress()
    assert mises["value"] == pytest.approx(below.maximum().value, rel=1e-12)
    assert shear["value"] == pytest.approx(below.maximum("interface_shear").value, rel=1e-12)
    assert shear["z"] == coated.scene.interfaces()[0]


@pytest.mark.solves
def test_few_planes_of_a_volume_leave_the_largest_value_as_it_is(
    coated: fret.Result, tmp_path: Path
) -> None:
    (tmp_path / "scene.toml").write_text(coated.scene.to_toml())
    fret_run("run", tmp_path / "scene.toml", "-o", tmp_path / "out.zarr", "--quiet")
    few = fret_run(
        "stress", tmp_path / "out.zarr", "--volume", "--json", "--depths", "8",
        "-o", tmp_path / "few.vti",
    )  # fmt: skip
    assert few.returncode == 0, few.stderr
    all_of_them = fret_run("stress", tmp_path / "out.zarr", "--volume", "--json")
    values = [json.loads(run.stdout)["value"] for run in (few, all_of_them)]
    assert values[0] == pytest.approx(values[1], rel=2e-3)


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("-o", "s.png"), "figures are drawn by pyfret.plot.stress_map"),
        (("--of", "interface_shear", "--body", "1"), "this body has no coating"),
        (("--of", "mises"), "must be one of"),
    ],
)
def test_what_stress_cannot_do_it_refuses(
    arguments: tuple[str, ...], expected: str, coated: fret.Result, tmp_path: Path
) -> None:
    (tmp_path / "scene.toml").write_text(coated.scene.to_toml())
    fret_run("run", tmp_path / "scene.toml", "-o", tmp_path / "out.zarr", "--quiet")
    refused = fret_run("stress", tmp_path / "out.zarr", *arguments)
    assert refused.returncode == 2
    assert expected in refused.stderr
    assert not (tmp_path / "s.png").exists()


def test_completions_and_manual_pages(tmp_path: Path) -> None:
    for shell in ("bash", "zsh", "fish"):
        assert "fret" in fret_run("completions", shell).stdout
    assert fret_run("man", tmp_path / "man").returncode == 0
    pages = {page.name for page in (tmp_path / "man").iterdir()}
    assert {"fret.1", "fret-run.1", "fret-stress.1"} <= pages


def test_a_contact_beyond_the_grid_is_told_by_check(scene_file: Path) -> None:
    tight = fret_run("check", scene_file, "--set", "grid.extent=1e-4")
    assert tight.returncode == 2
    assert "does not fit on the grid" in tight.stderr


def test_the_package_brings_the_command_along(tmp_path: Path) -> None:
    code = "from pyfret._cli import main; main()"
    scene = tmp_path / "scene.toml"
    written = subprocess.run(
        [sys.executable, "-c", code, "new", "coated_ball", "-o", scene], check=False
    )
    assert written.returncode == 0
    refused = subprocess.run(
        [sys.executable, "-c", code, "check", scene, "--set", "friction.mu=-1"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert refused.returncode == 2
    assert "friction.mu = -1" in refused.stderr
