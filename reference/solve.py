"""Case → reference motion with its own certificate: the only door to the mechanics.

The motion is the hand-written system's where there is one, else the generated mechanism's.
"""

import ctypes
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from ..cases.case import Case
from ..cases.mistake import CaseError, Mistake
from ..cases.scene.frame import SPACE
from ..cases.scene.quantity import needed_by_events, table
from ..cases.trajectory import Trajectory
from .assumptions import check_premises, check_start, pressed
from .certificate.agreement import Check
from .certificate.certify import certify
from .certificate.errors import beyond
from .coverage import noting
from .determined import check_determined
from .integrators.now import begun, doing
from .islands import Island, joined, parts, together
from .mechanism.modes.mechanism import Mechanism, PlanarMechanism, SpatialMechanism
from .motion.bodies import Answer, Beside
from .motion.follow import Followed, follow
from .refusal import bounded, refusals, unreached
from .start.assembly import assembled, closure_of, equally_good_start
from .start.planar_closure import PlanarClosure
from .start.spatial_closure import SpatialClosure
from .states.answer import answered
from .system import Array, Pose, System, instant
from .systems import written as written_system
from .systems.states.stated import STATED


@dataclass(frozen=True)
class Solution:
    """The reference motion of a case, and why it can be believed."""

    trajectory: Trajectory
    system: str  # which system moved: its name, or `generated`
    checks: tuple[Check, ...]
    equations: frozenset[str]  # the book's, executed on the way

    @property
    def holds(self) -> bool:
        return all(check.holds for check in self.checks)


def solve(case: Case) -> Solution:
    """The certified motion of a case at its sample times, or its states with their quantities.

    Raises CaseError where the case cannot be started, its idealisation does not hold, or it asks
    more than can be certified.
    """
    begun(case.name)
    with noting() as equations, bounded(case), one_thread():
        motion, checks = _solve_islands(case) if case.states is None else answered(case)
    return Solution(motion, case.system or "generated", checks, frozenset(equations))


def _solve_islands(case: Case) -> tuple[Trajectory, tuple[Check, ...]]:
    islands, mistakes, cases = list[Island](), list[Mistake](), parts(case)
    for k, part in enumerate(cases, start=1):
        if len(cases) > 1:
            begun(f"{case.name}, island {k} of {len(cases)}")
        try:
            islands.append(_solve_part(part))
        except CaseError as error:
            mistakes += error.mistakes
    if mistakes:
        raise CaseError(mistakes)
    alone = islands[0].motion, islands[0].checks
    motion, checks = alone if len(cases) == 1 else together(case, islands)
    if wrong := beyond(case, checks):
        raise CaseError(wrong)
    return motion, checks


def _solve_part(case: Case) -> Island:
    """The motion of what hangs together, and its checks."""
    doing("its start")
    written = _written(case)
    generated = mechanism(case)
    with refusals(case, generated):
        if written:
            check_start(case, written, generated)
        built, answer = _answers(case, written, generated, case.times)
        doing("its quantities")
        opened = check_determined(case, built, generated)
        motion = _motion(case, built, answer)
        marched = built.march(forces=pressed(case))  # in coordinates that see each turn
        check_premises(case, marched, built.followed)
        if built.turns.missed is not None:
            raise unreached(case, *built.turns.missed)
        checks = (*certify(case, answer, built, generated, motion, marched), *opened)
    return Island(case, motion, checks, generated.base)


def _answers(
    case: Case, written: System | None, generated: Mechanism, times: Array
) -> tuple[Answer, Answer]:
    """The generated mechanism's motion, and the answer: the written system's, if there is one."""
    system, asked = written or generated, _accelerations(case)
    followed = follow(system, times, every=bool(case.events))
    moved = followed if system is generated else follow(generated, times)
    built = Answer(generated, moved, accelerates=asked, scene=case.scene)
    if system is generated:
        return built, built
    beside = reactions_of(generated, moved, followed)
    return built, Answer(system, followed, beside, asked, case.scene)


def _motion(case: Case, built: Answer, answer: Answer) -> Trajectory:
    """The answer's bodies at the samples, with its record if the case asks for events."""
    motion = _switched(answer, answer.trajectory(case.times), case.duration)
    if case.events:
        ended = _phase_ends(built.followed, answer.followed)
        motion = replace(motion, record=replace(answer.record(forces=_felt(case)), ended=ended))
    return motion


def _switched(answer: Answer, motion: Trajectory, end: float) -> Trajectory:
    """The motion with the times at which it switches."""
    followed = answer.followed
    corners = [t for t in answer.system.corners if 0.0 < t < end]
    return replace(
        motion,
        switches=np.array([*(change.time for change in followed.changes), *corners], dtype=float),
        blows=np.array([change.time for change in answer.blows()], dtype=float),
        endless=followed.endless,
    )


def motion_of(case: Case, *, forces: bool = True) -> Callable[[Array], Trajectory]:
    """Returns a function for the motion that `solve` certifies at other times [s] up to its end.

    It is followed once more, and each state at another time is a step from there. forces: whether
    reactions are asked for.
    """
    begun(case.name)
    answers = list[tuple[Case, Mechanism, Answer]]()
    with bounded(case), one_thread():
        for part in parts(case):
            generated = mechanism(part)
            with refusals(part, generated):
                _, answer = _answers(part, _written(part), generated, part.times)
            answers.append((part, generated, answer))

    def at(times: Array) -> Trajectory:
        islands = list[Island]()
        with one_thread():
            for part, generated, answer in answers:
                motion = _switched(answer, answer.at(times, forces=forces), part.duration)
                islands.append(Island(part, motion, (), generated.base))
        return islands[0].motion if len(islands) == 1 else joined(case, islands, times)

    return at


def mechanism(case: Case) -> Mechanism:
    """The mechanism of a case's scene at its start. Raises CaseError as `assemble` does."""
    closure = closure_of(case)
    q, v = assembled(closure)
    generated = _build(case, closure, q, v)
    if (other := equally_good_start(closure, q, v)) is not None:
        generated.beside = _build(case, closure, *other)
    return generated


def _build(case: Case, closure: PlanarClosure | SpatialClosure, q: Array, v: Array) -> Mechanism:
    if case.scene.frame is SPACE:
        return SpatialMechanism(case.scene, (q, v))
    inner = [force.begins for force in case.scene.inner().values()]
    start = np.append(q, inner), v
    return PlanarMechanism(case.scene, start, closure.size, instant(case.duration))


def _written(case: Case) -> System | None:
    """The hand-written system, if there is one. Raises CaseError for what it says it cannot be."""
    if case.system in STATED:
        what = f"{case.system!r} answers for states, and this is a motion"
        raise CaseError([case.mistake(("system",), what)])
    try:
        return written_system(case.system, case.parameters) if case.system else None
    except ValueError as error:
        raise CaseError([case.mistake(("parameters",), f"{case.system}: {error}")]) from error


def reactions_of(generated: Mechanism, own: Followed, followed: Followed) -> Beside:
    """The generated modes' reactions on the written motion, phase by phase.

    There are none in a phase that only a second answer has. With another count of phases they are
    those of a phase that is not the motion's, and the certificate says so: its events differ.
    """
    same = len(own.phases) == len(followed.phases)

    def reactions(phase: int, t: float, poses: Mapping[str, Pose]) -> Mapping[str, float]:
        if phase >= len(own.phases):
            if same:
                return {}
            phase = len(own.phases) - 1
        mode = generated.modes[own.phases[phase]]
        return mode.reactions(t, *generated.base.place(poses))

    return reactions


def _phase_ends(own: Followed, followed: Followed) -> tuple[str, ...]:
    """Names of what ended each phase, by the generated mechanism, where both motions agree."""
    if len(own.changes) != len(followed.changes):
        return ()
    return (*(change.name or "" for change in own.changes), "")


def _accelerations(case: Case) -> bool:
    """Whether an acceleration is asked for."""
    known = table(case.scene)
    return any(known[name].kind == "acceleration" for name in case.allow if name in known)


def _felt(case: Case) -> bool:
    """Whether an event is defined by a force, or a force asked for at an event."""
    known = table(case.scene)
    return any(known[name].kind == "force" for name in needed_by_events(case.events, case.allow))


# Linear algebra on one thread: matrices here are small, and threads wait for each other.
#
# A chain of 20 bars takes 36 CPU s with OpenBLAS's own choice on two cores, and 3 on one thread;
# and how many threads share a product decides its last bit.


# As the wheels of numpy and scipy spell them, with 32 and with 64 bit integers.
SPELLED = [f"{before}{{}}{after}" for before in ("scipy_openblas_", "openblas_")
           for after in ("64_", "")]  # fmt: skip


@contextmanager
def one_thread() -> Iterator[None]:
    """One thread for OpenBLAS within the block, where numpy or scipy bring it; then as before."""
    before = [count() for count, _ in _libraries()]
    for _, set_count in _libraries():
        set_count(1)
    try:
        yield
    finally:
        for (_, set_count), threads in zip(_libraries(), before, strict=True):
            set_count(threads)


@cache
def _libraries() -> list[tuple[Callable[[], int], Callable[[int], Any]]]:
    """For each library: what asks and what sets its number of threads; other BLAS stay as is."""
    return [calls for file in _files() if (calls := _calls(file)) is not None]


def _files() -> Iterator[Path]:
    for package in (np, scipy):
        folder = Path(str(package.__file__)).parent
        for beside in (folder.parent / f"{folder.name}.libs", folder / ".dylibs"):
            yield from beside.glob("*openblas*")


def _calls(file: Path) -> tuple[Callable[[], int], Callable[[int], Any]] | None:
    try:
        library = ctypes.CDLL(str(file))  # the one that is loaded already
    except OSError:
        return None
    for name in SPELLED:
        get, put = name.format("get_num_threads"), name.format("set_num_threads")
        if hasattr(library, get) and hasattr(library, put):
            return getattr(library, get), getattr(library, put)
    return None
