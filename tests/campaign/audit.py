"""An audit of increments that uses nothing but the scene, the tractions and the rigid motions.

The surfaces, the coefficients of friction, the sums and the displacements are reckoned here, from
the scene file and the response of the bodies.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import tomllib

import pyfret as fret

#: What is off by more than the tolerance times this is a violation.
ROOM = 10.0


def bilinear(z: list[list[float]], spacing: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Numbers of a map at the places, linear between its points, its middle over the origin."""
    values = np.asarray(z)

    def places(at: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        position = np.clip(at / spacing + (n - 1) / 2, 0, n - 1)
        low = np.floor(position).astype(int)
        return low, np.minimum(low + 1, n - 1), position - low

    (i, k, s), (j, m, t) = places(x, values.shape[0]), places(y, values.shape[1])
    return (1 - s) * ((1 - t) * values[i, j] + t * values[i, m]) + s * (
        (1 - t) * values[k, j] + t * values[k, m]
    )


def fall(shape: Any, x: np.ndarray, y: np.ndarray) -> np.ndarray | None:
    """How far a surface has fallen behind the contact plane [m]; None for a random one."""
    if shape == "flat":
        return np.zeros_like(x)
    ((kind, entry),) = (
        shape.items() if len(shape) == 1 else [("sum", [{k: v} for k, v in shape.items()])]
    )
    if kind == "sum":
        parts = [fall(part, x, y) for part in entry]
        return None if any(p is None for p in parts) else sum(parts)
    angle = entry.get("angle", 0.0)
    along, across = (x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle))
    if kind == "sphere":
        return (x**2 + y**2) / (2 * entry["R"])
    if kind == "cylinder" and "length" not in entry:
        return along**2 / (2 * entry["R"])
    if kind == "ellipsoid":
        return along**2 / (2 * entry["R_x"]) + across**2 / (2 * entry["R_y"])
    if kind == "cone":
        return entry["slope"] * np.hypot(x, y)
    if kind == "wedge":
        return entry["slope"] * np.abs(along)
    if kind == "flat_punch":
        return np.maximum(np.hypot(x, y) - entry["radius"], 0.0) ** 2 / (2 * entry["edge"])
    if kind == "crowned_roller":
        beyond = np.maximum(np.abs(across) - entry["length"] / 2, 0.0)
        return along**2 / (2 * entry["R"]) + beyond**2 / (2 * entry["crown"])
    if kind == "height_map":
        return -bilinear(entry["z"], entry["spacing"], x, y)
    if kind == "waviness":
        wave = 2 * np.pi * along / entry["wavelength"] + entry["phase"]
        return entry["amplitude"] * (1 - np.cos(wave))
    return None


def rim(contact: np.ndarray) -> np.ndarray:
    """Contact cells next to one out of contact, where friction without a limit may let go."""
    inside = np.pad(contact, 1)
    nx, ny = contact.shape
    around = [inside[i : i + nx, j : j + ny] for i in range(3) for j in range(3)]
    return contact & ~np.logical_and.reduce(around)


class Audit:
    """Looks at the increments of a scene in their order."""

    def __init__(self, text: str) -> None:
        self.file = tomllib.loads(text)
        self.scene = fret.Scene.from_toml(text)
        grid = self.scene.grid
        self.x, self.y = np.meshgrid(grid.x, grid.y, indexing="ij")
        self.operator = fret.SurfaceOperator(self.scene.body1, self.scene.body2, grid)
        surfaces = [fall(self.file[body]["shape"], self.x, self.y) for body in ("body1", "body2")]
        self.h_init = None if any(s is None for s in surfaces) else sum(surfaces)
        self.before: dict[str, Any] | None = None
        # What displacements are compared with: the approach that the grid is drawn for, or more.
        wide = 0.27 * grid.dx * grid.nx
        self.depth = max(
            wide**2 / 0.01,
            *(abs(b.get("delta_z", 0.0)) for b in self.file["path"]),
            self.scene.hertz.delta_z if self.scene.hertz else 0.0,
        )
        self.targets = self._targets()
        self.tolerance = 1e-6

    def _targets(self) -> list[dict[str, float]]:
        """Return the targets at the end of each branch: loads, or motions in their place."""
        pairs = {"W": "delta_z", "T_x": "delta_x", "T_y": "delta_y", "M_x": "phi_x",
                 "M_y": "phi_y", "M_z": "phi_z"}  # fmt: skip
        now: dict[str, float] = {"W": 0.0, "T_x": 0.0, "T_y": 0.0, "phi_x": 0.0, "phi_y": 0.0,
                                 "phi_z": 0.0}  # fmt: skip
        ends = []
        for branch in self.file["path"]:
            for load, motion in pairs.items():
                for name, alternative in ((load, motion), (motion, load)):
                    if name in branch:
                        now.pop(alternative, None)
                        now[name] = branch[name]
            ends.append(dict(now))
        return ends

    def bound(self, p: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """The largest q_x and q_y that friction could carry at all [Pa]."""
        law = self.file["friction"]
        if law["mu"] == "stick":
            return None
        factor = np.ones_like(p)
        if "map" in law:
            factor = bilinear(law["map"]["z"], law["map"]["spacing"], self.x, self.y)
        if "history" in law:
            factor = factor * max(1.0, *(pair[1] for pair in law["history"]["table"]))
        mu_x = max(law["mu"], law.get("kinetic", 0.0))
        return mu_x * factor * p, mu_x * law.get("mu_y", law["mu"]) / max(
            law["mu"], 1e-300
        ) * factor * p

    def bulk(self, sigma: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
        """Return the part of the bulk stresses in u = u(2) - u(1) [m]."""
        u_x, u_y = np.zeros_like(self.x), np.zeros_like(self.x)
        for sign, stress, name in ((1, sigma[0], "body2"), (-1, sigma[1], "body1")):
            body = self.file[name]
            if stress != 0.0:
                u_x += sign * stress / body["E"] * self.x
                u_y -= sign * body["nu"] * stress / body["E"] * self.y
        return u_x, u_y

    def look(self, increment: fret.solution.Increment) -> dict[str, float]:
        """Violations of an increment over what is allowed; above 1 is wrong."""
        d = increment.dataset
        number = lambda name: float(d[name])  # noqa: E731
        p, q_x, q_y = (d[k].values for k in ("p", "q_x", "q_y"))
        cell = self.scene.grid.cell_area
        computed: dict[str, float] = {}
        if not all(np.isfinite(f).all() for f in (p, q_x, q_y)):
            return {"not a number": np.inf}
        sums = {
            "W": p.sum() * cell,
            "T_x": q_x.sum() * cell,
            "T_y": q_y.sum() * cell,
            "M_x": (self.y * p).sum() * cell,
            "M_y": -(self.x * p).sum() * cell,
            "M_z": (self.x * q_y - self.y * q_x).sum() * cell,
        }
        width = self.scene.grid.dx * self.scene.grid.nx / 4
        normal = max(sums["W"], max((abs(t.get("W", 0.0)) for t in self.targets), default=0.0))
        room = ROOM * self.tolerance
        # Loads are compared where the file prescribes them: at the end of a branch.
        if self.ends_branch(increment):
            target = self.targets[int(number("branch_of_increment"))]
            for name, expected in target.items():
                if name in sums:
                    size = normal if name[0] in "WT" else normal * width
                    if size > 0:
                        computed[f"balance {name}"] = abs(sums[name] - expected) / (room * size)
                elif expected != 0.0 or name == "delta_z":
                    off = abs(number(name) - expected)
                    computed[f"motion {name}"] = off / (1e-9 * max(abs(expected), self.depth))
        top = max(p.max(), 1e-300)
        computed["tension"] = -p.min() / (room * top)
        outside = p <= 0
        shear = np.hypot(q_x, q_y)
        computed["shear without pressure"] = shear[outside].max(initial=0.0) / (
            room * max(top, 1.0)
        )
        computed["status beside the field"] = self.contradiction(d)
        bound = self.bound(p)
        if bound is not None:
            b_x, b_y = (np.maximum(b, 1e-12 * max(top, 1.0)) for b in bound)
            over = np.hypot(q_x / b_x, q_y / b_y)[~outside].max(initial=0.0) - 1
            computed["Coulomb"] = over / 1e-6
        u_x, u_y, u_z = self.operator.displacement(p=p, q_x=q_x, q_y=q_y)
        if self.h_init is not None:
            motion = number("delta_z") + self.y * number("phi_x") - self.x * number("phi_y")
            h = self.h_init + u_z - motion
            size = max(self.depth, 1e-300)
            inside = np.sqrt((h[~outside] ** 2).mean()) if (~outside).any() else 0.0
            computed["gap inside"] = inside / (room * size)
            computed["overlap outside"] = -h[outside].min(initial=0.0) / (room * size)
        b_x, b_y = self.bulk((number("sigma_B"), number("sigma_B1")))
        u_x, u_y = u_x + b_x, u_y + b_y
        now = {
            "stick": d.stick.values,
            "parts": number("parts"),
            "u": (u_x, u_y),
            "p": p,
            "q": (q_x, q_y),
            "rolled": number("rolled"),
            "d": tuple(number(k) for k in ("delta_x", "delta_y", "phi_z")),
        }
        if self.before is not None and self.before["rolled"] == now["rolled"]:
            computed |= self.slip(self.before, now, bound)
        self.before = now
        return computed

    def contradiction(self, d: Any) -> float:
        """Infinite where status, stick ratio and the field ``stick`` disagree, else 0.

        An increment on a coarser grid has carried fields, and is left out.
        """
        if int(d.path_grid) != self.scene.grid.nx:
            return 0.0
        contact, stick = int(d.contact.sum()), int(d.stick.sum())
        ratio, status = float(d.stick_ratio), int(d.status)
        agrees = {
            0: contact == 0,
            1: contact > 0 and stick == contact and ratio == 1.0,
            2: 0.0 < ratio < 1.0 and 0 < stick < contact if stick else ratio == 0.0,
            3: contact > 0 and stick == 0 and ratio == 0.0,
        }
        return 0.0 if agrees[status] else np.inf

    def slip(
        self,
        before: dict[str, Any],
        now: dict[str, Any],
        bound: tuple[np.ndarray, np.ndarray] | None,
    ) -> dict[str, float]:
        """Compute the slip of cells in contact from one increment to the next.

        Where one was solved in pieces, what stuck in the last of them may have slipped before.
        """
        if now["parts"] > 1:
            return {}
        dd = [a - b for a, b in zip(now["d"], before["d"], strict=True)]
        ds_x = now["u"][0] - before["u"][0] - (dd[0] - self.y * dd[2])
        ds_y = now["u"][1] - before["u"][1] - (dd[1] + self.x * dd[2])
        ds = np.hypot(ds_x, ds_y)
        pair = (now["p"] > 0) & (before["p"] > 0)
        stuck = pair & ~rim(now["p"] > 0)
        (q_x, q_y), mu = now["q"], 1.0
        if bound is not None:
            mu = max(float(self.file["friction"]["mu"]), 0.05)
            least = [np.maximum(self.least(b), 1e-300) for b in bound]
            bears = least[0] > 1e-3 * max(bound[0].max(initial=0.0), 1e-12 * now["p"].max())
            stuck = pair & bears & (np.hypot(q_x / least[0], q_y / least[1]) < 0.99)
        room = ROOM * self.tolerance * mu * self.depth
        computed = {"slip in stick": ds[stuck].max(initial=0.0) / (10 * room)}
        if self.file["friction"]["mu"] != 0.0:
            # Each end of an increment may be off by the tolerance, in the root mean square.
            arguments = np.sqrt((ds[pair & now["stick"]] ** 2).sum())
            roots = sum(np.sqrt((end["p"] > 0).sum()) for end in (before, now))
            # Displacements are reckoned anew: half as much again for their rounding.
            computed["slip in cells that are said to stick"] = arguments / (
                1.5 * max(roots, 1.0) * self.allowed_slip()
            )
        forward = (q_x * ds_x + q_y * ds_y)[pair & (ds > 100 * room)]
        if forward.size:
            computed["slip along the shear"] = (forward > 0).mean() / 0.05
        return computed

    def allowed_slip(self) -> float:
        """The tolerance of slip, root mean square over the contact [m]."""
        law = self.file["friction"]
        mu = 1.0 if law["mu"] == "stick" else min(law["mu"], 1.0)
        approach = self.scene.hertz.delta_z if self.scene.hertz else self.depth
        return self.tolerance * mu * max(approach, 1e-300)

    def least(self, bound: np.ndarray) -> np.ndarray:
        """The least that friction bears of its largest bound: in motion, with its history."""
        law = self.file["friction"]
        factor = min(law["mu"], law.get("kinetic", law["mu"])) / max(
            law["mu"], law.get("kinetic", 0.0), 1e-300
        )
        if "history" in law:
            factors = [1.0, *(pair[1] for pair in law["history"]["table"])]
            factor *= min(factors) / max(factors)
        return factor * bound

    def ends_branch(self, increment: fret.solution.Increment) -> bool:
        """Whether the increment is the last of its branch."""
        counts = np.cumsum([b["increments"] for b in self.file["path"]])
        return int(increment.dataset["increment"]) in counts
