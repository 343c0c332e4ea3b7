"""Modes: which sites are open, stick or slide, what holds then, and which mode is consistent."""

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from second.equations import Row, Solved, redundant, solve
from second.motion import smooth
from second.sites import Site, group

CLOSE = 1e-8  # m, m/s: a gap and a rate that are none (what an event leaves of them is 1e-12)
TINY = 1e-7  # of the largest force: what rounding leaves of none
OPEN, STICK, FREE = "open", "stick", "free"


@dataclass
class Mode:
    """The state of each site: open, free (closed, nothing rubs), stick, or the sign of its slip."""

    sites: list[Site]
    states: dict[str, str]
    several: bool | None = None

    def rows(self, now: Any) -> list[Row]:
        """All rows that hold in this mode."""
        found = smooth(now)
        for s in self.sites:
            state = self.states[s.part]
            if state == OPEN:
                continue
            slip = s.slip(now) if s.slip else None
            if s.gap:
                follows = None
                if slip and state in "+-":
                    sign = 1.0 if state == "+" else -1.0
                    follows = -sign * s.rubs(1.0, sign) * slip.J
                found.append(Row(s.part, "normal", s.gap(now), follows))
            if slip and state == STICK:
                found.append(Row(s.part, s.what, slip._replace(p=0.0)))
        return found

    def solved(self, now: Any) -> Solved:
        """Accelerations and forces, of what slides too."""
        rows = self.rows(now)
        if self.several is None:
            self.several = redundant(now, rows)
        extra = np.zeros(now.n)
        rubbed: dict[str, float] = {}
        for s in self.sites:
            state = self.states[s.part]
            if s.slip and not s.pressed and state in "+-":
                slip = s.slip(now)
                sign = 1.0 if state == "+" else -1.0
                v = sign * max(sign * slip.v, 0.0) or sign * 1e-300
                rubbed[s.part] = -sign * s.rubs(0.0, v)
                extra += rubbed[s.part] * slip.J
        found = solve(now, rows, extra, self.several)
        for s in self.sites:
            if s.slip and s.pressed and self.states[s.part] in "+-":
                sign = 1.0 if self.states[s.part] == "+" else -1.0
                rubbed[s.part] = -sign * s.rubs(found.of(s.part, "normal"), sign)
        by = {s.part: s for s in self.sites}
        for part, f in rubbed.items():
            s = by[part]
            assert s.slip
            found = Solved(
                found.a, np.append(found.forces, f), [*found.rows, Row(part, s.what, s.slip(now))]
            )
        return found

    def room(self, now: Any, found: Solved, site: Site) -> float:
        """How much friction is left before what sticks breaks loose: of all that it shares with."""
        mine = group(site, now.model)
        T = most = 0.0
        for s in self.sites:
            if self.states[s.part] == STICK and group(s, now.model) == mine:
                T += found.of(s.part, s.what)
        for s in self.sites:
            if self.states[s.part] == STICK and group(s, now.model) == mine:
                most += s.holds(found.of(s.part, "normal"), -T)
        return most - abs(T)


def consistent(mode: Mode, now: Any) -> bool:
    """Whether nothing pulls that only pushes, holds more than it can, or goes where it is not."""
    found = mode.solved(now)
    small = TINY * max(1.0, float(np.max(np.abs(found.forces), initial=0.0)))
    for s in mode.sites:
        state = mode.states[s.part]
        if s.gap and not s.pivot:
            gap = s.gap(now)
            touching = gap.p < CLOSE and abs(gap.v) < CLOSE
            if state == OPEN and touching and gap.J @ found.a + gap.b < -small:
                return False
            if state != OPEN and found.of(s.part, "normal") < -small:
                return False
        if s.slip and state == STICK and mode.room(now, found, s) < -small:
            return False
        if s.slip and state in "+-" and abs(s.slip(now).v) < CLOSE:
            slip, sign = s.slip(now), 1.0 if state == "+" else -1.0
            if sign * (slip.J @ found.a + slip.b) < -small:
                return False
    return True


def options(s: Site, now: Any) -> list[str]:
    """The states in which a site can be, with these places and rates, the firmest first."""
    if s.gap:
        gap = s.gap(now)
        if abs(gap.p) > CLOSE or gap.v > CLOSE:
            return [OPEN]
        if s.pivot:
            return [STICK]
    firm = [FREE]
    if s.slip:
        v = s.slip(now).v
        firm = [STICK, "+", "-"] if abs(v) < CLOSE else ["+" if v > 0 else "-"]
    return [*firm, OPEN] if s.gap else firm


def chosen(sites: list[Site], now: Any, but: dict[str, list[str]]) -> Mode:
    """The first consistent mode; of some sites only the states that `but` names are tried."""
    tried = [but.get(s.part, options(s, now)) for s in sites]
    for states in sorted(
        itertools.product(*tried), key=lambda states: sum(state != STICK for state in states)
    ):
        mode = Mode(sites, dict(zip((s.part for s in sites), states, strict=True)))
        if consistent(mode, now):
            return mode
    raise ArithmeticError(f"no mode is consistent at {now.t}")
