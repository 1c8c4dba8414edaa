"""One file per kind of contact; each lists its pages."""

from validation.truth import Truth
from validation.truths import bodies, coatings, indentation, lines, sliding, stresses

#: All pages, in the order of the book.
TRUTHS: tuple[Truth, ...] = (
    *bodies.PAGES,
    *sliding.PAGES,
    *indentation.PAGES,
    *coatings.PAGES,
    *lines.PAGES,
    *stresses.PAGES,
)
