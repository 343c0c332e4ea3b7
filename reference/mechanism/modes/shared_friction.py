"""Contacts of one body that are closed together: one slip, and a friction that they share.

Points of a rigid body on a plane have one height, and by (2.6) one slip: they stick together or
slide together. Where they stick, equilibrium knows the sum of their friction forces and not the
share of each: the row of no slip holds once.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...coverage import Numbered
from .element import Element, State


@dataclass(frozen=True)
class Shared(Numbered):
    """The sticking contacts of one body by name, with their coefficients of stiction.

    The first one's row holds; its multiplier is the sum of all their friction forces.
    """

    contacts: tuple[str, ...]
    static: tuple[float, ...]

    @property
    def forces(self) -> tuple[str, ...]:
        """The reactions of which only the sum is determined."""
        return tuple(f"{name}.tangent" for name in self.contacts)

    def divided(self, forces: Mapping[str, float]) -> dict[str, float]:
        """(2.89) each takes a part as μ_s F_N, so that all break loose at one force [N]."""
        both = zip(self.contacts, self.static, strict=True)
        bounds = [mu_s * max(forces[f"{name}.normal"], 0.0) for name, mu_s in both]
        total, most = forces[self.forces[0]], sum(bounds)
        parts = [bound / most if most else 1.0 / len(bounds) for bound in bounds]
        return dict(zip(self.forces, [part * total for part in parts], strict=True))


def ways(
    elements: Sequence[Element], choices: Sequence[Sequence[State]]
) -> Iterator[tuple[State, ...]]:
    """Yields all states of the elements together, the likeliest first; the last changes fastest.

    What a body has closed on a plane does alike; without friction there is no choice.
    """
    states: list[State] = []
    iterators = [iter(choices[0])] if choices else []
    if not choices:
        yield ()
    while iterators:
        state = next(iterators[-1], None)
        if state is None:
            iterators.pop()
            del states[-1:]
        elif _alike(elements, states, state):
            if len(iterators) < len(choices):
                states.append(state)
                iterators.append(iter(choices[len(states)]))
            else:
                yield (*states, state)


def _alike(elements: Sequence[Element], states: Sequence[State], state: State) -> bool:
    """Whether the next element may do this beside what those before it do."""
    mine = elements[len(states)]
    if not _rubs(mine, state):
        return True
    before = zip(elements, states, strict=False)
    return all(e.together != mine.together or s == state for e, s in before if _rubs(e, s))


def alike_contacts(elements: Sequence[Element], states: Sequence[State], i: int) -> list[int]:
    """Element i, and the contacts of its body on its plane that slip or stick with it."""
    mine = elements[i]
    if not _rubs(mine, states[i]):
        return [i]
    pairs = enumerate(zip(elements, states, strict=True))
    return [k for k, (e, state) in pairs if _rubs(e, state) and e.together == mine.together]


def shares(elements: Sequence[Element], states: Sequence[State]) -> Iterator[Shared]:
    """The contacts that stick by more than one point of a body."""
    groups: dict[tuple[str, str], list[Element]] = {}
    for e, state in zip(elements, states, strict=True):
        if _rubs(e, state) and state == "sticks":
            groups.setdefault(e.together, []).append(e)
    for group in groups.values():
        if len(group) > 1:
            yield Shared(tuple(e.name for e in group), tuple(e.static for e in group))


def _rubs(e: Element, state: State) -> bool:
    return e.normal is not None and not e.only and not e.frictionless and state != "open"


def undecided(elements: Sequence[Element], choices: Sequence[Sequence[State]]) -> list[str]:
    """Names of the elements with more than one choice."""
    both = zip(elements, choices, strict=True)
    return [element.name for element, choice in both if len(choice) > 1]
