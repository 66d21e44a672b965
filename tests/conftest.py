"""How many examples property tests try: 200, the same every time, or with ``GOLC_EXAMPLES=5000`` that many new ones."""

from __future__ import annotations

import os
import signal

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

# A shell that starts the tests in the background has them ignore Ctrl-C, and with them what they interrupt; `nohup` has
# them ignore that its terminal has gone.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
