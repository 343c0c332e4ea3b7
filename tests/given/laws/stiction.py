"""By what systems with one slip rub, for the laws: where they stick, and where they slide."""

_RUBS = {
    "bearing": ("axle.friction", "sticks", ("turns",)),
    "friction_cone": ("touch.tangent", "sticks", ("down", "up")),
    "friction_of_rest": ("touch.tangent", "stuck", ("backward", "forward")),
    "stribeck_brake": ("guide.fx", "stuck", ("backward", "forward")),
    "stribeck_drive": ("guide.fx", "stuck", ("backward", "forward")),
}
HELD = {(system, stuck): name for system, (name, stuck, _) in _RUBS.items()}
"""(system, mode) → the reaction that its only multiplier is; its row is known as a rate only."""
SLIDING = {(system, mode): name for system, (name, _, slides) in _RUBS.items() for mode in slides}
"""(system, mode) → the force that no cut finds."""
