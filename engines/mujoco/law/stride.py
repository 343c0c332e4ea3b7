"""Which feet meet MuJoCo's floor: a pair with a negative margin finds no contact."""

from dataclasses import dataclass

import mujoco

from ....cases.scene import Anchor, Scene
from ...stride import Stride, stride

_NEVER = -1e3  # m, the margin of a pair that no depth closes


@dataclass
class Feet:
    """The feet of a scene in a model."""

    model: mujoco.MjModel
    data: mujoco.MjData
    stride: Stride

    def look(self) -> None:
        """Before a step."""
        mujoco.mj_kinematics(self.model, self.data)
        self.stride.look(self._place)
        self._tell()

    def remember(self) -> dict[str, bool]:
        """What a reading of this state needs."""
        return dict(self.stride.meets)

    def recall(self, noted: dict[str, bool]) -> None:
        """The feet as they were."""
        self.stride.meets = dict(noted)
        self._tell()

    def _place(self, at: Anchor) -> tuple[float, float]:
        x, y, _ = self.data.site(str(at)).xpos
        return float(x), float(y)

    def _tell(self) -> None:
        for name, meets in self.stride.meets.items():
            self.model.pair_margin[self.model.pair(name).id] = 0.0 if meets else _NEVER


def feet(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> Feet | None:
    """At the start of the data: who lies on the floor there has been sunk into it."""
    mujoco.mj_kinematics(model, data)
    standing = [name for name in scene.touching if data.geom(name).xpos[1] < 0.0]
    begun = stride(scene, standing)
    if begun is None:
        return None
    found = Feet(model, data, begun)
    found.look()
    return found
