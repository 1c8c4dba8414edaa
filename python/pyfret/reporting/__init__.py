"""Results for people without pyfret: one page for a browser, tables for notebooks.

``tables`` puts scenes, paths and results into tables, ``content`` collects the numbers of the
figures, ``page`` puts all into one file; ``page.html``, ``page.css`` and ``page.js`` are its looks.
"""

from pyfret.reporting.page import report

__all__ = ["report"]
