"""How many examples property tests try: 200, the same every time, or with ``GOLC_EXAMPLES=5000`` that many new ones."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

EXAMPLES = os.environ.get("GOLC_EXAMPLES")

settings.register_profile(
    "golc",
    max_examples=int(EXAMPLES or 200),
    derandomize=EXAMPLES is None,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("golc")
