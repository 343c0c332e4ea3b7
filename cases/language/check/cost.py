"""The cost of a reference, in seconds of a common machine, for each thing that can be counted.

Measured on one core of 2 GHz or so with chains, of 1 to 100 bars in the plane and 1 to 30 in space,
and rounded up. Only their sum is asked, and whether it is minutes or hours. A scene here is what
hangs together: islands that are solved apart cost what each costs.
"""

from ...scene import Scene

LIMIT = 300.0  # s of one case, what a person waits for without having been asked
OF_A_RADIAN = 800  # evaluations, of all motions together (measured on a pendulum)
OF_A_SAMPLE = 72  # evaluations at least: an explicit step, and four implicit ones


def evaluation(scene: Scene) -> float:
    """Cost [s] of the slopes of a motion, with the share of an integrator's linear equations."""
    n = len(scene.bodies)
    microseconds = (27, 0.6, 0.016) if scene.frame.dimension == 2 else (60, 1, 0.3, 0.012)
    return 1e-6 * _power(microseconds, n)


def laws(scene: Scene) -> float:
    """Cost [s] of all laws that are asked at a sample."""
    n = len(scene.bodies)
    milliseconds = (1.5, 0.3, 0.016) if scene.frame.dimension == 2 else (3, 2, 0.12, 0.004)
    return 1e-3 * _power(milliseconds, n)


def sample(scene: Scene) -> float:
    """Cost [s] of a sample, at which all motions end a step."""
    return OF_A_SAMPLE * evaluation(scene) + laws(scene)


def state(scene: Scene) -> float:
    """Cost [s] of one of the states of a claim about states."""
    n = len(scene.bodies)
    milliseconds = (0.1, 0.1, 0.0) if scene.frame.dimension == 2 else (2, 1.2, 0.3)
    return 1e-3 * _power(milliseconds, n)


def swung(scene: Scene, rad: float) -> float:
    """Cost [s] of swinging so far [rad]."""
    return OF_A_RADIAN * evaluation(scene) * rad


def about(seconds: float) -> str:
    """In words of the right size."""
    minutes = seconds / 60
    for size, unit in ((60 * 24 * 365, "years"), (60 * 24, "days"), (60, "hours")):
        if minutes > 2 * size:
            return f"about {minutes / size:.2g} {unit}"
    return f"about {minutes:.0f} minutes"


def _power(of: tuple[float, ...], n: int) -> float:
    return sum(factor * n**k for k, factor in enumerate(of))
