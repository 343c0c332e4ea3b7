"""One body on the floor as a user builds it, in plain MuJoCo and pymunk, with lines pasted in.

Nothing of the adapters is here: a file with z up and a free joint, a script with a `space`.
"""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
import re
from typing import Any

import mujoco
import numpy as np
import pymunk

from textmech.cases.case import Case
from textmech.cases.trajectory import Array
from textmech.engines.engine import Start

Box = tuple[float, float]
BOX: Box = (0.2, 0.1)  # m, of what a case calls a particle: nobody has a point
CUBE: Box = (0.1, 0.1)

MJCF = """
<mujoco>
  {pasted}
  <option gravity="{gx} 0 {gz}"/>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1" {rubs}/>
    <body pos="{x} 0 {z}" euler="0 {turned} 0">
      <freejoint/>
      <geom name="body" {geom} mass="{mass}" {rubs}/>
      {inertial}
    </body>
  </worldbody>
  {pair}
</mujoco>
"""


def in_mujoco(case: Case, start: Start, pasted: str, times: Array, box: Box = BOX) -> Array:
    """(N, 3) x, y and angle at the times: a box geom, or a sphere with the disk's inertia."""
    (body,), (contact,) = case.scene.bodies.values(), [*case.scene.contacts.values()][:1]
    (x, y, angle, vx, vy, omega), (gx, gy) = start[body.name], case.scene.gravity
    lifted = 0.0 if body.turns else box[1] / 2
    geom, inertial = f'type="sphere" size="{body.radius}"', ""
    if body.radius is None:
        width, height = body.size or box
        geom = f'type="box" size="{width / 2} {width / 2} {height / 2}"'
    else:
        j = body.moment
        inertial = f'<inertial pos="0 0 0" mass="{body.mass}" diaginertia="{j} {j} {j}"/>'
    found = re.findall("<contact>.*</contact>", pasted) if "solreffriction" in pasted else [""]
    pair = found[0].replace("…", "floor", 1).replace("…", "body", 1)
    text = MJCF.format(
        pasted=pasted, gx=gx, gz=gy, x=x, z=y + lifted, turned=-math.degrees(angle), geom=geom,
        mass=body.mass, inertial=inertial, pair=pair, rubs=f'friction="{contact.friction} 0 0"',
    )  # fmt: skip
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qvel[:] = vx, 0.0, vy, 0.0, -omega, 0.0
    rows, seen, done = [[x, y, angle]], angle, 0
    for count in np.rint(times[1:] / model.opt.timestep).astype(int):
        for _ in range(count - done):
            mujoco.mj_step(model, data)
            seen -= model.opt.timestep * data.qvel[4]  # only whole turns are taken from it
        done = count
        w, _, about, _ = data.qpos[3:]
        turned = -2 * math.atan2(about, w)
        turned += math.tau * round((seen - turned) / math.tau)
        rows.append([data.qpos[0], data.qpos[2] - lifted, turned])
    return np.array(rows)


def in_pymunk(case: Case, start: Start, pasted: str, times: Array, box: Box = BOX) -> Array:
    """(N, 3) x, y and angle at the times: a box, or a circle."""
    (part,), (contact,) = case.scene.bodies.values(), [*case.scene.contacts.values()][:1]
    x, y, angle, vx, vy, omega = start[part.name]
    lifted = 0.0 if part.turns else box[1] / 2
    space = pymunk.Space()
    space.gravity = case.scene.gravity
    floor = pymunk.Segment(space.static_body, (-100, 0), (100, 0), 0)
    floor.friction = floor.elasticity = 1.0
    body = pymunk.Body(part.mass, part.moment or pymunk.moment_for_box(part.mass, box))
    if part.radius is None:
        shape: Any = pymunk.Poly.create_box(body, part.size or box)
    else:
        shape = pymunk.Circle(body, part.radius)
    shape.friction, shape.elasticity = contact.friction, contact.restitution
    body.position, body.velocity = (x, y + lifted), (vx, vy)
    body.angle, body.angular_velocity = angle, omega
    space.add(floor, body, shape)
    names: dict[str, Any] = {"space": space, "pymunk": pymunk}
    exec(pasted, names)
    h = names["h"]
    ahead = h / 2 if "h/2 back" in pasted else 0.0
    rows, done = [[x, y, angle]], 0
    for count in np.rint(times[1:] / h).astype(int):
        for _ in range(count - done):
            space.step(h)
        done = count
        place = body.position + ahead * body.velocity
        rows.append([place.x, place.y - lifted, body.angle + ahead * body.angular_velocity])
    return np.array(rows)


MODELS = {"mujoco": in_mujoco, "pymunk": in_pymunk}
"""By the engine's name."""
