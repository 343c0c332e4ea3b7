"""Random blows on what is held by more contacts than it needs, and all velocities after them.

The second opinion knows no rank and no order: of each way in which contacts may take the blow one
linear programme has impulses and velocities for unknowns, and says how far any velocity may go.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import cos, pi, sin
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import linprog

from given import scenes
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.mechanism.modes.blow import Condition, Meeting
from textmech.reference.mechanism.modes.element import State
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.system import Array

R = 0.3  # of the disk, and half the side of the box


@dataclass(frozen=True)
class Blow:
    """What `impact` is asked."""

    M: Array
    joints: list[Condition]
    met: list[Meeting]
    v: Array
    columns: dict[str, tuple[int, int]]  # of each body: where its velocities begin and end

    def told(self, after: Array, *, mirrored: bool) -> Array:
        """The velocities of disk and ball, in this order; of a mirrored scene mirrored back."""
        signs = np.array([-1.0, 1.0, -1.0]) if mirrored else np.ones(3)
        return np.concatenate([signs * after[slice(*self.columns[name])] for name in ("d", "ball")])


def groove(random: np.random.Generator) -> dict[str, Any]:
    """A disk between two walls, and a ball that strikes it from above."""
    a, b = random.uniform(0.3, 1.3, 2)
    return {
        "body": f"d: {{disk: {{mass: 1.0, radius: {R}}}}}",
        "planes": {
            "left": (-R * sin(a), -R * cos(a), sin(a), cos(a)),
            "right": (R * sin(b), -R * cos(b), -sin(b), cos(b)),
        },
        "contacts": {"l": "d, ground.left", "r": "d, ground.right"},
        "hit": "ball, d",
        "at": random.uniform(0.3, pi - 0.3),
        "reach": R,
    }  # fmt: skip


def corridor(random: np.random.Generator) -> dict[str, Any]:
    """A box on the floor between two walls, on both corners and at both sides."""
    at = random.uniform(-0.9 * R, 0.9 * R)
    return {
        "body": f"d: {{block: {{mass: 1.0, width: {2 * R}, height: {2 * R}}}}}",
        "planes": {
            "left": (-R, 0.0, 1.0, 0.0), "right": (R, 0.0, -1.0, 0.0),
            "bottom": (0.0, -R, 0.0, 1.0),
        },
        "contacts": {
            "l": "d.upper_left, ground.left", "r": "d.upper_right, ground.right",
            "fl": "d.lower_left, ground.bottom", "fr": "d.lower_right, ground.bottom",
        },
        "hit": "ball, d.top",
        "at": at,
        "reach": None,
    }  # fmt: skip


def shaft(random: np.random.Generator) -> dict[str, Any]:
    """A disk that slides up between two walls that face each other, and is struck from above."""
    return {
        "body": f"d: {{disk: {{mass: 1.0, radius: {R}}}}}",
        "planes": {"left": (-R, 0.0, 1.0, 0.0), "right": (R, 0.0, -1.0, 0.0)},
        "contacts": {"l": "d, ground.left", "r": "d, ground.right"},
        "hit": "ball, d",
        "at": pi / 2,
        "reach": R,
        "drifts": float(random.choice([0.1, 0.2])),
    }  # fmt: skip


def blow(tmp_path: Path, make: Any, seed: int, *, order: int = 0, mirrored: bool = False) -> Blow:
    """One of them, its contacts and bodies listed in that order, or seen in a mirror."""
    random = np.random.default_rng(seed)
    way, r, kinds = -1.0 if mirrored else 1.0, random.uniform(0.05, R), make(random)
    mass, e = 10 ** random.uniform(-1, 1), float(random.choice([0.0, 0.5, 1.0]))
    planes = [
        f"{name}: {{at: [{way * x!r}, {y!r}], normal: [{way * nx!r}, {ny!r}]}}"
        for name, (x, y, nx, ny) in kinds["planes"].items()
    ]
    pairs = {**kinds["contacts"], "hit": kinds["hit"]}
    rubs = [round(float(random.uniform(0.05, 1.2)), 3) for _ in pairs]
    contacts = [
        f"{name}: {{between: [{both}], friction: {mu}"
        f"{f', restitution: {e}' if name == 'hit' else ''}}}"
        for (name, both), mu in zip(pairs.items(), rubs, strict=True)
    ]
    bodies = [kinds["body"], f"ball: {{disk: {{mass: {mass!r}, radius: {r!r}}}}}"]
    if kinds["reach"] is None:
        x, y, down = kinds["at"], R + r, -pi / 2
    else:
        x, y = (R + r) * cos(kinds["at"]), (R + r) * sin(kinds["at"])
        down = kinds["at"] + pi
    down += random.uniform(-1.0, 1.0)
    vx, vy, omega = cos(down), sin(down), float(random.uniform(-8.0, 8.0))
    if order % 2:
        bodies, contacts = bodies[::-1], contacts[::-1]
    ordered = contacts[order:] + contacts[:order]
    text = (
        f"scene:\n  planes: {{{', '.join(planes)}}}\n  bodies: {{{', '.join(bodies)}}}\n"
        f"  contacts: {{{', '.join(ordered)}}}\n"
        "initial: {d: {x: 0, y: 0, angle: 0}, ball: {x: 0, y: 9, angle: 0}}\n"
        "allow: {d.x: 1.0e-3}\n"
    )
    case = scenes.typed(tmp_path, text)
    where = scenes.mechanism(case).base.where
    columns = {name: (xy, xy + 3) for name, (xy, _) in where.columns.items()}
    q, v = np.zeros((2, 6))
    q[slice(*columns["ball"])] = way * x, y, 0.0
    v[slice(*columns["ball"])] = way * vx, vy, way * omega
    v[columns["d"][0] + 1] = kinds.get("drifts", 0.0)
    built = PlanarMechanism(case.scene, (q, v), R).built
    i = [e.name for e in built.elements].index("hit")
    states: Any = tuple("open" if e.name == "hit" else "sticks" for e in built.elements)
    mode = built.name(states)
    _, met = landing._meetings(built, mode, i, 0.0, q, v, rests=False, size=0.0)
    return Blow(built.M, [], met, v, columns)


def velocities(blow: Blow, random: np.random.Generator) -> list[tuple[tuple[State, ...], Array]]:
    """Each way that keeps the laws without creating energy, with two velocities farthest apart."""
    found: list[tuple[tuple[State, ...], Array]] = []
    options: list[Sequence[State]] = [
        ("sticks", "slides +", "slides -", *(() if m.strikes else ("open",))) for m in blow.met
    ]
    toward = random.standard_normal(len(blow.v))
    for states in product(*options):
        for sense in (1.0, -1.0):
            after = _farthest(blow, states, sense * toward)
            if after is not None and blow.M @ after**2 <= (1 + 1e-8) * (blow.M @ blow.v**2):
                found.append((states, after))
    return found


def _farthest(blow: Blow, states: Sequence[State], toward: Array) -> Array | None:
    """Unknown are q̇⁺ (n,), and of each contact its normal and tangent impulse."""
    n, k = len(blow.v), len(blow.met)
    eq, right, low = [], [], []
    for i, mass in enumerate(blow.M):  # M (q̇⁺ − q̇⁻) = Λ f
        row = np.zeros(n + 2 * k)
        row[i] = mass
        row[n::2] = [-m.normal.f[i] for m in blow.met]
        row[n + 1 :: 2] = [-m.tangent.f[i] for m in blow.met]
        eq.append(row)
        right.append(mass * blow.v[i])
    for j, (m, state) in enumerate(zip(blow.met, states, strict=True)):
        normal, tangent, N, T = (np.zeros(n + 2 * k) for _ in range(4))
        normal[:n], tangent[:n], N[n + 2 * j], T[n + 2 * j + 1] = m.normal.f, m.tangent.f, 1.0, 1.0
        mu = m.element.kinetic
        if state == "open":
            eq += [N, T]
            right += [0.0, 0.0]
            low.append(normal)
            continue
        eq.append(normal)
        right.append(m.after)
        low.append(N)
        if state == "sticks":
            eq.append(tangent)
            right.append(0.0)
            low += [mu * N - T, mu * N + T]
        else:
            sense = 1.0 if state == "slides +" else -1.0
            eq.append(T + sense * mu * N)
            right.append(0.0)
            low.append(sense * tangent)
    programme: Any = linprog
    out = programme(
        np.append(toward, np.zeros(2 * k)), A_eq=eq, b_eq=right, A_ub=-np.array(low),
        b_ub=np.zeros(len(low)), bounds=[(-1e3, 1e3)] * n + [(-1e6, 1e6)] * (2 * k),
    )  # fmt: skip
    return out.x[:n] if out.status == 0 else None
