"""The adapter between ground actions and a brick's numbers, with a real brick process at the other end."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from golc.diagnostics import DeviceError, GolcError
from golc.runtime.clock import Clock
from golc.runtime.devices.base import Args, Device, GivenUpError
from golc.runtime.devices.bricks import Link
from golc.runtime.devices.build import Surroundings, build_devices
from golc.runtime.devices.desk import Desk
from golc.runtime.loop.inbox import Broken, Inbox, Item, Report
from golc.runtime.sources.polling import Poller
from golc.theory.theory import BasicActionTheory

SPEED = 10.0
Robots = Callable[[str], Any]
Devices = Callable[[Any], Device]


@pytest.fixture
def device(delivery: BasicActionTheory) -> Iterator[Devices]:
    """The brick of the delivery domain, opened on the port of a robot."""
    made: list[Device] = []

    def make(brick: Any) -> Device:
        desk = Desk(lambda text: None, interactive=False, open_=False, plausible=lambda line: False)
        link = Link(brick.port, SPEED)
        made.append(build_devices(delivery, Surroundings(desk, lambda message, args: "", link))[0])
        return made[-1]

    yield make
    for each in made:
        each.close()


def poll(device: Device) -> list[tuple[str, Args]]:
    """What the brick reports when it is asked."""
    found: list[tuple[str, Args]] = []
    device.poll(lambda action, args: found.append((action, args)))
    return found


def polled(device: Device) -> list[tuple[str, Args]]:
    """What the brick reports next, asked for until it does."""
    deadline = time.monotonic() + 30
    while not (found := poll(device)) and time.monotonic() < deadline:
        time.sleep(0.01)
    return found


def perform(device: Device, action: str) -> Args:
    """Have an action done as the loop does: on a link that nobody else has."""
    with device.free():
        return device.perform(action, ())


def test_an_action_is_a_number_and_an_event_is_one_too(robot: Robots, device: Devices) -> None:
    brick = robot("willing")
    rcx = device(brick)
    rcx.open()

    assert perform(rcx, "start_to_next_station") == ()
    assert polled(rcx) == [("arrive_at_station", ())]
    assert poll(rcx) == []
    rcx.abort()
    rcx.close()

    heard = brick.everything()
    assert heard[0] == 81
    assert 34 in heard
    assert 81 in heard[-3:]


def test_an_action_can_be_given_up_and_the_brick_aborted(robot: Robots, device: Devices) -> None:
    brick = robot("slow")
    rcx = device(brick)
    rcx.open()

    def interrupt() -> None:
        brick.wait_for(34)
        rcx.interrupt()

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(GivenUpError):
        perform(rcx, "start_to_next_station")
    thread.join()
    rcx.abort()

    assert poll(rcx) == []
    assert 81 in brick.everything()[1:]


def test_an_interrupt_that_comes_too_late_disturbs_no_poll(robot: Robots, device: Devices) -> None:
    rcx = device(robot("lost"))
    rcx.open()
    perform(rcx, "start_to_next_station")
    rcx.interrupt()

    assert poll(rcx) == []


def test_a_brick_that_does_not_answer_is_told_when_it_is_opened(robot: Robots, device: Devices) -> None:
    with pytest.raises(DeviceError, match="no brick answers on /dev/") as failure:
        device(robot("silent")).open()

    assert "switched on" in (failure.value.help or "")


def test_a_number_without_meaning_is_told(robot: Robots, device: Devices) -> None:
    rcx = device(robot("strange"))
    rcx.open()
    perform(rcx, "start_to_next_station")

    with pytest.raises(DeviceError, match="the brick rcx reported 9, which is the number of no action"):
        polled(rcx)


def test_an_unopened_brick_does_nothing(device: Devices, robot: Robots) -> None:
    rcx = device(robot("willing"))

    rcx.abort()
    with pytest.raises(DeviceError, match="has not been opened"):
        poll(rcx)


class Reporting(Device):
    """A device with something to report, or a failure."""

    poll_interval = 0.01

    def __init__(self, reports: list[list[tuple[str, Args]] | GolcError]) -> None:
        super().__init__("left")
        self._reports = reports

    def poll(self, report: Callable[[str, Args], None]) -> None:
        happened = self._reports.pop(0) if self._reports else []
        if isinstance(happened, GolcError):
            raise happened
        for action, args in happened:
            report(action, args)


def items(inbox: Inbox, count: int) -> list[Item]:
    deadline = time.monotonic() + 30
    while len(inbox.items) < count and time.monotonic() < deadline:
        inbox.wait(1)
    return list(inbox.items)


def polling(inbox: Inbox, *devices: Device) -> Poller:
    return Poller(devices, frozenset({"arrive_at_station"}), inbox, Clock(time.monotonic, time.monotonic()))


def test_what_devices_report_goes_to_the_inbox_in_order() -> None:
    inbox = Inbox()
    poller = polling(inbox, Reporting([[], [("a", ()), ("b", (1,))], [("c", ())]]))
    poller.start()

    assert items(inbox, 3) == [Report("a", (), "left"), Report("b", (1,), "left"), Report("c", (), "left")]
    assert not poller.ended
    poller.close()


def test_a_failure_of_a_poll_goes_to_the_inbox_and_ends_the_source() -> None:
    inbox, error = Inbox(), DeviceError("the brick is silent")
    poller = polling(inbox, Reporting([[("a", ())], error]))
    poller.start()

    assert items(inbox, 2) == [Report("a", (), "left"), Broken("left", error)]
    poller.close()
    assert poller.ended


def test_a_poller_may_report_what_its_bricks_report(delivery: BasicActionTheory) -> None:
    poller = polling(Inbox(), Reporting([]))

    reported = [name for name, action in delivery.actions.items() if poller.may_report(action)]
    assert reported == ["arrive_at_station"]
    poller.close()
