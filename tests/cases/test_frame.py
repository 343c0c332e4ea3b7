"""What a frame tells of a scene's elements, and which scene they may stand in."""

import pickle

import numpy as np
import pytest

from textmech.cases.scene import Anchor, Scene, planar_joint, shape, solid
from textmech.cases.scene.frame import PLANE, SPACE, Frame


@pytest.mark.parametrize("frame", [PLANE, SPACE])
def test_a_frame_is_itself_in_another_process(frame: Frame) -> None:
    """So that `is` may be asked of it."""
    assert pickle.loads(pickle.dumps(frame)) is frame


def test_a_turned_vector() -> None:
    """By 30° about the axis out of the plane, as an angle and as a quaternion."""
    half = np.radians(15.0)
    flat = PLANE.turned(np.array([[2 * half]]), (0.6, 0.2))
    turned = SPACE.turned(np.array([[np.cos(half), 0.0, 0.0, np.sin(half)]]), (0.6, 0.2, 0.1))
    np.testing.assert_allclose(turned, [[*flat[0], 0.1]], atol=1e-15)
    np.testing.assert_allclose(flat, [[0.3 * 3**0.5 - 0.1, 0.3 + 0.1 * 3**0.5]], atol=1e-15)


@pytest.mark.mutant("an element of the plane in a scene of space, and the other way round")
def test_a_scene_takes_no_element_of_another_frame() -> None:
    ball = solid.sphere(name="ball", mass=1.0, radius=0.1, points={})
    disk = shape.disk(name="disk", mass=1.0, radius=0.1, points={})
    pin = planar_joint("pin", "pin", Anchor("ground", "O"), Anchor("ball", "center"))
    down = (0.0, 0.0, -9.8)
    assert Scene(down, {}, {"ball": ball}, {}, {}, {}, frame=SPACE).bodies == {"ball": ball}
    with pytest.raises(ValueError, match="'disk' is not of the scene's frame, SPACE"):
        Scene(down, {}, {"disk": disk}, {}, {}, {}, frame=SPACE)
    with pytest.raises(ValueError, match="'pin' is not of the scene's frame, SPACE"):
        Scene(down, {}, {"ball": ball}, {"pin": pin}, {}, {}, frame=SPACE)
    with pytest.raises(ValueError, match="'ball' is not of the scene's frame, PLANE"):
        Scene((0.0, -9.8), {}, {"ball": ball}, {}, {}, {})
