"""A mechanism on paper: the reference at several instants, the engines where they end."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...cases.scene.rotation import turned
from ...cases.trajectory import Array
from .column import Column
from .motions import Motion
from .pack import unpacked
from .paint import INK, style

INSTANTS = 7
AZIMUTH, ELEVATION = np.radians(35.0), np.radians(20.0)  # as the page looks at space

Pose = Mapping[str, Array]


def strobe(axes: Any, motion: Motion, ghosts: Sequence[Column]) -> None:
    """Draws it; ghosts: the ways whose last instant is drawn beside the reference's.

    The scale is the mechanism's: a ghost that fell away leaves the picture.
    """
    frames = _frames(motion["poses"])
    last = len(unpacked(motion["times"])) - 1
    for k in sorted({round(last * i / (INSTANTS - 1)) for i in range(INSTANTS)}):
        now = {part: rows[k] for part, rows in frames.items()}
        _bodies(axes, motion, now, color=INK, alpha=0.2 + 0.8 * (k / last), lw=1.6)
        if k == last:
            _links(axes, motion, now)
    if motion["trail"]:
        trail = _seen(np.stack([unpacked(c) for c in motion["trail"]], axis=1))
        axes.plot(*trail.T, color=INK, lw=0.8, alpha=0.5)
    axes.set_aspect("equal", adjustable="datalim")
    limits = axes.dataLim.frozen()
    for one in ghosts:
        told = motion["ghosts"][one.key]["poses"]
        ends = {part: rows[-1] for part, rows in _frames(told).items()}
        code = style(one, ghosts)["color"]
        _bodies(axes, motion, ends, color=code, ls="--", lw=1.3, label=one.title)
    axes.dataLim.set(limits)  # what drifts far away is cut off
    axes.autoscale_view()
    for place in motion["sketch"]["ground"]:
        axes.plot(*_seen(np.array([place])).T, marker=6, color=INK, ms=8, alpha=0.6)
    axes.set_axis_off()
    axes.set_title(f"{INSTANTS} instants, the last in full ink", fontsize=9, loc="left")


def _frames(poses: Mapping[str, Any]) -> dict[str, Array]:
    """By part (N, …)."""
    return {
        part: np.stack([unpacked(c) for c in columns], axis=1) for part, columns in poses.items()
    }


def _bodies(axes: Any, motion: Motion, now: Pose, **look: Any) -> None:
    label = look.pop("label", None)
    for name, body in motion["sketch"]["bodies"].items():
        if name not in now:
            continue
        for line in body["lines"]:
            axes.plot(*_seen(_placed(now[name], np.array(line))).T, label=label, **look)
            label = None
        if body["dot"]:
            centre = _seen(now[name][None, : motion["axes"]]).T
            axes.plot(*centre, marker="o", ms=6, label=label, **look)
            label = None


def _links(axes: Any, motion: Motion, now: Pose) -> None:
    for link in motion["sketch"]["links"]:
        ends = [_placed(now[p], np.array([place]))[0] if p else place for p, place in link["ends"]]
        axes.plot(*_seen(np.array(ends)).T, color=INK, lw=0.8, ls=":")


def _placed(pose: Array, places: Array) -> Array:
    """(K, 2 or 3) in ground axes of places (K, 2 or 3) on a part."""
    n = places.shape[1]
    if len(pose) == n:  # a driven point of the ground, and a particle
        return pose + places
    if n == 3:
        return pose[:3] + turned(pose[3:], places)
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return pose[:2] + places @ np.array([[cos, sin], [-sin, cos]])


def _seen(places: Array) -> Array:
    """(K, 2): the plane as it is, space from the side and above."""
    if places.shape[1] == 2:
        return places
    x, y, z = places.T
    across = -np.sin(AZIMUTH) * x + np.cos(AZIMUTH) * y
    towards = np.cos(AZIMUTH) * x + np.sin(AZIMUTH) * y
    return np.stack([across, z * np.cos(ELEVATION) - towards * np.sin(ELEVATION)], axis=1)
