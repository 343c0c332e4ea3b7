"""Spring and damper with which a contact of MuJoCo's throws back, in terms of the step h.

`springy` and `dead` return k [1/s²] as a text, b [1/h], and what they do.
"""

import math

BEAT = 0.2  # h times the contact's frequency
# 1/s: what has landed comes up within a tenth of a second, and is thrown back by 0.1 % of its
# speed at 1e-4 s: both errors are of first order. A spring of 0.01/h² throws back 1 % at any h.
RISE = 10.0
LEAST_BOUNCE = 0.02  # below, the damper that a spring of BEAT needs is unstable with RK4


def springy(e: float, beat: float = BEAT) -> tuple[str, float, str]:
    """For what keeps e > 0 of its speed. beat: h times the frequency.

    Where in a step a bounce begins decides what RK4 keeps, at any h: at e = 1 it is off by up to
    beat²/20 of it, else by b/3, for the damper meets at once what lands. Of 0.2 that is 0.2 %, 1 %
    at e = 0.8, 3.5 % at 0.5, 16 % at 0.1 (measured in test_contact.py); of 0.05 a quarter, in a
    bounce that lasts four times as long.
    """
    lasts, kept = spread(e, beat)
    because = (
        f"k = ({beat}/h)²: a bounce lasts {lasts:.0f} h; b gives e = {e:g}, to about {kept:.2g} % "
        "by where in a step it begins"
    )
    return f"{beat**2:.2g}/h2", 2 * damping_ratio(e) * beat, because


def spread(e: float, beat: float = BEAT) -> tuple[float, float]:
    """How many steps a bounce lasts, and how well [%] it keeps its speed, however small they are.

    For MuJoCo has no impulse: what strikes obliquely slides on meanwhile.
    """
    return math.pi / beat, 100 * max(beat**2 / 20, 2 * damping_ratio(e) * beat / 3)


def dead(points: int) -> tuple[str, float, str]:
    """For what throws nothing back, of a body that may land with so many points.

    Their dampers add up, and RK4 bears 2.8/h.
    """
    b = 1 / points
    because = f"k = {RISE:g}/h, b = {b:.3g}/h: it is hardly thrown back, and rises slowly"
    return f"{RISE:g}/h", b, because


def damping_ratio(bounce: float) -> float:
    """ζ of a spring and damper that push only, and throw back with `bounce` of the speed.

    With ζ = sin ψ: e = exp(−(π − 2ψ) tan ψ); with ζ = cosh χ: e = exp(−2χ coth χ).
    """
    from scipy.optimize import brentq

    turning = math.exp(-2.0)  # e at ζ = 1
    if bounce == 1.0:
        return 0.0
    if bounce > turning:
        psi = brentq(
            lambda x: math.exp(-(math.pi - 2 * x) * math.tan(x)) - bounce, 0.0, math.pi / 2 - 1e-6
        )
        return math.sin(psi)
    chi = brentq(lambda x: math.exp(-2 * x / math.tanh(x)) - bounce, 1e-6, 50.0)
    return math.cosh(chi)
