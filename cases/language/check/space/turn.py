"""What acts about a joint in space: which of its turns is meant."""

from typing import Any

from ....element import Force
from ....mistake import listed, nearest
from ....space.joint import SpatialJoint


def no_turn(joint: Any, force: Force) -> str | None:
    """Why there is no such turn, or none about which anything can act."""
    found: SpatialJoint = joint
    name, freedom = found.name, force.turn
    turns = [f.name for f in found.turns if f.name]
    written = [f"{name}.{turn}" for turn in turns]
    if not found.holds_attitude:
        why = "their middle axis is fixed in neither part; put a body between, on a joint more"
        return f"{name!r} leaves three turns, and about these nothing can act: {why}"
    if not turns:
        return f"the turns of {name!r}, a {found.kind}, have no names: write it as `freedoms`"
    if not freedom and found.kind == "freedoms":
        return f"{name!r} leaves freedoms with names: write {' or '.join(map(repr, written))}"
    if freedom in found.rates:
        turn = f"{name}.{found.rates[freedom].name}"
        return f"{freedom!r} is a rate; the turn is {turn!r}"
    if freedom in [f.name for f in found.shifts]:
        return f"{freedom!r} slides, and nothing turns there{listed(written)}"
    if freedom and freedom not in turns:
        return f"{name!r} has no turn {freedom!r}{nearest(f'{name}.{freedom}', written)}"
    return None
