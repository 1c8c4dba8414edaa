"""Measures that kill their process; what a process of a study imports for them is little."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    import pyfret as fret

#: Friction of the point whose process is killed.
DEADLY = 0.3


def dies_once(flag: Path, result: fret.Result) -> float:
    """Kill the process that measures the deadly point for the first time."""
    if result.mu == DEADLY and not flag.exists():
        flag.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return float(result.dataset.p_max.max())


def dies(result: fret.Result) -> float:
    """Kill the process that measures the deadly point."""
    if result.mu == DEADLY:
        os.kill(os.getpid(), signal.SIGKILL)
    return float(result.dataset.p_max.max())
