"""What can go wrong between the host and a brick, each with what a person can do about it."""

from __future__ import annotations

from golc.diagnostics import DeviceError


class LinkError(DeviceError):
    """The base of every error of the link to an RCX brick."""


class PortMissingError(LinkError):
    """There is nothing under the name of the port."""


class PortForbiddenError(LinkError):
    """This user may not open the port."""


class PortBusyError(LinkError):
    """Another program holds the port."""


class NotATowerError(LinkError):
    """The name belongs to something that cannot be a tower: a file, a directory, a device that is no tty."""


class PortFailedError(LinkError):
    """The port cannot be opened for a reason that the system gives in its own words."""


class PortGoneError(LinkError):
    """The port was open and went away: unplugged, or the far end of a pty or a socket has closed."""

    lasting = True


class SilentBrickError(LinkError):
    """The brick does not answer."""


class OverdueError(LinkError):
    """The brick answers, but the action has taken longer than its time-out."""


class PanicError(LinkError):
    """The brick reports panic: it was left alone in the middle of a number."""


class NonsenseError(LinkError):
    """The brick, or another one, sends numbers that mean nothing in this place."""


class InterruptedLinkError(LinkError):
    """The exchange was given up because another thread wanted so."""


class ParameterError(LinkError):
    """The numbers given to the link cannot go over this wire."""
