"""Citations for a result: pyfret, and the sources of the methods used."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from pyfret._core import Scene, __version__
from pyfret.quantities import quantities

if TYPE_CHECKING:
    from pyfret.run import Run

__all__ = ["Source", "cite", "sources"]


class Source(NamedTuple):
    """A publication and what it is cited for."""

    #: What of the result rests on it.
    what: str
    #: Authors, title, journal, year.
    text: str
    #: Digital object identifier.
    doi: str


#: The method of the whole.
METHOD = Source(
    "method",
    "S. Spinu, Numerical Study on the Influence of the Coating in the Fretting Contact, "
    "Tribology in Industry 42 (2020) 131-145",
    "10.24874/ti.2020.42.01.13",
)
#: The contact solver and the convolution.
SOLVERS = (
    Source(
        "contact solver",
        "I. A. Polonsky, L. M. Keer, A Numerical Method for Solving Rough Contact Problems Based "
        "on the Multi-Level Multi-Summation and Conjugate Gradient Techniques, Wear 231 (1999) "
        "206-219",
        "10.1016/S0043-1648(99)00113-1",
    ),
    Source(
        "convolution",
        "S. Liu, Q. Wang, G. Liu, A Versatile Method of Discrete Convolution and FFT (DC-FFT) for "
        "Contact Analyses, Wear 243 (2000) 101-111",
        "10.1016/S0043-1648(00)00427-0",
    ),
)
#: Response of layered bodies.
LAYERS = Source(
    "response of coated bodies",
    "T. C. O'Sullivan, R. B. King, Sliding Contact Stress Field Due to a Spherical Indenter on a "
    "Layered Elastic Half-Space, Journal of Tribology 110 (1988) 235-240",
    "10.1115/1.3261591",
)


def sources(of: Run | Scene | None = None) -> list[Source]:
    """The sources of the methods that a result or a scene takes; of all if none is given."""
    scene = of if isinstance(of, Scene) or of is None else of.scene
    layered = scene is None or bool(scene.body1.coatings or scene.body2.coatings)
    return [METHOD, *SOLVERS, *([LAYERS] if layered else [])]


@quantities
def cite(of: Run | Scene | None = None) -> str:
    """Say what to cite: pyfret with its version, and a line for each source.

    Parameters
    ----------
    of : Result or Scene, optional
        What is published; sources that it does not rest on are left out.

    Examples
    --------
    >>> print(cite())  # doctest: +ELLIPSIS
    pyfret ...
    """
    lines = [f"pyfret {__version__}: fretting contact of coated elastic bodies"]
    lines += [f"{s.what}: {s.text}, https://doi.org/{s.doi}" for s in sources(of)]
    return "\n".join(lines)
