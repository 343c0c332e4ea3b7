"""How fast a scene in space is set off and driven: turning costs steps, free or not."""

from collections.abc import Iterator
from typing import Any

from ....mistake import Path
from ....signal import fastest
from ....space.scene import SpatialScene
from ...grammar.file import File


def spins(file: File, scene: Any) -> Iterator[tuple[float, Path]]:
    """How fast [rad/s] bodies and joints start to turn, and how fast they are driven."""
    driven: SpatialScene = scene
    mine = [name for name in file.initial if name in {**driven.bodies, **driven.joints}]
    for name, start in ((name, file.initial[name]) for name in mine):
        turning = [*(f"omega_{i}" for i in (1, 2, 3))]
        if name in driven.joints:
            rates = driven.joints[name].rates
            turning += [rate for rate, freedom in rates.items() if freedom.kind == "turn"]
        for key in turning:
            yield abs(start.given.get(key, 0.0)), ("initial", name)
    for rate, signal in driven.drives.items():
        part, _, name = rate.rpartition(".")
        path = ("scene", "drive", rate)
        yield signal.angular_frequency, path
        freedom = driven.joints[part].rates.get(name) if part in driven.joints else None
        if freedom is not None and freedom.kind == "turn":
            yield fastest(signal, file.duration), path
