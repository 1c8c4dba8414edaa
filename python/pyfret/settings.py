"""How a scene is solved: the numerical methods, and what may be left out."""

from pyfret._core import FrequencyDomain, Hankel, InverseFft, Preset, Settings, Skip
from pyfret._util.names import listing

__all__ = ["FrequencyDomain", "Hankel", "InverseFft", "Preset", "Settings", "Skip"]
__dir__ = listing(__all__)
