"""A case's scene as the engine's own file or script, ready to paste."""

from ...cases.case import Case
from ...engines.engine import Engine, State
from ...reference.generated.mechanism import Mechanism
from ...reference.start.assembly import assemble
from ..trial.ladder import judged_step


def script(case: Case, engine: Engine) -> str:
    """The file, headed by the case, the setting, and each number's reason."""
    mechanism = Mechanism(case.scene, assemble(case))
    poses = mechanism.poses(0.0, *mechanism.start())
    start: State = {name: tuple(float(x) for x in pose) for name, pose in poses.items()}  # type: ignore[misc]
    step = judged_step(case, engine)
    head = [
        f"{case.name}: {case.title}",
        f"{engine.name} {engine.version}, {engine.setting}, h = {step:g} s",
        *(f"{c.name} = {c.value}: {c.because}" for c in engine.choices(case.scene, step)),
    ]
    protocol = engine.protocol(case.scene, start, step, "native")
    if protocol:
        head.append(f"protocol: {protocol}")
    opening, closing = engine.comment
    comments = "".join(f"{opening}{line}{closing}\n" for line in head)
    return comments + engine.script(case.scene, start, step)
