"""The rates at the start: what is given, and what the constraints make of it."""

import numpy as np

from ...cases.scene import GROUND, Scene
from ..system import Array
from . import messages
from .closure import Closure, Rows, joined
from .search import null, rank

LOOSE = 1e-6  # of a direction's largest entry: smaller ones are rounding
ROUNDING = 1e-15  # of the fastest: a drag with an exponent below 1 would make a force of it


def rates(closure: Closure, q: Array) -> Array:
    """v (n,) with f_a v = g (2.15); what nobody gives and nothing determines is 0.

    Raises CaseError if the given rates violate a constraint, or leave others open that cannot all
    be zero: a bar on a bar that turns could keep its own rate or its neighbour's. In space its
    joint has the rate 0; in the plane that is to be said.
    """
    given, v = closure.given_rates(), np.zeros(closure.n)
    v[list(given)] = list(given.values())
    held, resting = closure.velocities(q), closure.scaled(list(closure.resting(q)))
    for bodies in mechanisms(closure.scene):
        columns = closure.columns(bodies)
        free = [i for i in columns if i not in given]
        mine = held.about(columns), resting.about(columns)
        solution = _of_one(closure, *mine, v / closure.units, free)
        solution[np.abs(solution) <= ROUNDING * np.max(np.abs(solution), initial=0.0)] = 0.0
        v[free] = solution[free] * closure.units[free]  # a rate that is given stays to the bit
    closure.refuse_rates(q, v / closure.units)
    return v


def _of_one(closure: Closure, held: Rows, resting: Rows, v: Array, free: list[int]) -> Array:
    """v (n,) in sizes and rad per second, solved for the free columns of one mechanism.

    resting: what is to be zero where what is held does not tell it.
    """
    known = rank(held.rows[:, free])
    independent = [rank(np.vstack([held.rows, row])[:, free]) > known for row in resting.rows]
    at_rest = resting.selected(np.array(independent, bool))
    every = held.plus(at_rest)
    if not every.violated(v):
        return v
    solution = every.solved(v, free)
    if every.violated(solution):
        alone = held.solved(v, free)
        if held.violated(alone):
            owner = held.names[int(np.argmax(np.abs(held.residuals(alone))))]
            stands = owner in closure.standing
            raise (messages.moves if stands else messages.rates_violate)(closure.case, owner)
        raise messages.missing(closure.case, rank(every.rows[:, free]) - known, at_rest.names)
    loose = null(every.rows[:, free], len(free))
    if not len(loose):
        return solution
    open_ = np.max(np.abs(loose), axis=0) > LOOSE
    solution[np.array(free)[open_]] = 0.0
    solution = every.solved(solution, np.array(free)[~open_].tolist())
    if every.violated(solution):
        names = [closure.where.rate_names[i] for i in np.array(free)[open_]]
        raise messages.missing(closure.case, len(loose), names)
    return solution


def mechanisms(scene: Scene) -> list[set[str]]:
    """The bodies that joints hold together, and what may stand on each other.

    What only shares the ground moves by itself.
    """
    held = [{joint.a.body, joint.b.body} - {GROUND} for joint in scene.joints.values()]
    touching = [{pair.body, pair.touched} for pair in scene.pairs.values()]
    return joined(scene.bodies, [*held, *touching])
