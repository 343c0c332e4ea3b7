"""The reports. Imported first by the command and the plug-in: says what shadows our packages.

Their names are ordinary words, and a folder of the same name in front of ours on the path of
imports would otherwise end in an error that nobody understands.
"""

from importlib.util import find_spec
from pathlib import Path

for _name in ("cases", "reference", "engines"):
    _spec = find_spec(_name)
    _found = Path(_spec.origin).parent if _spec and _spec.origin else None
    if _found != Path(__file__).parents[1] / _name:
        raise ImportError(f"textmech: {_found or _name} shadows textmech's own package {_name!r}")
