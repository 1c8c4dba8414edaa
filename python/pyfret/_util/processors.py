"""Number of processors that this process may use."""

from __future__ import annotations

import os

__all__ = ["count_processors", "count_threads"]


def count_processors() -> int:
    """Count the processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def count_threads() -> int:
    """Count the threads of a run: ``RAYON_NUM_THREADS``, or one for each processor."""
    text = os.environ.get("RAYON_NUM_THREADS", "")
    return int(text) if text.isdigit() and int(text) > 0 else count_processors()
