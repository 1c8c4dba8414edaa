"""Figures of fretting contacts.

Every function draws on the axes given as ``ax`` (by default a new figure) and returns them, so that
results can be laid over each other and figures composed. A figure of several panels returns the
whole figure. ``.figure.savefig("name.png")`` writes either. A figure of a result is also a method
of it: ``result.plot.fretting_loop()``. :func:`paper_figures` makes the figures of the paper from
its four runs in one call.
"""

from typing import TYPE_CHECKING, Any

from pyfret._util.extras import application
from pyfret._util.modules import enter_public_module, name_hint
from pyfret._util.names import listing
from pyfret.plot.animation import animate
from pyfret.plot.comparison import comparison
from pyfret.plot.crack_section import crack_panels, crack_path
from pyfret.plot.cracks import crack_arrest, intensity, intensity_history, kitagawa
from pyfret.plot.critical_planes import critical_plane_rose, dang_van_diagram, haigh_diagram
from pyfret.plot.design_chart import design_chart
from pyfret.plot.fretting_map import arrest_map, fretting_map, running_map
from pyfret.plot.heat import temperature, temperature_map
from pyfret.plot.histories import fretting_loop, load_path, loop_evolution, stick_ratio
from pyfret.plot.life import criterion_map, life_over_distance, load_factor_map
from pyfret.plot.loads import (
    damage_contributions,
    damage_map,
    load_history,
    loop_histogram,
)
from pyfret.plot.maps import pressure_map, shear_streamlines, slip_map, stick_slip
from pyfret.plot.overview import overview
from pyfret.plot.profiles import pressure_profile, shear_profile, shear_profiles
from pyfret.plot.rough import (
    area_over_load,
    gap_map,
    pressure_histogram,
    spots,
    surface_heights,
)
from pyfret.plot.stresses import (
    envelope_maps,
    section_map,
    stress_along_depth,
    stress_history,
    stress_map,
    stress_maps,
)
from pyfret.plot.studies import study_map
from pyfret.plot.study_lines import study_line
from pyfret.plot.style import style
from pyfret.plot.wear import depth_map, third_body, wear_history, wear_loops, wear_profiles
from pyfret.plot.yielding import plastic_zone, residual_stress

__all__ = [
    "animate",
    "area_over_load",
    "arrest_map",
    "comparison",
    "crack_arrest",
    "crack_panels",
    "crack_path",
    "criterion_map",
    "critical_plane_rose",
    "damage_contributions",
    "damage_map",
    "dang_van_diagram",
    "depth_map",
    "design_chart",
    "envelope_maps",
    "fretting_loop",
    "fretting_map",
    "gap_map",
    "haigh_diagram",
    "intensity",
    "intensity_history",
    "kitagawa",
    "life_over_distance",
    "load_factor_map",
    "load_history",
    "load_path",
    "loop_evolution",
    "loop_histogram",
    "overview",
    "paper_figures",
    "plastic_zone",
    "pressure_histogram",
    "pressure_map",
    "pressure_profile",
    "residual_stress",
    "running_map",
    "section_map",
    "shear_profile",
    "shear_profiles",
    "shear_streamlines",
    "slip_map",
    "spots",
    "stick_ratio",
    "stick_slip",
    "stress_along_depth",
    "stress_history",
    "stress_map",
    "stress_maps",
    "study_line",
    "study_map",
    "style",
    "surface_heights",
    "temperature",
    "temperature_map",
    "third_body",
    "wear_history",
    "wear_loops",
    "wear_profiles",
]
__dir__ = listing(__all__)
enter_public_module(__name__)

if TYPE_CHECKING:
    from pyfret.plot import paper as paper
    from pyfret.plot.paper import paper_figures as paper_figures


def __getattr__(name: str) -> Any:
    """Import the figures of the paper at their first use."""
    if name not in ("paper", "paper_figures"):
        raise AttributeError(
            f"module 'pyfret.plot' has no {name!r}{name_hint(name, __all__, 'plot')}"
        )
    paper_module = application("pyfret.plot.paper")
    return paper_module if name == "paper" else paper_module.paper_figures
