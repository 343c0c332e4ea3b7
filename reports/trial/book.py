"""The book's own approximations of dry friction beside the engines: `book.karnopp` and others."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from ...cases.case import Case
from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ...engines.engine import Choice, Engine, Realised, State
from ...reference.approximations.approximation import DELTA, KINDS, A, Example, approximated
from ...reference.systems import SYSTEMS
from ...reference.systems.dynamometer import Dynamometer
from ...reference.systems.growing_force import GrowingForce

STEP = 1e-3  # s, of the boxcar form: the finest rung then takes 1/16 of it


def approximations(case: Case) -> Iterator["Book"]:
    """One producer for each of (2.91), (2.94), (2.95), where the case is Example 2.3 or 2.4."""
    if case.system is None:
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
    comment: tuple[str, str] = ("# ", "")
    own_step: float | None = STEP

    def realisations(self, scene: Scene) -> tuple[Realised, ...]:
        """The approximation is all there is."""
        return ("native",)

    def refuses(self, scene: Scene) -> str | None:
        """It is only offered where it applies."""
        return None

    def withholds(self, scene: Scene, quantity: str) -> str | None:
        """It knows how the block moves, and no forces of the guide."""
        part, _, field = quantity.rpartition(".")
        forces = ("fx", "fy", "force", "torque", "friction")
        return (
            "adapter: only the motion is read" if part in scene.joints and field in forces else None
        )

    def tied(self, scene: Scene) -> bool:
        """Its band and sharpness are the book's, whatever the step."""
        return False

    def exponents(self, scene: Scene, realised: Realised, *, held: bool) -> tuple[int, ...]:
        """A fixed step that crosses events is of first order."""
        return (1, 2)

    def protocol(self, scene: Scene, start: State, step: float, realised: Realised) -> str:
        """The two numbers of the approximations."""
        sharp = f", A = {A:g} s/m" if self.setting == "smooth" else ""
        return f"band {DELTA:g} m/s{sharp}"

    def choices(self, scene: Scene, step: float) -> list[Choice]:
        """The book's."""
        return [Choice("band", DELTA, "Examples 2.3 and 2.4"), Choice("sharpness", A, "the same")]

    def script(self, scene: Scene, start: State, step: float) -> str:
        """There is no engine to paste it into."""
        return ""

    def measure(self, scene: Scene, start: State) -> dict[str, float]:
        """Its block is the case's."""
        return {"block.mass": self.system.m}

    def run(
        self,
        scene: Scene,
        start: State,
        times: Array,
        step: float,
        *,
        tied_to: float,
        realised: Realised,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        """The motion from rest, as the examples start."""
        found = approximated(self.setting, self.system, times, step)
        return found if record else replace(found, record=None)

    def prepare(
        self, scene: Scene, start: State, step: float, *, realised: Realised
    ) -> Callable[[int], None]:
        """There is no bare loop to compare with."""
        raise NotImplementedError
