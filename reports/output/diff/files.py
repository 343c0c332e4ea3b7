"""The files of a report whose columns are known; any other is compared cell by cell."""

from .causes import CAUSES
from .certificates import CERTIFICATES
from .covered import COVERED
from .errors import ERRORS
from .instants import INSTANTS
from .ladders import LADDERS
from .steps import STEPS

_KNOWN = (ERRORS, LADDERS, STEPS, INSTANTS, CERTIFICATES, COVERED, CAUSES)
FILES = {file.name: file for file in _KNOWN}
