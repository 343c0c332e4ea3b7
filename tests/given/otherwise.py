"""A module with one of its lines changed: a mistake that no attribute could be replaced for."""

import inspect
from types import ModuleType
from typing import Any


def otherwise(module: ModuleType, was: str, now: str) -> Any:
    """The module anew with that text in place of the other, which must stand there once.

    Nobody who has imported it sees anything of it; what it imports itself is as it is.
    """
    source = inspect.getsource(module)
    assert source.count(was) == 1, f"{module.__name__} has {source.count(was)} times {was!r}"
    found = ModuleType(module.__name__)
    found.__package__, found.__file__ = module.__package__, module.__file__
    exec(compile(source.replace(was, now), str(module.__file__), "exec"), found.__dict__)
    return found
