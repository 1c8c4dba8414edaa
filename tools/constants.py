"""Scans the constants of the numerical methods: docs/constants.md.

Each constant is given a smaller and a larger value, alone, and the scenes of
`crates/contact-core/examples/ablation` are solved on 64 x 64 cells. The table says by how much the
work (convolutions of all scenes together) and the worst error change. One build serves all values:
in a copy of the sources the constants are read from the environment.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
SOURCE = Path("crates/contact-core/src")

# File, constant, the values tried. Those in BUILT take a build for each value.
SCAN = [
    ("estimate/choice.rs", "EXPECTED", ("1.25", "2.0")),
    ("estimate/choice.rs", "AIM", ("0.7", "1.0")),
    ("estimate/choice.rs", "ACCEPTED", ("0.7", "1.1")),
    ("estimate/choice.rs", "GROWN", ("3.0", "12.0")),
    ("estimate/choice.rs", "KEPT", ("0.65", "0.95")),
    ("estimate/choice.rs", "MOST_REFINEMENT", ("2.5", "6.0")),
    ("estimate/choice.rs", "OWN", ("1.4", "2.8")),
    ("estimate/trial.rs", "ORDER", ("1.25", "2.0")),
    ("estimate/trial.rs", "GROWTH_ORDER", ("0.75", "1.5")),
    ("estimate/trial.rs", "SOLVER_SHARE", ("5e-3", "2e-2")),
    ("estimate/trial.rs", "MISSED", ("1.0", "1.5")),
    ("estimate/trial.rs", "CONTACT", ("150", "600")),
    ("estimate/trial.rs", "RING", ("3.3", "13.2")),
    ("estimate/trial.rs", "FEW", ("24", "48")),
    ("estimate/trial.rs", "HALF_SHARE", ("1e-2", "1e-1")),
    ("march/remembered.rs", "PIECES", ("5", "9")),
    ("march/remembered.rs", "STIFF", ("1e-9", "1e-5")),
    ("march/remembered.rs", "BEHIND", ("2.0", "8.0")),
    ("march/remembered.rs", "BESIDE", ("0.01", "0.04")),
    ("march/remembered.rs", "LEAST_STICK", ("0.3", "0.7")),
    ("march/problem.rs", "PREDICTED_SHARE", ("0.4", "1.0")),
    ("march/problem.rs", "NORMAL_SHARE", ("0.2", "0.8")),
    ("march/problem.rs", "TANGENTIAL_SHARE", ("0.3", "0.9")),
    ("march/problem.rs", "FORCING", ("0.05", "0.2")),
    ("march/entry/equations.rs", "KEPT_SHARE", ("0.25", "1.0")),
    ("march/entry/equations.rs", "ENTERED_SHARE", ("0.125", "0.5")),
    ("march/domain/mod.rs", "AROUND", ("4", "10")),
    ("march/entry/view.rs", "REACH", ("5", "11")),
    ("march/entry/view.rs", "ONSET", ("0.015", "0.06")),
    ("march/entry/screened.rs", "NEAREST", ("0.18", "0.7")),
    ("march/entry/screened.rs", "LEAST", ("0.25", "1.0")),
    ("march/entry/least_squares.rs", "RIDGE", ("1e-8", "1e-4")),
    ("march/accounts/areas.rs", "RING", ("2", "6")),
    ("march/accounts/areas.rs", "FEWEST_CELLS", ("2", "8")),
    ("solvers/no_slip/turn.rs", "STARTS", ("0.33", "1.0")),
    ("solvers/no_slip/turn.rs", "STARTED", ("0.4", "1.0")),
    ("solvers/no_slip/turn.rs", "SLIPPED", ("0.5", "0.99")),
    ("solvers/no_slip/turn.rs", "FARTHER", ("0.05", "0.2")),
    ("solvers/intermediate/known_pressure.rs", "STALLED", ("3", "10")),
    ("solvers/intermediate/known_pressure.rs", "UNSETTLED", ("2", "6")),
    ("solvers/intermediate/anderson.rs", "DEPTH", ("4", "16")),
    ("solvers/intermediate/anderson.rs", "SLOW", ("0.25", "0.8")),
    ("solvers/intermediate/anderson.rs", "SLOW_PASSES", ("1", "4")),
    ("solvers/intermediate/precision.rs", "ROUNDED", ("0.05", "0.2")),
    ("solvers/inner/tangential.rs", "NEGLIGIBLE_CHANGE", ("0.05", "0.2")),
    ("solvers/inner/tangential.rs", "AIM", ("0.2", "0.8")),
    ("solvers/inner/tangential.rs", "DESCENT", ("5", "20")),
    ("solvers/inner/newton_system.rs", "RIGHT", ("1.0", "4.0")),
    ("zones/parabola.rs", "FIRST_BEND", ("0.2", "0.8")),
    ("zones/parabola.rs", "BEND", ("0.07", "0.3")),
    ("zones/parabola.rs", "MOVED", ("0.1", "0.4")),
    ("zones/level.rs", "FARTHEST", ("1.0", "2.5")),
    ("zones/level.rs", "STRAIGHT", ("0.05", "0.2")),
]

# Largest share of the work and of an error that is no change.
SAME = 0.03
ERRORS = ("q after the first branch", "q at the ends", "contact radius", "stick radius")
# Errors below these are those of the finer runs: shear over the largest, radii in cells.
FLOORS = (1e-4, 1e-4, 0.005, 0.005)

BUILT = ("AROUND", "REACH", "DEPTH", "PIECES")

READ = """fn {name}() -> {kind} {{
    static VALUE: std::sync::OnceLock<{kind}> = std::sync::OnceLock::new();
    *VALUE.get_or_init(|| match std::env::var("{key}") {{
        Ok(value) => value.parse().expect("a number in {key}"),
        Err(_) => {value},
    }})
}}"""


def key_of(file: str, name: str) -> str:
    """Environment variable of a constant."""
    return "SCAN_" + re.sub(r"\W", "_", file.removesuffix(".rs")).upper() + "_" + name


def definition(text: str, name: str) -> re.Match[str]:
    """Where a constant is defined: its type and its value."""
    found = re.search(rf"\bconst {name}: ([^=]+?) = ([^;]+);", text)
    if not found:
        raise SystemExit(f"no constant {name}")
    return found


def read_from_environment(copy: Path, file: str, name: str) -> None:
    """Makes a constant a function in the copy, in its file and where it is imported."""
    source = copy / SOURCE
    module = Path(file).parent.name if file.endswith("/mod.rs") else Path(file).stem
    # Where other modules have a constant of the same name, it is known by its module.
    defined = [f for f in source.rglob("*.rs") if f"const {name}:" in f.read_text()]
    used = rf"\b{module}\b[^;]*" if len(defined) > 1 else ""
    text = (source / file).read_text()
    kind, value = definition(text, name).groups()
    read = READ.format(name=name, kind=kind, value=value, key=key_of(file, name))
    for path in source.rglob("*.rs"):
        text = path.read_text()
        here = path == source / file
        if not here and not re.search(rf"^use [^;]*{used}\b{name}\b", text, re.MULTILINE):
            continue
        lines = []
        for line in text.splitlines():
            if not line.lstrip().startswith(("//", "use ")) and f"const {name}:" not in line:
                line = re.sub(rf"(?<![:\w]){name}\b(?!\()", f"{name}()", line)
            lines.append(line)
        text = "\n".join(lines) + "\n"
        path.write_text(re.sub(rf"\bconst {name}: [^;]+;", read, text) if here else text)


def build(copy: Path) -> Path:
    """Builds the example in the copy: its path."""
    command = ["cargo", "build", "--quiet", "--locked", "--profile", "scan", "--package"]
    command += ["contact-core", "--example", "constants"]
    run = subprocess.run(command, cwd=copy, capture_output=True, text=True, check=False)
    if run.returncode:
        raise SystemExit(run.stderr)
    return copy / "target" / "scan" / "examples" / "constants"


def solved(program: Path, folder: Path, **changed: str) -> dict[str, list[float] | str]:
    """What each scene takes and errs by, with constants changed through the environment."""
    run = subprocess.run(
        [program, folder],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | changed,
    )
    if run.returncode:
        raise SystemExit(run.stderr)
    rows: dict[str, list[float] | str] = {}
    for line in run.stdout.splitlines():
        name, *numbers = line.split("|")
        rows[name] = [float(n) for n in numbers] if len(numbers) == 5 else numbers[0]
    return rows


def compared(
    base: dict[str, list[float] | str], rows: dict[str, list[float] | str]
) -> tuple[str, str]:
    """The change of the work, and of the error that changes most."""
    work, before = 0.0, 0.0
    worst, words = 1.0, "same"
    for scene, now in rows.items():
        was = base[scene]
        if isinstance(was, str):
            continue
        if isinstance(now, str):
            return "", f"{scene}: {now}"
        work, before = work + now[0], before + was[0]
        for name, floor, a, b in zip(ERRORS, FLOORS, now[1:], was[1:], strict=True):
            ratio = (a + floor) / (b + floor)
            if abs(ratio - 1) > SAME and max(ratio, 1 / ratio) > max(worst, 1 / worst):
                worst, words = ratio, f"{scene}: {name} x {ratio:.2f}"
    change = work / before - 1
    return ("same" if abs(change) < SAME else f"{100 * change:+.0f} %"), words


def present(base: dict[str, list[float] | str]) -> str:
    """The table of what the present constants take and err by."""
    lines = ["| scene | convolutions | q first | q at the ends | contact radius | stick radius |"]
    lines.append("|---|---|---|---|---|---|")
    for scene, now in base.items():
        if isinstance(now, str):
            lines.append(f"| {scene} | {now} |")
            continue
        work, *shear_and_radii = now
        cells = " | ".join(f"{error:.2g}" for error in shear_and_radii)
        lines.append(f"| {scene} | {work:.0f} | {cells} |")
    return "\n".join(lines) + "\n"


def main() -> int:
    """Writes the table to standard output."""
    with tempfile.TemporaryDirectory() as temporary:
        copy, folder = Path(temporary) / "copy", Path(temporary) / "finer"
        ignored = shutil.ignore_patterns("target", ".venv", ".git", "out")
        shutil.copytree(ROOT, copy, ignore=ignored)
        folder.mkdir()
        for file, name, _ in SCAN:
            if name not in BUILT:
                read_from_environment(copy, file, name)
        program = build(copy)
        base = solved(program, folder)
        print((ROOT / "tools" / "constants.md").read_text())
        print(present(base))
        print(
            "| constant | value | tried | work | error that changes most |\n|---|---|---|---|---|"
        )
        for file, name, values in SCAN:
            text = (ROOT / SOURCE / file).read_text()
            value_now = definition(text, name)[2]
            for value in values:
                if name in BUILT:
                    path = copy / SOURCE / file
                    kept = path.read_text()
                    found = definition(kept, name)
                    path.write_text(kept[: found.start(2)] + value + kept[found.end(2) :])
                    rows = solved(build(copy), folder)
                    path.write_text(kept)
                else:
                    rows = solved(program, folder, **{key_of(file, name): value})
                work, error = compared(base, rows)
                print(f"| `{file}` {name} | {value_now} | {value} | {work} | {error} |", flush=True)
            if name in BUILT:
                build(copy)
    return 0


if __name__ == "__main__":
    sys.exit(main())
