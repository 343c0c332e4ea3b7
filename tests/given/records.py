"""What tests read from a record."""

import numpy as np

from textmech.cases.trajectory import Array, Trajectory


def boundaries(motion: Trajectory) -> Array:
    """Times at which the phases of the record meet."""
    record = motion.record
    assert record is not None
    assert record.phase is not None
    return record.times[np.flatnonzero(np.diff(record.phase))]
