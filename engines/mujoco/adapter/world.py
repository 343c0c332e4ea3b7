"""The functions that differ between MuJoCo's plane and its space; `MuJoCo` has the verbs."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any

import mujoco

from ....cases.fields.signal import Signal
from ....cases.trajectory import Trajectory
from ...engine import Choice, Plan, Realised, Start

Built = tuple[mujoco.MjModel, mujoco.MjData]


@dataclass(frozen=True)
class World:
    """Called with a scene and its start; functions of a run also with its step [s] and plan.

    settles: whether bodies start as deep in the floor as it carries them. best: the tuned recipe,
    as a user writes it. recipes: those of contacts, by their words; worth: which to try. met: what
    touches. closed: whether anything lies on the floor. soft: the groups of soft constraints. lent:
    what is compiled, for one run. built: the scene with what stands for joints that MuJoCo has not,
    and its start.
    """

    unbuildable: Callable[[Any], str | None]
    ways: Callable[..., tuple[Realised, ...]]
    plan: Callable[..., Plan]
    tuned: Callable[..., list[Choice]]
    best: Callable[..., list[Choice]]
    recipes: Mapping[str, Callable[[Any], list[Choice]]]
    worth: Callable[[Any], list[str]]
    met: Callable[[Any], Sequence[Any]]
    closed: Callable[[Any, Start], bool]
    soft: Callable[[Any], list[str]]
    with_own: Callable[..., list[Choice]]
    compiled: Callable[..., Built]
    placed: Callable[..., tuple[mujoco.MjModel, mujoco.MjData, Any]]
    lent: Callable[..., AbstractContextManager[Built]]
    measured: Callable[..., dict[str, float]]
    mjcf: Callable[..., str]
    signals: Callable[[Any], list[Signal]]  # of the actuators' controls, in their order
    simulate: Callable[..., Trajectory]
    built: Callable[..., tuple[Any, Start]] = lambda scene, start: (scene, start)
