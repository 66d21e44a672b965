"""The lines that say what people do, one thing a line::

    at 3 s: press go for 0.3 s
    on sound up after 2 s: press go
    on sound down after 4 s: put back
    on 2nd stop after 1 s at station 5: put at station 3 facing backward
    at 60 s: lift
    at 62 s: put at 400, 250 facing 90

``at`` counts from the beginning, ``on`` from when the robot makes a sound, or from when its wheels stop, and then it
must still stand at the end of that time. With ``at station``, the robot has to be at that station when it begins.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from math import radians

from golc.diagnostics import Code, Findings, Span
from golc.runtime.rcxsim.surroundings import Button
from golc.runtime.rcxsim.world.people import At, Cue, Deed, Lift, Names, OnSound, OnStop, Press, PutAt, PutBack, PutDown
from golc.runtime.rcxsim.world.robot import SECOND
from golc.theory.suggest import did_you_mean

SOUNDS = ("click", "double_beep", "down", "up", "low_beep", "fast_up")
"""The brick's own sounds by number; the names are those of NQC."""
BRICK_BUTTONS = tuple(button.value for button in Button)
PRESSED_FOR = 0.3
"""Seconds that a button is held where the line does not say."""

_NUMBER = r"\d{1,9}(?:\.\d{1,9})?"
_SIGNED = rf"[-+]?{_NUMBER}"
_TRIGGER = re.compile(
    rf"(?:at\s+(?P<at>{_NUMBER})\s*s"
    rf"|on\s+(?:(?P<nth>\d{{1,9}})(?:st|nd|rd|th)\s+)?(?:(?P<sound>sound)(?:\s+(?P<which>(?!after\b)\w+))?|stop)"
    rf"\s+after\s+(?P<after>{_NUMBER})\s*s(?:\s+at\s+station\s+(?P<station>\S+))?)"
)
_DEED = re.compile(
    rf"press\s+(?P<button>\S+)(?:\s+for\s+(?P<held>{_NUMBER})\s*s)?"
    r"|(?P<lift>lift)"
    r"|(?P<back>put\s+back)"
    rf"|put\s+at\s+station\s+(?P<station>\S+?)(?:\s+facing\s+(?P<way>forward|backward|{_SIGNED}))?"
    rf"|put\s+at\s+(?P<x>{_SIGNED})\s*,\s*(?P<y>{_SIGNED})\s+facing\s+(?P<facing>{_SIGNED})"
)
FORMS = "write `at 3 s: DEED`, `on sound up after 2 s: DEED` or `on stop after 1 s at station 5: DEED`"
DEEDS = "people can `press BUTTON for 0.3 s`, `lift`, `put back`, `put at station 3 facing forward`, " + (
    "`put at 400, 250 facing 90`"
)


def read_deed(text: str, where: Span, names: Names, findings: Findings) -> Deed | None:
    """What people do, such as ``press go for 0.3 s``; None if it is wrong, which is then a finding at ``where``."""
    text = text.strip()
    match = _DEED.fullmatch(text)
    if match is None:
        findings.error(Code.WORLD, f"`{text}` is nothing that people can do here", where, help=DEEDS)
        return None
    if match["button"]:
        known = _known(match["button"], "button", [*names.buttons, *BRICK_BUTTONS], where, findings)
        return Press(match["button"], _micro(match["held"] or PRESSED_FOR)) if known else None
    if match["station"]:
        known = _known(match["station"], "station", names.stations, where, findings)
        return _put_at(match["station"], match["way"]) if known else None
    if match["x"]:
        return PutDown(float(match["x"]), float(match["y"]), radians(float(match["facing"])))
    return Lift() if match["lift"] else PutBack()


def read_line(text: str, where: Span, names: Names, findings: Findings) -> Cue | None:
    """A line of a script; None if it is wrong, which is then a finding at ``where``."""
    when, colon, what = text.partition(":")
    match = _TRIGGER.fullmatch(when.strip())
    if not colon or match is None:
        findings.error(Code.WORLD, f"`{text.strip()}` does not say when people do what", where, help=FORMS)
        return None
    deed = read_deed(what, where, names, findings)
    if not _known(match["station"], "station", names.stations, where, findings) or deed is None:
        return None
    if match["at"]:
        return Cue(At(), _micro(match["at"]), deed)
    nth = None if match["nth"] is None else int(match["nth"])
    if nth == 0:
        findings.error(Code.WORLD, "counts begin with `1st`", where)
        return None
    trigger: OnSound | OnStop = OnStop()
    if match["sound"]:
        number = _sound(match["which"])
        if number == _UNHEARD_OF:
            help_ = did_you_mean(match["which"], SOUNDS) or f"the sounds are {', '.join(SOUNDS)}, or 0 to 5"
            findings.error(Code.WORLD, f"the brick has no sound `{match['which']}`", where, help=help_)
            return None
        trigger = OnSound(number)
    return Cue(trigger, _micro(match["after"]), deed, nth, match["station"])


_UNHEARD_OF = -1


def _sound(word: str | None) -> int | None:
    """The number of a sound; None stands for any."""
    if word is None:
        return None
    if word in SOUNDS:
        return SOUNDS.index(word)
    return int(word) if word in map(str, range(len(SOUNDS))) else _UNHEARD_OF


def _put_at(station: str, way: str | None) -> PutAt:
    if way in (None, "forward", "backward"):
        return PutAt(station, backward=way == "backward")
    return PutAt(station, facing=radians(float(way)))


def _known(name: str | None, what: str, names: Collection[str], where: Span, findings: Findings) -> bool:
    if name is None or name in names:
        return True
    help_ = did_you_mean(name, names) or (f"there are {', '.join(names)}" if names else f"the file has no {what}")
    findings.error(Code.WORLD, f"there is no {what} `{name}`", where, help=help_)
    return False


def _micro(seconds: str | float) -> int:
    return round(float(seconds) * SECOND)
