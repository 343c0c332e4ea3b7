"""Why a start in space is refused, in words that name the part and the number."""

import math

import numpy as np

from ....cases.case import Case
from ....cases.mistake import CaseError
from ....cases.space.joint import SpatialJoint
from ....cases.space.scene import SpatialScene
from ...system import Array
from .closure import SpatialClosure

DEGREES = 180 / math.pi
OPEN = 1e-6  # of a direction's largest entry: smaller ones are rounding


def _initial(case: Case, what: str) -> CaseError:
    return CaseError([case.mistake(("initial",), what)])


def cannot_close(closure: SpatialClosure, q: Array) -> CaseError:
    """No positions satisfy the constraints; q is the best that was found."""
    residual, rows, owners = closure.equations(q)
    worst = int(np.argmax(np.abs(residual)))
    turns = not np.any(rows[worst][~closure.where.turning])
    gap = abs(float(residual[worst]))
    size = f"{gap * DEGREES:.3g} deg" if turns else f"{gap * closure.size:.3g} m"
    why = "the mechanism cannot be assembled from what is given"
    return _initial(closure.case, f"{why}: {owners[worst]} stays open by {size}")


def locked(case: Case, joint: SpatialJoint, angle: float) -> CaseError:
    """Three turns, of which the first and the last are about one axis."""
    first, middle, last = joint.turns
    at = f"{joint.name}.{middle.name} = {angle * DEGREES:.4g} deg"
    axes = f"{first.name!r} and {last.name!r} turn about one axis"
    return _initial(
        case, f"at {at} {axes}, so that they determine nothing; start it by the body's `attitude`"
    )


def flat(case: Case) -> CaseError:
    """A rim that lies on the floor."""
    assert isinstance(case.scene, SpatialScene)
    rims = ", ".join(name for name, contact in case.scene.contacts.items() if contact.rim)
    return _initial(case, f"{rims}: a disk that lies flat has no lowest point; start it tilted")


def several_ways(closure: SpatialClosure, ways: list[Array]) -> CaseError:
    """Names the joint coordinate in which the ways differ most, with its values."""
    values = [_coordinates(closure, q) for q in ways]
    names = list(values[0])
    if not names:
        what = f"the mechanism can be assembled in {len(ways)} ways; say which by `near`"
        return _initial(closure.case, what)
    name = max(names, key=lambda n: max(_differ(values[0][n], v[n]) for v in values))
    told = list(dict.fromkeys(f"{v[name] * DEGREES:.4g} deg" for v in values))
    joint, _, field = name.partition(".")
    return _initial(
        closure.case,
        f"the mechanism can be assembled in {len(ways)} ways: {name} = {' or '.join(told)}; say "
        f"which by `near`, for instance near: {{{joint}: {{{field}: {told[0]}}}}}",
    )


def _coordinates(closure: SpatialClosure, q: Array) -> dict[str, float]:
    return {
        f"{joint.name}.{freedom.name}": value
        for joint in closure.scene.joints.values()
        for freedom, value, _ in closure.given.coordinates(joint, q)
        if freedom.name and freedom.kind == "turn"
    }


def _differ(a: float, b: float) -> float:
    return abs(math.remainder(a - b, math.tau))


def open_ended(closure: SpatialClosure, q: Array, loose: Array) -> CaseError:
    """Coordinates that follow from nothing."""
    names = []
    for joint in closure.scene.joints.values():
        for freedom, _, row in closure.given.coordinates(joint, q):
            if np.max(np.abs(loose @ (row * closure.units))) > OPEN and freedom.name:
                names.append(f"{joint.name}.{freedom.name}")
        if any(f.kind == "ball" for f in joint.freedoms):
            rows = closure.given.relative(joint, q)
            if np.max(np.abs(loose @ (rows * closure.units).T)) > OPEN:
                names.append(f"{joint.name}.attitude")
    held = {end.body for joint in closure.scene.joints.values() for end in joint.refers()}
    for body in (name for name in closure.scene.bodies if name not in held):
        at = closure.where.columns[body]
        places = [f"{body}.{axis}" for axis in "xyz"]
        names += [
            name for i, name in enumerate(places) if np.max(np.abs(loose[:, at.r_dot + i])) > OPEN
        ]
        if at.omega is not None and np.max(np.abs(loose[:, at.omega : at.omega + 3])) > OPEN:
            names.append(f"{body}.attitude")
    return _missing(closure.case, len(loose), names or _open_places(closure, loose))


def _open_places(closure: SpatialClosure, loose: Array) -> list[str]:
    """Of bodies that hang on each other and nowhere else."""
    columns = _open_columns(closure, loose, closure.where.rate_names)
    parts = (name.partition(".") for name in columns)
    fields = {"vx": "x", "vy": "y", "vz": "z"}
    return list(dict.fromkeys(f"{body}.{fields.get(rate, 'attitude')}" for body, _, rate in parts))


def rates_open(closure: SpatialClosure, loose: Array) -> CaseError:
    """Rates that follow from nothing and cannot all be zero."""
    return _missing(
        closure.case, len(loose), _open_columns(closure, loose, closure.where.rate_names)
    )


def _open_columns(closure: SpatialClosure, loose: Array, names: tuple[str, ...]) -> list[str]:
    open_ = np.max(np.abs(loose), axis=0) > OPEN
    return [name for name, is_open in zip(names, open_, strict=True) if is_open]


def _missing(case: Case, count: int, names: list[str]) -> CaseError:
    return _initial(
        case,
        f"{count} more needed: {', '.join(names)} {'is' if len(names) == 1 else 'are'} "
        "not determined by what is given and the constraints",
    )


def dependent(case: Case, part: str) -> CaseError:
    """A constraint that repeats what others hold."""
    kind = "joints" if part in case.scene.joints else "contacts"
    return CaseError(
        [
            case.mistake(
                ("scene", kind, part),
                "the constraints are not independent: what this one holds is held by the others "
                "already, for good or in this position, so its reaction has no single value; "
                "replace it by one that holds less (a ball, a universal joint), or start elsewhere",
            )
        ]
    )


def rates_violate(case: Case, part: str) -> CaseError:
    """The given rates contradict each other."""
    return _initial(case, f"the rates violate {part}: no motion satisfies all that is given")
