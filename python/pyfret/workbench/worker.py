"""A run in the background: reads its order from a folder, writes progress and result there."""

from __future__ import annotations

import json
import sys
import warnings
from pathlib import Path
from typing import Any

from pyfret._core import Scene
from pyfret._util.progress import Progress
from pyfret._util.scene_warnings import SceneWarning
from pyfret.workbench.answers import REFUSALS
from pyfret.workbench.runs import run_fit, run_study, run_wear

__all__ = ["main"]

#: The runs by their kinds.
RUNS = {"wear": run_wear, "study": run_study, "fit": run_fit}


def main(folder: Path) -> None:
    """Do what the order in a folder asks for."""
    order = json.loads((folder / "order.json").read_text(encoding="utf-8"))

    def report(done: int, total: int) -> None:
        """Note the progress."""
        replace(folder / "progress.json", [done, total])

    if order["kind"] != "fit":
        # A fit is many runs, none of which shows how far it is.
        Progress.observer = staticmethod(report)
    report(0, 0)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SceneWarning)
            scene = Scene.from_toml(order["scene"])
            outcome: dict[str, Any] = RUNS[order["kind"]](scene, order, folder)
    except (*REFUSALS, TypeError, ImportError) as error:
        outcome = {"refused": str(error)}
    replace(folder / "result.json", outcome)


def replace(path: Path, content: Any) -> None:
    """Write a file of JSON at once, so that no reader sees half of it."""
    unfinished = path.with_suffix(".part")
    unfinished.write_text(json.dumps(content), encoding="utf-8")
    unfinished.replace(path)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
