"""Contacts of bodies that yield beside rows of truth: data/plastic/rows.json."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

import pyfret as fret

#: What the energy balance of a cycle is made of.
ENERGIES = ("delta_z", "plastic_work", "dissipated", "elastic")
#: States whose row has a residual stress in the substrate below the interface that contradicts
#: that in the film: nothing yields there, so that the strain is continuous, but 247 MPa in the
#: film (E/(1 - nu) = 560 GPa) go with 139 MPa in the substrate (300 GPa), and the row has 249 MPa.
#: The strain is compared.
CONTRADICTORY = {("hard_thin", 0)}
ROWS = Path(__file__).parent / "data" / "plastic" / "rows.json"


@cache
def rows(kind: str) -> dict[str, Any]:
    """Give the rows of a kind: normal, fretting or line."""
    return {row["name"]: row for row in json.loads(ROWS.read_text())[kind]}


def material(layer: dict[str, Any]) -> fret.Elastic:
    """Make a material, with its law where it yields."""
    law = None
    if "yield_stress" in layer:
        law = fret.Plastic(
            s_y=layer["yield_stress"],
            hardening=layer.get("hardening", 0.0),
            kinematic=layer.get("kinematic_hardening", 0.0),
        )
    return fret.Elastic(E=layer["E"], nu=layer["nu"], plastic=law)


def body(row: dict[str, Any]) -> fret.Body:
    """Make the body that yields."""
    coatings = [fret.Coating(material(c), thickness=c["thickness"]) for c in row["coatings"]]
    return fret.Body(material(row["substrate"]), coatings=coatings)


class Compared:
    """Differences from a row, over what is allowed: the bar plus the error of the row."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.found: list[tuple[str, float, float]] = []

    def see(self, what: str, value: float, truth: float, allowed: float) -> None:
        """Note a number."""
        self.found.append((what, value - truth, allowed))

    def table(
        self, what: str, values: list[float], of: dict[str, list[float]], allowed: float
    ) -> None:
        """Note numbers of a row; `allowed` without the errors of the row."""
        truth = zip(values, of["value"], of["error"], strict=True)
        for n, (value, expected, error) in enumerate(truth):
            self.see(f"{what}[{n}]", value, expected, allowed + error)

    def balance(self, what: str, of: dict[str, Any], W: float, cycle: slice) -> None:
        """Note the energy balance of a cycle under a constant W, beside 1 % of what is lost.

        Loop and W d(delta_z) are friction, plastic work and the growth of the elastic energy;
        the error of the residual stress settles with the cycles.
        """
        loop = float(np.trapezoid(of["T_x"][cycle], of["delta_x"][cycle]))
        inside = slice(cycle.start + 1, cycle.stop)
        friction, plastic, elastic = (
            float(np.sum(of[name][inside])) for name in ("dissipated", "plastic_work", "elastic")
        )
        given_values = loop + W * float(of["delta_z"][cycle.stop - 1] - of["delta_z"][cycle.start])
        self.see(what, given_values - elastic, friction + plastic, 0.01 * (friction + plastic))

    def misses(self) -> list[str]:
        """Give what is out of its bar."""
        return [
            f"{w}: off by {d:.3g}, allowed {a:.3g}" for w, d, a in self.found if not abs(d) <= a
        ]

    def __str__(self) -> str:
        """Give each difference over what is allowed."""
        return f"{self.name}: " + ", ".join(
            f"{w} {d / a if a else 0:+.2f}" for w, d, a in self.found
        )


def value_at_depth(of_axis: Any, z: float) -> float:
    """Give the value at a depth, from the planes of its layer."""
    return float(PchipInterpolator(of_axis.z.to_numpy(), of_axis.to_numpy())(z))


def value_at_interface(of_axis: Any, depth: float, layer: int) -> float:
    """Give the value at an interface, continued from the planes of a layer."""
    inside = of_axis.isel(z=np.flatnonzero(of_axis.layer.to_numpy() == layer))
    z, values = inside.z.to_numpy() - depth, inside.to_numpy()
    near = np.argsort(np.abs(z))[:3]
    return float(np.polyval(np.polyfit(z[near], values[near], len(near) - 1), 0.0))


def strain_along(row: dict[str, Any], stress: Any, layer: int) -> Any:
    """Give the elastic strain along the surface on the axis, of the planes of a layer."""
    inside = stress.isel(z=np.flatnonzero(stress.layer.to_numpy() == layer))
    item = [*row["coatings"], row["substrate"]][layer]
    xx, zz = (inside.sel(component=name) for name in ("xx", "zz"))
    return ((1 - item["nu"]) * xx - item["nu"] * zz) / item["E"]


def middle(field: Any) -> float:
    """Give an even field in the middle of its grid, between the cells."""
    m = field.shape[0] // 2
    rows_ = [1.125 * (f[m - 1] + f[m]) / 2 - 0.125 * (f[m - 2] + f[m + 1]) / 2 for f in field]
    return float(1.125 * (rows_[m - 1] + rows_[m]) / 2 - 0.125 * (rows_[m - 2] + rows_[m + 1]) / 2)


def followed(scene: fret.Scene, stops: list[int]) -> Iterator[tuple[Any, Any]]:
    """Give the increment and its plastic state where increments of the path end."""
    for n, increment in enumerate(fret.march(scene), 1):
        if n in stops:
            yield increment, increment.plastic()


def indented(
    row: dict[str, Any],
    number: int,
    *,
    n: int = 48,
    increments: int = 8,
    given: str = "approach",
    room: float = 1.3,
    **changes: Any,
) -> Compared:
    """Press to a state of a row and take the load off."""
    state = row["states"][number]
    load, approach = state["load"], state["approach"]
    path = fret.LoadPath.start()
    if given == "approach":
        path = path.displace(delta_z=approach, increments=increments)
    else:
        path = path.normal(load["value"], increments=increments)
    path = path.normal(1e-4 * load["value"], increments=4)
    scene = fret.Scene(
        body1=fret.Body(fret.RIGID, shape=fret.Sphere(R=row["indenter"]["R"])),
        body2=body(row),
        friction=0.0,
        grid=fret.Grid.centred(width=2 * room * state["contact_radius_between"][1], n=n),
        path=path,
        **changes,
    )
    compared = Compared(f"{row['name']} {approach:g} by {given}, {n} cells")
    (top, loaded), (_, unloaded) = followed(scene, [increments, increments + 4])
    if given == "approach":
        compared.see("load", float(top.W), load["value"], load["error"] + 5e-3 * load["value"])
    else:
        part = load["error"] / load["value"] + 5e-3
        compared.see("approach", float(top.delta_z), approach, part * approach)
    volume = state["plastic_volume"]
    allowed = volume["error"] + 0.06 * volume["value"]
    compared.see("volume", loaded.volume(), volume["value"], allowed)
    depths = state["depths"]
    strain = loaded.on_axis("equivalent")
    largest = state["largest_plastic_strain"]["value"]
    on_axis = [value_at_depth(strain, z) for z in depths]
    compared.table("p", on_axis, state["plastic_strain_on_axis"], 0.03 * largest)
    remaining = state["unloaded"]
    if isinstance(remaining, str):  # the row holds the reason instead
        return compared
    options = {axis: remaining[f"s_{axis}_on_axis"] for axis in ("rr", "zz")}
    upper = max(abs(value) for table in options.values() for value in table["value"])
    stress = unloaded.on_axis("residual_stress")
    interfaces = remaining.get("s_rr_at_interfaces")
    if interfaces:
        upper = max(upper, max(abs(value) for value in interfaces["value"]))
    for axis, component in (("rr", "xx"), ("zz", "zz")):
        values = [value_at_depth(stress.sel(component=component), z) for z in depths]
        compared.table(axis, values, options[axis], 0.03 * upper)
    if interfaces:
        edges = np.cumsum([c["thickness"] for c in row["coatings"]])
        sides = [(z, n + side) for n, z in enumerate(edges) for side in (0, 1)]
        values = [value_at_interface(stress.sel(component="xx"), z, layer) for z, layer in sides]
        if (row["name"], number) in CONTRADICTORY:
            interfaces = {name: of_row[:1] for name, of_row in interfaces.items()}
            below = strain_along(row, stress, 1)[:1]
            above = strain_along(row, stress, 0)
            line = np.polyfit(above.z, above, 2)
            expected = float(np.polyval(line, below.z)[0])
            compared.see("continuous strain", float(below[0]), expected, 0.03 * abs(expected))
        compared.table("interface", values[: len(interfaces["value"])], interfaces, 0.03 * upper)
    imprint = remaining["imprint_depth"]
    depth = middle(unloaded.dataset.imprint.to_numpy())
    allowed = imprint["error"] + 0.015 * abs(imprint["value"])
    compared.see("imprint", depth, imprint["value"], allowed)
    return compared


def end_point_friction(result: fret.Result) -> Any:
    """Give the friction work of every increment by the rule of the rows: last shear times slip.

    ``dissipated`` has the mean bound of the increment instead of the last one. In the four
    increments of the first quarter of a cycle, in which the contact grows, it is 4 % lower.
    """
    d = result.dataset
    area = result.scene.grid.dx * result.scene.grid.dy
    powers = 0.0
    for axis in "xy":
        total = d[f"slip_{axis}"].to_numpy()
        powers += d[f"q_{axis}"].to_numpy() * np.diff(total, axis=0, prepend=0.0)
    return area * np.abs(powers.sum(axis=(1, 2)))


def fretted(row: dict[str, Any], *, n: int = 48, room: float = 1.3, **changes: Any) -> Compared:
    """Go along the path of a ball that frets."""
    ball = row["ball"]
    upper = fret.Body(fret.Elastic(E=ball["E"], nu=ball["nu"]), shape=fret.Sphere(R=ball["R"]))
    lower = body(row)
    path = fret.LoadPath.start().normal(row["W"], increments=6)
    amplitude = row["shift_amplitude"]
    for end, increments in ((1, 4), (-1, 8), (1, 8), (-1, 8)):
        path = path.displace(delta_x=end * amplitude, increments=increments)
    a = fret.Scene(
        body1=upper,
        body2=lower,
        friction=row["friction"],
        grid=fret.Grid.centred(width=1e-3, n=16),
        path=path,
    ).hertz.a
    scene = fret.Scene(
        body1=upper,
        body2=lower,
        friction=row["friction"],
        grid=fret.Grid.centred(width=2 * room * a, n=n),
        path=path,
        settings=fret.Settings(save="all"),
        **changes,
    )
    result = fret.solve(scene, progress=False)
    compared = Compared(f"{row['name']}, {n} cells")
    largest = max(abs(T) for T in row["T"])
    done = {
        "plastic": np.cumsum(result.plastic_work.to_numpy()),
        "friction": np.cumsum(end_point_friction(result)),
    }
    columns = (
        ("T", result.T_x.to_numpy(), 0.01 * largest),
        ("largest_pressure", result.p_max.to_numpy(), None),
        ("approach", result.delta_z.to_numpy(), None),
        ("plastic_volume", result.plastic_volume.to_numpy(), None),
    )
    bars = {"largest_pressure": 0.015, "approach": 0.005, "plastic_volume": 0.06}
    for name, values, allowed in columns:
        truth = zip(values, row[name], row[f"{name}_error"], strict=True)
        worst = max(
            (
                (
                    value - expected,
                    (bars[name] * abs(expected) if allowed is None else allowed) + error,
                )
                for n, (value, expected, error) in enumerate(truth)
                if n >= 5
            ),
            key=lambda pair: abs(pair[0]) / pair[1],
        )
        compared.see(name, worst[0], 0.0, worst[1])
    columns = {n: result.dataset[n].to_numpy() for n in ("T_x", "delta_x", *ENERGIES)}
    # The trapezoidal rule of the loop, of eight increments a stroke, leaves 2 %, which is printed.
    columns["elastic"] = columns["elastic"] - result.dataset.quadrature.to_numpy()
    for k, start in enumerate((9, 17)):
        compared.balance(f"energy[{k}]", columns, row["W"], slice(start, start + 17))
    ends = [5, 9, 17, 25, 33]
    for name, bar in (("plastic", 0.06), ("friction", 0.03)):
        expected, error = row[f"{name}_work"], row[f"{name}_work_error"]
        before = -1
        for stroke, end in enumerate(ends):
            if name == "friction" and stroke == 0:
                before = end
                continue
            start = (
                (0.0, 0.0, 0.0)
                if before < 0
                else (done[name][before], expected[before], error[before])
            )
            truth = expected[end] - start[1]
            allowed = bar * truth + max(error[end], start[2])
            compared.see(f"{name}_work[{stroke}]", done[name][end] - start[0], truth, allowed)
            before = end
    return compared


def drawn(row: dict[str, Any], *, n: int = 128, room: float = 1.5, **changes: Any) -> Compared:
    """Go along the path of a cylinder that frets, in plane strain, and take it off."""
    item, a, T = row["cylinder"], row["a_of_the_bare_elastic_pair"], row["T_amplitude"]
    path = fret.LoadPath.start().normal(row["W"], increments=8).tangential([T], increments=8)
    for end in (-T, T, -T, T, -T):
        path = path.tangential([end], increments=16)
    path = path.tangential([0.0], increments=8).normal(1e-4 * row["W"], increments=8)
    scene = fret.Scene(
        body1=fret.Body(fret.Elastic(E=item["E"], nu=item["nu"]), shape=fret.Cylinder(R=item["R"])),
        body2=body(row),
        friction=row["friction"],
        grid=fret.Grid.strip(extent=2 * room * a, n=n),
        path=path,
        **changes,
    )
    names = ("p_max", "plastic_volume", "T_x", "delta_x", *ENERGIES)
    rows_ = []
    for increment in fret.march(scene):
        rows_.append([float(getattr(increment, name)) for name in names])
        if len(rows_) == 112:
            state = increment.plastic()
    columns = dict(zip(names, np.transpose(rows_), strict=True))
    stops = [7, 15, 31, 47, 63, 79, 95]
    compared = Compared(f"{row['name']}, {n} cells")
    for name, key, values, bar in (
        ("p_max", "largest_pressure", columns["p_max"], 0.005),
        ("area", "plastic_area", columns["plastic_volume"], 0.06),
        ("plastic_work", "plastic_work", columns["plastic_work"].cumsum(), 0.03),
        ("friction_work", "friction_work", columns["dissipated"].cumsum(), 0.03),
    ):
        truth = zip(values[stops], row[key]["value"], row[key]["error"], strict=True)
        floor = 1e-6 * max(row[key]["value"])
        for k, (value, expected, error) in enumerate(truth):
            compared.see(f"{name}[{k}]", value, expected, error + bar * abs(expected) + floor)
    for k, start in enumerate((15, 31, 47, 63)):
        compared.balance(f"energy[{k}]", columns, row["W"], slice(start, start + 33))
    cycle = slice(63, 96)
    loop = float(np.trapezoid(columns["T_x"][cycle], columns["delta_x"][cycle]))
    expected = row["loop_of_the_last_cycle"]
    compared.see("loop", loop, expected["value"], expected["error"] + 0.01 * expected["value"])
    end = row["end_unloaded"]
    strain = state.on_axis("equivalent")
    stress = state.on_axis("residual_stress").sel(component="xx")
    largest = max(
        *end["plastic_strain_below_centre"]["value"], row["largest_plastic_strain"]["value"][1]
    )
    values = [value_at_depth(strain, z) for z in end["depths"]]
    compared.table("p", values, end["plastic_strain_below_centre"], 0.03 * largest)
    upper = max(abs(value) for value in end["s_xx_below_centre"]["value"])
    values = [value_at_depth(stress, z) for z in end["depths"]]
    compared.table("xx", values, end["s_xx_below_centre"], 0.03 * upper)
    imprint = state.dataset.imprint.isel(grid_y=0)
    shape = PchipInterpolator(imprint.grid_x.to_numpy(), imprint.to_numpy())(end["imprint_x"])
    upper = max(abs(value) for value in end["imprint_relative_to_first"]["value"])
    compared.table("imprint", shape - shape[0], end["imprint_relative_to_first"], 0.015 * upper)
    return compared
