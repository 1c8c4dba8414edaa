"""Results for people without pyfret: one page for a browser.

``content`` collects the numbers of the figures, ``page`` puts all into one file; ``page.html``,
``page.css`` and ``page.js`` are its looks.
"""

from pyfret._util.names import listing
from pyfret.report.page import write_page

__all__ = ["write_page"]
__dir__ = listing(__all__)
