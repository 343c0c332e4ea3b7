"""Which reactions of the hand-written systems are multipliers, and which no free cut finds."""

from . import stiction

At = tuple[str, str]
"""The name of a system, and of one of its modes."""

# The reactions that the multipliers λ of (2.60) are, in the order of the rows.
MULTIPLIERS: dict[At, tuple[str, ...]] = {
    **{at: (name,) for at, name in stiction.HELD.items()},
    ("anisotropic_drift", "stuck"): ("guide.fx",),
    ("ball_on_rope", "swings"): ("rope.force",),
    ("bouncing_disk", "rest"): ("touch.normal",),
    ("drag_stops", "rest"): ("guide.fx",),
    ("compass_walker", "left stands"): ("left_foot.tangent",),
    ("compass_walker", "right stands"): ("right_foot.tangent",),
    ("light_feet", "left stands"): ("left_foot.tangent",),
    ("light_feet", "right stands"): ("right_foot.tangent",),
    ("driven_edge", "moving"): ("blade.force", "blade.drive"),
    ("driven_knee", "moving"): ("knee.torque",),
    ("dynamometer", "stuck"): ("guide.fx",),
    ("four_bar", "moving"): ("C.fx", "C.fy"),
    ("growing_force", "stuck"): ("guide.fx",),
    ("knife_edge", "moving"): ("edge.force",),
    ("rolling_wheel", "moving"): ("touch.tangent", "touch.normal"),
    ("sleigh", "moving"): ("blade.force",),
    ("sliding_block", "sticks"): ("touch.tangent",),
    ("sliding_disk", "rolling"): ("touch.normal", "touch.tangent"),
    ("sliding_disk", "slips backward"): ("touch.normal",),
    ("sliding_disk", "slips forward"): ("touch.normal",),
    ("sliding_ladder", "leans"): ("top.normal",),
    ("stopped_pendulum", "rests"): ("stop.low",),
    ("tipping_block", "stands"): ("left.normal",),
    ("stacked_blocks", "rests"): ("floor.tangent", "upper.tangent"),
    ("stacked_blocks", "together"): ("upper.tangent",),
    ("stacked_blocks", "on top"): ("floor.tangent",),
    ("disk_on_disk", "rolls"): ("touch.normal", "touch.tangent"),
    ("disk_on_disk", "slips"): ("touch.normal",),
}
# How many rows have a residual (2.14), where not all: what sticks or rolls has no place of its own.
RESIDUALS = {
    **dict.fromkeys(stiction.HELD, 0),
    ("anisotropic_drift", "stuck"): 0,
    ("drag_stops", "rest"): 0,
    ("compass_walker", "left stands"): 0,
    ("compass_walker", "right stands"): 0,
    ("light_feet", "left stands"): 0,
    ("light_feet", "right stands"): 0,
    ("driven_edge", "moving"): 0,
    ("driven_knee", "moving"): 0,
    ("dynamometer", "stuck"): 0,
    ("growing_force", "stuck"): 0,
    ("knife_edge", "moving"): 0,
    ("sleigh", "moving"): 0,
    ("sliding_block", "sticks"): 0,
    ("sliding_disk", "rolling"): 1,
    ("stacked_blocks", "rests"): 0,
    ("stacked_blocks", "together"): 0,
    ("stacked_blocks", "on top"): 0,
    ("disk_on_disk", "rolls"): 1,
}
# The forces that no cut finds: friction that slides, and a floor that is out of reach.
APPLIED: dict[At, tuple[str, ...]] = {
    **{at: (name,) for at, name in stiction.SLIDING.items()},
    ("anisotropic_drift", "backward"): ("guide.fx",),
    ("anisotropic_drift", "forward"): ("guide.fx",),
    ("bouncing_disk", "flight"): ("touch.normal",),
    ("dynamometer", "backward"): ("guide.fx",),
    ("dynamometer", "forward"): ("guide.fx",),
    ("growing_force", "backward"): ("guide.fx",),
    ("growing_force", "forward"): ("guide.fx",),
    ("sliding_block", "down"): ("touch.tangent",),
    ("sliding_block", "up"): ("touch.tangent",),
    ("sliding_disk", "slips backward"): ("touch.tangent",),
    ("sliding_ladder", "slides"): ("top.normal",),
    ("tipping_block", "tips"): ("left.normal",),
    ("sliding_disk", "slips forward"): ("touch.tangent",),
    ("smooth_dynamometer", "moving"): ("guide.fx",),
    ("smooth_growing_force", "moving"): ("guide.fx",),
    ("disk_on_disk", "slips"): ("touch.tangent",),
    ("disk_on_disk", "flies"): ("touch.normal", "touch.tangent"),
}
