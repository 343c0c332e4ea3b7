"""The action for other projects' CI: its own lines, run by bash, with and without a regression."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from given.scenes.swing import swing
from ruamel.yaml import YAML

ACTION = Path(__file__).parents[1] / "action.yml"
INPUTS = {"what": "swing.yaml --engine mujoco.shipped", "baseline": "baseline", "out": "new"}


def ended(folder: Path) -> list[int]:
    """The exit code of each step but the installation, as far as a job goes on."""
    _, *steps = YAML(typ="safe").load(ACTION)["runs"]["steps"]
    variables = folder / "variables"
    variables.touch()
    codes: list[int] = []
    for step in steps:
        given = dict(line.split("=", 1) for line in variables.read_text().splitlines())
        for name, value in step.get("env", {}).items():
            given[name] = INPUTS[value.removeprefix("${{ inputs.").removesuffix(" }}")]
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        files = {"GITHUB_ENV": str(variables), "GITHUB_STEP_SUMMARY": str(folder / "summary.md")}
        command = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]]
        env = {**os.environ, **files, **given, "PATH": path}
        done = subprocess.run(command, cwd=folder, env=env, capture_output=True, check=False)
        codes.append(done.returncode)
        if done.returncode:
            break
    return codes


@pytest.mark.slow
@pytest.mark.mutant("a project's engine got worse than its baseline")
def test_a_regression_against_the_baseline_ends_the_job(tmp_path: Path) -> None:
    (tmp_path / "swing.yaml").write_text(swing("1.0e-1"), encoding="utf-8")
    words = [sys.executable, "-m", "textmech", "run", *INPUTS["what"].split(), "--out", "baseline"]
    subprocess.run(words, cwd=tmp_path, check=True, capture_output=True)
    assert ended(tmp_path) == [0, 0, 0]
    assert "nothing changed" in (tmp_path / "summary.md").read_text()
    shutil.rmtree(tmp_path / "new")
    (tmp_path / "swing.yaml").write_text(swing("1.0e-9"), encoding="utf-8")
    assert ended(tmp_path)[:2] == [0, 1]
    (tmp_path / "swing.yaml").write_text("title: 3\n", encoding="utf-8")
    assert ended(tmp_path) == [2]  # nothing was run
