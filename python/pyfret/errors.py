"""Errors by area, and warnings of doubtful input.

===========  ===========================  ==============================================
area         error                        what is wrong
===========  ===========================  ==============================================
scene        :class:`InvalidSceneError`   the scene or its file; :class:`OffGridError`, a
                                          grid that is too small for it
solve        :class:`SolveError`          a scene that could not be solved:
                                          :class:`NoConvergenceError`,
                                          :class:`SlidingError`,
                                          :class:`KernelInaccurateError`
store        :class:`StoreError`          a file or a store
argument     :class:`ArgumentError`       what a function of ``fatigue``, ``wear``,
                                          ``subsurface``, ``heat``, ``kernels`` or
                                          ``reference`` was given
===========  ===========================  ==============================================

Errors of scenes and arguments are :class:`ValueError`, errors of stores :class:`OSError`.
"""

from pyfret._core import (
    ArgumentError,
    InvalidSceneError,
    KernelInaccurateError,
    NoConvergenceError,
    OffGridError,
    SlidingError,
    SolveError,
    StoreError,
)
from pyfret._util.names import listing
from pyfret._util.scene_warnings import SceneWarning

__all__ = [
    "ArgumentError",
    "InvalidSceneError",
    "KernelInaccurateError",
    "NoConvergenceError",
    "OffGridError",
    "SceneWarning",
    "SlidingError",
    "SolveError",
    "StoreError",
]
__dir__ = listing(__all__)
