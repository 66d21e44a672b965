"""How patient the host is with a brick, and the account it keeps of what went over the wire."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Timing:
    """The patience of the host, in simulated seconds unless it says otherwise; the defaults are those of Legolog."""

    answer: float = 3.5
    """Wait for an answer, and what a request for more time is worth; less than the time a tower stays awake."""
    poll: float = 0.3
    """Wait for the answer to a poll."""
    least: float = 1.0
    """A part is not sent again when less than this is left of the action's time."""
    late: float = 2.0
    """A digit that takes longer than this after the one before it was acknowledged may be a repetition."""
    sends: int = 5
    """Number of times that a part is sent without an answer before the brick counts as silent."""
    polls: int = 8
    """Number of polls in a row without an answer, and ..."""
    silence: float = 15.0
    """... time since the first of them, before the brick counts as silent."""
    nonsense: int = 8
    """Number of meaningless messages in a row that are ignored."""
    abort: float = 4.0
    """Time in which the brick has to confirm an abort."""


@dataclass
class BrickStatistics:
    """What happened between the host and one brick, counted."""

    actions: int = 0
    """Actions that were answered."""
    polls: int = 0
    """Requests for exogenous actions."""
    events: int = 0
    """Exogenous actions received."""
    resent: int = 0
    """Messages sent again because no answer came."""
    repeated: int = 0
    """Actions sent again from their first digit."""
    unanswered: int = 0
    """Polls without an answer in time."""
    more_time: int = 0
    """Requests for more time."""
    late: int = 0
    """Exogenous actions that came after the host had given up their poll."""
    lost: int = 0
    """Exogenous actions of which only a part arrived."""
    nonsense: int = 0
    """Messages that meant nothing where they came."""
    panics: int = 0
    """Times that the brick reported panic."""
    aborts: int = 0
    """Times that the brick was told to stop."""
