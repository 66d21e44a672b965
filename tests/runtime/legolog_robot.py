"""The delivery robot as a process of its own: a brick programmed for Legolog, at the end of a pty.

It knows its frames by heart and shares no code with golc. Usage: ``legolog_robot.py MOOD``; a mood other than
``willing`` says what it does wrong. Prints the path of its port, then every message that it hears, one a line.
"""

import os
import sys
import tty

FRAMES = {
    32: "55ff00f70820df17e8",  # turnaround
    33: "55ff00f70821de18e7",  # signal_arrival
    34: "55ff00f70822dd19e6",  # start_to_next_station
    35: "55ff00f70823dc1ae5",  # arrive_at_station
    36: "55ff00f70824db1be4",  # stop_abnormally
    37: "55ff00f70825da1ce3",  # push_go_button
    41: "55ff00f70829d620df",  # nothing that the domain knows
    64: "55ff00f70840bf37c8",  # done
    80: "55ff00f70850af47b8",  # panic
    81: "55ff00f70851ae48b7",  # abort
    82: "55ff00f70852ad49b6",  # continue
    83: "55ff00f70853ac4ab5",  # has an exogenous action occurred?
    84: "55ff00f70854ab4bb4",  # none
    85: "55ff00f70855aa4cb3",  # more time needed
    100: "55ff00f708649b5ba4",  # nothing at all
}
NUMBERS = {bytes.fromhex(frame): number for number, frame in FRAMES.items()}
ACTIONS = (32, 33, 34)
BROUGHT_ABOUT = {34: 35, 33: 37}
stumbled: list[int] = []
"""Whether a clumsy robot has left the line, which it does once."""


def answer(number: int, mood: str, events: list[int]) -> int | None:
    """The answer to a message, if there is one; ``events`` are those that the robot has to report."""
    if mood == "silent":
        return None
    if number == 83:
        return events.pop(0) if events else 84
    if number == 81:
        events.clear()
        return None
    if mood == "slow":
        return 85
    if mood == "panicking":
        return 80
    if mood == "confused":
        return 100
    if number not in ACTIONS:
        return None
    if mood == "strange":
        events.append(41)
    elif mood == "clumsy" and number == 34 and not stumbled:
        stumbled.append(number)
        events.append(36)
    elif mood != "lost" and number in BROUGHT_ABOUT:
        events.append(BROUGHT_ABOUT[number])
    return 64


def main() -> None:
    mood = sys.argv[1]
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    print(os.ttyname(theirs), flush=True)
    heard, events = b"", list[int]()
    while data := os.read(ours, 256):
        heard += data
        while (place := heard.find(b"\x55\xff\x00")) >= 0 and len(heard) >= place + 9:
            number = NUMBERS[heard[place : place + 9]]
            heard = heard[place + 9 :]
            print(number, flush=True)
            if mood == "leaving" and number in ACTIONS:
                return
            reply = answer(number, mood, events)
            if reply is not None:
                os.write(ours, bytes.fromhex(FRAMES[reply]))


if __name__ == "__main__":
    main()
