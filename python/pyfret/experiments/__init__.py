"""Published fretting tests: scene, path and data of each as one call.

To be repeated and varied::

    test = fret.experiments.fouvry2017("RP_f_20")
    worn = test.wear(tolerance=0.005)
    test.row["worn_volume_m3"], float(worn.volume1[-1] + worn.volume2[-1])

Numbers are facts of the cited papers. They were typed from tables or read off figures by others and
converted to SI units. ``remarks`` name misprints and derived numbers. None of the papers was read
in full.
"""

from pyfret._util.names import listing
from pyfret.experiments.sets import (
    NAMES,
    Experiment,
    arnaud2021,
    baydoun2019,
    fouvry2007,
    fouvry2017,
    icf13,
    table,
    vanpeteghem2011,
)

__all__ = [
    "NAMES",
    "Experiment",
    "arnaud2021",
    "baydoun2019",
    "fouvry2007",
    "fouvry2017",
    "icf13",
    "table",
    "vanpeteghem2011",
]
__dir__ = listing(__all__)
