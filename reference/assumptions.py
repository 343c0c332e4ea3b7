"""Checks what a case takes for granted and only its motion can tell: it rolls, moves, lands.

And what only its start can: that a hand-written system starts as the scene does.
"""

import math
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Any

import numpy as np

from ..cases.case import Case
from ..cases.fields.kind import WORK
from ..cases.mistake import CaseError, Mistake
from ..cases.scene import Contact
from ..cases.scene.difference import deviation
from ..cases.scene.frame import PLANE, SPACE
from ..cases.scene.islands import islands
from ..cases.scene.observe import motion_of, observe
from ..cases.scene.passages import dips, smooth
from ..cases.scene.quantity import table
from ..cases.trajectory import Array, Trajectory
from .mechanism.modes.mechanism import Mechanism
from .motion.event_location import TOUCH
from .motion.follow import Followed, Touch
from .start.assembly import size_of
from .system import Pose, System

HELD = 1e-12  # of a place: so far what is held drifts, or trembles by rounding
STILL = 1e-9  # of the motion's size: smaller changes are no motion
NOISE = 1e-14  # of what carries it through its own size: rounding, where nothing has a size
OPEN = 1e-9  # of the mechanism's size: nearer than that, a contact starts closed
HAIR = 1e-9  # of a coefficient of friction
TURNS = 5  # of Newton: twice the digits each
ROUNDING = 1e-12  # of the normal force: a wheel that needs no friction rolls without any
START = 1e-12  # of the sizes: two derivations of one start differ by rounding
PLACES = ("x", "y", "z", "attitude", "attitude", "attitude", "attitude")
RATES = ("vx", "vy", "vz", "omega_1", "omega_2", "omega_3")
FIELDS = {PLANE: ("x", "y", "angle", "vx", "vy", "omega"), SPACE: (*PLACES, *RATES)}
LEAST: Mapping[str, Callable[[Any], float]] = {"muscle": lambda muscle: -muscle.hill_a}
"""By a force element's word, what has to act [N] on what contracts in it."""
UNITS = {"x": "m", "y": "m", "z": "m", "angle": "rad", "attitude": "1"}
UNITS |= {"vx": "m/s", "vy": "m/s", "vz": "m/s"} | dict.fromkeys(("omega", *RATES[3:]), "rad/s")


def check_start(case: Case, system: System, generated: Mechanism) -> None:
    """Raises CaseError with what a hand-written system starts otherwise than the scene does."""
    mode, *state = system.start()
    poses = system.modes[mode].poses(0.0, *state)
    if unknown := [name for name in case.scene.bodies if name not in poses]:
        has = ", ".join(name for name, pose in poses.items() if len(pose) > 1)
        what = f"{case.system} has no body {unknown[0]!r}; its bodies: {has}"
        raise CaseError([case.mistake(("scene", "bodies", unknown[0]), what)])
    own = {name: poses[name] for name in case.scene.bodies}  # a start of inner states is no body's
    assembled = generated.base.where.poses(*generated.start()[1:])
    if mistakes := list(_otherwise(case, own, assembled)):
        raise CaseError(mistakes)


def _otherwise(
    case: Case, own: Mapping[str, Pose], assembled: Mapping[str, Pose]
) -> Iterator[Mistake]:
    """Yields a mistake at each entry, or else body, of which the written start differs."""
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
        errors = [abs(a[row, i] - b[row, i]) for i in columns]
        differ = [i for i, d in enumerate(errors) if not d <= START * least[i]]
        given = (
            [i for i in differ if fields[i] in case.initial[name].given]
            if name in case.initial
            else []
        )
        for i in given or sorted(differ, key=lambda i: -errors[i])[:1]:
            what = (
                f"{case.system} starts {name} with {fields[i]} = {a[row, i]:.6g} "
                f"{UNITS[fields[i]]}, the "
                f"scene with {b[row, i]:.6g}: leave out `system`, then the scene alone answers"
            )
            yield case.mistake(("initial", name, *([fields[i]] if given else [])), what)


def pressed(case: Case) -> bool:
    """Whether a premise is about forces: what rolls, pivots or is pushed by a face."""
    ideal = any(contact.ideal is not None for contact in case.scene.contacts.values())
    return ideal or any(pair.face is not None for pair in case.scene.pairs.values())


def check_premises(case: Case, motion: Trajectory, followed: Followed) -> None:
    """Raises CaseError with what the motion contradicts: the first kind of mistake there is.

    motion: at every step of the march, whatever the samples are; followed: the changes of mode.
    """
    happened = [change.name for change in followed.changes]
    for kind in (
        _unsaid(case, motion, happened),
        _grazes(case, followed.touched),
        _slipping(case, motion),
        _past_ends(case, motion),
        _motionless(case, motion),
        _blow_work(case, motion),
        _beyond_law(case, motion),
    ):
        if mistakes := list(kind):
            raise CaseError(mistakes)


def _unsaid(case: Case, motion: Trajectory, happened: Collection[str | None]) -> Iterator[Mistake]:
    """Yields a mistake for a contact that starts above the floor and lands, unless it says so.

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


def _grazes(case: Case, touched: Collection[Touch]) -> Iterator[Mistake]:
    """Yields a mistake where rounding says how it goes on, or whether what is asked happens."""
    for touch in touched:
        part, _, does = (touch.name or "").rpartition(" ")
        part = part.partition(".")[0]
        section = "joints" if part in case.scene.joints else "contacts"
        section = "forces" if part in case.scene.forces else section
        asked = [name for name, e in case.events.items() if e.quantity.rpartition(".")[0] == part]
        places = [("events", name) for name in asked]
        if touch.jumps:
            places = [("scene", section, part)]
        what = (
            f"whether {part} {does} at t = {touch.time:.6g} s is rounding: what tells it comes to "
            f"zero there and turns back, within {TOUCH:.0e} of what it was; change a number"
        )
        for place in places:
            yield case.mistake(place, what)


def _past_ends(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """Yields a mistake where what a face pushes is past the face's end, in any step."""
    bends = case.scene.corners()
    for pair in case.scene.pairs.values():
        if pair.face is None:
            continue
        pushed = motion.reactions[f"{pair.name}.normal"] > 0
        times = list[float]()
        for margin in pair.margins(motion_of(case.scene, motion)):
            times += motion.times[(margin < 0) & pushed].tolist()
            for rows in smooth(motion, bends):
                if np.all(margin[rows] >= 0) and np.any(pushed[rows]):
                    times += [t for t, _ in dips(motion.times[rows], margin[rows])]
        if times:
            what = (
                f"{pair.at} has left the {pair.on} by t = {min(times):.3g} s, "
                "where it is past its end: shorten the duration, or name what it then touches"
            )
            yield case.mistake(("scene", "contacts", pair.name), what)


def _slipping(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """Yields a mistake where what rolls or pivots breaks |λ_t| ≤ μ λ_n or λ_n > 0, in any step.

    Names the first time at which it fails, and the μ that would be enough.
    """
    for contact in case.scene.contacts.values():
        if contact.ideal is None:
            continue
        doing = "rolling" if contact.ideal == "rolling" else "pivoting"
        normal = motion.reactions[f"{contact.name}.normal"]
        tangent, carried = _along_floor(motion, contact.name), _support(case, motion, contact)
        fails = tangent > (contact.friction + ROUNDING) * normal
        fails |= (carried <= 0) | (normal < 0)
        if not np.any(fails):
            yield from _slipping_between(case, motion, contact, normal, carried)
            continue
        first = int(np.argmax(fails))
        t = motion.times[first]
        if carried[first] <= 0 or normal[first] < 0:
            what = _pull_text(contact, float(t))
        else:
            what = (
                f"{doing} is not possible with friction {contact.friction:.3g}: at t = {t:.3g} s "
                f"it would slip; {_needed(case, motion, contact, normal, carried)}"
            )
        yield case.mistake(("scene", "contacts", contact.name, "ideal"), what)


def _pull_text(contact: Contact, t: float) -> str:
    plane = contact.plane.name
    return f"the {plane} would have to pull at t = {t:.3g} s: {contact.body} leaves it"


def _slipping_between(
    case: Case, motion: Trajectory, contact: Contact, normal: Array, carried: Array
) -> Iterator[Mistake]:
    """Yields a mistake where it holds at both ends of a step, and not in it."""
    doing = "rolling" if contact.ideal == "rolling" else "pivoting"
    path = ("scene", "contacts", contact.name, "ideal")
    if pulls := _pulls(case, motion, carried):
        what = _pull_text(contact, min(pulls))
        yield case.mistake(path, what)
    elif slips := _dips_of_friction(case, motion, contact.name, normal, contact.friction):
        what = (
            f"{doing} is not possible with friction {contact.friction:.6g}: at t = "
            f"{min(t for t, _ in slips):.3g} s it would slip; "
            f"{_needed(case, motion, contact, normal, carried)}"
        )
        yield case.mistake(path, what)


def _pulls(case: Case, motion: Trajectory, carried: Array) -> list[float]:
    """When [s] between two steps the floor would have to pull."""
    parts = smooth(motion, case.scene.corners())
    return [t for rows in parts for t, _ in dips(motion.times[rows], carried[rows])]


def _dips_of_friction(
    case: Case, motion: Trajectory, contact: str, normal: Array, mu: float
) -> list[tuple[float, float]]:
    """When [s] between two steps that coefficient is not enough, and which would be."""
    shortfalls = list[tuple[float, float]]()
    for rows in smooth(motion, case.scene.corners()):
        times, pushes = motion.times[rows], normal[rows]
        for side in _friction_each_way(motion, contact):
            for t, low in dips(times, mu * pushes - side[rows]):
                push = float(np.interp(t, times, pushes))
                shortfalls.append((t, mu - low / push if push > 0.0 else mu))
    return shortfalls


def _friction_each_way(motion: Trajectory, contact: str) -> tuple[Array, ...]:
    """(N,) the floor's friction [N] one way and the other; in space its size."""
    along = motion.reactions.get(f"{contact}.tangent")
    return (_along_floor(motion, contact),) if along is None else (along, -along)


def _support(case: Case, motion: Trajectory, contact: Contact) -> Array:
    """(N,) Normal force that carries the body [N]: of one on a corner that of the corner alone.

    Of feet that stand one after the other it is what they carry together.
    """
    feet = [
        name
        for name, other in case.scene.contacts.items()
        if (other.ahead_of if contact.ahead_of else _pivot_together(contact, other))
    ]
    each = [motion.reactions[f"{name}.normal"] for name in feet]
    return each[0] if len(each) == 1 else np.sum(each, axis=0)


def _pivot_together(a: Contact, b: Contact) -> bool:
    """Whether both are points of one body on one plane that only pivot, or one contact."""
    pivots = a.ideal == b.ideal == "pivot"
    return a is b or (pivots and (a.body, a.on) == (b.body, b.on))


def _along_floor(motion: Trajectory, contact: str) -> Array:
    """(N,) how large the floor's friction is [N]."""
    if f"{contact}.tangent" in motion.reactions:
        return np.abs(motion.reactions[f"{contact}.tangent"])
    return np.hypot(*(motion.reactions[f"{contact}.{axis}"] for axis in ("fx", "fy")))


def _needed(case: Case, motion: Trajectory, contact: Contact, normal: Array, carried: Array) -> str:
    """Words for the coefficient of friction that would be enough, or that none is."""
    stands = np.full(len(normal), True) if carried is normal else normal > 0
    pushes, rubs = normal[stands], _along_floor(motion, contact.name)[stands]
    if np.any(pushes <= 0) or _pulls(case, motion, carried):
        return f"elsewhere {contact.body} would even leave the floor"
    # A hair more than at any step: between two steps only what is positive at both can dip.
    enough = max(contact.friction, (1 + HAIR) * float(np.max(rubs / pushes)))
    for _ in range(TURNS):  # Newton's method, from below
        more = _dips_of_friction(case, motion, contact.name, normal, enough)
        enough = max([enough, *(mu for _, mu in more)])
    doing = "rolling" if contact.ideal == "rolling" else "pivoting"
    return f"{doing} all the way needs {_no_less(enough)}"


def _no_less(value: float) -> str:
    """The number in four digits, rounded up: with one that is rounded down it would slip still."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 3)
    return f"{math.ceil(value / digit - ROUNDING) * digit:.4g}"


def _motionless(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """Yields a mistake for a place or velocity that stays constant, unless that is the claim."""
    known = table(case.scene)
    for name in (name for name in case.allow if name in known):  # the rest are of events
        quantity = known[name]
        claimed = name in case.stays
        if quantity.kind not in ("coordinate", "velocity"):
            continue
        samples = observe(case.scene, motion, name)
        moved, still = _range(samples), stays(case, motion, name)
        if case.rests and not claimed:
            if not still:
                what = f"{name} moves by {moved:.3g} {quantity.unit}"
                yield case.mistake(("rests",), what)
        elif still and not claimed:
            at = "as it is" if samples.ndim > 1 else f"{samples[0]:.6g}"
            what = f"never moves: it stays {at}; leave it out, or say what is claimed: "
            yield case.mistake(("allow", name), f"{what}`stays: [{name}]`, or `rests: true` of all")
        elif claimed and not still:
            what = f"moves by {moved:.3g} {quantity.unit}"
            yield case.mistake(("stays", case.stays.index(name)), what)


def stays(case: Case, motion: Trajectory, name: str) -> bool:
    """Whether a place or velocity stays what it was, but for rounding."""
    samples, unit = observe(case.scene, motion, name), table(case.scene)[name].unit
    states = np.concatenate(list(motion.states.values()))
    # a place held at 0 trembles by rounding, which is small only beside the other bodies'
    size = max(
        np.max(np.abs(samples)),
        np.max(np.abs(states[:, case.scene.frame.alike(unit)]), initial=0.0),
    )
    least = STILL * size
    if unit == "m" and samples.ndim == 1:  # where the scene stands is no motion
        least = max(STILL * _spread(motion, case), HELD * size)
    return _range(samples) <= max(least, NOISE * _floor(case, unit))


def _spread(motion: Trajectory, case: Case) -> float:
    """How far [m] any body goes along an axis."""
    columns = case.scene.frame.alike("m")
    each = (np.ptp(states[:, columns], axis=0) for states in motion.states.values())
    return max((float(np.max(far)) for far in each), default=0.0)


def _floor(case: Case, unit: str) -> float:
    """The scale of a unit, also at rest: the mechanism's size or 1 rad, of rates per duration."""
    through = size_of(case) if "m" in unit else 1.0
    return through / case.duration if unit.endswith("/s") else through


def _range(samples: Array) -> float:
    """The range of a quantity; of an attitude, its largest turn from the first."""
    return float(np.ptp(samples) if samples.ndim == 1 else np.max(deviation(samples, samples[:1])))


def _blow_work(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """Yields a mistake for work of a joint's drive where something strikes: a blow has no power."""
    known, frame = table(case.scene), case.scene.frame
    columns = [*frame.alike("m/s"), *frame.alike("rad/s")]
    for name in case.allow:
        part, _, field = name.rpartition(".")
        if field not in WORK or name not in known or part not in case.scene.joints:
            continue
        parts = (island for island in islands(case.scene) if part in island.joints)
        bodies = next(parts, case.scene).bodies
        rates = np.hstack([motion.states[body][:, columns] for body in bodies])
        assert motion.phase is not None  # a march has it
        jumps = np.max(np.abs(np.diff(rates, axis=0)), axis=1) * (np.diff(motion.phase) > 0)
        if np.any(struck := jumps > STILL * np.max(np.abs(rates))):
            what = (
                f"something strikes at {motion.times[int(np.argmax(struck))]:.6g} s, and a blow "
                f"does work through what drives {part} that no power tells: leave it out, or end "
                "before it"
            )
            yield case.mistake(("allow", name), what)


def _beyond_law(case: Case, motion: Trajectory) -> Iterator[Mistake]:
    """Yields a mistake for a Hill muscle under less than −a, where it has no law."""
    muscle: Any
    for name, muscle in case.scene.forces.items():
        if (least := LEAST.get(muscle.word)) is None:
            continue
        length = observe(case.scene, motion, f"{name}.length")
        own = observe(case.scene, motion, f"{name}.{muscle.inner}")
        pulls = muscle.series_stiffness * (length - own)
        beyond = pulls <= least(muscle)
        if beyond.any():
            k = int(np.argmax(beyond))
            what = (
                f"what contracts is pressed by {-pulls[k]:.4g} N at {motion.times[k]:.4g} s, and "
                f"Hill's law holds above {least(muscle):g} N"
            )
            yield case.mistake(("scene", "forces", name), what)
