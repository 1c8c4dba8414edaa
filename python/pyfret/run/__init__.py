"""A run as it was solved: its numbers and fields, the datum that all the rest takes.

``attributes``: numbers of the scene that a run and its increments share. ``state``: the contact at
the end of one increment. ``run``: all increments. ``loops``, ``summary`` and ``tables``: the
outcome as numbers and text.
"""

from pyfret.run.run import Run
from pyfret.run.state import State

__all__ = ["Run", "State"]
