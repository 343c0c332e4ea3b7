"""LAPACK's routines by their names, as scipy has them: imported with the first that is called.

What only looks at a scene, as `textmech show` does, calls none, and scipy is half of its start.
"""

from typing import Any


def __getattr__(name: str) -> Any:
    if name.startswith("_"):
        raise AttributeError(name)
    from scipy.linalg import lapack

    routine = globals()[name] = getattr(lapack, name)  # the next call finds it here
    return routine
