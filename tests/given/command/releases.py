"""Made-up releases of pymunk as wheels, which pip installs without any network."""

import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path

import pytest

# The real one under another version, with what a release may have changed.
REAL = """\
import importlib, os, sys
here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.remove(here)
del sys.modules[__name__]
real = importlib.import_module(__name__)
sys.path.insert(0, here)
real.version = {version!r}
{change}
sys.modules[__name__] = real
"""
HEAVIER = """\
step = real.Space.step
def heavier(space, dt):
    space.gravity = real.Vec2d(0, -9.81)
    step(space, dt)
real.Space.step = heavier
"""
SAME = ""
LACKING = "raise ImportError('no module of this name any more')"
DYING = "os.kill(os.getpid(), 9)"


def wheel(
    folder: Path,
    version: str,
    change: str,
    *,
    says: str | None = None,
    name: str = "pymunk",
    needs: Sequence[str] = (),
) -> None:
    """A release; says: the version that it tells, if that is another one; needs: as pip knows."""
    folder.mkdir(exist_ok=True)
    package = name.replace("-", "_")
    info = f"{package}-{version}.dist-info"
    text = REAL.format(version=says or version, change=change)
    head = f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n"
    kind = "Wheel-Version: 1.0\nGenerator: test\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
    files = {
        f"{package}/__init__.py": text,
        f"{info}/METADATA": head + "".join(f"Requires-Dist: {need}\n" for need in needs),
        f"{info}/WHEEL": kind,
    }
    record = f"{info}/RECORD"
    with zipfile.ZipFile(folder / f"{package}-{version}-py3-none-any.whl", "w") as archive:
        for path, content in files.items():
            archive.writestr(path, content)
        archive.writestr(record, "".join(f"{path},,\n" for path in [*files, record]))


def index(patch: pytest.MonkeyPatch, folder: Path) -> None:
    """pip knows these releases, and no others; the command's own process finds textmech."""
    patch.setenv("PIP_CONFIG_FILE", "/dev/null")
    patch.setenv("PIP_NO_INDEX", "1")
    patch.setenv("PIP_FIND_LINKS", str(folder))
    patch.setenv("PYTHONPATH", ":".join(path for path in sys.path if path.endswith("typing")))
