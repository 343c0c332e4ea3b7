"""The equal-physics audit: an engine must hold the case's numbers before it takes a step."""

import math
from collections.abc import Mapping

from ....cases.scene import Scene
from ....cases.scene.frame import PLANE
from ....cases.scene.observe import observe
from ....cases.trajectory import Trajectory
from .answers import read_back
from .trial import Trial

EQUAL = 1e-12  # relative: both sides hold the same doubles, up to a product or a sum
NOTHING = EQUAL / 10  # its last bits are another machine's


def expected(scene: Scene, start: Trajectory) -> dict[str, float]:
    """The numbers that `Engine.measure` should find, by name, from the scene and the start."""
    axes = scene.frame.axes
    numbers = {f"gravity.{axis}": g for axis, g in zip(axes, scene.gravity, strict=True)}
    for element in scene.elements():
        numbers |= {f"{element.name}.{key}": x for key, x in element.numbers().items()}
    for name in ("energy.kinetic", *(f"momentum.{axis}" for axis in axes)):
        numbers[name] = float(observe(scene, start, name)[0])
    return numbers


def audit(trial: Trial) -> tuple[float, str]:
    """The largest relative difference, and what it is about; engines may not know everything.

    Rounding is nothing: what is below a tenth of what counts as equal is told as 0.
    """
    wanted, measured, off = audited(trial)
    worst = max(off, key=off.__getitem__, default="")
    if off.get(worst, 0.0) <= NOTHING:
        return 0.0, f"{len(measured)} numbers read back"
    what = f"{worst} is {measured[worst]!r}, the case says {wanted[worst]!r}"
    return off[worst], what


def audited(trial: Trial) -> tuple[dict[str, float], dict[str, float], dict[str, float]]:
    """By name the numbers of the case, those that the engine reads back, and how far each is off.

    Raises BadAnswer.
    """
    wanted = expected(trial.case.scene, trial.reference)
    measured = read_back(trial.engine.measure(trial.case.scene, trial.start), wanted)
    sizes = _sizes(trial.case.scene, wanted)
    off = {n: _relative(x - wanted[n], sizes.get(n, wanted[n])) for n, x in measured.items()}
    return wanted, measured, off


def _relative(difference: float, size: float) -> float:
    """Returns a difference relative to a number, however small; NaN differs most of all."""
    relative = abs(difference / size) if size else abs(difference)
    return math.inf if math.isnan(relative) else relative


def _sizes(scene: Scene, wanted: Mapping[str, float]) -> dict[str, float]:
    """Sizes of vectors, whose components may cancel to nothing: g, and p ≤ √(2 m T); of tensors."""
    mass = sum(body.mass for body in scene.bodies.values())
    momentum = math.sqrt(2 * mass * wanted["energy.kinetic"])
    gravity = math.hypot(*scene.gravity)
    sizes = {"gravity": gravity, "momentum": momentum}
    vectors = {f"{name}.{axis}": x for name, x in sizes.items() for axis in scene.frame.axes}
    return vectors | _tensors(scene)


def _tensors(scene: Scene) -> dict[str, float]:
    """For each entry of a tensor: the largest of its entries; products of inertia may be zero."""
    if scene.frame is PLANE:
        return {}
    return {
        f"{name}.{key}": max(map(abs, body.inertia))
        for name, body in scene.bodies.items()
        if body.turns
        for key in body.numbers()
        if key.startswith("inertia")
    }
