"""Words of summaries and messages: as people write them, and none of them of megabytes."""

from __future__ import annotations

import json
import re
import resource
import subprocess
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, SAME_PROCESS
from pyfret._core import with_error, with_range

FRET = ROOT / "target" / "release" / "fret"
STEEL = fret.Elastic(E=210e9, nu=0.3)
FILM = fret.Coating(fret.Elastic(E=420e9, nu=0.25), thickness=8e-5)
PATH = fret.LoadPath.start().normal(100.0, increments=2).cycles(1, T_x=15.0, increments=6)
SCENE = fret.Scene(
    body1=fret.Body(STEEL, shape=fret.Sphere(R=0.01)),
    body2=fret.Body(STEEL, coatings=[FILM]),
    friction=0.3,
    grid=fret.Grid.centred(width=6e-4, n=16),
    path=PATH,
)
#: A text of 5 MB, and the longest message that repeats it [characters].
LONG, LONGEST = "k" * 5_000_000, 2000


def solved(path: fret.LoadPath = PATH) -> fret.Result:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return fret.solve(SCENE, path, progress=False)


@pytest.fixture(scope="module")
def result() -> fret.Result:
    return solved()


@pytest.mark.solves
def test_a_summary_has_the_words_of_the_field(result: fret.Result) -> None:
    text = " ".join(result.summary().split())
    for word in ("error of q", "doubted", "from 0", "(estimate)"):
        assert word not in text, word
    assert "sliding ratio (slip/shift)" in text


@pytest.mark.solves
def test_a_layer_has_the_same_name_wherever_it_is_printed(result: fret.Result) -> None:
    """Largest stresses, worst points and load factors are in "coating 1" or "the substrate"."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        stress = result.at(-1).stress()
        steel = "steel_4340"
        life = result.life([steel, steel], "smith_watson_topper")
        factors = result.load_factors([1e9, 5e8])
        extrema = [
            *(stress.maximum("von_mises", layer=layer) for layer in (0, 1)),
            *(life.worst_of(layer) for layer in (0, 1)),
            *(factors.least_of(layer) for layer in (0, 1)),
        ]
    for extremum in extrema:
        name = ["coating 1", "the substrate"][extremum.layer]
        assert extremum.layer_name == name
        assert f"in {name}" in repr(extremum)
        assert "from 0" not in repr(extremum)


def test_an_estimate_has_its_word_before_the_number_and_its_unit() -> None:
    assert with_error(2.16345) == "about 2.2"
    assert with_error(-0.2, 97.0) == "0 +- 97"
    assert with_error(-0.6, 9.7) == "-0.6 +- 9.7"
    assert re.fullmatch(r"about 52000", with_range(52_345.0, np.nan, np.nan))


def test_a_life_has_the_digits_that_its_factor_leaves() -> None:
    """A factor of 3 leaves two digits, a part of a thousand four."""
    assert with_range(123_456.0, 41_152.0, 370_368.0) == "1.2e5 (4.1e4 to 3.7e5)"
    assert with_range(52_345.0, 52_300.0, 52_390.0) == "52350 (52300 to 52390)"


@pytest.mark.solves
def test_a_contact_that_is_unloaded_has_no_stick_ratio() -> None:
    unloaded = solved(fret.LoadPath.start().normal([100.0, 0.0], increments=2))
    assert np.isnan(float(unloaded.stick_ratio[-1]))
    assert np.isfinite(unloaded.stick_ratio[0])
    text = unloaded.summary()
    assert "nan" not in text.lower()
    assert "no contact" in text
    study = fret.study.run(
        SCENE.replace(path=fret.LoadPath.start().normal([100.0, 0.0], increments=2)),
        {"mu": [0.3]},
        measure=["p_max", "stick_ratio"],
        executor=SAME_PROCESS,
        progress=False,
    )
    assert "stick_ratio: there is no contact at the end" in study.unanswered()[0][1]


def fret_check(*options: str, text: str | None = None) -> subprocess.CompletedProcess[str]:
    command = [str(FRET), "check", "-", *options]
    scene = SCENE.to_toml() if text is None else text
    return subprocess.run(command, input=scene, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    ("setting", "key"),
    [
        ("pitch=1e-6", "grid.spacing"),
        ("grid.pitch=1e-6", "grid.spacing"),
        ("cof=0.3", "friction.mu"),
    ],
)
def test_a_setting_of_another_name_names_the_key(setting: str, key: str) -> None:
    refused = fret_check("--set", setting)
    assert refused.returncode == 2
    assert f"`{key}`" in refused.stderr
    assert len(refused.stderr.splitlines()) == 1, refused.stderr


def test_mu_is_short_for_its_key_in_settings_and_studies() -> None:
    short = fret_check("--set", "mu=0.4", "--json")
    assert short.returncode == 0, short.stderr
    whole = fret_check("--set", "friction.mu=0.4", "--json")
    first, second = (json.loads(ended.stdout) for ended in (short, whole))
    # The memory that is available changes.
    assert {**first, "memory": 0, "text": 0} == {**second, "memory": 0, "text": 0}
    assert SCENE.replace({"mu": 0.4}).mu == SCENE.replace({"friction.mu": 0.4}).mu == 0.4


def test_a_word_of_others_names_the_argument_of_a_grid() -> None:
    with pytest.raises(TypeError, match="spacing"):
        fret.Grid.from_spacing((32, 32), pitch=1e-6)  # type: ignore[call-arg]


#: Calls with a text of megabytes.
ECHOES: dict[str, Callable[[], object]] = {
    "key of a file": lambda: fret.Scene.from_toml(f"{LONG} = 1\n{SCENE.to_toml()}"),
    "value of a file": lambda: fret.Scene.from_toml(
        re.sub(r"(?m)^mu = .*$", f'mu = "{LONG}"', SCENE.to_toml())
    ),
    "list of a file": lambda: fret.Scene.from_toml(
        re.sub(r"(?m)^schema = .*$", f"schema = [{'1, ' * 1_000_000}]", SCENE.to_toml())
    ),
    "setting": lambda: fret.Scene.from_toml(SCENE.to_toml(), set=[f"{LONG}=1"]),
    "value of a setting": lambda: fret.Scene.from_toml(
        SCENE.to_toml(), set=[f"friction.mu={LONG}"]
    ),
    "key of replace": lambda: SCENE.replace({LONG: 1.0}),
    "argument": lambda: fret.Scene(**{LONG: 1}),
    "name of a material": lambda: fret.material(LONG),
    "quantity": lambda: fret.Sphere(R=LONG),
    "criterion": lambda: fret.fatigue.Criterion.of(LONG, "7075"),
    "choice": lambda: fret.Settings(preset=LONG),  # type: ignore[arg-type]
    "measure": lambda: fret.study.run(SCENE, {"mu": [0.3]}, measure=LONG),
    "parameter": lambda: fret.study.run(SCENE, {LONG: [0.3]}, measure="p_max"),
    "file": lambda: fret.open(LONG),
}


#: Errors of a text that nobody takes.
REFUSALS = (ValueError, TypeError, LookupError, OSError, fret.errors.StoreError)


@pytest.mark.parametrize("name", ECHOES)
def test_a_text_of_megabytes_is_refused_in_a_short_message_at_once(name: str) -> None:
    """Refuse 5 MB in linear time: a second of processor time, five on a slow machine."""
    started = time.process_time()
    with pytest.raises(REFUSALS) as refused:
        ECHOES[name]()
    assert time.process_time() - started < 5.0
    assert len(str(refused.value)) < LONGEST, str(refused.value)[:200]


@pytest.mark.solves
@pytest.mark.skipif(sys.platform != "linux", reason="limits of Linux")
def test_a_limit_of_file_sizes_ends_a_run_with_a_sentence(tmp_path: Path) -> None:
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))

    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.to_toml())
    ended = subprocess.run(
        [str(FRET), "run", str(scene), "-q", "-o", str(tmp_path / "run.zarr")],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=limit,
    )
    assert ended.returncode in (1, 3), (ended.returncode, ended.stderr)
    assert "too large" in ended.stderr.lower()
    assert "run.zarr" in ended.stderr
