"""Results of finite elements as the programs write them: which increment, which components.

The files in `data/corpus` are written by CalculiX 2.20, CalculiX GraphiX 2.17 and VTK 9.7.
"""

from __future__ import annotations

import shutil
import warnings
from pathlib import Path

import numpy as np
import pytest

import pyfret as fret
from pyfret import export
from pyfret.export.components import ORDERS, read_order, to_matrices
from pyfret.export.meshes import read_mesh

CORPUS = Path(__file__).parent / "data" / "corpus"
#: The middle of the bar, in mm.
FRAME = export.Frame(origin=(1.0, 0.5, 0.5), unit="mm")
#: A contact whose x lies in the model's plane y-z.
LEANING = export.Frame(x=(0.0, 1.0, 1.0), z=(0.0, 1.0, -1.0), unit="mm")

#: Bulk stress [Pa] of a job by its ``step``, or a part of the reason why it is refused.
STRESSES: dict[str, dict[int | str | None, float | str]] = {
    "static": {None: 100e6},
    "two_steps": {None: 200e6, "time 1": 100e6, "time 2": 200e6, "time 3": "no such increment"},
    "modal": {None: 100e6, "time 1": 100e6},
    "buckling": {None: -100e6},
    "steady_state": {None: "vibration 1000", "vibration 1000": "amplitudes of a vibration"},
    "diverged": {None: "did not converge at time 0.75", "time 0.5": 240e6},
}


@pytest.mark.parametrize("ending", ["frd", "dat"])
@pytest.mark.parametrize("job", STRESSES)
def test_the_stress_is_of_the_last_load_or_of_the_chosen_increment(job: str, ending: str) -> None:
    path = CORPUS / f"ccx_{job}.{ending}"
    for step, expected in STRESSES[job].items():
        with warnings.catch_warnings():
            # A run that did not converge has no last line.
            warnings.filterwarnings("ignore", "(?s).*9999", fret.errors.SceneWarning)
            if isinstance(expected, str):
                with pytest.raises(ValueError, match=expected):
                    export.bulk_stress(path, frame=FRAME, step=step)
            else:
                stress = export.bulk_stress(path, frame=FRAME, step=step)
                assert stress == pytest.approx(expected, rel=1e-3)


def test_a_step_is_chosen_by_its_number() -> None:
    path = CORPUS / "ccx_two_steps.frd"
    assert export.bulk_stress(path, frame=FRAME, step=1) == pytest.approx(100e6, rel=1e-4)
    first, second = (export.compliance(path, 100.0, frame=FRAME, step=n) for n in (1, 2))
    assert second == pytest.approx(2.0 * first, rel=1e-4)
    with pytest.raises(ValueError, match="is no step of loads"):
        export.bulk_stress(CORPUS / "ccx_modal.frd", frame=FRAME, step=2)


def test_modes_are_read_by_their_names_only() -> None:
    """Modes of unit modal mass have stresses of 1e10 Pa."""
    path = CORPUS / "ccx_modal.frd"
    assert export.bulk_stress(path, frame=FRAME, step="mode 2") > 1e10


@pytest.mark.parametrize("read", ["bulk_stress", "compliance"])
def test_modes_alone_are_refused(read: str, tmp_path: Path) -> None:
    lines = (CORPUS / "ccx_modal.frd").read_text().splitlines(keepends=True)
    heads = [n for n, line in enumerate(lines) if line.startswith("    1PSTEP")]
    modal = next(n for n in heads if lines[n].split()[-1] == "2")
    (tmp_path / "modes.frd").write_text("".join(lines[: heads[0]] + lines[modal:]))
    force = () if read == "bulk_stress" else (100.0,)
    with pytest.raises(ValueError, match="no increment under load, but mode 1"):
        getattr(export, read)(tmp_path / "modes.frd", *force, frame=FRAME)


@pytest.mark.parametrize("with_status", [True, False])
def test_a_failed_iteration_is_found_with_and_without_the_status_file(
    tmp_path: Path, *, with_status: bool
) -> None:
    for ending in ("frd", "sta")[: 1 + with_status]:
        shutil.copy(CORPUS / f"ccx_diverged.{ending}", tmp_path / f"job.{ending}")
    for step in (None, 1):
        with pytest.raises(ValueError, match=r"did not converge at time 0.75|no step of loads"):
            export.compliance(tmp_path / "job.frd", 100.0, frame=FRAME, step=step)


def test_displacements_and_forces_alone_are_doubted_without_the_status_file(
    tmp_path: Path,
) -> None:
    """CalculiX writes the same blocks of a failed first increment."""
    text = (CORPUS / "ccx_diverged.frd").read_text()
    blocks = text.split("    1PSTEP")
    (tmp_path / "job.frd").write_text(
        blocks[0] + "".join(f"    1PSTEP{b}" for b in blocks[-2:]) + " 9999\n"
    )
    with pytest.warns(fret.errors.SceneWarning, match=r"job\.sta beside it would decide"):
        export.compliance(tmp_path / "job.frd", 100.0, frame=FRAME)


def test_an_increment_without_the_field_is_no_reason_to_take_an_earlier_one(
    tmp_path: Path,
) -> None:
    text = (CORPUS / "ccx_two_steps.frd").read_text()
    cut = text.rindex("    1PSTEP", 0, text.rindex(" -4  STRESS"))
    (tmp_path / "job.frd").write_text(text[:cut] + " 9999\n")
    with pytest.raises(ValueError, match=r"last increment, time 2.*no block STRESS.*'time 1'"):
        export.bulk_stress(tmp_path / "job.frd", frame=FRAME)
    assert export.compliance(tmp_path / "job.frd", 100.0, frame=FRAME) > 0.0


def test_contact_stresses_and_forces_are_no_stresses() -> None:
    """CDIS, CSTR, CF and RF stand in the same files."""
    printed = export.bulk_stress(CORPUS / "ccx_contact.dat", frame=FRAME)
    rows = [line.split() for line in (CORPUS / "ccx_contact.dat").read_text().splitlines()[3:11]]
    assert printed == pytest.approx(1e6 * np.mean([float(row[2]) for row in rows]))
    low = export.Frame(origin=(0.5, 0.5, 0.0), unit="mm")
    assert export.bulk_stress(CORPUS / "ccx_contact.frd", frame=low) < 0.0
    with pytest.raises(ValueError, match="are no stresses"):
        read_order(("COPEN", "CSLIP1", "CSLIP2", "CPRESS", "CSHEAR1", "CSHEAR2"))


@pytest.mark.parametrize("ending", ["vtu", "vtk"])
def test_names_of_components_decide_their_order(ending: str) -> None:
    """(s_yy + s_zz) / 2 + s_yz = (50 + 20) / 2 + 30, with 10 for s_xz."""
    labelled, bare = (CORPUS / f"vtk_{kind}.{ending}" for kind in ("named", "bare"))
    assert export.bulk_stress(labelled, field="S", frame=LEANING) == pytest.approx(65e6)
    with pytest.raises(ValueError, match=r"without names.*4\.5e\+07 Pa.*6\.5e\+07 Pa"):
        export.bulk_stress(bare, field="S", frame=LEANING)
    for kind, expected in (("VTK", 65e6), ("Abaqus", 45e6)):
        components = ORDERS[kind]
        stress = export.bulk_stress(bare, field="S", frame=LEANING, components=components)
        assert stress == pytest.approx(expected)
    # Along the axes both orders have the same stress.
    along = export.Frame(unit="mm")
    assert export.bulk_stress(bare, field="S", frame=along) == pytest.approx(100e6)


def test_components_of_a_frd_are_taken_by_their_names(tmp_path: Path) -> None:
    text = (CORPUS / "ccx_static.frd").read_text()
    swapped = text.replace("SXX   ", "SYY_  ").replace("SYY   ", "SXX   ").replace("SYY_", "SYY ")
    (tmp_path / "job.frd").write_text(swapped)
    assert abs(export.bulk_stress(tmp_path / "job.frd", frame=FRAME)) < 5e6


@pytest.mark.parametrize("order", [*ORDERS.values(), ("yz", "xx", "zz", "xy", "yy", "xz")])
def test_matrices_follow_any_order(order: tuple[str, ...]) -> None:
    tensor = np.array([[1.0, 2.0, 3.0], [2.0, 4.0, 5.0], [3.0, 5.0, 6.0]])
    row = [tensor["xyz".index(i), "xyz".index(j)] for i, j in order]
    np.testing.assert_array_equal(to_matrices(np.array([row]), order)[0], tensor)
    for names in (
        [f"S{pair.upper()}" for pair in order],
        [f"S{'xyz'.index(i) + 1}{'xyz'.index(j) + 1}" for i, j in order],
        [f"SI{pair[::-1].upper()}" for pair in order],
    ):
        np.testing.assert_array_equal(to_matrices(np.array([row]), read_order(names))[0], tensor)


@pytest.mark.parametrize(
    "names",
    [
        ("EXX", "EYY", "EZZ", "EXY", "EYZ", "EZX"),
        ("SXX", "SYY", "SZZ", "SXY", "SXY", "SZX"),
        ("max", "mid", "min", "x", "y", "z"),
    ],
)
def test_what_is_no_stress_is_refused(names: tuple[str, ...]) -> None:
    with pytest.raises(ValueError, match="its components are"):
        read_order(names)


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("cgx_bar.msh", (2.0, 1.0, 1.0)),
        *(
            (f"gmsh_box{kind}", (1.0, 1.0, 1.0))
            for kind in ("_22.msh", "_41.msh", ".inp", ".vtk", ".mesh")
        ),
    ],
)
def test_meshes_are_read_by_their_content(name: str, size: tuple[float, ...]) -> None:
    mesh = read_mesh(CORPUS / name)
    np.testing.assert_allclose(np.ptp(mesh.points, axis=0), size)
    assert sum(len(rows) for rows in mesh.volumes) == (2 if name == "cgx_bar.msh" else 4)


def test_a_mesh_of_another_program_is_refused_by_what_it_lacks(tmp_path: Path) -> None:
    (tmp_path / "a.msh").write_text("mesh of something else\n")
    with pytest.raises(ValueError, match=r"must begin with \$MeshFormat"):
        read_mesh(tmp_path / "a.msh")
