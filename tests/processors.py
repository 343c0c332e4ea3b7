"""Runs the tests as other processors would: `python tests/processors.py [what pytest takes]`.

A sum of products has other last bits with other vector units, another number of threads or another
order of a set. A test whose outcome changes with them hangs on rounding. Each machine of the list
is played by this one with variables that OpenBLAS, numpy, glibc and Python read; one that would be
the same as another here is left out, and said.
"""

import os
import subprocess
import sys
import tempfile

OLD = "-AVX512F,-AVX512VL,-AVX2,-FMA"
MACHINES: dict[str, dict[str, str]] = {
    "as it is": {},
    "SkylakeX": {"OPENBLAS_CORETYPE": "SkylakeX", "PYTHONHASHSEED": "1"},
    "Haswell": {"OPENBLAS_CORETYPE": "Haswell", "NPY_DISABLE_CPU_FEATURES": "X86_V4 AVX512_ICL"},
    "Sandybridge": {"OPENBLAS_CORETYPE": "Sandybridge", "OPENBLAS_NUM_THREADS": "2"},
    "Nehalem": {"OPENBLAS_CORETYPE": "Nehalem", "PYTHONHASHSEED": "2"},
    "Prescott": {
        "OPENBLAS_CORETYPE": "Prescott",
        "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL",
        "GLIBC_TUNABLES": f"glibc.cpu.hwcaps={OLD}",
        "OPENBLAS_NUM_THREADS": "1",
    },
}
BITS = """
import hashlib, numpy as np
x = np.random.default_rng(1).random((40, 40)) + 0.1
sums = x @ x, np.linalg.solve(x, x[0]), np.exp(x), np.sin(x), x.sum()
print(hashlib.sha256(b"".join(np.asarray(s).tobytes() for s in sums)).hexdigest())
print(hash("the order of a set"))
"""


def bits(machine: dict[str, str]) -> str:
    """What sums, functions and the order of a set come to on that machine."""
    own = {"PYTHONHASHSEED": "0"} | os.environ | machine
    command = [sys.executable, "-c", BITS]
    return subprocess.run(command, env=own, check=True, stdout=subprocess.PIPE, text=True).stdout


def passes(machine: dict[str, str], asked: list[str]) -> bool:
    """Whether the tests pass there, with nothing at hand that another machine has found."""
    with tempfile.TemporaryDirectory(prefix="textmech-processors-") as empty:
        own = {"PYTHONHASHSEED": "0"} | os.environ | machine | {"TEXTMECH_CACHE": empty}
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *asked]
        return subprocess.run(command, env=own, check=False).returncode == 0


def main(asked: list[str]) -> int:
    """1 if a test fails on any machine, as a command's exit code."""
    seen: dict[str, str] = {}
    failed = []
    for name, machine in MACHINES.items():
        same = seen.setdefault(bits(machine), name)
        if same != name:
            print(f"{name}: the same bits here as {same}, left out", flush=True)
            continue
        print(f"{name}: {' '.join(f'{k}={v!r}' for k, v in machine.items())}", flush=True)
        if not passes(machine, asked):
            failed.append(name)
    print(f"failed: {', '.join(failed)}" if failed else "the same on all of them")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or ["-n", "auto", "--dist", "worksteal"]))
