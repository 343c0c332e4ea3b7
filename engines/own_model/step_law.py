"""Names elements whose law depends on the step, or on a state other than q, v and act."""

from collections.abc import Iterator

import mujoco
import numpy as np

from .model import OwnModel
from .numbers import element, plugins
from .release import column, enabled

OBJECT = mujoco.mjtObj
REASONS = {
    "discrete": "the integrator `discrete` has the step in its law",
    "delay": "a delay or history is counted in steps",
    "early": "`actearly` takes the activation of the next step",
    "sleep": "bodies that sleep have the step in their law",
    "state": "a plugin or a spring that yields has a state outside of qpos, qvel and act",
}


def with_step(own: OwnModel) -> list[str]:
    """Returns in words why a model's law depends on its step, with the elements."""
    elements: dict[str, list[str]] = {}
    for reason, name in _elements(own):
        elements.setdefault(reason, []).append(name)
    return [f"{REASONS[reason]}: {', '.join(names)}" for reason, names in elements.items()]


def _elements(own: OwnModel) -> Iterator[tuple[str, str]]:
    """Yields a reason and an element that has it."""
    m = own.model
    if mujoco.mjtIntegrator(m.opt.integrator).name == "mjINT_DISCRETE":
        yield "discrete", own.places.after("option", "integrator")
    if enabled(m, "mjENBL_SLEEP"):
        yield "sleep", own.places.after("option", "sleep")
    actuator, sensor = OBJECT.mjOBJ_ACTUATOR, OBJECT.mjOBJ_SENSOR
    for reason, kind, has in (
        ("delay", actuator, _has_delay(m, "actuator")),
        ("delay", sensor, _has_delay(m, "sensor")),
        ("early", actuator, m.actuator_actearly),
        ("state", OBJECT.mjOBJ_JOINT, column(m, "jnt_plasticadr") >= 0),
        ("state", OBJECT.mjOBJ_TENDON, column(m, "tendon_plasticadr") >= 0),
        ("state", OBJECT.mjOBJ_FLEX, column(m, "flex_plasticadr") >= 0),
    ):
        for i in map(int, np.flatnonzero(has)):
            yield reason, element(m, own.places, kind, i)
    for kind, i in plugins(m):
        yield "state", element(m, own.places, kind, i)


def _has_delay(m: mujoco.MjModel, word: str) -> np.ndarray:
    return (column(m, f"{word}_delay") != 0) | (column(m, f"{word}_history") != 0).any(axis=1)
