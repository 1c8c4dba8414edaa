"""Studies: the same contact for many values of its parameters.

``design`` says which points, ``measures`` what is kept of each result, ``point`` solves one,
``workers`` shares them out, ``store`` writes them down, ``running`` is the loop over all.
"""

from pyfret.studies.design import varied
from pyfret.studies.measures import MEASURES, Cracking, Wear
from pyfret.studies.outcome import Study, open_study
from pyfret.studies.running import study

__all__ = ["MEASURES", "Cracking", "Study", "Wear", "open_study", "study", "varied"]
