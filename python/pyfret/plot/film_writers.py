"""Writers of films."""

from __future__ import annotations

import shutil
from importlib import import_module
from typing import Any

import matplotlib as mpl
from matplotlib.animation import FFMpegWriter, PillowWriter
from PIL import Image


class OnePalette(PillowWriter):
    """A writer of GIF files whose frames share the colours of all of them."""

    def finish(self) -> None:
        """Reduce the colours of all frames together, and write the file."""
        frames = [frame.convert("RGB") for frame in self._frames]  # type: ignore[has-type]
        step = max(len(frames) // SAMPLES, 1)
        sampled = frames[::step]
        width, height = sampled[0].size
        sheet = Image.new("RGB", (width, height * len(sampled)))
        for n, frame in enumerate(sampled):
            sheet.paste(frame, (0, n * height))
        palette = sheet.quantize(256)
        self._frames = [
            frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames
        ]
        super().finish()


#: Frames that the colours of a film are taken from.
SAMPLES = 4
#: Writers of files, by their endings.
WRITERS = {".mp4": FFMpegWriter, ".gif": OnePalette}
#: Options of the writers, by their endings; the colours of the theme are kept.
OPTIONS: dict[str, dict[str, Any]] = {".mp4": {"extra_args": ["-crf", "14"]}, ".gif": {}}


def find_ffmpeg() -> str | None:
    """Return the program ffmpeg: on the path, else in the package imageio-ffmpeg."""
    program = shutil.which(mpl.rcParams["animation.ffmpeg_path"])
    if program is not None:
        return str(program)
    try:
        return str(import_module("imageio_ffmpeg").get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        return None
