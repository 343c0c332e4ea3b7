"""Massless rods in the generated mechanism: laws, closed loops, starts, planted mistakes."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import rods, scenes
from given.multibody_laws import EXACT, balance, lagrangian

from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.constraints import constraint_terms as rows
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import solve


def violated(folder: Path, scene: str) -> float:
    """(2.60) and (2.51) at the start, with any rates that the rods allow."""
    mode: Multibody = scenes.mechanism(scenes.typed(folder, scene)).base
    q, v = mode.start()
    f, any_rates = mode.f_a(0.0, q), np.random.default_rng(1).normal(size=len(v))
    v = any_rates - np.linalg.pinv(f) @ (f @ any_rates - mode.g(0.0, q))
    return max(lagrangian(mode, 0.0, q, v), balance(mode, 0.0, q, v))


@pytest.mark.slow
@pytest.mark.parametrize("scene", [rods.CHAIN, rods.SWING], ids=["chain", "loop"])
def test_rods_keep_their_length(scene: str, tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, scene)
    solution = solve(case)
    assert solution.holds
    assert violated(tmp_path, scene) < EXACT
    for name in case.scene.joints:
        gap = observe(case.scene, solution.trajectory, f"{name}.gap")
        assert np.max(np.abs(gap)) < 1e-13


@pytest.mark.slow
def test_a_rod_is_a_bar_without_mass(tmp_path: Path) -> None:
    """The same chain with a bar of 1e-7 kg on two pins in place of the rod: 1e-6 of it is off."""
    one = solve(scenes.typed(tmp_path, rods.CHAIN)).trajectory
    light = rods.CHAIN.replace(
        "  bodies: {", "  bodies: {link: {bar: {mass: 1.0e-7, length: 0.3193}}, "
    )
    start = one.states["bar"][0]
    end = start[:2] + 0.4 * np.array([np.cos(start[2]), np.sin(start[2])])
    length = float(np.hypot(*(one.states["bob"][0, :2] - end)))
    light = light.replace("0.3193", repr(length)).replace(
        "chain: {distance: [bar.end, bob.center]}",
        "chain: {pin: [bar.end, link.start]}\n    other: {pin: [link.end, bob.center]}",
    )
    light = light.replace("chain.force: 1.0, ", "")
    other = solve(scenes.typed(tmp_path, light)).trajectory
    for body in ("bar", "bob"):
        assert other.states[body] == pytest.approx(one.states[body], abs=1e-5)


@pytest.mark.slow
def test_tension_is_positive_where_it_pulls(tmp_path: Path) -> None:
    """Hanging m g, standing on its rod −m g."""
    for y, sign in ((-0.5, 1.0), (0.5, -1.0)):
        scene = (
            "scene:\n  points: {O: [0, 0]}\n  bodies: {bob: {particle: {mass: 2.0}}}\n"
            "  joints: {rod: {distance: [bob.center, ground.O]}}\n"
            f"initial: {{bob: {{x: 0, y: {y}}}}}\nrests: true\nallow: {{rod.force: 1.0}}\n"
        )
        case = scenes.typed(tmp_path, scene)
        force = observe(case.scene, solve(case).trajectory, "rod.force")
        assert force[0] == pytest.approx(sign * 2.0 * 9.80665, rel=1e-14)


@pytest.mark.slow
@pytest.mark.mutant("γ of a massless rod without a part of its turn")
def test_a_lost_term_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """γ without the turn of the rod: (|Δ̇|² − λ̇²)/λ."""
    sound = rows.Distance.row

    def lost(self: Any, k: Any, ends: Any) -> Row:
        row, rate = sound(self, k, ends), ends[self.b].r_dot - ends[self.a].r_dot
        return Row(row.loads, row.g, row.gamma - 0.1 * (rate @ rate))

    monkeypatch.setattr(rows.Distance, "row", lost)
    assert violated(tmp_path, rods.CHAIN) > 1e-3


REFUSED = [
    ("initial: {bob: {x: 0, y: 0}}", "has no length"),
    ("initial: {bob: {x: 0.6}}", "can be assembled in 2 ways"),
    ("initial: {bob: {x: 1.6}}", "cannot be assembled"),
    ("initial: {bob: {x: 0.6, y: 0.8, vx: 1, vy: 1}}", "the rates violate rod"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("start", "what"), REFUSED)
def test_starts(start: str, what: str, tmp_path: Path) -> None:
    length = "" if "y: 0}" in start else ", length: 1.0"
    scene = (
        "scene:\n  points: {O: [0, 0]}\n  bodies: {bob: {particle: {mass: 2.0}}}\n"
        f"  joints: {{rod: {{distance: [ground.O, bob.center]{length}}}}}\n"
        f"{start}\nallow: {{bob.x: 1.0}}\n"
    )
    with pytest.raises(CaseError) as caught:
        solve(scenes.typed(tmp_path, scene))
    assert what in caught.value.mistakes[0].what
