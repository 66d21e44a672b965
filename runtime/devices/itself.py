"""The device ``self``: bookkeeping actions, of which the world need not know."""

from __future__ import annotations

from golc.runtime.devices.base import Args, Bindings, Device
from golc.theory.theory import Binding


class Itself(Device):
    """Does nothing, at once."""

    def __init__(self, name: str, bindings: tuple[Binding, ...]) -> None:
        super().__init__(name)
        self._bindings = Bindings(bindings)

    def handles(self, action: str, args: Args) -> bool:
        return self._bindings.find(action, args) is not None

    def perform(self, action: str, args: Args) -> Args:
        """Nothing is sent."""
        return ()
