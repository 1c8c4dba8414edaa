"""A load path in motion."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FFMpegWriter, FuncAnimation, PillowWriter

from pyfret._util.arrays import plain
from pyfret.plot.histories import fretting_loop, loop_point
from pyfret.plot.maps import shear_streamlines, stick_slip
from pyfret.plot.style import styled

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from pyfret.run import Run

#: What a file is written with, by its ending.
WRITERS = {".mp4": FFMpegWriter, ".gif": PillowWriter}


@styled
def animate(
    result: Run,
    path: str | os.PathLike[str],
    *,
    increments: Sequence[int] | None = None,
    fps: int = 12,
    dpi: int = 100,
) -> None:
    """Write the loop, the stick and slip zones and the shear of a path as a film.

    A frame is an increment that kept its fields: solve with ``save="all"`` for all of them.

    Parameters
    ----------
    result : Result
        The run.
    path : path
        File to write: ``.gif``, or ``.mp4``, which needs the program ffmpeg.
    increments : sequence of int, optional
        Increments to show, from 1 (default: all that kept their fields).
    fps : int
        Frames per second.
    dpi : int
        Pixels per inch; a frame is 11 by 3.6 inches.

    Raises
    ------
    ValueError
        The ending of the file is another, or fewer than two increments kept their fields.
    """
    target = Path(path)
    if target.suffix not in WRITERS:
        raise ValueError(f"{target}: must end in {' or '.join(WRITERS)}")
    if target.suffix == ".mp4" and not FFMpegWriter.isAvailable():
        raise ValueError(f"{target}: films as .mp4 need the program ffmpeg; .gif needs none")
    kept = result.dataset.saved_increment.values
    if increments is not None:
        kept = plain(increments, "increments").astype(np.int64)
    if kept.size < 2:
        raise ValueError(
            f"{kept.size} increment kept its fields: a film needs more, solve(..., save='all')"
        )
    snapshots = [result.at(int(n)) for n in kept]
    largest = max(float(np.hypot(at.q_x.values, at.q_y.values).max()) for at in snapshots)
    mu_p = result.mu * result.p_H if "p_H" in result.dataset.attrs else 1e6
    figure, row = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
    fretting_loop(result, ax=row[0], color="0.75")
    (dot,) = row[0].plot([], [], "o", color="C1", markersize=7)
    shear_streamlines(snapshots[-1], ax=row[2], largest=largest / mu_p)
    bar = figure.axes[-1]

    def draw(n: int) -> Any:
        at = snapshots[n]
        dot.set_data(*loop_point(result, at))
        for ax, plot in ((row[1], stick_slip), (row[2], None)):
            ax.clear()
            if plot is not None:
                plot(at, ax=ax)
            else:
                shear_streamlines(at, ax=ax, largest=largest / mu_p, colorbar=False)
        row[0].set_title(f"increment {int(at.increment)}")
        return (dot, bar)

    film = FuncAnimation(figure, draw, frames=len(snapshots), blit=False)
    film.save(target, writer=WRITERS[target.suffix](fps=fps), dpi=dpi)
    plt.close(figure)
