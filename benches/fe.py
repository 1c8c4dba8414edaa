"""The coated fretting line contact by CalculiX and by pyfret: error against time and memory.

Runs that the kept table has are not repeated without ``--again``. Needs ``ccx`` (Debian package
calculix-ccx) for the others. ::

    python benches/fe.py --document docs/validation
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import Any

from environment import BENCHES, ROOT

sys.path.insert(0, str(ROOT))

from validation import coated_line
from validation.calculix import Model, run, to_row

#: Runs of CalculiX: meshes, increments of the pressing and of the branches, stiffness of the stick.
MODELS = (
    Model(cells=5, press=8),
    Model(cells=10, press=8),
    Model(cells=10, press=32),
    Model(cells=10, press=8, stick=1e7),
    Model(cells=10, press=8, stick=2.5e8),
    Model(cells=10, press=8, branch=48),
    Model(cells=20, press=32),
    Model(cells=20, press=32, stick=2.5e8),
    Model(ratio=1.0, cells=10, press=8),
    Model(ratio=1.0, cells=10, press=8, stick=2.5e8),
)
#: Runs of pyfret: ratio, cells, increments of the pressing and of the first branch.
OURS = (
    (2.0, 16, "auto", "auto"),
    (2.0, 32, "auto", "auto"),
    (2.0, 64, "auto", "auto"),
    (2.0, 128, "auto", "auto"),
    (2.0, 256, "auto", "auto"),
    (2.0, 512, "auto", "auto"),
    (2.0, 128, 8, 12),
    (2.0, 128, 32, 12),
    (2.0, 128, 512, 12),
    (1.0, 32, "auto", "auto"),
    (1.0, 128, "auto", "auto"),
)


def run_ours(ratio: float, cells: int, press: int | str, branch: int | str) -> dict[str, Any]:
    """Run pyfret in a process of its own."""
    numbers = {"ratio": ratio, "cells": cells, "press": press, "branch": branch}
    words = [word for key, value in numbers.items() for word in (f"--{key}", str(value))]
    command = [sys.executable, str(BENCHES / "run_line.py"), *words]
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    row: dict[str, Any] = json.loads(done.stdout)
    return row


def main() -> None:
    """Run what is missing, keep it, and write the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--again", action="store_true", help="repeat the runs that are kept, too")
    parser.add_argument("--document", type=Path, help="folder of the page")
    options = parser.parse_args()
    file = coated_line.KEPT
    kept: dict[str, list[dict[str, Any]]] = {"elements": [], "ours": []}
    if file.exists() and not options.again:
        kept = json.loads(file.read_text())
    done = [{key: row[key] for key in asdict(MODELS[0])} for row in kept["elements"]]
    kept["ours"] = [run_ours(*numbers) for numbers in OURS]
    for model in MODELS:
        if asdict(model) in done:
            continue
        if shutil.which("ccx") is None:
            print(f"no ccx (CalculiX) here: {model} is left out")
            continue
        with tempfile.TemporaryDirectory() as folder:
            kept["elements"].append(to_row(model, run(model, Path(folder))))
        print(model, f"{kept['elements'][-1]['seconds']:.1f} s", flush=True)
        file.write_text(json.dumps(kept) + "\n")
    file.write_text(json.dumps(kept) + "\n")
    if options.document:
        print(coated_line.write(options.document))


if __name__ == "__main__":
    main()
