"""Marches of a table: in memory, or in a folder of stores that a later call goes on with."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from pyfret import _core
from pyfret._core import StoreError
from pyfret._util.concurrently import run_concurrently
from pyfret._util.progress import Progress
from pyfret.run.dataset import dataset
from pyfret.run.opening import open_dataset
from pyfret.run.run import Run

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Mapping

    from pyfret._core import Scene

__all__ = ["Marches"]


class Marches:
    """Runs of scenes by their names.

    Parameters
    ----------
    store : path, optional
        Folder of the stores; it is made. A run that is there is opened, and one that ended early
        goes on to the same bits.
    progress : bool
        Whether to draw a progress bar.
    """

    def __init__(self, store: str | os.PathLike[str] | None = None, *, progress: bool) -> None:
        self.folder = None if store is None else Path(store)
        self.progress = progress
        self.made: dict[str, Run] = {}

    def run(self, scene: Scene, name: str) -> Run:
        """March through the path of a scene, or open its run."""
        return self.run_all({name: scene})[name]

    def run_all(self, scenes: Mapping[str, Scene]) -> dict[str, Run]:
        """March through the paths of scenes at the same time; runs that were made are kept."""
        new = {name: scene for name, scene in scenes.items() if name not in self.made}
        if new:
            works = {name: partial(self._march, scene, name) for name, scene in new.items()}
            title = next(iter(new.values())).title or next(iter(new))
            with Progress(title=title, shown=self.progress) as bar:
                self.made.update(run_concurrently(works, bar))
        return {name: self.made[name] for name in scenes}

    def _march(self, scene: Scene, name: str, count: Callable[[int, int], None]) -> Run:
        """March through the path of a scene, or open its run; `count` gets its increments."""
        if self.folder is None:
            return Run(dataset(*_core.solve_in_memory(scene, on_increment=count)))
        path = self.folder / f"{name}.zarr"
        self._claim(scene, name)
        try:
            if path.exists():
                _core.resume(path, on_increment=count)
                return Run(open_dataset(path))
        except StoreError:
            # The run ended before its first checkpoint.
            pass
        _core.solve(scene, store=path, overwrite=True, on_increment=count)
        return Run(open_dataset(path))

    def _claim(self, scene: Scene, name: str) -> None:
        """Write the scene of a run beside its store, or refuse a folder with another one."""
        assert self.folder is not None
        self.folder.mkdir(parents=True, exist_ok=True)
        described, text = self.folder / f"{name}.toml", scene.to_toml()
        if not described.exists():
            described.write_text(text, encoding="utf-8")
        elif described.read_text(encoding="utf-8") != text:
            raise ValueError(
                f"store = {self.folder}: holds the table of another scene or history: must be a "
                "new folder, or the one of this history"
            )
