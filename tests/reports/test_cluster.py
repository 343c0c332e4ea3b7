"""A cluster's executor does the work where an address is given, and only there."""

import sys
from concurrent.futures import Executor, ThreadPoolExecutor
from types import SimpleNamespace
from typing import Any

import pytest

from textmech.cases.mistake import CaseError
from textmech.reports.command.run import _executor as executor


class Client:
    """As Dask's, with threads for its workers."""

    def __init__(self, address: str, **_: Any) -> None:
        if "nobody" in address:
            raise OSError("Timed out trying to connect")

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def get_executor(self) -> Executor:
        return ThreadPoolExecutor(1)


def test_without_an_address_there_is_none() -> None:
    with executor(None) as found:
        assert found is None


def test_it_is_the_clients(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", SimpleNamespace(Client=Client))
    with executor("tcp://here:8786") as found:
        assert isinstance(found, Executor)


@pytest.mark.parametrize(
    ("module", "words"),
    [(None, r"textmech\[dask\]"), (SimpleNamespace(Client=Client), "Timed out")],
)
def test_what_cannot_be_reached_is_bad_input(
    module: object, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", module)
    with pytest.raises(CaseError, match=words), executor("tcp://nobody:8786"):
        pass
