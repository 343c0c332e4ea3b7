"""The equal-physics audit: an engine must hold the case's numbers before it takes a step."""

from ...cases.observe import observe
from ...cases.scene import Scene
from ...cases.trajectory import Trajectory
from .trial import Trial

EQUAL = 1e-12  # relative: both sides hold the same doubles, up to a product or a sum


def expected(scene: Scene, start: Trajectory) -> dict[str, float]:
    """What `Engine.measure` should find, from the scene and the start."""
    numbers = {"gravity.x": scene.gravity[0], "gravity.y": scene.gravity[1]}
    for element in scene.elements():
        numbers |= {f"{element.name}.{key}": x for key, x in element.numbers().items()}
    for name in ("energy.kinetic", "momentum.x", "momentum.y"):
        numbers[name] = float(observe(scene, start, name)[0])
    return numbers


def audit(trial: Trial) -> tuple[float, str]:
    """The largest relative difference, and what it is about; engines may not know everything."""
    wanted = expected(trial.case.scene, trial.reference)
    found = trial.engine.measure(trial.case.scene, trial.start)
    worst, because = 0.0, f"{len(found)} numbers read back"
    for name, value in found.items():
        difference = abs(value - wanted[name]) / max(abs(wanted[name]), 1.0)
        if not difference <= worst:  # NaN counts
            worst, because = difference, f"{name} is {value!r}, the case says {wanted[name]!r}"
    return worst, because
