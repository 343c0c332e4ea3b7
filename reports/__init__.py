"""The reports: comparing, judging, writing, the command, the plug-in, and the committed tables.

For Python: `from textmech.reports import advise, load, solve, run`, explained in `front.interface`.
"""

import time
from importlib import import_module
from typing import Any

BEGUN = time.time()  # s: a file of code that is newer than this is not the code that runs
PUBLIC = {
    "CaseError": "..cases.mistake",
    "advise": ".front.interface",
    "load": ".front.interface",
    "run": ".front.interface",
    "solve": ".front.interface",
}
"""By name where it is: imported when it is asked for, as pytest imports this for its plug-in."""


def __getattr__(name: str) -> Any:
    if name not in PUBLIC:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(PUBLIC[name], __name__), name)
