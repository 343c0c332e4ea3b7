"""Why a start in space is refused, in words that name the part and the number."""

import numpy as np

from ....cases.case import Case
from ....cases.mistake import CaseError
from ....cases.scene.joint import Joint
from ...system import Array
from .. import messages
from ..messages import DEGREES
from .closure import SpatialClosure

OPEN = 1e-6  # of a direction's largest entry: smaller ones are rounding
HARDLY = 1e-4  # beside a dead centre: ten times the singular values that count as zero there


def cannot_close(closure: SpatialClosure, q: Array) -> CaseError:
    """No positions satisfy the constraints; q is the best that was found."""
    residual, rows = closure.equations(q)
    worst = int(np.argmax(np.abs(residual)))
    turns = not np.any(rows[worst][~closure.where.turning])
    why = "the mechanism cannot be assembled from what is given"
    gap = abs(float(residual[worst]))
    return messages.stays_open(
        closure.case, why, closure.whose(q)[worst], gap, closure.size, turns=turns
    )


def locked(case: Case, joint: Joint, angle: float) -> CaseError:
    """Three turns, of which the first and the last are about one axis."""
    first, middle, last = joint.turns
    at = f"{joint.name}.{middle.name} = {angle * DEGREES:.4g} deg"
    axes = f"{first.name!r} and {last.name!r} turn about one axis"
    return messages.initial(
        case, f"at {at} {axes}, so that they determine nothing; start it by the body's `attitude`"
    )


def unreached(case: Case, joint: Joint) -> CaseError:
    """Three turns about skew axes, which cannot make the attitude that is given."""
    names = ", ".join(repr(turn.name) for turn in joint.turns)
    return messages.initial(
        case,
        f"the turns {names} of {joint.name} cannot make the attitude at which it starts; write a "
        "ball, or axes of which each is at right angles to the one before it",
    )


def flat(case: Case) -> CaseError:
    """A rim that lies on the floor."""
    rims = ", ".join(name for name, contact in case.scene.contacts.items() if contact.rim)
    return messages.initial(
        case, f"{rims}: a disk that lies flat has no lowest point; start it tilted"
    )


def open_ended(closure: SpatialClosure, q: Array, loose: Array) -> CaseError:
    """Coordinates that follow from nothing."""
    return messages.missing(closure.case, len(loose), _open(closure, q, loose))


def dead_centre(closure: SpatialClosure, q: Array, loose: Array) -> CaseError:
    """Coordinates that hardly follow from what is given."""
    return messages.dead_centre(closure.case, _open(closure, q, loose, HARDLY))


def _open(closure: SpatialClosure, q: Array, loose: Array, small: float = OPEN) -> list[str]:
    """The coordinates that change by more than `small` along the directions `loose` (k, n)."""
    names: list[str] = []
    for joint in closure.scene.joints.values():
        for freedom, _, row in closure.given.coordinates(joint, q):
            if np.max(np.abs(loose @ (row * closure.units))) > small and freedom.name:
                names.append(f"{joint.name}.{freedom.name}")
        if any(f.kind == "ball" for f in joint.freedoms):
            rows = closure.given.relative(joint, q)
            if np.max(np.abs(loose @ (rows * closure.units).T)) > small:
                names.append(f"{joint.name}.attitude")
    held = {end.body for joint in closure.scene.joints.values() for end in joint.refers()}
    for body in (name for name in closure.scene.bodies if name not in held):
        at = closure.where.slots[body]
        places = [f"{body}.{axis}" for axis in "xyz"]
        names += [
            name for i, name in enumerate(places) if np.max(np.abs(loose[:, at.r_dot + i])) > small
        ]
        if at.omega is not None and np.max(np.abs(loose[:, at.omega : at.omega + 3])) > small:
            names.append(f"{body}.attitude")
    return names or _open_places(closure, loose)


def _open_places(closure: SpatialClosure, loose: Array) -> list[str]:
    """The open coordinates of bodies that hang on each other and nowhere else."""
    columns = _open_columns(closure, loose, closure.where.rate_names)
    parts = (name.partition(".") for name in columns)
    fields = {"vx": "x", "vy": "y", "vz": "z"}
    return list(dict.fromkeys(f"{body}.{fields.get(rate, 'attitude')}" for body, _, rate in parts))


def rates_open(closure: SpatialClosure, loose: Array) -> CaseError:
    """Rates that follow from nothing and cannot all be zero."""
    names = _open_columns(closure, loose, closure.where.rate_names)
    return messages.missing(closure.case, len(loose), names)


def _open_columns(closure: SpatialClosure, loose: Array, names: tuple[str, ...]) -> list[str]:
    return [names[i] for i in open_columns(loose)]


def open_columns(loose: Array) -> list[int]:
    """The columns that what is loose moves."""
    return np.flatnonzero(np.max(np.abs(loose), axis=0) > OPEN).tolist()


def dependent(closure: SpatialClosure, part: str) -> CaseError:
    """A joint, contact, constraint or drive that repeats what others hold."""
    scene = closure.scene
    sections = {"joints": scene.joints, "contacts": scene.contacts, "drive": scene.drives}
    section = next((key for key, parts in sections.items() if part in parts), "constraints")
    such = " (a ball, a universal joint)" if section == "joints" else ""
    return messages.dependent(closure.case, section, part, such)
