"""Scans the constants of the numerical methods: docs/constants.md.

Each constant is given a smaller and a larger value in a copy of the sources, alone, and the scenes
of `crates/contact-core/examples/ablation` are solved on 64 x 64 cells. The table says by how much
the work (convolutions of all scenes together) and the worst error change.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
SOURCE = Path("crates/contact-core/src")

# File, constant, the values tried.
SCAN = [
    ("march/problem.rs", "PREDICTED_SHARE", ("0.4", "1.0")),
    ("march/problem.rs", "NORMAL_SHARE", ("0.2", "0.8")),
    ("march/problem.rs", "TANGENTIAL_SHARE", ("0.45", "1.0")),
    ("march/entry/asked.rs", "KEPT_SHARE", ("0.25", "1.0")),
    ("march/entry/asked.rs", "ENTERED_SHARE", ("0.125", "0.5")),
    ("march/domain/mod.rs", "AROUND", ("4", "10")),
    ("march/entry/view.rs", "REACH", ("5", "11")),
    ("march/entry/view.rs", "ONSET", ("0.015", "0.06")),
    ("march/entry/screened.rs", "NEAREST", ("0.18", "0.7")),
    ("march/entry/least_squares.rs", "RIDGE", ("1e-8", "1e-4")),
    ("march/accounts/areas.rs", "RING", ("2", "6")),
    ("solvers/no_slip/turn.rs", "STARTS", ("0.33", "1.0")),
    ("solvers/no_slip/turn.rs", "STARTED", ("0.4", "1.0")),
    ("solvers/no_slip/turn.rs", "SLIPPED", ("0.5", "1.0")),
    ("solvers/no_slip/turn.rs", "NEARER", ("0.05", "0.2")),
    ("solvers/intermediate/known_pressure.rs", "STALLED", ("3", "10")),
    ("solvers/intermediate/anderson.rs", "DEPTH", ("4", "16")),
    ("solvers/intermediate/anderson.rs", "SLOW", ("0.25", "0.8")),
    ("solvers/intermediate/precision.rs", "ROUNDED", ("0.05", "0.2")),
    ("solvers/inner/tangential.rs", "SETTLED", ("0.05", "0.2")),
    ("solvers/inner/tangential.rs", "AIM", ("0.2", "0.8")),
    ("solvers/inner/newton_system.rs", "RIGHT", ("1.0", "4.0")),
    ("zones/parabola.rs", "FIRST_BEND", ("0.2", "0.8")),
    ("zones/parabola.rs", "BEND", ("0.07", "0.3")),
    ("zones/parabola.rs", "MOVED", ("0.1", "0.4")),
    ("zones/level.rs", "STRAIGHT", ("0.05", "0.2")),
]

# Largest share of the work and of an error that is no change.
SAME = 0.03
ERRORS = ("q after the first branch", "q at the ends", "contact radius", "stick radius")
# Errors below these are those of the finer runs: shear over the largest, radii in cells.
FLOORS = (1e-4, 1e-4, 0.005, 0.005)


def value_of(text: str, name: str) -> re.Match[str]:
    """Where a constant has its value."""
    found = re.search(rf"\bconst {name}: [^=]+= ([^;]+);", text)
    if not found:
        raise SystemExit(f"no constant {name}")
    return found


def solved(copy: Path, folder: Path) -> dict[str, list[float] | str]:
    """What each scene takes and errs by, from a build of the copy."""
    command = ["cargo", "run", "--quiet", "--locked", "--profile", "scan", "--package"]
    command += ["contact-core", "--example", "constants", "--", str(folder)]
    run = subprocess.run(command, cwd=copy, capture_output=True, text=True, check=False)
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


def main() -> int:
    """Writes the table to standard output."""
    with tempfile.TemporaryDirectory() as temporary:
        copy, folder = Path(temporary) / "copy", Path(temporary) / "finer"
        ignored = shutil.ignore_patterns("target", ".venv", ".git", "out")
        shutil.copytree(ROOT, copy, ignore=ignored)
        folder.mkdir()
        base = solved(copy, folder)
        print((ROOT / "tools" / "constants.md").read_text())
        print(
            "| constant | value | tried | work | error that changes most |\n|---|---|---|---|---|"
        )
        for file, name, values in SCAN:
            path = copy / SOURCE / file
            text = path.read_text()
            found = value_of(text, name)
            for value in values:
                path.write_text(text[: found.start(1)] + value + text[found.end(1) :])
                work, error = compared(base, solved(copy, folder))
                print(f"| `{file}` {name} | {found[1]} | {value} | {work} | {error} |", flush=True)
            path.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
