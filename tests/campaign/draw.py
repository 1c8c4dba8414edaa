"""Random scenes with any key of a scene file, as text."""

from __future__ import annotations

import math
import random

R = 0.01


def power(rng: random.Random, low: float, high: float) -> float:
    """A number whose logarithm is even."""
    return 10.0 ** rng.uniform(low, high)


def table(pairs: dict[str, object]) -> str:
    """An inline table."""
    return "{ " + ", ".join(f"{k} = {value(v)}" for k, v in pairs.items()) + " }"


def value(v: object) -> str:
    """A value as TOML has it."""
    if isinstance(v, dict):
        return table(v)
    if isinstance(v, bool):
        return str(v).lower()
    if isinstance(v, str):
        return f'"{v}"'
    if isinstance(v, list):
        return "[" + ", ".join(value(x) for x in v) + "]"
    return repr(v)


def half_width(rng: random.Random) -> float:
    """About how wide half of the contact is to be, as a share of the grid."""
    return rng.uniform(0.2, 0.33)


def body(rng: random.Random, extent: float, share: float) -> dict[str, object]:
    """A substrate, coated or not."""
    made: dict[str, object] = {
        "E": power(rng, 9.5, 11.6),
        "nu": rng.choice([0.0, 0.3, 0.45, rng.uniform(-0.3, 0.49)]),
    }
    if rng.random() < share:
        made["coatings"] = [
            {
                "E": {"E_substrate": power(rng, -1.0, 1.0)},
                "nu": rng.uniform(0.1, 0.45),
                "thickness": extent * power(rng, -1.7, 0.0),
            }
            for _ in range(rng.choice([1, 1, 1, 2]))
        ]
    return made


def shape(rng: random.Random, extent: float, cell: float) -> dict[str, object]:
    """A shape that parts from a flat towards the border of the grid."""
    turned = rng.uniform(0, math.tau)
    sphere = {"sphere": {"R": R}}
    dip = extent**2 / R
    kind = rng.choice(
        ["sphere"] * 4
        + ["ellipsoid", "cylinder", "roller", "cone", "wedge", "punch", "wavy", "rough", "map"]
    )
    if kind == "ellipsoid":
        R_x, R_y = (R * rng.uniform(0.4, 1.6) for _ in range(2))
        return {"ellipsoid": {"R_x": R_x, "R_y": R_y, "angle": turned}}
    if kind == "cylinder":
        return {"cylinder": {"R": R, "length": extent * rng.uniform(0.3, 0.6), "angle": turned}}
    if kind == "roller":
        length = extent * rng.uniform(0.1, 0.4)
        return {"crowned_roller": {"R": R, "length": length, "crown": R, "angle": turned}}
    if kind == "cone":
        return {"cone": {"slope": 0.3 * extent / R}}
    if kind == "wedge":
        return {"sum": [sphere, {"wedge": {"slope": 0.05 * extent / R, "angle": turned}}]}
    if kind == "punch":
        return {"flat_punch": {"radius": extent * rng.uniform(0.1, 0.25), "edge": 0.1 * R}}
    if kind == "wavy":
        wave = {
            "amplitude": dip * power(rng, -4.0, -2.0),
            "wavelength": extent * rng.uniform(0.1, 0.5),
            "angle": turned,
            "phase": rng.uniform(0, math.tau),
        }
        return {"sum": [sphere, {"waviness": wave}]}
    if kind == "rough":
        rough = {
            "rms": dip * power(rng, -4.5, -2.3),
            "hurst": rng.uniform(0.4, 0.9),
            "longest": extent / 2,
            "shortest": rng.uniform(2.5, 6.0) * cell,
            "seed": rng.randrange(1 << 30),
        }
        return {"sum": [sphere, {"rough": rough}]}
    if kind == "map":
        n = rng.randrange(3, 9)
        top = dip * power(rng, -4.0, -2.0)
        z = [[rng.uniform(-top, top) for _ in range(n)] for _ in range(n)]
        return {"sum": [sphere, {"height_map": {"spacing": 1.01 * extent / n, "z": z}}]}
    return sphere


def friction(rng: random.Random, extent: float, slip: float) -> dict[str, object]:
    """Coulomb's law with what may be added to it."""
    mu: object = rng.choice([0.0, 0.1, 0.3, 0.3, 0.6, 1.0, "stick"])
    made: dict[str, object] = {"mu": mu}
    if not isinstance(mu, float) or mu == 0.0:
        return made
    if rng.random() < 0.15:
        made["mu_y"] = mu * rng.uniform(0.5, 2.0)
    if rng.random() < 0.2:
        made["kinetic"] = mu * rng.uniform(0.5, 1.0)
    if rng.random() < 0.3:
        n = rng.randrange(2, 9)
        factors = [0.0, 0.0, 0.5, 1.0, 2.0] if rng.random() < 0.5 else [0.3, 1.0, 1.5]
        z = [[rng.choice(factors) for _ in range(n)] for _ in range(n)]
        made["map"] = {"spacing": 1.01 * extent / n, "z": z}
    if rng.random() < 0.2:
        item = rng.choice(["slip", "increment", "dissipated"])
        far = {"slip": slip, "increment": 5.0, "dissipated": 1e8 * slip}[item]
        end = rng.choice([0.0, 0.5, 2.0])
        made["history"] = {"of": item, "table": [[0.0, 1.0], [far, end]]}
    return made


def branches(rng: random.Random, made: dict[str, object], W: float, extent: float) -> list[object]:
    """A load path: pressed first, then any of the six motions, driven or given."""
    mu = made["mu"]
    mu_W = (mu if isinstance(mu, float) else 1.0) * W
    a, depth = 0.27 * extent, (0.27 * extent) ** 2 / R
    count = lambda: rng.randrange(1, 5)  # noqa: E731
    if rng.random() < 0.2:
        path: list[object] = [{"delta_z": depth * rng.uniform(0.3, 1.0), "increments": count()}]
    else:
        path = [{"W": W, "increments": count()}]
    for _ in range(rng.randrange(1, 4)):
        kind = rng.choice(
            ["T"] * 4
            + ["shift", "shift", "far", "M_z", "phi_z", "tilt", "W", "lift", "bulk", "roll", "both"]
        )
        part, sign = rng.uniform(0.1, 0.9), rng.choice([-1, 1])
        branch: dict[str, object] = {"increments": count()}
        if kind == "T":
            branch |= {"T_x": sign * part * mu_W * 0.7, "T_y": rng.choice([0.0, 0.3]) * mu_W}
        elif kind == "shift":
            branch |= {"delta_x": sign * depth * power(rng, -2.0, 0.5)}
        elif kind == "far":
            branch |= {rng.choice(["delta_x", "delta_y"]): sign * depth * power(rng, 0.5, 1.5)}
        elif kind == "both":
            branch |= {
                "W": W * rng.uniform(0.3, 1.0),
                "delta_y": sign * depth * power(rng, -2.0, 0.0),
            }
        elif kind == "M_z":
            branch |= {"M_z": sign * part * 0.3 * mu_W * a}
        elif kind == "phi_z":
            branch |= {"phi_z": sign * depth / a * power(rng, -2.0, 0.0)}
        elif kind == "tilt":
            tilts = {"phi_x": 0.05 * sign * depth / a, "M_y": 0.02 * sign * W * a}
            name = rng.choice(list(tilts))
            branch |= {name: tilts[name]}
        elif kind == "W":
            branch |= {"W": W * rng.choice([0.0, 0.3, 0.7, 1.0])}
        elif kind == "lift":
            branch |= {"delta_z": depth * rng.uniform(-0.3, 0.9)}
        elif kind == "bulk":
            branch |= {rng.choice(["sigma_B", "sigma_B1"]): sign * power(rng, 6.0, 8.0)}
        else:
            already = sum(b.get("cells", 0) for b in path if isinstance(b, dict))
            cells = branch["increments"]
            branch |= {"cells": cells, "rolled": (already, cells)}
        path.append(branch)
    return path


def give_way(seed: int, W: float, extent: float, *bodies: dict[str, object]) -> None:
    """Bonds that give way, below some of the layers: about as much as the bodies approach."""
    rng = random.Random(f"bonds {seed}")
    mean = W / (0.27 * extent) ** 2
    for body in bodies:
        coatings = body.get("coatings", [])
        assert isinstance(coatings, list)
        for coating in coatings:
            if rng.random() < 0.5:
                compliance = (0.27 * extent) ** 2 / R / mean
                coating["bond_normal"] = compliance * power(rng, -3.0, 1.0)
                coating["bond_shear"] = rng.choice([0.0, compliance * power(rng, -3.0, 2.0)])


def draw(seed: int, *, bonds: bool = False) -> str:
    """The scene of a seed, as the text of its file; with `bonds` some of its layers give way."""
    rng = random.Random(seed)
    n = rng.choice([16, 20, 24, 32])
    cells: object = n if rng.random() < 0.7 else [n, n + rng.choice([-3, 1, 4])]
    extent = power(rng, -4.0, -2.5)
    cell = extent / n
    first, two = body(rng, extent, 0.25), body(rng, extent, 0.5)
    if rng.random() < 0.3:
        two = first | ({} if rng.random() < 0.5 else {"nu": first["nu"]})
    if rng.random() < 0.05:
        first = {"E": "rigid"}
    below: object = "flat"
    if rng.random() < 0.15:
        far = R * power(rng, 0.5, 1.5)
        below = {"sphere": {"R": far}} if rng.random() < 0.5 else {"cylinder": {"R": far}}
    made = friction(rng, extent, 0.01 * extent)
    stiff = [b["E"] for b in (first, two) if isinstance(b["E"], float)]
    E_star = 1.0 / sum(1.0 / E for E in stiff)
    W = 4 / 3 * E_star * (half_width(rng) * extent) ** 3 / R
    if bonds:
        give_way(seed, W, extent, first, *([two] if two is not first else []))
    path, rolled = [], 0
    for branch in branches(rng, made, W, extent):
        assert isinstance(branch, dict)
        if "cells" in branch:
            rolled += branch.pop("cells")
            branch["rolled"] = rolled * cell
        path.append(branch)
    lines = [
        "schema = 1",
        f'title = "campaign {seed}"',
        f"body1 = {value({'shape': shape(rng, extent, cell), **first})}",
        f"body2 = {value({'shape': below, **two})}",
        f"friction = {value(made)}",
        f"grid = {value({'n': cells, 'spacing': cell})}",
        "path = [",
        *(f"    {value(branch)}," for branch in path),
        "]",
    ]
    if rng.random() < 0.12:
        lines.append('solver.preset = "spinu2020"')
    return "\n".join(lines) + "\n"
