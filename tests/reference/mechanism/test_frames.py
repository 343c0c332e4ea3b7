"""Machines of the plane, built again in space: the same motion, and no force out of the plane.

Both frames have the formulas of rows and forces in common, but neither attitudes, moments and
coordinates, nor what solves the equations. Trees alone: a loop of hinges is held twice in space.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.reference.mechanism.kinematics.frame import SPACE
from textmech.reference.mechanism.modes.mode import Multibody

EXACT = 1e-12  # of the largest: algebra, only rounding differs
COUNT = 4


def machine(seed: int) -> dict[str, str]:
    """A tree of bodies on pins and slides, with every force that both frames have, as two files."""
    rng = np.random.default_rng(seed)

    def pair() -> list[float]:
        return rng.uniform(-0.5, 0.5, 2).round(3).tolist()

    flat, solid, pins, hinges, start, before = [], [], [], [], [], [("ground", "O")]
    for i in range(COUNT):
        m, J = rng.uniform(0.5, 2.0, 2).round(3).tolist()
        P, Q = pair(), pair()
        flat.append(f"b{i}: {{rigid: {{mass: {m}, inertia: {J}}}, points: {{P: {P}, Q: {Q}}}}}")
        inertia, (P3, Q3) = [J, J, J, 0, 0, 0], ([*P, 0], [*Q, 0])
        solid.append(
            f"b{i}: {{rigid: {{mass: {m}, inertia: {inertia}}}, points: {{P: {P3}, Q: {Q3}}}}}"
        )
        body, point = before[rng.integers(len(before))]
        ends = f"[{body}.{point}, b{i}.P]"
        at, rate = rng.uniform(-1.0, 1.0, 2).round(3).tolist()
        if i % 2:
            along = pair()
            pins.append(f"j{i}: {{slide: {ends}, along: {along}}}")
            hinges.append(f"j{i}: {{slide: {ends}, along: {[*along, 0]}}}")
            start.append(f"j{i}: {{shift: {at}, SPEED: {rate}}}")
        else:
            pins.append(f"j{i}: {{pin: {ends}}}")
            hinges.append(f"j{i}: {{hinge: {ends}, axis: [0, 0, 1]}}")
            start.append(f"j{i}: {{angle: {at}, omega: {rate}}}")
        before.append((f"b{i}", "Q"))
    c, d, k, l0 = rng.uniform(0.5, 3.0, 4).round(3).tolist()
    common = f"""\
    coil: {{spring: [b1.Q, ground.O], stiffness: {10 * c}, rest_length: {l0 / 10}}}
    oil: {{damper: [b3.Q, b0.Q], damping: {d}}}
    wire: {{torsion: j0, stiffness: {k}, rest_angle: 0.4}}
    rub: {{torsion_damper: j2, damping: {d / 3}}}
    drive: {{motor: j0, sine: {{amplitude: {c}, angular_frequency: 2.0, phase: 0.4}}}}
"""
    push, M = pair(), float(rng.uniform(-1.0, 1.0))
    text = "scene:\n{head}  bodies: {{{bodies}}}\n  joints: {{{joints}}}\n  forces:\n{forces}"
    text += "initial: {{{initial}}}\nallow: {{b0.x: 1.0}}\n"
    return {
        "plane": text.format(
            head="  gravity: [1.3, -9.6]\n  points: {O: [0.2, -0.1]}\n",
            bodies=", ".join(flat), joints=", ".join(pins),
            initial=", ".join(start).replace("SPEED", "speed"),
            forces=common + f"    hand: {{push: b2.Q, constant: {push}}}\n"
            f"    twist: {{torque: b3, ramp: {M}}}\n",
        ),
        "space": text.format(
            head="  space: 3\n  gravity: [1.3, -9.6, 0]\n  points: {O: [0.2, -0.1, 0]}\n",
            bodies=", ".join(solid), joints=", ".join(hinges),
            initial=", ".join(start).replace("SPEED", "shift_dot"),
            forces=common + f"    hand: {{push: b2.Q, constant: {[*push, 0]}}}\n"
            f"    twist: {{torque: b3, ramp: [0, 0, {M}]}}\n",
        ),
    }  # fmt: skip


def built(folder: Path, seed: int) -> tuple[Multibody, Multibody]:
    texts = machine(seed)
    flat, solid = (scenes.mechanism(scenes.typed(folder, text)).base for text in texts.values())
    return flat, solid


def lifted(poses: dict[str, Any]) -> dict[str, Any]:
    """Planar states as those of bodies that stay in the plane z = 0."""
    return {
        name: (
            x, y, 0.0, math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2), vx, vy, 0.0, 0.0, 0.0,
            omega,
        )
        for name, (x, y, angle, vx, vy, omega) in poses.items()
    }  # fmt: skip


def apart(flat: Multibody, solid: Multibody) -> float:
    """The largest difference of accelerations and forces, relative; none is out of the plane."""
    t, (q, v) = 0.3, flat.start()
    at = solid.place(lifted(flat.poses(t, q, v)))
    a, b = flat.accelerations(t, q, v), solid.accelerations(t, *at).reshape(COUNT, 6)
    a_c, alpha = a.reshape(COUNT, 3)[:, :2], a.reshape(COUNT, 3)[:, 2]
    own = np.column_stack([a_c, np.zeros((COUNT, 3)), alpha])
    worst = np.max(np.abs(b - own)) / np.max(np.abs(a))
    known, found = flat.reactions(t, q, v), solid.reactions(t, *at)
    size = max(map(abs, known.values()))
    for joint in flat.scene.joints:
        pairs = [(known[f"{joint}.{axis}"], found[f"{joint}.{axis}"]) for axis in ("fx", "fy")]
        pairs.append((0.0, found[f"{joint}.fz"]))
        worst = max(worst, *(abs(one - other) / size for one, other in pairs))
    return float(worst)


@pytest.mark.parametrize("seed", range(6))
def test_a_tree_of_the_plane_moves_alike_in_space(seed: int, tmp_path: Path) -> None:
    flat, solid = built(tmp_path, seed)
    assert apart(flat, solid) < EXACT


@pytest.mark.mutant("ω × x in space with the wrong sign of its z component")
def test_a_mistake_of_one_frame_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    flat, solid = built(tmp_path, 1)
    cross = type(SPACE).cross

    def wrong(self: Any, w: Any, x: Any) -> Any:
        found = cross(self, w, x)
        return type(found)((found[0], -found[1], found[2]))

    monkeypatch.setattr(type(SPACE), "cross", wrong)
    assert apart(flat, type(solid)(solid.scene, solid.start())) > 1e-3
