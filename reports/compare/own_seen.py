"""Says in words what a model's own steps show and its limit does not: a joint that shakes."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...engines.own_model.limit import Limit
from ...engines.own_model.opened import Opened
from ...engines.own_model.quantities import Quantity
from ...engines.own_model.seen import Shake, diverges, joint_of, short_of_target
from ...engines.own_model.signs import Signs, signs

ARRIVES = 0.5  # of what its own steps stay short: its own equations bring it nearer than that
LATE = 0.9  # of a run: what shakes until then shakes on
NOTABLE = 0.01  # of the largest kinetic energy: less is lost by any step
FEW = 3  # elements by name


@dataclass(frozen=True)
class Seen:
    """By velocity, or None for all of it, what its own steps show and its own equations do not.

    beside: what else they show: forces at their limits, energy.
    """

    joints: Mapping[int | None, str]
    beside: Sequence[str] = ()

    def of(self, quantity: Quantity) -> str:
        """Returns what is seen of a joint, of a ball or a free one in any direction."""
        if quantity.of != "joint":
            return ""
        directions = range(quantity.first, quantity.first + quantity.wide)
        return "; ".join(self.joints[k] for k in directions if k in self.joints)


def seen(opened: Opened, exact: Limit, until: float, *, off: bool = True) -> Seen:
    """Returns what the model's own steps show until a time [s], in words.

    off: whether they are off by more than is allowed; else no energy is said to be lost, which of a
    model at rest is much beside a kinetic energy of nothing.
    """
    own = opened.own
    shown = signs(own, exact, until, opened.joint_bars)
    if shown is None:
        when, dof = diverges(own, until)
        who = "it" if dof is None else joint_of(own.model, dof)[0]
        return Seen({dof: f"{who} diverges after {when:.3g} s; its own equations do not"})
    arrives = short_of_target(own, until, exact.y[exact.times <= until][-1])
    short = {
        k: off
        for k, off in short_of_target(own, shown.end, shown.y).items()
        if off > opened.joint_bars[k] and arrives[k] < ARRIVES * off
    }
    words = {
        k: _words(opened, exact, until, k, shown, short) for k in sorted({*short, *shown.shakes})
    }
    return Seen({k: word for k, word in words.items() if word}, [*_notes(shown, off=off)])


def _words(
    opened: Opened, exact: Limit, until: float, k: int, shown: Signs, short: Mapping[int, float]
) -> str:
    """Returns what is seen of a velocity's joint; nothing, where its own equations show it too."""
    own = opened.own
    name, unit = joint_of(own.model, k)
    words: list[str] = []
    if (shake := shown.shakes.get(k)) and not _shakes(exact, own.model.nq + k, shake):
        ends = "" if shake.ends >= LATE * until else f" until {shake.ends:.2g} s"
        words.append(f"shakes at {shake.rate:#.2g} {unit}/s{ends}")
    if k in short:
        words.append(f"stays {short[k]:#.2g} {unit} short of its target")
    equations = "bring it there" if k in short else "do not"
    return f"{name} {' and '.join(words)}; its own equations {equations}" if words else ""


def _shakes(exact: Limit, column: int, shake: Shake) -> bool:
    """Whether the limit is about as fast then."""
    inside = (exact.times >= shake.begins) & (exact.times <= shake.ends)
    return np.abs(exact.y[inside, column]).max(initial=0.0) >= ARRIVES * shake.rate


def _notes(shown: Signs, *, off: bool) -> Iterator[str]:
    most = sorted(shown.at_limit.items(), key=lambda each: -each[1])
    if most:
        each = ", ".join(f"{name} in {share:.0%}" for name, share in most[:FEW])
        yield f"at its force limit: {each} of the steps{', …' if most[FEW:] else ''}"
    by, kinetic = shown.lost.by, shown.lost.kinetic
    worst = float(by[np.argmax(np.abs(by))])
    if off and abs(worst) > NOTABLE * kinetic:
        verb = "lose" if worst > 0 else "gain"
        yield (
            f"its steps {verb} up to {abs(worst):.2g} J against its limit, whose kinetic energy is "
            f"at most {kinetic:.2g} J"
        )
