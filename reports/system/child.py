"""Another program, run to its end, which never outlives us: in whatever way we are ended."""

import ctypes
import os
import signal
import subprocess
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import Literal

from . import termination as ending

_WITH_PARENT = 1  # Linux: PR_SET_PDEATHSIG


def run(
    words: Sequence[object],
    *,
    env: Mapping[str, str] | None = None,
    heard: Literal["stdout", "stderr"] | None = None,
) -> tuple[int, str]:
    """Returns its exit code, negative if a signal ended it, and what it wrote to what is `heard`.

    Its other stream is ours, but where its errors are heard: there what else it says is of no use.
    It has a session of its own: Ctrl-C in the terminal reaches us, and we end it. Its stdin ends
    when we do, or at once where its errors are heard: nobody would see what it asks.
    """
    pipe = subprocess.PIPE
    process = subprocess.Popen(
        [str(word) for word in words],
        env=env,
        stdin=pipe,
        stdout=pipe if heard else None,
        stderr=pipe if heard == "stderr" else None,
        start_new_session=True,
        preexec_fn=_tied(),
    )
    with process, ending.at_once(lambda: _kill(process)):
        try:
            said = b""
            if heard == "stderr":
                _, said = process.communicate()
            elif process.stdout:
                said = process.stdout.read()
            process.wait()
        finally:
            _kill(process)
    return process.returncode, said.decode(errors="replace")


def _kill(process: subprocess.Popen[bytes]) -> None:
    """With what it has started itself."""
    if process.poll() is not None:
        return
    with suppress(OSError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()


def _tied() -> Callable[[], object] | None:
    """The call by which a new process asks to be killed with us; None where the system has none."""
    with suppress(OSError, AttributeError, TypeError):
        ask = ctypes.CDLL(None).prctl
        return lambda: ask(_WITH_PARENT, int(signal.SIGKILL))
    return None
