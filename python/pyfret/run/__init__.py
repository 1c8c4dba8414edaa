"""A run as it was solved: its numbers and fields, the datum that all the rest takes.

``attributes`` is what a run and each of its increments know of their scene, ``state`` the contact
at the end of one increment, ``run`` all increments; ``loops``, ``summary`` and ``tables`` say what
they came to.
"""

from pyfret.run.run import Run
from pyfret.run.state import State

__all__ = ["Run", "State"]
