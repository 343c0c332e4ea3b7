"""The book's own approximations of dry friction beside the engines: `book.karnopp` and others."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from ....cases.case import Case
from ....cases.scene import Scene
from ....cases.scene.quantity import table
from ....cases.trajectory import Array, Trajectory
from ....engines.engine import Choice, Engine, Plan, Start
from ....reference.approximations.approximation import DELTA, KINDS, A, Example, approximated
from ....reference.systems import SYSTEMS
from ....reference.systems.friction.dynamometer import Dynamometer
from ....reference.systems.friction.growing_force import GrowingForce

STEP = 1e-3  # s, of the boxcar form: the finest rung then takes 1/16 of it


def approximations(case: Case) -> Iterator["Book"]:
    """One producer for each of (2.91), (2.94), (2.95), where the case is Example 2.3 or 2.4."""
    if case.system is None or case.states is not None:
        return
    system = SYSTEMS[case.system](**case.parameters)
    if isinstance(system, GrowingForce | Dynamometer):
        yield from (Book(kind, system) for kind in KINDS)


def producers(case: Case, engines: Sequence[Engine], *, book: bool) -> list[Engine]:
    """The engines, and the book's approximations of the case where they are wanted."""
    return [*engines, *(approximations(case) if book else ())]


@dataclass(frozen=True)
class Book:
    """An approximation behind the protocol of `engines.engine`."""

    setting: str
    system: Example
    name: str = "book"
    version: str = "chapter 2"
    own_step: float | None = STEP

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan]:
        """Returns its one plan, a native one; a fixed step that crosses events is of order 1."""
        forces = ("fx", "fy", "force", "torque", "friction")
        sharp = f", A = {A:g} s/m" if self.setting == "smooth" else ""
        return [
            Plan(
                "native",
                held=(1, 2),
                numbers=_numbers,
                protocol=partial(_words, f"band {DELTA:g} m/s{sharp}"),
                withheld={
                    name: "adapter: only the motion is read"
                    for name, quantity in table(scene).items()
                    if (quantity.part in scene.joints and quantity.field in forces)
                    or quantity.kind == "acceleration"
                },
            )
        ]

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        """Returns the mass of its block, which is the case's."""
        return {"block.mass": self.system.m}

    def run(
        self,
        scene: Scene,
        start: Start,
        times: Array,
        step: float,
        plan: Plan,
        *,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        """The motion from rest, as the examples start."""
        trajectory = approximated(self.setting, self.system, times, step)
        return trajectory if record else replace(trajectory, record=None)

    def script(
        self,
        scene: Scene,
        start: Start,
        step: float,
        plan: Plan,
        *,
        title: str = "",
        duration: float = 1.0,
    ) -> str:
        """Returns no script: there is no engine to paste it into."""
        return ""


def _numbers(step: float) -> Sequence[Choice]:
    """Returns the band and the sharpness that the book's examples have."""
    return Choice("band", DELTA, "Examples 2.3 and 2.4"), Choice("sharpness", A, "the same")


def _words(words: str, step: float) -> str:
    return words
