"""The tests write nothing in the checkout, and strike what they start by Ctrl-C.

They run with eigenvalues as numpy gives them from 2.5 on, whichever is installed.
"""

import gc
import signal
from functools import wraps
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.command.checkout import Unchanged


def pytest_configure(config: pytest.Config) -> None:
    """Of the session itself: its workers would see each other's moment."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # begun by `&`; it is inherited
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(Unchanged(Path(__file__).parents[1]))
    complex_eigenvalues()


def complex_eigenvalues() -> None:
    """Makes eigenvalues, their vectors and roots of polynomials of a complex type, real or not.

    So numpy does from 2.5 on; before, they are real where all of them are.
    """
    eig, eigvals, roots = np.linalg.eig, np.linalg.eigvals, np.roots

    @wraps(eig)
    def pair(a: Any) -> Any:
        found = eig(a)
        return type(found)(*(part.astype(complex) for part in found))

    np.linalg.eig = pair
    np.linalg.eigvals = wraps(eigvals)(lambda a: eigvals(a).astype(complex))
    np.roots = wraps(roots)(lambda p: roots(p).astype(complex))


def pytest_collection_finish() -> None:
    """What is collected stays to the end: no search for garbage has to pass through it."""
    gc.freeze()
