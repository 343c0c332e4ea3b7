"""The equations of a user's model: its engine's parts of them, against the textbook's.

Both see the same numbers, of the compiled model, and share no line of what they make of them.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain, islice

import numpy as np

from ...cases.mistake import plain
from ...cases.trajectory import Array
from ...cases.tree import BIAS, CONSTRAINTS, DRIVEN, MASS, PARTS, PASSIVE, WIDTH, Line, Tree
from ...engines.own_model.constraints import Constraints
from ...engines.own_model.model import OwnModel, State
from ...reference.formalisms import tree_equations as textbook
from ...reference.formalisms.tree_equations import Term
from ...reference.laws import constraints as law

STATES = 100  # half of them of its motion, half drawn
DURATION = 1.0  # s of its motion
ROUNDING = 1e-11  # of the size of its terms: a light finger far from its tree comes to 1e-12


@dataclass
class Part:
    """A part of the equations: how far it is off, in which joint, over how many states.

    off: of the largest that the terms could be, or None where nothing is compared. unread: what the
    model has that is not compared, by element. against: of what it is off, with a unit; bound: by
    how much it may be. span: over how long [s], of a motion.
    """

    name: str
    off: float | None
    joint: str = ""
    states: int = 0
    unread: Sequence[str] = field(default_factory=tuple)
    because: str = ""
    against: str = "from the textbook's"
    bound: float = ROUNDING
    span: float = 0.0

    @property
    def holds(self) -> bool:
        """Whether it is off by its bound at most, as far as it is compared."""
        return self.off is None or self.off <= self.bound


def equations(model: OwnModel, count: int = STATES) -> list[Part]:
    """Compares each part at so many states, of the model's motion and drawn about its start."""
    tree = model.tree
    parts = [Part(name, None, unread=tree.unread.get(name, ())) for name in PARTS]
    if not tree.n:
        return parts
    own = [*model.moving(DURATION)]
    moved = own[:: max(1, len(own) // (count // 2))][: count // 2]
    for state in islice(chain(moved, model.drawn(count)), count):
        ours, theirs = _textbook(tree, state), model.parts(state)
        for part in parts:
            if not part.unread and (part.name != DRIVEN or tree.motors):
                _compare(part, tree, ours[part.name], theirs[part.name])
    parts.append(constraints(model, moved))
    for part in parts:
        if part.name == MASS and not part.holds and (coupling := _branching(tree)):
            part.because = f"{' and '.join(coupling)} couples branches by its armature: {NO_ENTRY}"
    return parts


def constraints(model: OwnModel, states: Iterable[State]) -> Part:
    """Returns how far the forces of constraints are off: in M a + bias = τ + Jᵀ f, or in their law.

    Which f is in its cone and of the model's own law of J a − a_ref, is in `laws/constraints.py`.
    """
    asked = Constraints(model)
    part = Part(CONSTRAINTS, None, unread=asked.unread, against="from the optimum of their law")
    for state in states if not part.unread else ():
        acting = asked.at(state)
        if acting is not None:
            part.states += 1
            _worsen(part, model.tree.named, *law.balance(acting))
            each, off, sizes = zip(*law.differences(acting), strict=True)
            _worsen(part, [x.name for x in each].__getitem__, np.array(off), np.array(sizes))
    return part


NO_ENTRY = "MuJoCo's matrix has entries only of joints that hang one on the other"


def _branching(tree: Tree) -> list[str]:
    """Returns the lines whose armature couples joints of which none hangs on the other."""
    holder = {j.v: k for k, link in enumerate(tree.links) for j in link.joints}
    above: list[set[int]] = []
    for k, link in enumerate(tree.links):
        above.append({k} | (above[link.parent] if link.parent >= 0 else set()))

    def coupled(line: Line) -> bool:
        bodies = {holder[int(v)] for v in np.flatnonzero(line.coefficients)}
        return any(a not in above[b] and b not in above[a] for a in bodies for b in bodies)

    return [f"tendon {line.name}" for line in tree.lines if line.armature and coupled(line)]


def _compare(part: Part, tree: Tree, ours: tuple[Array, Array], theirs: Array) -> None:
    values, sizes = ours
    part.states += 1
    _worsen(part, tree.named, values - theirs, sizes)


def _worsen(part: Part, name: Callable[[int], str], difference: Array, sizes: Array) -> None:
    """Updates a part with the largest difference over its size, and the name of what has it."""
    difference = np.abs(difference)
    with np.errstate(divide="ignore", invalid="ignore"):
        off = np.where(difference == 0.0, 0.0, difference / sizes)
    off = np.where(np.isnan(off), np.inf, off)
    worst = float(off.max())
    if part.off is None or worst > part.off:
        places = np.unravel_index(int(np.argmax(off)), off.shape)
        names = dict.fromkeys(name(int(k)) for k in places)
        part.off, part.joint = worst, " and ".join(names)


def _textbook(tree: Tree, state: State) -> dict[str, tuple[Array, Array]]:
    """Returns by part its values, and the sizes of what they are the sums of."""
    q, v = state.q, state.v
    bodies = textbook.moving(tree, q, v)
    M = textbook.mass_matrix(tree, bodies)
    diagonal = np.sqrt(np.diag(M))
    bias = textbook.bias(tree, bodies), textbook.size_of_bias(tree, bodies, M)
    values = {MASS: (M, np.outer(diagonal, diagonal)), BIAS: bias}
    terms = {PASSIVE: textbook.passive(tree, q, v, bodies)}
    if DRIVEN not in tree.unread:
        terms[DRIVEN] = textbook.driven(tree, q, v, state.u, bodies)
    return values | {name: (term.forces, _sizes(tree, term)) for name, term in terms.items()}


def _sizes(tree: Tree, term: Term) -> Array:
    """Returns the sizes, of a vector's components the largest."""
    sizes = term.size.copy()
    for joint in tree.joints:
        for k in range(joint.v, joint.v + WIDTH[joint.kind][1] - 1, 3):
            sizes[k : k + 3] = sizes[k : k + 3].max()
    return sizes


def lines(parts: Iterable[Part]) -> list[str]:
    """Returns a line for each part, and for what is not compared."""
    return [f"  {part.name:15}  {plain(line)}" for part in parts for line in _sentences(part)]


def _sentences(part: Part) -> Iterator[str]:
    if part.off is not None:
        off = f"{part.off:.0e} {part.against}"
        off = off if part.holds else f"FAILS: {off} in {part.joint}"
        yield f"{off}, over {part.span:.3g} s" if part.span else f"{off}, at {part.states} states"
    if part.because:
        yield part.because
    yield from (f"not compared: {what}" for what in part.unread)
