"""Random forces on a scene that is drawn, in the plane and in space."""

from typing import Any

from second.drawn import Draw


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
