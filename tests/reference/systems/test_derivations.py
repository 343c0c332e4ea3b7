"""The linkages derived once more by sympy.physics.mechanics, from frames and points alone."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp
from given import laws
from given.examples import PARAMETERS, only
from given.states import states
from sympy.physics import mechanics

Derived = Callable[[Any, Any], tuple[Any, Any]]
me: Any = mechanics  # sympy has no types worth checking


class Sketch:
    """Bars added one by one; then sympy's own Lagrange equations."""

    def __init__(self) -> None:
        self.N = me.ReferenceFrame("N")
        self.O = me.Point("O")
        self.O.set_vel(self.N, 0)
        self.bodies: list[Any] = []

    def bar(self, q: Any, *, start: Any, m: float, l: float) -> Any:
        """Adds a slender bar at the angle q; answers its end."""
        frame = self.N.orientnew(f"F{len(self.bodies)}", "Axis", [q, self.N.z])
        centre = start.locatenew(f"C{len(self.bodies)}", sp.Float(l) / 2 * frame.x)
        end = start.locatenew(f"E{len(self.bodies)}", sp.Float(l) * frame.x)
        centre.v2pt_theory(start, self.N, frame)
        end.v2pt_theory(start, self.N, frame)
        inertia = me.inertia(frame, 0, 0, sp.Float(m) * sp.Float(l) ** 2 / 12)
        body = me.RigidBody(f"B{len(self.bodies)}", centre, frame, m, (inertia, centre))
        body.potential_energy = m * 9.80665 * centre.pos_from(self.O).dot(self.N.y)
        self.bodies.append(body)
        return end

    def solved(self, q: list[Any], *, U: Any = 0, loop: list[Any] | None = None) -> Derived:
        """q, v → q̈ and the multipliers of the loop."""
        L = me.Lagrangian(self.N, *self.bodies) - U
        equations = me.LagrangesMethod(L, q, hol_coneqs=loop) if loop else me.LagrangesMethod(L, q)
        equations.form_lagranges_equations()
        rates = [x.diff(me.dynamicsymbols._t) for x in q]
        plain = sp.symbols(f"q:{len(q)} v:{len(q)}")
        known = dict(zip([*rates, *q], [*plain[len(q) :], *plain[: len(q)]], strict=True))
        matrix, right = equations.mass_matrix_full, equations.forcing_full
        f = sp.lambdify([plain], [me.msubs(matrix, known), me.msubs(right, known)], cse=True)

        def answer(q: Any, v: Any) -> tuple[Any, Any]:
            M, F = f([*q, *v])
            unknown = np.linalg.solve(np.asarray(M, float), np.asarray(F, float).ravel())
            return unknown[len(q) : 2 * len(q)], unknown[2 * len(q) :]

        return answer


def double_pendulum(*, m1: float, l1: float, m2: float, l2: float, **_: float) -> Derived:
    sketch, (alpha, beta) = Sketch(), me.dynamicsymbols("alpha beta")
    elbow = sketch.bar(alpha, start=sketch.O, m=m1, l=l1)
    sketch.bar(beta, start=elbow, m=m2, l=l2)
    return sketch.solved([alpha, beta])


def rhombus(*, m: float, l: float, c: float, l0: float, **_: float) -> Derived:
    sketch, (one, two) = Sketch(), me.dynamicsymbols("theta1 theta2")
    left = sketch.bar(one, start=sketch.O, m=m, l=l)
    right = sketch.bar(two, start=sketch.O, m=m, l=l)
    sketch.bar(two, start=left, m=m, l=l)
    sketch.bar(one, start=right, m=m, l=l)
    x, y = (left.pos_from(right).dot(axis) for axis in (sketch.N.x, sketch.N.y))
    return sketch.solved([one, two], U=c / 2 * (sp.sqrt(x**2 + y**2) - l0) ** 2)


def four_bar(*, m: float, a: float, b: float, c: float, d: float, **_: float) -> Derived:
    sketch, q = Sketch(), list(me.dynamicsymbols("alpha beta gamma"))
    Q = sketch.O.locatenew("Q", sp.Float(d) * sketch.N.x)
    Q.set_vel(sketch.N, 0)
    B = sketch.bar(q[0], start=sketch.O, m=m, l=a)
    C = sketch.bar(q[1], start=B, m=m, l=b)
    end = sketch.bar(q[2], start=Q, m=m, l=c)
    gap = end.pos_from(C)
    return sketch.solved(q, loop=[gap.dot(sketch.N.x), gap.dot(sketch.N.y)])


@pytest.mark.slow
@pytest.mark.parametrize("derive", [double_pendulum, rhombus, four_bar], ids=lambda f: f.__name__)
def test_sympy_derives_the_same_accelerations(derive: Callable[..., Derived]):
    name = derive.__name__
    mode, derived = only(name), derive(**PARAMETERS[name])
    for t, q, v in states(name, "moving"):
        a, lam = derived(q, v)
        assert laws.difference(mode.accelerations(t, q, v), a) < laws.LIMIT
        if len(lam):
            reactions = mode.reactions(t, q, v)
            assert laws.difference([reactions["C.fx"], reactions["C.fy"]], lam) < laws.LIMIT
