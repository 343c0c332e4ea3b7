"""A program that is run ends with whoever ran it, however that is ended, and leaves no folder."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from textmech.reports.system import child
from textmech.reports.versions.measure import COMMAND

SOON = 3.0  # s, on a machine that does much else; killing takes milliseconds
RUNS = """\
import sys
from textmech.reports.system import child, termination
from textmech.reports.system.temporary_folder import temporary_folder
termination.listen()
try:
    with temporary_folder("textmech-run-") as folder:
        child.run([sys.executable, "-c", {program!r}], heard={heard!r})
except KeyboardInterrupt:
    termination.end(130)
"""
PROGRAM = """\
import os
import subprocess
import sys
import time
inner = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
with open(os.environ["TOLD"] + "-", "w") as file:
    file.write(f"{os.getpid()} {inner.pid}")
os.rename(os.environ["TOLD"] + "-", os.environ["TOLD"])
time.sleep(60)
"""


def alive(process: int) -> bool:
    """Whether it runs; one that nobody has buried yet does not."""
    try:
        text = Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
    except OSError:
        return False
    return text.rpartition(") ")[2][0] != "Z"


def within(seconds: float, path: Path) -> str:
    end = time.monotonic() + seconds
    while not path.exists():
        assert time.monotonic() < end
        time.sleep(0.01)
    return path.read_text(encoding="utf-8")


@pytest.fixture(
    params=[None, "stderr", "stdout"],
    ids=["its streams are ours", "its errors are read", "its output is read"],
)
def running(
    request: pytest.FixtureRequest, tmp_path: Path
) -> Iterator[tuple[subprocess.Popen[str], list[int]]]:
    """A process that runs a program, and the numbers of that and of what that has started."""
    (tmp_path / "tmp").mkdir()
    process = subprocess.Popen(
        [sys.executable, "-c", RUNS.format(program=PROGRAM, heard=request.param)],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"TOLD": str(tmp_path / "told"), "TMPDIR": str(tmp_path / "tmp")},
        start_new_session=True,
    )
    try:
        yield process, [int(word) for word in within(60.0, tmp_path / "told").split()]
    finally:
        process.kill()
        process.communicate()


STRIKES = {
    "kill": [signal.SIGTERM],
    "Ctrl-C": [signal.SIGINT],
    "twice": [signal.SIGTERM] * 2,
    "five times": [signal.SIGINT] * 5,
}


@pytest.mark.slow
@pytest.mark.mutant("a program outlives the run that was ended")
@pytest.mark.parametrize("name", STRIKES)
def test_it_ends_with_us_and_nothing_stays(
    name: str, running: tuple[subprocess.Popen[str], list[int]], tmp_path: Path
) -> None:
    process, numbers = running
    assert all(map(alive, numbers))
    for number in STRIKES[name]:
        os.killpg(process.pid, number)
        time.sleep(0.02)
    _, said = process.communicate(timeout=SOON)
    assert process.returncode == 130
    assert "Traceback" not in said
    end = time.monotonic() + SOON
    while any(map(alive, numbers)):
        assert time.monotonic() < end
        time.sleep(0.01)
    assert list((tmp_path / "tmp").iterdir()) == []


@pytest.mark.slow
@pytest.mark.skipif(child._tied() is None, reason="the system ends no child with its parent")
def test_killed_it_takes_the_program_along(
    running: tuple[subprocess.Popen[str], list[int]],
) -> None:
    """What this has started itself reads that its own parent is gone, if it looks."""
    process, (program, inner) = running
    process.kill()
    process.wait()
    end = time.monotonic() + SOON
    while alive(program):
        assert time.monotonic() < end
        time.sleep(0.01)
    os.kill(inner, signal.SIGKILL)


@pytest.mark.slow
def test_what_it_says_and_how_it_ended_is_told() -> None:
    code = "import sys; sys.stderr.write('b\\xe4d'); sys.exit(3)"
    assert child.run([sys.executable, "-X", "utf8", "-c", code], heard="stderr") == (3, "bäd")
    both = "import sys; sys.stdout.write('said'); sys.stderr.write('wrong')"
    assert child.run([sys.executable, "-c", both], heard="stdout") == (0, "said")
    assert child.run([sys.executable, "-c", "import os; os.kill(os.getpid(), 9)"]) == (-9, "")
    assert child.run([sys.executable, "-c", "import sys; sys.stdin.read()"], heard="stderr") == (
        0,
        "",
    )


def test_a_release_is_not_measured_for_nobody() -> None:
    """Its stdin has ended: whoever asked for it is gone."""
    done = subprocess.run(
        [sys.executable, "-P", "-c", COMMAND, "run"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, b"")
