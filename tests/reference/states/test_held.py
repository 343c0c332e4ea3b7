"""A chain that is put together wrongly is seen by what its joints hold, or read back."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.claims import CHAIN, claimed

from textmech.reference.mechanism.kinematics.space import chain
from textmech.reference.mechanism.kinematics.space.chain import Moving, SpatialChain
from textmech.reference.states.answer import answered, misread

CHECKS = ("joints hold (2.10), (2.15)", "coordinates read back")
AT, SHIFTED, TURNED = Moving.at, Moving.shifted, Moving.turned


def broken(case: Any) -> set[str]:
    """Which of the checks do not hold."""
    return {c.name for c in answered(case)[1] if c.name in CHECKS and not c.holds}


def without_spin(self: Moving, x: Any) -> Moving:
    """ω × R x is lost."""
    return replace(AT(self, x), r_dot=self.r_dot)


def backward(self: Moving, u: Any, s: Any, s_dot: Any) -> Moving:
    return SHIFTED(self, u, -s, -s_dot)


def along_ground(self: Moving, u: Any, s: Any, s_dot: Any) -> Moving:
    """Its rate is that of a line which stands still."""
    return replace(SHIFTED(self, u, s, s_dot), r_dot=self.r_dot + np.multiply.outer(u, s_dot))


def twice(self: Moving, u: Any, phi: Any, phi_dot: Any) -> Moving:
    return TURNED(self, u, 2 * phi, phi_dot)


def about_ground(self: Moving, u: Any, phi: Any, phi_dot: Any) -> Moving:
    """ω grows by φ̇ u of the ground's axes."""
    return replace(TURNED(self, u, phi, phi_dot), omega=self.omega + np.multiply.outer(u, phi_dot))


MISTAKES: dict[str, tuple[Any, str, Callable[..., Any]]] = {
    "ω × x lost": (Moving, "at", without_spin),
    "a slide the other way": (Moving, "shifted", backward),
    "a slide's line that does not turn": (Moving, "shifted", along_ground),
    "twice the angle": (Moving, "turned", twice),
    "an axis that does not turn": (Moving, "turned", about_ground),
    "turns in the other order": (chain, "_product", lambda a, b: PRODUCT(b, a)),
    "the second point forgotten": (
        SpatialChain, "_point",
        lambda self, anchor: POINT(self, anchor) * (0.0 if anchor.point == "in" else 1.0),
    ),
}  # fmt: skip
PRODUCT, POINT = chain._product, SpatialChain._point


@pytest.mark.parametrize("coordinate", ["q1.angle", "rail.s", "rail.a"])
def test_what_is_read_back_is_each_coordinate(coordinate: str, tmp_path: Path) -> None:
    """Of the drawn ones, which are 1 at most, one is told 1e-4 m or rad beside where it is."""
    case = claimed(tmp_path, CHAIN)
    assert case.states is not None
    found, drawn = answered(case)[0], case.states.drawn(case.scene)
    drawn[coordinate] = drawn[coordinate] + [1e-4, 0.0, 0.0]
    told = misread(case.scene, found, drawn)
    assert told == pytest.approx(1e-4, rel=1e-3)  # of places up to 1.0001


def test_a_sound_chain(tmp_path: Path) -> None:
    assert broken(claimed(tmp_path, CHAIN)) == set()


@pytest.mark.mutant("chain of bodies: {mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes(mistake: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(*MISTAKES[mistake])
    assert broken(claimed(tmp_path, CHAIN)) != set()
