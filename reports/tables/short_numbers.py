"""Numbers as short as a table of 80 columns needs them."""

NEAR = 1.1
MANY = 1000.0  # from which on a power of ten is shorter


def factor(ratio: float) -> str:
    """Formats a ratio in two digits: 2.4, 340, 1.3e4; but 1.04, which is more than once."""
    if ratio < MANY:
        return f"×{float(f'{ratio:.{3 if ratio < NEAR else 2}g}'):g}"
    digits, _, power = f"{ratio:.1e}".partition("e")
    return f"×{digits}e{int(power)}" if power else f"×{digits}"  # inf has no power


def milliseconds(step: float) -> str:
    """Formats a step [s] in milliseconds: 8 ms, 0.25 ms."""
    return f"{float(f'{1e3 * step:.3g}'):g} ms"
