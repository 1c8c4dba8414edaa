"""What goes wrong, by area: errors, and warnings of what is hardly meant."""

from pyfret._core import (
    InvalidSceneError,
    KernelInaccurateError,
    NoConvergenceError,
    OffGridError,
    SlidingError,
    StoreError,
)
from pyfret._util.names import listing
from pyfret.scene.warnings import SceneWarning

__all__ = [
    "InvalidSceneError",
    "KernelInaccurateError",
    "NoConvergenceError",
    "OffGridError",
    "SceneWarning",
    "SlidingError",
    "StoreError",
]
__dir__ = listing(__all__)
