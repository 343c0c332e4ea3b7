"""A sphere that rolls down an incline and spins about its normal: what MuJoCo loses by the spin."""

import numpy as np
from given.engine_space import STILL, G, attitude, spatial, state, vector

from textmech.cases.scene import Anchor
from textmech.cases.scene.body import Body
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.rotation import inverse, turned
from textmech.engines.engine import Plan, Start
from textmech.engines.mujoco import MuJoCo

R, M = 0.2, 1.5
J = 0.4 * M * R * R
UP = np.array([0.0, 0.0, 1.0])
SLOPE = np.array([0.3 * 0.8, 0.3 * 0.6, -0.95]) * G
TIMES = np.linspace(0.0, 0.5, 6)


def lost(step: float, spin: float, *, held: bool = False) -> float:
    """[N] how far the friction is from 2/7 of the weight along the incline."""
    ball = Body("ball", "sphere", M, (J, J, J, 0.0, 0.0, 0.0), {"center": STILL}, R, frame=SPACE)
    touch = spatial_contact("touch", Anchor("ball", "center"), 0.6, rim=False)
    scene = spatial([ball], contacts=[touch], gravity=vector(SLOPE))
    v, q = np.array([0.3, -0.4, 0.0]), attitude((0.5, -0.3, 0.2, 0.7))
    omega = turned(inverse(np.array(q)), np.cross(UP, v) / R + spin * UP)
    start: Start = {"ball": state((0.1, 0.2, R), q, v, omega)}
    engine = MuJoCo("tuned")
    (plan,) = engine.plans(scene, start)
    assert isinstance(plan, Plan)
    plan = plan.held_at(1e-3) if held else plan
    felt = ("touch.fx", "touch.fy")
    found = engine.run(scene, start, TIMES, step, plan, reactions=felt).reactions
    known = -2 / 7 * M * SLOPE
    return max(float(np.max(np.abs(found[name] - known[i]))) for i, name in enumerate(felt))


def test_friction_that_follows_the_step_is_of_first_order_where_the_sphere_spins() -> None:
    """Measured at 5 rad/s: 1.2e-4 and 6.0e-5 N of 1 N; 5.9e-6 N where b stays as at 1 ms.

    The Jacobian stands in axes that turn with the body from stage to stage. What relaxes within a
    step, b ∝ 1/h, sees the same of that in each: RK4's order is reduced to one.
    """
    tied = lost(5e-4, 5.0)
    assert 1.8 < lost(1e-3, 5.0) / tied < 2.2
    assert lost(5e-4, 5.0, held=True) < tied / 8


def test_it_is_as_the_spin_is_and_gone_without_it() -> None:
    assert 1.8 < lost(1e-3, 10.0) / lost(1e-3, 5.0) < 2.2
    assert lost(1e-3, 0.0) < lost(1e-3, 5.0) / 100
