"""The plug-in where a file has mistakes, or asks for endless work."""

import pytest
from given.inner import inner
from given.pendulum import pendulum

pytest_plugins = ["pytester"]

ONLY = ("--textmech-engine", "mujoco.tuned")


@pytest.mark.slow
def test_a_mistake_that_solving_finds_costs_its_own_file(pytester: pytest.Pytester) -> None:
    pytester.makefile(".yaml", good=pendulum(), still=pendulum(angle="-90 deg"))
    done = inner(pytester, "good.yaml", "still.yaml", *ONLY)
    done.assert_outcomes(passed=3, failed=3)  # each: the reference, the audit, the angle
    done.stdout.fnmatch_lines(["*still.yaml:11:9: allow.rod.angle: never moves*"])


@pytest.mark.slow
def test_endless_work_is_said_and_allow_long_goes_on(pytester: pytest.Pytester) -> None:
    pytester.makefile(".yaml", slow=pendulum(step=1e-9))
    done = inner(pytester, "slow.yaml", *ONLY)
    done.assert_outcomes(failed=1)
    done.stdout.fnmatch_lines(["*slow.yaml:10:1: step: *--textmech-allow-long*"])
    done = inner(pytester, "slow.yaml", "--textmech-allow-long", "--collect-only", "-q", *ONLY)
    done.stdout.fnmatch_lines(["slow.yaml::slow-mujoco.tuned-rod.angle"])


@pytest.mark.slow
def test_the_settings_of_the_ini_file_may_be_of_another_engine(pytester: pytest.Pytester) -> None:
    """What its settings are for may be all that is not asked now; who names a file means it."""
    pytester.makefile(".yaml", good=pendulum(), mine="pymunk: {step: 2.5e-3}\n")
    pytester.makeini("[pytest]\ntextmech_settings = mine.yaml\n")
    done = inner(pytester, "good.yaml", "--collect-only", "-q", *ONLY)
    done.stdout.fnmatch_lines(["good.yaml::good-mujoco.tuned-rod.angle"])
    done = inner(pytester, "good.yaml", "--textmech-settings", "mine.yaml", *ONLY)
    done.assert_outcomes(errors=1)
    done.stdout.fnmatch_lines(["*--textmech-settings: mine.yaml: no chosen engine uses it*"])
