"""The rows of constraints at any states, in the plane and in space.

A row is the rate of its place, and γ what is left of the row's derivative: by the complex step,
which shares no algebra with the row. Plane and space share the formulas of the terms, so that
neither tests the other.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene import Anchor, Signal
from textmech.reference.formalisms.derivative import along
from textmech.reference.mechanism.constraints import constraint_terms as terms
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.kinematics import frame
from textmech.reference.mechanism.kinematics.coordinates import Coordinates
from textmech.reference.mechanism.kinematics.kinematics import Direction, Kinematics, Row
from textmech.reference.mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from textmech.reference.system import Array

EXACT = 1e-12  # of terms of the size 1 to 100, a dozen roundings
SEEN = 1e-3
PLANE = """\
scene:
  points:
    O: [0.3, -0.2]
    hook: {at: [0.5, 0.4], velocity: [0.1, -0.2]}
    crank: {at: [0.1, 0.2], moves: {sine: {amplitude: [0.3, -0.2], angular_frequency: 4.0}}}
  bodies:
    a: {rigid: {mass: 1.3, inertia: 0.2}, points: {P: [0.1, 0.2]}}
    b: {rigid: {mass: 0.7, inertia: 0.1}, points: {P: [-0.3, 0.1]}}
    bob: {particle: {mass: 0.4}}
initial: {}
allow: {a.x: 1.0}
"""
SPACE = """\
scene:
  space: 3
  points: {O: [0.3, -0.2, 0.1], hook: {at: [0.5, 0.4, 0.3], velocity: [0.1, -0.2, 0.3]}}
  bodies:
    a: {rigid: {mass: 1.3, inertia: [0.2, 0.3, 0.25, 0, 0, 0]}, points: {P: [0.1, 0.2, 0.3]}}
    b: {rigid: {mass: 0.7, inertia: [0.1, 0.2, 0.15, 0, 0, 0]}, points: {P: [-0.3, 0.1, 0.2]}}
    bob: {particle: {mass: 0.4}}
initial: {}
allow: {a.x: 1.0}
"""
LAW = Signal("sine", (0.7,), 3.0, 0.4)
U, W, N = (0.6, -0.8), (2 / 7, 3 / 7, 6 / 7), (0.36, 0.48, 0.8)  # unit vectors
IN_PLANE: dict[str, terms.Term] = {
    "along": terms.Along(1, U),
    "turning": terms.Turning(1, -0.7),
    "line": terms.Line(0, 1, U),
    "apart": terms.Apart(0, 1),
    "distance": terms.Distance(0, 1),
    "around": terms.Around(0, 1),
    "carried": terms.Carried(1, U),
    "given": terms.Given(LAW),
}
IN_SPACE: dict[str, terms.Term] = {
    "along": terms.Along(1, W),
    "line": terms.Line(0, 1, W),
    "apart": terms.Apart(0, 1),
    "distance": terms.Distance(0, 1),
    "carried": terms.Carried(1, W),
    "given": terms.Given(LAW),
    "dot": terms.Dot(0, 1, W, N),
    "turn": terms.Turn(0, 1, W, N, (1.3, -0.4)),
    "lowest of a rim": terms.Lowest(1, 0.3, N, W),
    "lowest of a sphere": terms.Lowest(1, 0.3, None, W),
    "heading": terms.Heading(1, N),
}
UP = terms.Lowest(1, 0.3, N, (0.0, 0.0, 1.0))  # along the floor it is the rate of no place
PLACED = ("along", "turning", "line", "apart", "distance", "dot")
ENDS = {
    "bodies": ("a.P", "b.P"), "from the ground": ("ground.O", "b.P"),
    "from a driven point": ("ground.hook", "b.P"), "to one": ("a.P", "ground.hook"),
    "from a particle": ("bob.center", "b.P"), "of centres": ("a.center", "b.center"),
}  # fmt: skip
MOVING = {"from a moving point": ("ground.crank", "b.P")}
OF_BODIES = ("carried", "lowest", "heading")  # whose second part carries something


def layout(text: str) -> Any:
    scene = scenes.parsed(text).scene
    return Coordinates(scene) if text == PLANE else SpatialCoordinates(scene)  # type: ignore[arg-type]


def held(term: terms.Term, ends: tuple[str, str], where: Any) -> Constraint:
    anchors = tuple(Anchor(*end.split(".")) for end in ends)
    return Constraint("j", anchors, ((term,),), ((),), None, where)


def states(where: Any) -> list[tuple[float, Array, Array]]:
    random = np.random.default_rng(3)
    m, n = len(where.names), len(where.masses)
    return [
        (random.uniform(0.1, 2.0), random.uniform(-2.0, 2.0, m), random.uniform(-3.0, 3.0, n))
        for _ in range(5)
    ]


def left_of_gamma(part: Constraint, where: Any) -> float:
    """f_a v̇ = γ is d/dt of f_a v = g, along q̇ of v, any state."""

    def excess(t: Any, q: Any, v: Array) -> Any:
        f_a, g, _ = part.alone.rows(t, q, v)
        return f_a @ v - g

    worst = 0.0
    for t, q, v in states(where):
        gamma = part.alone.rows(t, q, v)[2]
        slopes = along(lambda t, q, v=v: excess(t, q, v), (t, q), (1.0, where.rates(q, v)))
        worst = max(worst, float(np.max(np.abs(gamma + slopes)) / max(np.max(np.abs(gamma)), 1.0)))
    return worst


def left_of_rates(part: Constraint, where: Any) -> float:
    """f_a v − g is the rate of the place."""
    worst = 0.0
    for t, q, v in states(where):
        f_a, g, _ = part.alone.rows(t, q, v)
        slopes = along(
            lambda t, q: np.array([x + 0j for x in part.places(t, q.tolist())]),
            (t, q),
            (1.0, where.rates(q, v)),
        )
        worst = max(worst, float(np.max(np.abs(f_a @ v - g - slopes))))
    return worst


ALL = [(PLANE, name, ends) for name in IN_PLANE for ends in ENDS | MOVING]
ALL += [(SPACE, name, ends) for name in IN_SPACE for ends in ENDS]
ALL = [
    (text, name, ends) for text, name, ends in ALL
    if not (name.startswith(OF_BODIES) and ends == "to one")
]  # fmt: skip


@pytest.mark.parametrize(("text", "name", "ends"), ALL)
def test_a_row_is_the_rate_of_its_place_and_gamma_of_the_row(
    text: str, name: str, ends: str
) -> None:
    where = layout(text)
    term = (IN_PLANE if text == PLANE else IN_SPACE)[name]
    part = held(term, (ENDS | MOVING)[ends], where)
    assert left_of_gamma(part, where) < EXACT
    if name in PLACED:
        assert left_of_rates(part, where) < 100 * EXACT  # of rates up to 30 m/s
    else:
        upright = "lowest" in name  # its place is that of the lowest point, whose rate is another
        assert upright or np.isnan(part.places(0.3, states(where)[0][1].tolist())).all()


def test_the_height_of_a_rim_is_what_its_row_is_the_rate_of() -> None:
    where = layout(SPACE)
    assert left_of_rates(held(UP, ENDS["bodies"], where), where) < 100 * EXACT


@pytest.mark.mutant("slip of a disk's centre for that of its rim")
def test_the_slip_of_a_centre_is_not_that_of_the_rim(monkeypatch: pytest.MonkeyPatch) -> None:
    """The height of the lowest point does not change as the rows of the centre would have it."""
    planted(monkeypatch, terms.Lowest, lost_lever)
    where = layout(SPACE)
    assert left_of_rates(held(UP, ENDS["bodies"], where), where) > SEEN


def test_no_term_is_left_out() -> None:
    known = {type(term) for term in (*IN_PLANE.values(), *IN_SPACE.values())}
    written = {kind for kind in vars(terms).values() if isinstance(kind, type)}
    assert {kind for kind in written if hasattr(kind, "row")} - {terms.Term} == known


def lost_gamma(row: Row) -> Row:
    return Row(row.loads, row.g, 0.0)


def lost_lever(row: Row) -> Row:
    """A force acts at the centre of mass."""
    return Row([(part, F, M if F is None else None) for part, F, M in row.loads], row.g, row.gamma)


MOVED = [
    (text, name)
    for text, known in ((PLANE, IN_PLANE), (SPACE, IN_SPACE))
    for name in known
    if name not in ("turning", "lowest of a sphere")  # γ = 0: what they are about does not turn
]


@pytest.mark.mutant("γ of {name} left out, in the plane or in space")
@pytest.mark.parametrize(("text", "name"), MOVED)
def test_a_lost_gamma_is_seen(text: str, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    where, term = layout(text), (IN_PLANE if text == PLANE else IN_SPACE)[name]
    planted(monkeypatch, type(term), lost_gamma)
    assert left_of_gamma(held(term, ENDS["bodies"], where), where) > SEEN


@pytest.mark.mutant("lever of {name} left out, in the plane or in space")
@pytest.mark.parametrize("text", [PLANE, SPACE])
@pytest.mark.parametrize("name", ["along", "line", "apart", "distance"])
def test_a_lost_lever_is_seen(text: str, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    where, term = layout(text), (IN_PLANE if text == PLANE else IN_SPACE)[name]
    planted(monkeypatch, type(term), lost_lever)
    assert left_of_rates(held(term, ENDS["bodies"], where), where) > SEEN


def planted(patch: pytest.MonkeyPatch, kind: Any, change: Callable[[Row], Row]) -> None:
    sound = kind.row
    patch.setattr(kind, "row", lambda *given: change(sound(*given)))


@pytest.mark.mutant("{lost} of a direction that a body carries left out, in the plane or in space")
@pytest.mark.parametrize("text", [PLANE, SPACE])
@pytest.mark.parametrize("lost", ["u_dot", "beside"])
def test_a_rate_of_a_direction_is_missed(
    text: str, lost: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    where, term = layout(text), (IN_PLANE if text == PLANE else IN_SPACE)["line"]
    sound = Kinematics.carried

    def still(k: Kinematics, *given: Any) -> Direction:
        return replace(sound(k, *given), **{lost: k.still})

    monkeypatch.setattr(Kinematics, "carried", still)
    assert left_of_gamma(held(term, ENDS["bodies"], where), where) > SEEN


@pytest.mark.mutant("ω × x in space with the wrong sign of its z component")
def test_a_mistake_in_a_product_of_vectors_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    where, cross = layout(SPACE), type(frame.SPACE).cross

    def wrong(self: Any, w: Any, x: Any) -> Any:
        found = cross(self, w, x)
        return type(found)((found[0], -found[1], found[2]))

    monkeypatch.setattr(type(frame.SPACE), "cross", wrong)
    assert left_of_rates(held(IN_SPACE["along"], ENDS["bodies"], where), where) > SEEN
