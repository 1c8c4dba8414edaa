"""Load histories that are measured, counted or given as a spectrum.

The history of a contact's loads is read once, counted by rainflow, and solved, worn or judged::

    history = fret.LoadHistory.from_csv("rig.tdms")
    history.count().dataset
    fret.wear.solve(scene, history=history, body2=fret.wear.Archard(k=1e-15), cycles=100)
"""

from pyfret._util.names import listing
from pyfret.history.counting import rainflow
from pyfret.history.load_history import LoadHistory
from pyfret.history.loops import CountedLoops
from pyfret.history.scene_file import read_history
from pyfret.history.spectrum import Spectrum

__all__ = ["CountedLoops", "LoadHistory", "Spectrum", "rainflow", "read_history"]
__dir__ = listing(__all__)
