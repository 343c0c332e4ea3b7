"""A disk that rolls too slowly falls: the contact that carries it must not flutter."""

import numpy as np
import pytest
from given.engine_space import STILL, simulated, spatial, state

from textmech.cases.scene import Anchor
from textmech.cases.scene.body import Body
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.rotation import about, turned

R, M = 0.25, 1.3
J = M * R * R / 4
DISK = Body(
    "disk",
    "disk",
    M,
    (J, 2 * J, J, 0.0, 0.0, 0.0),
    {"center": STILL},
    R,
    (0.0, 1.0, 0.0),
    frame=SPACE,
)
SCENE = spatial(
    [DISK], contacts=[spatial_contact("touch", Anchor("disk", "center"), 1.0, rim=True)]
)


@pytest.mark.slow
def test_a_disk_that_falls_keeps_its_normal_force() -> None:
    """It rises to 24 N and more as the disk falls, alike at two steps, to 0.015 N.

    With d = 0.9999 contact is lost again and again, and N is 13 N off.
    """
    lean, spin = np.radians(2.0), 2.2
    q, omega = np.array(about((1.0, 0.0, 0.0), lean)), np.array([0.0, spin, 0.0])
    up = turned(q, (0.0, 0.0, R))  # from the lowest point to the centre
    begun = state((0.0, 0.0, up[2]), q, np.cross(turned(q, omega), up), omega)
    times = np.linspace(0.0, 1.0, 26)
    normals, energies = [], []
    for step in (4e-4, 2e-4):
        motion = simulated(SCENE, {"disk": begun}, times, step, ["touch.normal"])
        normals.append(motion.reactions["touch.normal"])
        rows = motion.states["disk"]
        turning = J * (rows[:, 10] ** 2 + 2 * rows[:, 11] ** 2 + rows[:, 12] ** 2)
        moving = M * np.sum(rows[:, 7:10] ** 2, axis=1)
        energies.append((turning + moving) / 2 + M * 9.80665 * rows[:, 2])
    assert np.max(normals[1]) > 20.0
    assert np.max(np.abs(normals[0] - normals[1])) < 0.1
    assert np.max(np.abs(energies[1] / energies[1][0] - 1)) < 1e-3
