"""Studies: the same contact for many values of its parameters.

``design`` makes the points, ``measures`` the numbers that are kept of each result. ``point`` solves
one, ``workers`` shares them out, ``store`` writes them down, ``loop`` goes over all. ``loads`` is
the study of the load path for a map of running conditions. ::

    found = fret.study.run("scene.toml", {"friction.mu": [0.3, 0.5]}, measure="loop_energy")
    found.map()
"""

from __future__ import annotations

from pyfret._util.modules import enter_public_module
from pyfret._util.names import listing
from pyfret.study.answers import answers
from pyfret.study.candidate import Candidate
from pyfret.study.compare import compare
from pyfret.study.comparison import Comparison
from pyfret.study.loads import arrest_map, running_conditions
from pyfret.study.loop import run
from pyfret.study.measures import MEASURES, Arrest, Cracking, FirstToFail, WornDepth
from pyfret.study.outcome import Study
from pyfret.study.stresses import LargestStress
from pyfret.study.thresholds import Averaged, Limits, ThresholdLoad, fit_limits, threshold

__all__ = [
    "MEASURES",
    "Arrest",
    "Averaged",
    "Candidate",
    "Comparison",
    "Cracking",
    "FirstToFail",
    "LargestStress",
    "Limits",
    "Study",
    "ThresholdLoad",
    "WornDepth",
    "answers",
    "arrest_map",
    "compare",
    "fit_limits",
    "run",
    "running_conditions",
    "threshold",
]
__dir__ = listing(__all__)

enter_public_module(__name__)
