"""Motion from event to event: at each one all combinations of open, stuck and sliding."""

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from second.contacts import Site, bends, group, sites
from second.equations import Row, Solved, mass, redundant, solve
from second.motion import ATOL, RTOL, Motion, Piece, State, smooth, spans
from second.moving import Array

# Modes: which sites are open, stick or slide, what holds then, and which mode is consistent.

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


# A motion that switches: followed from event to event, with blows between.

FAR = 1.0  # m: a foot that is not ahead strikes nothing
SLOW = 1e-6  # m/s: what strikes slower stays
MOST = 400  # pieces


def blow(site_list: list[Site], mode: Mode | None, now: Any) -> Array:
    """The rates after a blow, if something strikes: impulses within friction, no pull."""
    found = list(site_list)
    gaps = {s.part: s.gap(now) for s in found if s.gap is not None}
    near = [s for s in found if s.gap and gaps[s.part].p < CLOSE and (not s.pivot or s.ahead(now))]
    strikes = [s for s in near if gaps[s.part].v < -CLOSE and not stands(mode, s)]
    if not strikes:
        return now.u
    pivots = any(s.pivot for s in strikes)
    rests = [s for s in near if s not in strikes and abs(gaps[s.part].v) < CLOSE]
    rests = [s for s in rests if not (pivots and s.pivot)]
    tried = [ways(s, firm=True) for s in strikes] + [ways(s, firm=False) for s in rests]
    for states in itertools.product(*tried):
        u = after(now, list(zip([*strikes, *rests], states, strict=True)), set(strikes))
        if u is not None:
            return u
    raise ArithmeticError(f"no blow is consistent at {now.t}")


def stands(mode: Mode | None, s: Site) -> bool:
    """Whether a pivot stands already."""
    return mode is not None and s.pivot and mode.states[s.part] == STICK


def ways(s: Site, firm: bool) -> list[str]:
    """How a site can go through a blow: one that strikes does not stay open."""
    if s.pivot:
        return [STICK]
    closed = [STICK, "+", "-"] if s.slip else [FREE]
    return closed if firm else [*closed, OPEN]


def after(now: Any, states: list[tuple[Site, str]], strikes: set[Site]) -> Array | None:
    """The rates after a blow in which each site goes as is said, None where it cannot."""
    rows = [(row, None, 0.0) for *_, row in now.rows()]
    tags: list[tuple[Site | None, str]] = [(None, "")] * len(rows)
    for s, state in states:
        if s.gap is None or state == OPEN:
            continue
        gap, slip = s.gap(now), s.slip(now) if s.slip else None
        e = s.restitution if s in strikes and gap.v < -SLOW else 0.0
        follows = None
        if slip and state in "+-":
            sign = 1.0 if state == "+" else -1.0
            follows = -sign * s.rubs(1.0, sign) * slip.J
        rows.append((gap, follows, -(1 + e) * gap.v))
        tags.append((s, "normal"))
        if slip and state == STICK:
            rows.append((slip, None, -slip.v))
            tags.append((s, "tangent"))
    n, k = now.n, len(rows)
    A, r = np.zeros((n + k, n + k)), np.zeros(n + k)
    A[:n, :n] = mass(now)
    for i, (l, follows, change) in enumerate(rows):
        A[n + i, :n] = l.J
        A[:n, n + i] = -(l.J if follows is None else l.J + follows)
        r[n + i] = change
    z = np.linalg.lstsq(A, r, rcond=1e-11)[0]
    if np.linalg.norm(A @ z - r) > 1e-9 * max(1.0, float(np.linalg.norm(r))):
        return None
    u, small = now.u + z[:n], TINY * max(1.0, float(np.max(np.abs(z[n:]))))
    P = {(s.part, what): p for (s, what), p in zip(tags, z[n:], strict=True) if s}
    for s, state in states:
        if s.gap is None:
            continue
        N, rate = P.get((s.part, "normal"), 0.0), float(s.gap(now).J @ u)
        if min(N, 0.0) < -small or (state == OPEN and rate < -CLOSE):
            return None
        if s.slip and state == STICK and abs(P[s.part, "tangent"]) > s.rubs(N, 1.0) + small:
            return None  # a blow rubs by the kinetic coefficient
        if s.slip and state in "+-":
            sign = 1.0 if state == "+" else -1.0
            if sign * float(s.slip(now).J @ u) < -CLOSE:
                return None
    return u


def watched(mode: Mode, state: State, last: float) -> list[tuple[Site | None, str, Any]]:
    """What ends a mode: functions of time and numbers that fall to zero."""
    found: list[tuple[Site | None, str, Any]] = []

    def watch(site: Site | None, what: str, value: Any) -> None:
        def falls(t: float, y: Array) -> float:
            return value(state.now(min(t, last), y))

        falls.terminal, falls.direction = True, -1.0  # type: ignore[attr-defined]
        found.append((site, what, falls))

    for s in mode.sites:
        how = mode.states[s.part]
        if s.gap and how == OPEN:
            watch(s, "closes", lambda now, s=s, gap=s.gap: gap(now).p if s.ahead(now) else FAR)
        elif s.gap and not s.pivot:
            watch(s, "opens", lambda now, s=s: mode.solved(now).of(s.part, "normal"))
        if s.slip and how in "+-":
            sign = 1.0 if how == "+" else -1.0
            watch(s, "stops", lambda now, slip=s.slip, sign=sign: sign * slip(now).v)
        if s.slip and how == STICK and not s.pivot:
            watch(s, "breaks", lambda now, s=s: mode.room(now, mode.solved(now), s))
    return found


def kinks(state: State, y: Array, t: float, last: float) -> list[Any]:
    """Where one-sided springs change next."""
    found = []
    for i, (x, v) in enumerate(bends(state.now(t, y))):

        def crosses(t: float, y: Array, i: int = i) -> float:
            return bends(state.now(min(t, last), y))[i][0]

        crosses.terminal = True  # type: ignore[attr-defined]
        crosses.direction = -np.sign(v if abs(x) < CLOSE else x)  # type: ignore[attr-defined]
        found.append(crosses)
    return found


def next_mode(now: Any, mode: Mode, site: Site | None, what: str) -> Mode:
    """The mode behind an event."""
    but: dict[str, list[str]] = {}
    for s in mode.sites:
        if s.pivot:  # it stays until another one strikes
            but[s.part] = [mode.states[s.part]]
    if site and what == "opens":
        but[site.part] = [OPEN]
    elif site and what == "breaks":
        T = mode.solved(now).of(site.part, site.what)
        mine = group(site, now.model)
        alike = [s.part for s in mode.sites if group(s, now.model) == mine]
        but |= {part: ["-" if T > 0 else "+"] for part in alike if mode.states[part] == STICK}
    elif site and site.gap and what == "closes" and site.pivot and site.gap(now).p > -CLOSE:
        but |= {s.part: [STICK if s is site else OPEN] for s in mode.sites if s.pivot}
    return chosen(mode.sites, now, but)


def followed(model: Any, y: Array, state: State, duration: float, samples: int) -> Motion:
    """The motion from a start, through all its modes."""
    all_sites = sites(model)
    pieces: list[Piece] = []
    y = y.copy()
    now = state.now(0.0, y)
    y[state.cuts[0] : state.cuts[1]] = blow(all_sites, None, now)
    mode = chosen(all_sites, state.now(0.0, y), {})
    for a, b in spans(model, duration):
        t, last = a, np.nextafter(b, a)
        if a > 0.0:  # what acts may have jumped
            mode = next_mode(state.now(a, y), mode, None, "")
        while t < b and len(pieces) < MOST:
            ends, bent = watched(mode, state, last), kinks(state, y, t, last)

            def rate(t: float, y: Array, mode: Mode = mode, last: float = last) -> Array:
                now = state.now(min(t, last), y)
                return state.rate(now, mode.solved(now))

            sol = solve_ivp(
                rate, (t, b), y, "DOP853", rtol=RTOL, atol=ATOL, dense_output=True,
                max_step=duration / (samples - 1), events=[e for *_, e in ends] + bent,
            )  # fmt: skip
            if not sol.success or sol.sol is None:
                raise ArithmeticError(sol.message)
            pieces.append(Piece(t, float(sol.t[-1]), sol.sol, mode))
            y, t = sol.y[:, -1].copy(), float(sol.t[-1])
            hit = [i for i, e in enumerate(sol.t_events or []) if len(e)]
            if not hit:
                continue
            site, what = (ends[hit[0]][0], ends[hit[0]][1]) if hit[0] < len(ends) else (None, "")
            now = state.now(min(t, last), y)
            if what == "closes":
                y[state.cuts[0] : state.cuts[1]] = blow(all_sites, mode, now)
            mode = next_mode(state.now(min(t, last), y), mode, site, what)
    if len(pieces) >= MOST:
        raise ArithmeticError("it switches without end")
    times = np.linspace(0.0, duration, samples)
    found = []
    for t in times:
        piece = next((p for p in pieces if t < p.end), pieces[-1])  # what is just after a corner
        now = state.now(t, piece.at(t))
        found.append((now, piece.mode.solved(now)))
    return Motion(state, pieces, times, found)
