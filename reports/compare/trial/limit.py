"""How long an engine may take for one task, beyond what its steps are worth: then it hangs.

And how much memory its process may take: one that eats without end costs its own rows, and not the
run. Both are told by the environment, so that processes of our own and pytest know them too.
"""

import os
from contextlib import suppress
from math import inf

VARIABLE = "TEXTMECH_TIME_LIMIT"
USUAL = 120.0  # s of a clock, for what waits spends nothing else: a task of ours takes a few
SLACK = 10.0  # times what a run is worth: the machine may be busy, or old


def limit(worth: float = 0.0) -> float:
    """The time [s] for a task that is worth so much [s]. Raises ValueError as `choose` does."""
    return _above_zero(os.environ.get(VARIABLE, USUAL), f"${VARIABLE}") + SLACK * worth


def choose(seconds: float | None) -> None:
    """Sets the limit from now on; None: the usual one, or what the environment says.

    Raises ValueError where this, or the environment's word of the memory, is no number above 0.
    """
    if seconds is not None:
        os.environ[VARIABLE] = repr(_above_zero(seconds, "it"))
    limit()
    if MEMORY in os.environ:
        _above_zero(os.environ[MEMORY], f"${MEMORY}", "GiB")


def _above_zero(said: str | float, what: str, unit: str = "seconds") -> float:
    try:
        number = float(said)
    except ValueError:
        number = 0.0
    if not number > 0.0:  # nan is none either
        raise ValueError(f"{what} should be a number of {unit} above 0, is {said!r}")
    return number


MEMORY = "TEXTMECH_MEMORY_LIMIT"
SHARE = 0.5  # of the machine's memory for all processes: the rest is the user's
LEAST = 2.0  # GiB for one: engines and a case of ours take some 0.5
GIB = 2**30


def limit_memory(jobs: int) -> None:
    """Limit this process, one of so many, to its share of the memory, where the system can.

    The share is beside what the process has already, which may be all that a notebook holds. What
    it asks for beyond is refused, as a MemoryError in Python. Room that is only reserved, as for a
    graphics card, does not count. The share is put into the environment, from which messages read
    it: no row says how much the process had before.
    """
    with suppress(ImportError, AttributeError, OSError, ValueError):  # no POSIX, or a lower limit
        import resource

        share = _share(jobs)
        most = _data_size() + int(GIB * share)
        hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
        if hard == resource.RLIM_INFINITY or most < hard:
            resource.setrlimit(resource.RLIMIT_DATA, (most, hard))
            os.environ[MEMORY] = repr(share)


def _data_size() -> int:
    """Returns the data [bytes] of this process, as its parent had them; 0 where nothing tells."""
    with (
        suppress(OSError, ValueError, IndexError),
        open("/proc/self/status", encoding="ascii") as status,
    ):
        return 1024 * next(int(line.split()[1]) for line in status if line.startswith("VmData:"))
    return 0


def memory_limit_text() -> str:
    """How much memory this process may take, in words; nothing where nobody limits it."""
    with suppress(ImportError, AttributeError, OSError):
        import resource

        most = resource.getrlimit(resource.RLIMIT_DATA)[0]
        if most != resource.RLIM_INFINITY:
            return f"{min(most / GIB, _from_environment(inf)):.3g} GiB"
    return ""


def _share(jobs: int) -> float:
    """Returns the memory [GiB] that each of so many processes may take."""
    all_of_it = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / GIB
    return _from_environment(max(LEAST, SHARE * all_of_it / jobs))


def _from_environment(usual: float) -> float:
    """Returns the memory [GiB] that the environment gives each process, else the usual."""
    with suppress(KeyError, ValueError):
        if (said := float(os.environ[MEMORY])) > 0.0:
            return said
    return usual
