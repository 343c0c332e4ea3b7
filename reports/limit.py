"""How long an engine may take for one task, beyond what its steps are worth: then it hangs.

Told by the environment, so that processes of our own and pytest know it too.
"""

import os

VARIABLE = "TEXTMECH_TIME_LIMIT"
USUAL = 120.0  # s of a clock, for what waits spends nothing else: a task of ours takes a few
SLACK = 10.0  # times what a run is worth: the machine may be busy, or old


def limit(worth: float = 0.0) -> float:
    """The time [s] for a task that is worth so much [s]."""
    try:
        beyond = float(os.environ.get(VARIABLE, USUAL))
    except ValueError:
        beyond = USUAL
    return (beyond if beyond > 0.0 else USUAL) + SLACK * worth


def choose(seconds: float | None) -> None:
    """Another one from now on."""
    if seconds is not None:
        os.environ[VARIABLE] = repr(seconds)
