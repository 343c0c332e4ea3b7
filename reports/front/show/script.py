"""A case's scene as the engine's own file or script, ready to paste."""

from ....cases.case import Case
from ....cases.mistake import CaseError
from ....engines.engine import Engine, Refusal
from ...compare.trial.ladder import judged_step
from ...compare.trial.start import assembled
from ...compare.trial.states import moving
from ...compare.trial.trial import ways


def script(case: Case, engine: Engine) -> str:
    """The file at the judged step, headed by the case, the setting, and each number's reason.

    Raises CaseError where the engine does not build the scene natively.
    """
    start = assembled(moving(case))
    native = next(w for w in ways(engine, case.scene, start) if w.realised == "native")
    if isinstance(native, Refusal):
        raise CaseError([case.mistake(("scene",), f"is refused: {native.because}")])
    title = f"{case.name}: {case.title}"
    step, duration = judged_step(case, engine), case.duration
    return engine.script(case.scene, start, step, native, title=title, duration=duration)
