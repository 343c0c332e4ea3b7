"""Warnings about a motion: it shows what is no mistake of its file, and most likely not meant."""

from collections.abc import Iterator

import numpy as np

from ....cases.case import Case
from ....cases.scene.unnamed import penetrations
from ....cases.trajectory import Trajectory

ON = 1e-3  # of two samples: closer to an impact no step of an engine parts them


def unintended(case: Case, trajectory: Trajectory) -> Iterator[str]:
    """Yields a sentence for each thing that goes through another, and for samples on impacts."""
    if case.states is not None:
        return
    yield from penetrations(case.scene, trajectory)
    gaps = np.abs(case.times[:, None] - trajectory.blows[None, :])
    met = case.times[np.min(gaps, axis=1, initial=np.inf) <= ON * case.interval].tolist()
    if met:
        many = f" and {len(met) - 1} more" if len(met) > 1 else ""
        yield (
            f"the sample at {met[0]:.4g} s{many} falls on an impact: there an engine may be before "
            "it or behind it, and no force is compared; another number of `samples` misses it"
        )
