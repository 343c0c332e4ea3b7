"""A cluster's executor in place of this machine's processes."""

from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib import import_module

from ...cases.mistake import CaseError, Mistake


@contextmanager
def executor(address: str | None) -> Iterator[Executor | None]:
    """Yields the Dask scheduler's executor at the address; None without one. Raises CaseError."""
    if address is None:
        yield None
        return
    try:
        dask = import_module("distributed")
    except ImportError:
        what = "needs Dask: pip install 'textmech[dask]'"
        raise CaseError([Mistake("--cluster", 0, 0, "", what)]) from None
    try:
        client = dask.Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise CaseError([Mistake("--cluster", 0, 0, address, str(error))]) from None
    with client:
        yield client.get_executor()
