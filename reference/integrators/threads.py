"""Linear algebra on one thread: matrices here are small, and threads wait for each other.

A chain of 20 bars takes 36 CPU s with OpenBLAS's own choice on two cores, and 3 on one thread; and
how many threads share a product decides its last bit.
"""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import scipy

# As the wheels of numpy and scipy spell them, with 32 and with 64 bit integers.
SPELLED = [f"{before}{{}}{after}" for before in ("scipy_openblas_", "openblas_")
           for after in ("64_", "")]  # fmt: skip


@contextmanager
def one_thread() -> Iterator[None]:
    """One thread for OpenBLAS within the block, where numpy or scipy bring it; then as before."""
    before = [count() for count, _ in _libraries()]
    for _, set_count in _libraries():
        set_count(1)
    try:
        yield
    finally:
        for (_, set_count), threads in zip(_libraries(), before, strict=True):
            set_count(threads)


@cache
def _libraries() -> list[tuple[Callable[[], int], Callable[[int], Any]]]:
    """For each library: what asks and what sets its number of threads; other BLAS stay as is."""
    return [found for file in _files() if (found := _calls(file)) is not None]


def _files() -> Iterator[Path]:
    for package in (np, scipy):
        folder = Path(str(package.__file__)).parent
        for beside in (folder.parent / f"{folder.name}.libs", folder / ".dylibs"):
            yield from beside.glob("*openblas*")


def _calls(file: Path) -> tuple[Callable[[], int], Callable[[int], Any]] | None:
    try:
        library = ctypes.CDLL(str(file))  # the one that is loaded already
    except OSError:
        return None
    for name in SPELLED:
        get, put = name.format("get_num_threads"), name.format("set_num_threads")
        if hasattr(library, get) and hasattr(library, put):
            return getattr(library, get), getattr(library, put)
    return None
