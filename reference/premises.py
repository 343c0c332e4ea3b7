"""What a case takes for granted and only its motion can tell: that it rolls, winds, moves, lands.

And what only its start can: that a hand-written system starts as the scene does.
"""

from collections.abc import Collection, Iterator, Mapping

import numpy as np

from ..cases.case import Case
from ..cases.difference import apart
from ..cases.frame import PLANE, SPACE
from ..cases.mistake import CaseError, Mistake
from ..cases.observe import motion_of, observe
from ..cases.quantity import table
from ..cases.space.joint import rate_of
from ..cases.trajectory import Array, Trajectory
from .generated.either import Generated
from .motion.bodies import Answer
from .start.sizes import size_of
from .system import Pose, System

STILL = 1e-9  # of the motion's size: smaller changes are no motion
OPEN = 1e-9  # of the mechanism's size: nearer than that, a contact starts closed
ROUNDING = 1e-12  # of the normal force: a wheel that needs no friction rolls without any
START = 1e-12  # of the sizes: two derivations of one start differ by rounding
PLACES = ("x", "y", "z", "attitude", "attitude", "attitude", "attitude")
RATES = ("vx", "vy", "vz", "omega_1", "omega_2", "omega_3")
FIELDS = {PLANE: ("x", "y", "angle", "vx", "vy", "omega"), SPACE: (*PLACES, *RATES)}
UNITS = {"x": "m", "y": "m", "z": "m", "angle": "rad", "attitude": "1"}
UNITS |= {"vx": "m/s", "vy": "m/s", "vz": "m/s"} | dict.fromkeys(("omega", *RATES[3:]), "rad/s")


def check_start(case: Case, system: System, generated: Generated) -> None:
    """Raises CaseError with what a hand-written system starts otherwise than the scene does."""
    mode, *state = system.start()
    own = system.modes[mode].poses(0.0, *state)
    assembled = generated.base.where.poses(*generated.start()[1:])
    if found := list(_otherwise(case, own, assembled)):
        raise CaseError(found)


def _otherwise(
    case: Case, own: Mapping[str, Pose], assembled: Mapping[str, Pose]
) -> Iterator[Mistake]:
    """At what the file gives; at the body, if it gives nothing of what differs."""
    names, frame = list(assembled), case.scene.frame
    fields = FIELDS[frame]
    a, b = (np.array([poses[name] for name in names], float) for poses in (own, assembled))
    if frame is SPACE:  # a quaternion and its opposite are the same attitude
        same = np.sum(a[:, frame.attitude] * b[:, frame.attitude], axis=1, keepdims=True) >= 0
        a[:, frame.attitude] *= np.where(same, 1.0, -1.0)
    size = np.max(np.abs(b), axis=0)
    kinds = [(frame.place, size_of(case)), (frame.attitude, 1.0)]
    kinds += [(frame.velocity, 0.0), (frame.spin, 0.0)]
    columns = range(frame.width)
    least = {i: max(least, *size[kind]) for kind, least in kinds for i in columns[kind]}
    for row, name in enumerate(names):
        apart = [abs(a[row, i] - b[row, i]) for i in columns]
        differ = [i for i, d in enumerate(apart) if not d <= START * least[i]]
        given = (
            [i for i in differ if fields[i] in case.initial[name].given]
            if name in case.initial
            else []
        )
        for i in given or sorted(differ, key=lambda i: -apart[i])[:1]:
            what = (
                f"{case.system} starts {name} with {fields[i]} = {a[row, i]:.6g} "
                f"{UNITS[fields[i]]}, the "
                f"scene with {b[row, i]:.6g}: leave out `system`, then the scene alone answers"
            )
            yield case.mistake(("initial", name, *([fields[i]] if given else [])), what)


def check_shares(case: Case, built: Answer) -> None:
    """Raises CaseError with the forces that are asked for, where only their sum is determined."""
    modes = [built.system.modes[name] for name in dict.fromkeys(built.followed.modes)]
    shared = {name for mode in modes for name in mode.undetermined}
    asked = [(("allow", name), name) for name in case.allow]
    asked += [(("events", name), event.quantity) for name, event in case.events.items()]
    what = (
        "{} is not determined: several points of the body stick there, and only the sum of their "
        "frictions is known; leave it out"
    )
    if found := [case.mistake(path, what.format(name)) for path, name in asked if name in shared]:
        raise CaseError(found)


def check_premises(case: Case, motion: Trajectory, happened: Collection[str | None]) -> None:
    """Raises CaseError with what the motion contradicts: the first kind of mistake there is.

    happened: the names of the changes of mode, as `touch lands`.
    """
    for mistakes in (
        _unsaid(case, motion, happened),
        _slipping(case, motion),
        _beside(case, motion),
        _wound(case, motion),
        _still(case, motion),
    ):
        if found := list(mistakes):
            raise CaseError(found)


def _unsaid(case: Case, motion: Trajectory, happened: Collection[str | None]) -> Iterator[Mistake]:
    """A contact that starts above the floor and lands has to say so: often it is a slip of the pen.

    One that has not landed by the end is no mistake: there is nothing to say yet.
    """
    said = {event.quantity for event in case.events.values() if event.value == 0.0}
    size = size_of(case)
    touched = {c.name: c.plane.name for c in case.scene.contacts.values() if c.ideal is None}
    touched |= {pair.name: pair.on for pair in case.scene.pairs.values()}
    for name, on in touched.items():
        gap = float(observe(case.scene, motion, f"{name}.gap")[0])
        lands = f"{name} lands" in happened
        if lands and gap > OPEN * size and f"{name}.gap" not in said:
            what = (
                f"starts {gap:.3g} m above the {on}; if it is meant to fall on it, "
                f"name the event: events: {{lands: {{{name}.gap: falls to zero}}}}"
            )
            yield case.mistake(("scene", "contacts", name), what)


def _beside(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """What is pushed by a face is between its ends, at every sample."""
    for pair in case.scene.pairs.values():
        if pair.face is None:
            continue
        off = pair.beyond(motion_of(case.scene, motion))
        off &= motion.reactions[f"{pair.name}.normal"] > 0
        if np.any(off):
            what = (
                f"{pair.at} has left the {pair.on} at t = {motion.times[np.argmax(off)]:.3g} s, "
                "where it is past its end: shorten the duration, or name what it then touches"
            )
            yield case.mistake(("scene", "contacts", pair.name), what)


def _slipping(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """Rolling or pivoting is assumed: |λ_t| ≤ μ λ_n and λ_n > 0 at every sample.

    Names the first time at which it fails, and the μ that would be enough.
    """
    for contact in case.scene.contacts.values():
        if contact.ideal is None:
            continue
        doing = "rolling" if contact.ideal == "rolling" else "pivoting"
        normal = motion.reactions[f"{contact.name}.normal"]
        tangent = _along_floor(motion, contact.name)
        fails = tangent > (contact.friction + ROUNDING) * normal
        fails |= (_carried(case, motion) if contact.ahead_of else normal) <= 0
        if not np.any(fails):
            continue
        stands = normal > 0 if contact.ahead_of else np.full(len(normal), True)
        first = int(np.argmax(fails))
        t = motion.times[first]
        if normal[first] <= 0:
            what = f"the floor would have to pull at t = {t:.3g} s: {contact.body} leaves it"
        else:
            what = (
                f"{doing} is not possible with friction {contact.friction:.3g}: at t = {t:.3g} s "
                f"it would slip; {_needed(normal[stands], tangent[stands], contact.body, doing)}"
            )
        yield case.mistake(("scene", "contacts", contact.name, "ideal"), what)


def _carried(case: Case, motion: Trajectory) -> Array:
    """(N,) what the feet carry [N] that stand one after the other."""
    feet = [name for name, contact in case.scene.contacts.items() if contact.ahead_of]
    return np.sum([motion.reactions[f"{name}.normal"] for name in feet], axis=0)


def _along_floor(motion: Trajectory, contact: str) -> Array:
    """(N,) how large the floor's friction is [N]."""
    if f"{contact}.tangent" in motion.reactions:
        return np.abs(motion.reactions[f"{contact}.tangent"])
    return np.hypot(*(motion.reactions[f"{contact}.{axis}"] for axis in ("fx", "fy")))


def _needed(normal: Array, tangent: Array, body: str, doing: str) -> str:
    if np.any(normal <= 0):
        return f"later {body} would even leave the floor"
    return f"{doing} all the way needs {np.max(tangent / normal):.3g}"


def _wound(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """In space a state holds attitudes, which tell a joint's angle within half a turn."""
    if case.scene.frame is not SPACE:
        return
    for force in case.scene.forces.values():
        if not force.winds:
            continue
        angle = observe(case.scene, motion, f"{force.name}.angle")
        rate = observe(case.scene, motion, f"{force.about}.{rate_of(force.turn or 'angle')}")
        # Between two samples as the cubic through them goes, which has their rates.
        between = (angle[1:] + angle[:-1]) / 2 - np.diff(rate) * np.diff(motion.times) / 8
        wound = np.abs(angle) > np.pi
        wound[1:] |= np.abs(between) > np.pi
        if np.any(wound):
            what = (
                f"is wound by more than half a turn at t = {motion.times[np.argmax(wound)]:.3g} s, "
                "and in space its torque is known within that: shorten the duration, or turn less"
            )
            yield case.mistake(("scene", "forces", force.name), what)


def _still(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """A place or velocity that stays what it was proves nothing, unless that is the claim."""
    known = table(case.scene)
    states = np.concatenate(list(motion.states.values()))
    for name in (name for name in case.allow if name in known):  # the rest are of events
        quantity = known[name]
        claimed = name in case.stays
        if (case.rests and not claimed) or quantity.kind not in ("coordinate", "velocity"):
            continue
        samples = observe(case.scene, motion, name)
        # a place held at 0 trembles by rounding, which is small only beside the other bodies'
        size = max(
            np.max(np.abs(samples)),
            np.max(np.abs(states[:, case.scene.frame.alike(quantity.unit)]), initial=0.0),
        )
        moved = _moved(samples)
        still = moved <= STILL * size
        if still and not claimed:
            at = "as it is" if samples.ndim > 1 else f"{samples[0]:.6g}"
            what = f"never moves: it stays {at}; leave it out, or say what is claimed: "
            yield case.mistake(("allow", name), f"{what}`stays: [{name}]`, or `rests: true` of all")
        elif claimed and not still:
            what = f"moves by {moved:.3g} {quantity.unit}"
            yield case.mistake(("stays", case.stays.index(name)), what)


def _moved(samples: Array) -> float:
    """How far a quantity goes; of an attitude, from where it began."""
    return float(np.ptp(samples) if samples.ndim == 1 else np.max(apart(samples, samples[:1])))
