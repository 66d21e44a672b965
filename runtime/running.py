"""Running a program from Python: what happens is told to functions, and what came of it is a value."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Unpack

from golc.api.theory import Theory
from golc.diagnostics import GolcError
from golc.runtime.conversation import Voice
from golc.runtime.loop.happenings import Observer
from golc.runtime.record import Callbacks, Listener, Record, Run
from golc.runtime.session import run_online
from golc.runtime.settings import Options, Settings
from golc.theory.ground import read_procedure


def run(
    theory: Theory,
    program: str = "control",
    port: str | None = None,
    *,
    on_action: Listener | None = None,
    on_sensing: Listener | None = None,
    on_exogenous: Listener | None = None,
    on_message: Callable[[str], object] | None = None,
    observers: Iterable[Observer] = (),
    voice: Voice | None = None,
    check: bool = True,
    remember: int | None = None,
    **options: Unpack[Options],
) -> Run:
    """Run a program online with the devices of its theory until it ends; they are told to stop however it does.

    ``program``: a procedure with its arguments, as ``"serve(3)"``. ``port``: a tty, a pty, a pySerial URL or
    ``usb:PATH``; without one golc simulates the brick. Told are ``on_action`` of every action that was done,
    ``on_sensing`` of those that have sensed something, ``on_exogenous`` of every exogenous action, ``on_message`` of
    the text of each ``say``, and ``observers`` of everything, as values of ``golc.runtime.loop.happenings``; whatever
    they raise ends the run. ``voice`` speaks to a person: ``Voice(print)`` shows the trace of ``golc run``,
    ``Voice(print, ask=input)`` lets them answer, too. ``remember``: how many of the latest actions and messages the
    result has; by default all, which a run without end has no memory for. All else is in ``Options``.

    Raises ``UserError`` before anything happens if the theory, its devices or the events are wrong, ``ValueError`` for
    options that make no sense, ``FileExistsError`` for a journal that is there already. Raises ``ProgramError`` if the
    program fails, ``UserError`` where it comes to an action that no device does, and ``DeviceError`` if the world
    fails; these are in the result instead if ``check`` is false.

    >>> import golc
    >>> sorter = golc.load("examples/sorter/sorter.gl")
    >>> done = golc.run(sorter, "sort_one", world="none", speed=1000)
    >>> [str(action) for action in done.actions][:2]
    ['feed', 'look']
    """
    settings = Settings(port, **options)
    call = read_procedure(theory.elaborated, program)
    record = Record(theory, Callbacks(on_action, on_sensing, on_exogenous, on_message), remember)
    try:
        run_online(theory.elaborated, call, settings, voice or Voice(), [*observers, record])
    except GolcError as error:
        if check or record.ended is None:
            raise
        return record.result(program, error)
    return record.result(program)
