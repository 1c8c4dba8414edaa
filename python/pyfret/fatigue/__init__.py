"""Assessment of stress histories: crack initiation, first yield and shakedown.

Histories are arrays of shape (time, ..., 6), Voigt order xx, yy, zz, xy, xz, yz, tension positive,
in Pa. No contact is needed; ``docs/fatigue.md`` has the equations and their sources. ::

    from pyfret import fatigue

    steel = fatigue.Materials()["steel_42CrMo4"]
    found = fatigue.evaluate_margin(stress, steel, "dang_van")
    found.safety_factor.min()
"""

from pyfret._util.names import listing
from pyfret.fatigue.averages import average, critical_distance
from pyfret.fatigue.criteria import (
    COMPONENTS,
    CRITERIA,
    Assessment,
    Criterion,
    Material,
    Materials,
    dang_van_path,
    evaluate_criterion,
    evaluate_margin,
    first_yield,
    mean_stress_slope,
    moving_load,
    to_pylife,
)
from pyfret.fatigue.cycles import cycle_increments, history
from pyfret.fatigue.damage import Damage, add_damages, damage
from pyfret.fatigue.damage_law import DamageLaw, damage_of_loops, equivalent_amplitude
from pyfret.fatigue.distance import OverDistance
from pyfret.fatigue.factors import LoadFactors, load_factors
from pyfret.fatigue.frictional_work import ruiz
from pyfret.fatigue.lives import Life, life, lives
from pyfret.fatigue.ranges import LifeRange, Range
from pyfret.fatigue.response import CyclicResponse, cyclic_response
from pyfret.fatigue.section import Section
from pyfret.history.counting import rainflow

__all__ = [
    "COMPONENTS",
    "CRITERIA",
    "Assessment",
    "Criterion",
    "CyclicResponse",
    "Damage",
    "DamageLaw",
    "Life",
    "LifeRange",
    "LoadFactors",
    "Material",
    "Materials",
    "OverDistance",
    "Range",
    "Section",
    "add_damages",
    "average",
    "critical_distance",
    "cycle_increments",
    "cyclic_response",
    "damage",
    "damage_of_loops",
    "dang_van_path",
    "equivalent_amplitude",
    "evaluate_criterion",
    "evaluate_margin",
    "first_yield",
    "history",
    "life",
    "lives",
    "load_factors",
    "mean_stress_slope",
    "moving_load",
    "rainflow",
    "ruiz",
    "to_pylife",
]
__dir__ = listing(__all__)
