"""Random scenes as a file has them: their numbers, and their forces."""

import math
from typing import Any

import numpy as np

# Random words for random scenes: numbers in all their forms, laws in time, directions.

UNITS = {
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3},
    "kg": {"kg": 1.0, "g": 1e-3},
    "rad": {"rad": 1.0, "deg": math.pi / 180, "°": math.pi / 180, "rev": 2 * math.pi},
    "rad/s": {"rad/s": 1.0, "deg/s": math.pi / 180, "rpm": math.pi / 30},
    "m/s": {"m/s": 1.0, "cm/s": 1e-2, "km/h": 1 / 3.6},
    "N": {"N": 1.0, "kN": 1e3, "kg m/s^2": 1.0},
    "N/m": {"N/m": 1.0, "N/cm": 100.0},
    "N s/m": {"N s/m": 1.0, "N*s/m": 1.0},
    "N m/rad": {"N m/rad": 1.0},
    "N m": {"N m": 1.0, "J": 1.0},
    "kg m²": {"kg m²": 1.0, "kg m^2": 1.0},
    "s": {"s": 1.0, "ms": 1e-3},
    "": {},
}


class Draw:
    """A source of random words, which keeps the parameters that it has named."""

    def __init__(self, seed: int) -> None:
        self.random = np.random.default_rng(seed)
        self.parameters: dict[str, Any] = {}

    def pick(self, *choices: Any) -> Any:
        """One of some."""
        return choices[int(self.random.integers(len(choices)))]

    def chance(self, part: float) -> bool:
        """Whether what happens so often happens."""
        return bool(self.random.random() < part)

    def number(self, low: float, high: float, unit: str = "") -> Any:
        """A number between two: a literal, with a unit, or a parameter or its negative."""
        value = round(float(self.random.uniform(low, high)), 3)
        return self.told(value, unit)

    def told(self, value: float, unit: str = "") -> Any:
        """A number in one of the forms in which it can stand."""
        names = list(UNITS[unit])
        text: Any = value
        if names and self.chance(0.4):
            name = self.pick(*names)
            text = f"{value / UNITS[unit][name]!r} {name}"
        if not self.chance(0.3):
            return text
        name = f"p{len(self.parameters)}"
        if isinstance(text, float) and self.chance(0.4):
            self.parameters[name] = -text
            return f"-{name}"
        self.parameters[name] = text
        return name

    def vector(self, size: float, n: int, unit: str = "") -> list[Any]:
        """A list of numbers."""
        return [self.number(-size, size, unit) for _ in range(n)]

    def direction(self, n: int) -> list[float]:
        """A direction, of any length."""
        v = self.random.normal(size=n)
        return [round(float(x), 3) for x in v / np.linalg.norm(v) * self.random.uniform(0.5, 2)]

    def law(self, size: float, n: int, unit: str, jumps: bool = True) -> dict[str, Any]:
        """A law in time, of a number (n = 0) or a vector."""
        kinds = ["constant", "ramp", "sine", "polynomial", "table", *(["step", "pulse"] * jumps)]
        kind = self.pick(*kinds)

        def amount(unit: str = unit) -> Any:
            return self.vector(size, n, unit) if n else self.number(-size, size, unit)

        if kind == "constant":
            return {kind: amount()}
        if kind == "ramp":
            return {kind: amount("")}
        along = {"along": self.direction(n)} if n else {}
        if kind == "sine":
            phase = {"phase": self.number(-2, 2, "rad")} if self.chance(0.6) else {}
            w = self.number(3, 9, "rad/s")
            return {kind: {"amplitude": amount(), "angular_frequency": w} | phase}
        if kind == "polynomial":
            return {kind: along | {"coefficients": self.vector(size, 3)}}
        if kind == "table":
            times = np.sort(self.random.uniform(0.02, 0.23, 3))
            values = self.vector(size, 3, unit)
            return {kind: along | {"times": [round(float(t), 4) for t in times], "values": values}}
        if kind == "step":
            return {kind: {"amplitude": amount(), "at": self.number(0.05, 0.2, "s")}}
        return {
            kind: {
                "amplitude": amount(),
                "from": self.number(0.02, 0.1, "s"),
                "until": self.number(0.12, 0.2, "s"),
            }
        }


def finished(made: Any, seed: int) -> dict[str, Any]:
    """The file of a scene that is drawn: a short motion, and all the quantities that it has."""
    scene = {key: value for key, value in made.scene.items() if value}
    used = set(leaves([scene, made.initial]))
    return {
        "title": f"Random scene {seed}",
        "source": {"equations": ["2.60"]},
        "parameters": {p: v for p, v in made.draw.parameters.items() if used & {p, f"-{p}"}},
        "scene": scene,
        "initial": made.initial,
        "events": getattr(made, "events", {}),
        "duration": 0.24,
        "samples": 13,
        "step": {"mujoco": 1.0e-3},
        "allow": dict.fromkeys(sorted(set(made.wanted)), 1.0e3),
    }


def leaves(told: Any) -> list[Any]:
    """All that stands in a structure."""
    if isinstance(told, dict):
        return leaves(list(told.values()))
    return [leaf for each in told for leaf in leaves(each)] if isinstance(told, list) else [told]


# Random forces on a scene that is drawn, in the plane and in space.


def force(d: Draw, scene: dict[str, Any], turning: list[str]) -> tuple[dict[str, Any], list[str]]:
    """A force of any kind that is smooth, and the quantities that it has."""
    space = scene.get("space") == 3
    n = 3 if space else 2
    bodies = scene["bodies"]
    rigid = [b for b in bodies if "particle" not in bodies[b]]
    small = [b for b in bodies if b not in rigid]
    sliding = [
        j for j, told in scene["joints"].items() if {"slide", "slot"} & set(told) and not space
    ]
    kinds = ["spring", "damper", "push"]
    kinds += ["torque"] * bool(rigid) + ["drag", "linear_muscle", "muscle"] * (not space)
    kinds += ["torsion", "torsion_damper", "motor"] * bool(turning)
    kinds += ["couple", "couple"] * (len(rigid) > 1 and not space) + ["runner"] * bool(
        rigid and not space
    )
    kinds += ["viscous"] * bool(sliding) + ["magnetic"] * bool(small and not space)
    kind = d.pick(*kinds)
    name = d.pick(*bodies)
    point = f"{name}.{'P' if name in rigid and d.chance(0.6) else 'center'}"
    if kind in ("spring", "damper", "muscle", "linear_muscle"):
        return line(d, kind, d.pick([point, "ground.far"], ["ground.far", point]))
    if kind == "push":
        return {"push": point} | d.law(5.0, n, "N"), ["work"]
    if kind == "torque":
        return {"torque": d.pick(*rigid)} | d.law(1.0, 3 if space else 0, "N m"), ["work"]
    if kind == "couple":
        one, two = d.random.choice(rigid, 2, replace=False)
        return {"couple": [str(one), str(two)]} | d.law(1.0, 0, "N m"), ["work"]
    if kind == "motor":
        return {"motor": d.pick(*turning)} | d.law(1.0, 0, "N m"), ["work"]
    if kind == "torsion":
        rest = d.number(-0.5, 0.5, "rad")
        told = {
            "torsion": d.pick(*turning),
            "stiffness": d.number(1, 5, "N m/rad"),
            "rest_angle": rest,
        }
        return told, ["angle", "torque", "work"]
    if kind == "torsion_damper":
        return (
            {"torsion_damper": d.pick(*turning), "damping": d.number(0.1, 0.5)},
            ["angle", "torque", "work"],
        )
    if kind == "drag":
        told = {"drag": point, "coefficient": d.number(0.1, 1.0), "exponent": d.pick(1, 1.5, 2, 3)}
        return told, ["fx", "fy", "force", "work"]
    if kind == "runner":
        told = {"drag": f"{d.pick(*rigid)}.P", "along": d.direction(2), "exponent": d.pick(1, 2)}
        told |= {"coefficient": d.number(0.1, 1.0), "across": d.number(1, 4)}
        if d.chance(0.5):
            told["backward"] = d.number(0.5, 2.0)
        return told, ["fx", "fy", "force", "work"]
    if kind == "viscous":
        both = {"forward": d.number(0.2, 1.0), "backward": d.number(0.5, 2.0)}
        told = {"viscous": d.pick(*sliding), "coefficient": d.pick(both, d.number(0.3, 1.0))}
        return told | {"exponent": d.pick(1, 2)}, ["speed", "force", "work"]
    charge = {"charge": d.number(0.5, 1.5), "along_z": d.number(-4, 4)}
    return {"magnetic": d.pick(*small)} | charge, []


def line(d: Draw, kind: str, ends: list[str]) -> tuple[dict[str, Any], list[str]]:
    """What acts along the line between two points."""
    told: dict[str, Any] = {kind: ends}
    if kind == "damper":
        return told | {"damping": d.number(0.3, 3, "N s/m")}, ["length", "force", "work"]
    if kind == "spring":
        told |= {"stiffness": d.number(5, 30, "N/m"), "rest_length": d.number(0.5, 3, "m")}
        return told, ["length", "force", "work"]
    told |= {"isometric": d.number(20, 60, "N"), "series_stiffness": d.number(10, 20, "N/m")}
    told |= {"parallel_stiffness": d.number(1, 4, "N/m"), "rest_length": d.number(2, 4, "m")}
    told["contractile_length"] = d.number(2.0, 3.0, "m")
    if kind == "muscle":
        told |= {"hill_a": d.number(20, 40, "N"), "hill_b": d.number(0.1, 0.5, "m/s")}
    else:
        told["damping"] = d.number(20, 60, "N s/m")
    return told, ["length", "force", "contractile_length"]
