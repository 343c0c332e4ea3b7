"""How hypothesis draws: the same examples in every run. Who searches longer asks for more."""

from hypothesis import HealthCheck, settings


def examples(count: int) -> settings:
    """So many of them."""
    return settings(
        max_examples=count,
        derandomize=True,
        deadline=None,  # the machine may be busy
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
    )
