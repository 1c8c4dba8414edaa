"""The audit of the campaign sees what is wrong, and nothing in a contact that is right."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import pyfret as fret

sys.path.insert(0, str(Path(__file__).parent / "campaign"))

from audit import Audit
from draw import draw
from run import campaign, fate, summarise

pytestmark = pytest.mark.solves

SCENE = """
schema = 1
body1 = { shape.sphere.R = 0.01, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 70e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 24, extent = 6e-4 }
path = [{ W = 50.0, increments = 2 }, { T_x = 8.0, increments = 2 }]
"""


def test_a_contact_that_is_right_passes_and_every_error_shows() -> None:
    """Each equation is broken in turn."""
    audit = Audit(SCENE)
    for increment in fret.march(audit.scene):
        before = audit.before
        computed = audit.look(increment)
        assert max(computed.values()) < 1, computed
    d = increment.dataset
    middle = tuple(n // 2 for n in d.p.shape)
    outside = (0, 0)
    errors = {
        "balance W": ("p", middle, 1.1 * d.p[middle]),
        "balance T_x": ("q_x", middle, 1.1 * d.q_x[middle]),
        "tension": ("p", outside, -1e6),
        "shear without pressure": ("q_y", outside, 1e5),
        "Coulomb": ("q_y", middle, 0.4 * d.p[middle]),
        "gap inside": ("p", middle, 1.1 * d.p[middle]),
        "slip in stick": ("q_x", middle, 1.1 * d.q_x[middle]),
    }
    for name, (field, position, wrong) in errors.items():
        broken = d.copy(deep=True)
        broken[field][position] = wrong
        audit.before = before
        computed = audit.look(SimpleNamespace(dataset=broken))
        assert computed[name] > 1, (name, computed)


def test_most_of_what_is_drawn_is_a_scene() -> None:
    """The others are refused by name."""
    refused = 0
    for seed in range(100):
        try:
            fret.Scene.from_toml(draw(seed))
        except fret.errors.InvalidSceneError:
            refused += 1
    assert refused < 25


def test_scenes_of_everything_are_solved_or_rightly_refused() -> None:
    """A slice of the campaign through scene files: `python tests/campaign/run.py 0 5000`."""
    lines, right = summarise(list(campaign(0, 40)))
    assert right, "\n".join(lines)


@pytest.mark.slow
def test_what_follows_from_random_contacts_is_found_or_refused_for_a_reason() -> None:
    """A slice of `make whole`: bonds, laws of the user, heat, cracks, wear with debris."""
    outcomes = list(campaign(0, 24, whole=True))
    lines, right = summarise(outcomes)
    assert right, "\n".join(lines)
    computed = [
        name
        for entry in outcomes
        for name, why in dict(entry.get("after") or {}).items()
        if not why
    ]  # type: ignore[call-overload]
    assert {"heat", "crack", "wear"} <= set(computed)


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes of Unix")
def test_all_that_is_saved_is_killed_and_damaged() -> None:
    """A slice of `make kill`: runs, wear, studies, fits, in both formats."""
    program = Path(__file__).parent / "campaign" / "damage.py"
    done = subprocess.run(
        [sys.executable, str(program), "8", "1"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert len(done.stdout.splitlines()) == 10


# The campaign itself goes past every warning; surfaces of a few cells are drawn, too.
@pytest.mark.filterwarnings("ignore:the surfaces are uneven:pyfret.errors.SceneWarning")
def test_the_papers_method_solves_contacts_that_slide_far() -> None:
    """Gross slip and a rotation many times the reach of the contact, under `spinu2020`."""
    for seed in (449, 748, 768, 867, 1175, 1331):
        assert "spinu2020" in draw(seed)
        item = fate(seed)
        assert item["fate"] == "solved", (seed, item)
