"""What a generated mechanism says of modes that contradict contact or friction."""

import numpy as np
import pytest

from textmech.cases import shape
from textmech.cases.scene import Anchor, Contact, Scene
from textmech.reference.generated.mechanism import Mechanism

STANDS, UP = (0.0, 0.25, 0.0), 9.81


def said(mode: str, q: tuple[float, ...], v: tuple[float, ...], *, gravity: tuple[float, float]):
    """Of a disk on the floor, R = 0.25 m, μ = 0.4, in a mode."""
    disk = shape.disk(name="wheel", mass=1.3, radius=0.25, points={})
    touch = Contact("touch", Anchor("wheel", "center"), 0.4, 0.4)
    scene = Scene(gravity, {}, {"wheel": disk}, {}, {"touch": touch}, {})
    mechanism = Mechanism(scene, (np.array(STANDS), np.zeros(3)), 0.25)
    built = mechanism.built
    names = {s: built.name((s,)) for s in ("open", "slides +", "slides -", "sticks")}
    return mechanism.possible(names[mode], 0.0, np.array(q), np.array(v))


@pytest.mark.parametrize("mode", ["sticks", "slides +", "slides -"])
def test_a_floor_does_not_pull(mode: str):
    v = {"sticks": 0.0, "slides +": 1.0, "slides -": -1.0}[mode]
    pulled = said(mode, STANDS, (v, 0.0, 0.0), gravity=(0.0, UP))
    assert pulled == "the floor would have to pull at touch"
    assert said(mode, STANDS, (v, 0.0, 0.0), gravity=(0.0, -UP)) is None
    assert said("open", STANDS, (v, 0.0, 0.0), gravity=(0.0, UP)) is None


def test_a_rim_stays_above_the_floor():
    sunk = (0.0, 0.25 - 1e-6, 0.0)
    assert said("open", sunk, (0.0, 0.0, 0.0), gravity=(0.0, -UP)) == "touch is in the floor"


@pytest.mark.parametrize(("slope", "slips"), [(1.19, False), (1.21, True)])
@pytest.mark.parametrize("way", [1, -1])
def test_a_disk_rolls_on_slopes_up_to_three_mu(slope: float, slips: bool, way: int):
    """Friction is a third of the drive, and at most 0.4 of the weight across."""
    words = said("sticks", STANDS, (0.0, 0.0, 0.0), gravity=(way * slope * UP, -UP))
    assert words == ("touch would have to slip" if slips else None)


@pytest.mark.parametrize(("mode", "way"), [("slides +", 1.0), ("slides -", -1.0)])
def test_a_mode_slides_its_own_way(mode: str, way: float):
    """(2.16) the slip is ẋ + R ω."""
    assert said(mode, STANDS, (way, 0.0, 0.0), gravity=(0.0, -UP)) is None
    other = said(mode, STANDS, (way, 0.0, -5.0 * way), gravity=(0.0, -UP))
    assert other == "touch slides the other way"
