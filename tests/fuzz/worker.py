"""A process that is given numbers of inputs, one a line, and says of each what became of it.

``python tests/fuzz/worker.py SEED FOLDER MEGABYTES``
"""

from __future__ import annotations

import faulthandler
import json
import random
import re
import resource
import signal
import sys
import traceback
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.fuzz.corpus import seeds
from tests.fuzz.inputs import Inputs
from tests.fuzz.stages import Clock, FaultError, every_stage

MEGABYTE = 2**20


def main() -> None:
    """Answers on the stream that was standard output; what golc prints goes nowhere."""
    answers, sys.stdout = sys.stdout, sys.stderr
    inputs = Inputs(seeds(), int(sys.argv[1]), Path(sys.argv[2]))
    most = int(sys.argv[3]) * MEGABYTE
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    faulthandler.enable()
    faulthandler.register(signal.SIGUSR1)
    for line in sys.stdin:
        clock = Clock(lambda stage: print(json.dumps(stage), file=answers, flush=True))
        print(json.dumps(_answer(inputs, int(line), clock)), file=answers, flush=True)


def _answer(inputs: Inputs, number: int, clock: Clock) -> dict[str, Any]:
    answer: dict[str, Any] = {"times": clock.times}
    before = _megabytes()
    try:
        examined = every_stage(inputs.write(number, clock), random.Random(number), clock)
    except FaultError as error:
        answer |= {"fault": str(error), "kind": _kind(str(error).splitlines())}
    except Exception as error:
        lines = traceback.format_exception(error, limit=-25)
        answer |= {"fault": "".join(lines), "kind": _kind(traceback.format_exception(error))}
    else:
        answer |= {"theory": examined.theory is not None, "codes": sorted({f.code.code for f in examined.findings})}
        answer |= {"asked": examined.asked, "undecided": examined.undecided}
    return answer | {"megabytes": _megabytes(), "more": _megabytes() - before}


def _megabytes() -> int:
    """The most memory that this process has had so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024


def _kind(lines: list[str]) -> str:
    """The innermost place in golc and the error: what inputs with the same fault have in common."""
    text = "".join(line if line.endswith("\n") else f"{line}\n" for line in lines).splitlines()
    places = [line.strip() for line in text if line.lstrip().startswith("File") and "/golc/" in line]
    errors = [line for line in text if re.match(r"\w[\w.]*(Error|Exception|Assertion)\b|the canonical|not? \w+", line)]
    error = errors[-1] if errors else text[-1]
    return f"{error[:120]} | {places[-1] if places else ''}"


if __name__ == "__main__":
    main()
