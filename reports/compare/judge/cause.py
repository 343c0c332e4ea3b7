"""Why there is a difference, as far as a held ladder tells."""

from ...tables import row as of
from .convergence import FALLEN, Convergence

STEPS = (of.EXACT, of.TEXTBOOK, of.WITHIN, of.FALLS)  # verdicts that blame no model


def cause(convergence: Convergence, finer: str = "", simplified: str = "", unit: str = "") -> str:
    """Returns why a quantity is off, in words; finer: why a step below the judged gave nothing.

    simplified: what the engine leaves out of the scene, named unless the step alone is to blame.
    unit: the quantity's.
    """
    step_alone = convergence.verdict in STEPS and not _stays_beside_event(convergence) and not finer
    left_out = "" if step_alone else simplified
    return "; ".join(part for part in (_reason(convergence, finer, unit), left_out) if part)


def _stays_beside_event(convergence: Convergence) -> bool:
    """Whether errors beside an event stay the same at every step, though elsewhere they fall."""
    sizes = convergence.errors.values()
    stays = max(sizes) < FALLEN * min(sizes)
    return convergence.verdict == of.TEXTBOOK and convergence.usable_step is None and stays


def _reason(convergence: Convergence, finer: str, unit: str) -> str:
    if finer:
        return f"a smaller step diverges ({finer}): neither step nor model can be named"
    usable = convergence.usable_step
    enough = f"within from h = {usable:.3g} s on" if usable else "not within at any step tried"
    order = "" if convergence.order is None else f" with order {convergence.order:.1f}"
    limit = f"{convergence.limit or 0.0:.3g} {unit}".rstrip()
    sizes = convergence.errors.values()
    finest = f"no step down to h = {min(convergence.errors):.3g} s helps"
    every = f"{finest}: {min(sizes):.3g} to {max(sizes):.3g} at every step tried"
    if _stays_beside_event(convergence):
        return f"beside an event {every}; elsewhere the error falls{order}"
    return {
        of.EXACT: f"the step: {enough}" if usable else "rounding",
        of.TEXTBOOK: f"the step: it falls{order}, {enough}",
        of.WITHIN: f"the step: {enough}; the model's own {limit} would be",
        of.ANOTHER: f"does not vanish with the step: {limit} stay",
        of.FALLS: f"the step: its size falls{order or ', with no clear order'}, {enough}",
        of.STAYS: every,
        of.UNSETTLED: "no limit settles over the steps tried: neither step nor model can be named",
        of.INSTANTS: f"instants of events: {enough}",
    }[convergence.verdict]
