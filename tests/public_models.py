"""How the models of gymnasium and dm-control step: `make models` writes reports/public_models.csv.

The packages' newest releases are brought into a folder of their own, without what they depend on.
What has been measured is in the store: a run that was ended goes on where it was.
"""

import subprocess
import sys
import tempfile
from importlib.metadata import distributions
from pathlib import Path

import mujoco
import pandas as pd

LIST = Path(__file__).parents[1] / "reports" / "public_models.csv"
FOLDERS = {"gymnasium": "gymnasium/envs/mujoco/assets", "dm-control": "dm_control/suite"}
"""By package where its models are."""


def main() -> None:
    """Writes a row for each model, with its package's version and MuJoCo's."""
    frames: list[pd.DataFrame] = []
    with tempfile.TemporaryDirectory() as place:
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", place]
        subprocess.run([*pip, *FOLDERS], check=True)
        versions = {one.name.replace("_", "-"): one.version for one in distributions(path=[place])}
        for package, folder in FOLDERS.items():
            out = Path(place, "reports", package)
            run = [sys.executable, "-m", "textmech", "run", str(Path(place, folder)), "--causes"]
            done = subprocess.run([*run, "--out", str(out)], check=False)
            if done.returncode > 1:
                raise SystemExit(f"{package}: the run ended with {done.returncode}")
            frame = pd.read_csv(out / "models.csv", dtype=str, keep_default_na=False)
            frame.insert(0, "package", f"{package} {versions[package]}")
            frame.insert(1, "engine", f"mujoco {mujoco.__version__}")
            frames.append(frame)
    pd.concat(frames).to_csv(LIST, index=False, lineterminator="\n")


if __name__ == "__main__":
    main()
