"""Orders of background runs: the fields of the page as what the worker reads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret.workbench.events import Context, Event, number_of
from pyfret.workbench.fields import find_field
from pyfret.workbench.uploads import dropped_path

if TYPE_CHECKING:
    from pyfret.workbench.jobs import Job

__all__ = ["ORDERS", "start_run"]

#: Most values of a study.
MOST_VALUES = 60


def request_wear(context: Context, values: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """Return title and settings of the run of wear in the form."""
    order = {
        "body": 1 if values.get("wear-body") == "1" else 2,
        "alpha": positive(values, "wear-alpha", "wear coefficient"),
        "cycles": positive(values, "wear-cycles", "cycles"),
    }
    return f"Wear after {order['cycles']:.4g} cycles", order


def request_study(context: Context, values: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """Return title and settings of the study of one result over one field of the form."""
    field = find_field(context.scene, str(values.get("study-key")))
    if field is None:
        raise ValueError("the field of the study is not in this scene: choose it again")
    low, high = number_of(values.get("study-low")), number_of(values.get("study-high"))
    count = round(number_of(values.get("study-count")))
    if not 2 <= count <= MOST_VALUES:
        raise ValueError(f"number of values = {count}: must be 2 to {MOST_VALUES}")
    label = f"{field.label} [{field.unit}]" if field.unit else field.label
    order = {
        "key": field.key,
        "values": [float(f"{v * field.scale:.12g}") for v in np.linspace(low, high, count)],
        "measure": str(values.get("study-measure")),
        "scale": field.scale,
        "label": label,
    }
    return f"{values.get('study-measure')}".replace("_", " ") + f" over {field.label}", order


def order_fit(context: Context, values: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """Order a fit to the dropped loop and the dropped scar, and a prediction."""
    order: dict[str, Any] = {"body": 1 if values.get("fit-body") == "1" else 2}
    for role in ("loop", "scar"):
        chosen = [k for k, v in values.items() if k.startswith("role-") and v == role]
        if len(chosen) > 1:
            raise ValueError(f"{len(chosen)} files are a {role}: choose one")
        if chosen:
            drop = chosen[0].removeprefix("role-")
            name = str(values["drops"][drop])
            order[role] = str(dropped_path(context.sessions, context.session, drop, name))
    if "loop" not in order and "scar" not in order:
        raise ValueError("drop a measured loop or the profile of a scar first")
    order["rig"] = values.get("fit-rig") == "yes"
    if "scar" in order:
        order["cycles"] = positive(values, "fit-cycles", "cycles of the scar")
        if str(values.get("fit-predict", "")).strip():
            order["predict"] = positive(values, "fit-predict", "cycles of the prediction")
    return "Fit to " + " and ".join(role for role in ("loop", "scar") if role in order), order


def positive(values: dict[str, Any], key: str, name: str) -> float:
    """Return a positive number of the page."""
    value = number_of(values.get(key))
    if not value > 0.0:
        raise ValueError(f"{name} = {value:g}: must be positive")
    return value


#: Background runs by the event that starts them.
ORDERS = {"wear": request_wear, "study": request_study, "fit": order_fit}


def start_run(context: Context, event: Event) -> Job:
    """Start the background run that an event asks for."""
    title, order = ORDERS[event["event"]](context, event.get("values", {}))
    order |= {"kind": event["event"], "scene": context.scene.to_toml()}
    return context.jobs.start(context.session, title, order)
