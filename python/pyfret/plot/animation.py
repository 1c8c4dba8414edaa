"""A load path in motion."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np

from pyfret._util.arrays import plain
from pyfret.plot.histories import fretting_loop, loop_point
from pyfret.plot.maps import shear_streamlines, stick_slip
from pyfret.plot.style import styled

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    from matplotlib.axes import Axes

    from pyfret.run import Run


#: Width and height of a frame [inch]: letters of 12 pixels in a page of 740.
FRAME = (7.4, 2.8)


def common_limits(
    snapshots: Sequence[Any], draw: Callable[..., Any], ax: Axes
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the limits of axes that show a map of all increments."""
    limits = []
    for at in (snapshots[0], snapshots[len(snapshots) // 2], snapshots[-1]):
        ax.clear()
        draw(at, ax=ax)
        limits.append((*ax.get_xlim(), *ax.get_ylim()))
    low, high = np.min(limits, axis=0), np.max(limits, axis=0)
    return (float(low[0]), float(high[1])), (float(low[2]), float(high[3]))


@styled
def animate(
    result: Run,
    path: str | os.PathLike[str],
    *,
    increments: Sequence[int] | None = None,
    fps: int = 12,
    dpi: int = 150,
) -> None:
    """Write the loop, the stick and slip zones and the shear of a path as a film.

    A frame is an increment that kept its fields: solve with ``save="all"`` for all of them. Axes
    and scales of colours are the same in all frames, and each frame has its time.

    Parameters
    ----------
    result : Result
        The run.
    path : path
        File to write: ``.gif``, or ``.mp4``, which needs the program ffmpeg or the package
        imageio-ffmpeg.
    increments : sequence of int, optional
        Increments to show, from 1 (default: all that kept their fields).
    fps : int
        Frames per second.
    dpi : int
        Pixels per inch; a frame is 7.4 by 2.8 inches.

    Raises
    ------
    ValueError
        The ending of the file is another, or fewer than two increments kept their fields.
    """
    # Loaded for films alone: figures do not need them.
    from matplotlib.animation import FuncAnimation

    from pyfret.plot.film_writers import OPTIONS, WRITERS, find_ffmpeg

    target = Path(path)
    if target.suffix not in WRITERS:
        raise ValueError(f"{target}: must end in {' or '.join(WRITERS)}")
    ffmpeg = find_ffmpeg()
    if target.suffix == ".mp4" and ffmpeg is None:
        raise ValueError(
            f"{target}: films as .mp4 need the program ffmpeg or the package imageio-ffmpeg "
            '(pip install "fretting[film]"); .gif needs none'
        )
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
    figure, row = plt.subplots(1, 3, figsize=FRAME, layout="constrained")
    fretting_loop(result, ax=row[0], color="0.75")
    (dot,) = row[0].plot([], [], "o", color="C1", markersize=7)
    maps: list[Callable[..., Any]] = [
        stick_slip,
        partial(shear_streamlines, largest=largest / mu_p, colorbar=False),
    ]
    limits = [
        common_limits(snapshots, draw_map, ax) for draw_map, ax in zip(maps, row[1:], strict=True)
    ]

    def draw(n: int) -> Any:
        """Draw the n-th frame."""
        at = snapshots[n]
        dot.set_data(*loop_point(result, at))
        for ax in row[1:]:
            ax.clear()
        stick_slip(at, ax=row[1])
        shear_streamlines(at, ax=row[2], largest=largest / mu_p)
        for ax, (across, up) in zip(row[1:], limits, strict=True):
            ax.set_xlim(across)
            ax.set_ylim(up)
        time = f"increment {int(at.increment)}, t = {float(at.dataset.t):.4g}"
        row[0].set_title(time)
        return (dot,)

    film = FuncAnimation(figure, draw, frames=len(snapshots), blit=False)
    with mpl.rc_context({"animation.ffmpeg_path": ffmpeg or "ffmpeg"}):
        film.save(target, writer=WRITERS[target.suffix](fps=fps, **OPTIONS[target.suffix]), dpi=dpi)
    plt.close(figure)
