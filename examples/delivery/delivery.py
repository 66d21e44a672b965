"""The delivery robot of the Legolog paper (Levesque & Pagnucco, 2000), as `delivery.gl` has it.

Stations stand along a line, with a person at each of them, who takes off what has arrived, puts on what is to be
delivered, and presses the robot's go button.
"""

from __future__ import annotations

from golc.embed import Theory, bind, causes, each, enum, expect, given, interrupts, interval, on, poss, until, wait

theory = Theory("delivery")

station = theory.type("station", interval(1, 6))
heading = theory.type("heading", enum(-1, 1))
phase = theory.type("phase", enum("moving", "stopped", "suspended"))
moving, stopped, suspended = phase

location = theory.fluent("location", station, 3)
direction = theory.fluent("direction", heading, 1)
motion = theory.fluent("motion", phase, stopped)


@theory.fluent
def holding_delivery_for(to: station):
    return to in {4, 6}


@theory.fluent
def delivery_requested(origin: station) -> station | None:
    return None


@theory.define
def stop_requested(n: station):
    return delivery_requested(n) != None or holding_delivery_for(n)


@theory.action
def turnaround():
    poss(motion == stopped)
    causes(direction, -direction)


@theory.action
def start_to_next_station():
    poss(motion in {stopped, suspended} and location + direction in station)
    causes(motion, moving)


@theory.action
def signal_arrival():
    pass


@theory.action
def reposition_robot():
    poss(motion == suspended)


@theory.exog
def arrive_at_station():
    poss(motion == moving and location + direction in station)
    causes(location, location + direction)
    causes(motion, stopped)


@theory.exog
def stop_abnormally():
    """The robot has lost the line."""
    poss(motion == moving)
    causes(motion, suspended)


@theory.exog
def push_go_button():
    causes(delivery_requested(location), None)
    causes(holding_delivery_for(location), False)
    for m in each(station, where=m != location):
        causes(holding_delivery_for(m), True, when=delivery_requested(location) == m)


@theory.exog(sources=["operator"])
def request_delivery(origin: station, to: station):
    poss(origin != to)
    causes(delivery_requested(origin), to)


@theory.exog(sources=["operator"])
def cancel_request(origin: station, to: station):
    poss(delivery_requested(origin) == to)
    causes(delivery_requested(origin), None)


@theory.proc
def head(d: heading):
    """Drive one station further, or turn around for it."""
    if direction == d:
        start_to_next_station()
    else:
        turnaround()


@theory.proc
def head_for(n: station):
    if n > location:
        head(1)
    else:
        head(-1)


@theory.proc
def control():
    """The most urgent first; after each action the world may have changed, and it is decided anew what to do."""
    with interrupts():
        with on(motion == suspended):
            reposition_robot()
            start_to_next_station()
        with on(motion == moving):
            wait(until=motion != moving)
        with on(stop_requested(location)):
            signal_arrival()
            if stop_requested(location):
                wait()
        for n in on(station, where=stop_requested(n)):
            head_for(n)
        with on(location > 1):
            head(-1)
        with on(True):
            wait()


@theory.device("rcx", file="delivery.nqc")
def rcx_device():
    bind(turnaround, number=0, call="turnAround")
    bind(signal_arrival, number=1, call="signalArrival")
    bind(start_to_next_station, number=2, start="goToNextStation")
    bind(arrive_at_station, number=3)
    bind(stop_abnormally, number=4)
    bind(push_go_button, number=5)


@theory.device("operator")
def operator_device():
    bind(reposition_robot, prompt=f"Please put me back on the line, near station {location}, then press Enter")


# What the robot of the paper did, recorded from the original system: the world answers each start with an arrival and
# each signal with the go button.


@theory.scenario
def quiet_start():
    on(arrive_at_station(), when=motion == moving)
    on(push_go_button(), when=stop_requested(location))
    expect(
        actions=[
            start_to_next_station(),
            signal_arrival(),
            start_to_next_station(),
            start_to_next_station(),
            signal_arrival(),
            turnaround(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
        ]
    )
    expect(location == 1 and direction == -1 and motion == stopped)
    expect(not any(stop_requested(n) for n in station))


@theory.scenario
def request_on_the_way():
    on(request_delivery(2, 5), waiting=True)
    on(arrive_at_station(), when=motion == moving)
    on(push_go_button(), when=stop_requested(location))
    expect(
        actions=[
            start_to_next_station(),
            signal_arrival(),
            turnaround(),
            start_to_next_station(),
            start_to_next_station(),
            signal_arrival(),
            turnaround(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
            signal_arrival(),
            start_to_next_station(),
            signal_arrival(),
            turnaround(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
        ]
    )
    expect(location == 1 and not any(stop_requested(n) for n in station))


@theory.scenario
def request_that_is_cancelled():
    on(request_delivery(2, 5), after=1)
    on(cancel_request(2, 5), after=2)
    on(arrive_at_station(), when=motion == moving)
    on(push_go_button(), when=stop_requested(location))
    until(motion == stopped and location == 1)
    expect(
        actions=[
            start_to_next_station(),
            signal_arrival(),
            start_to_next_station(),
            start_to_next_station(),
            signal_arrival(),
            turnaround(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
            start_to_next_station(),
        ]
    )
    expect(signal_arrival(), exactly=2)


@theory.scenario
def nothing_to_do():
    given(location == 1 and holding_delivery_for(4) == False and holding_delivery_for(6) == False)
    expect(actions=[])
