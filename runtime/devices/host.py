"""The device ``host``: functions of a Python file beside the domain."""

from __future__ import annotations

import reprlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from golc.diagnostics import DeviceError
from golc.runtime.devices.base import Args, Bindings, Device, translated
from golc.theory.foreign import golc_value
from golc.theory.ground import describe
from golc.theory.python_file import Function, PythonError
from golc.theory.theory import BasicActionTheory, Binding, ByCall
from golc.theory.types import Type, Value


class Host(Device):
    """Calls a Python function for each action; the function returns what the action senses.

    Arguments are passed as golc's values: integers, truth values, ``None``, symbols and texts as strings, real numbers
    that are not whole as ``Fraction``, sets as ``frozenset``, lists as ``tuple``. Whatever a function raises is a
    ``DeviceError``: an exception in a behaviour is an outcome and must not end the run with a robot moving.
    """

    def __init__(self, name: str, path: Path, bindings: tuple[Binding, ...], theory: BasicActionTheory) -> None:
        super().__init__(name)
        self._file = theory.python.file(path)
        self._all = bindings
        self._bindings = Bindings(bindings)
        self._theory = theory
        self._functions: dict[str, Function] = {}

    def open(self) -> None:
        """Execute the file and look up every function that a binding names."""
        for binding in self._all:
            if self._theory.actions[binding.action].exogenous:
                continue
            name = function_name(binding)
            with _failing():
                self._functions[name] = self._file.function(name)

    def handles(self, action: str, args: Args) -> bool:
        return self._bindings.find(action, args) is not None

    def label(self, action: str, args: Args) -> str:
        binding = self._bindings.find(action, args)
        return self.name if binding is None else f"{self.name} {function_name(binding)}"

    def perform(self, action: str, args: Args) -> Args:
        """Call the function and check what it returns against the sensed types."""
        binding = self._bindings.find(action, args)
        assert binding is not None
        name = function_name(binding)
        with _failing():
            result = self._file.guarded(f"`{name}`", lambda: self._functions[name](*args))
        types = [term.type for term in self._theory.actions[action].senses]
        if not types:
            return ()
        return tuple(self._checked(value, type_, binding) for value, type_ in self._paired(result, types, name))

    def _paired(self, result: object, types: Sequence[Type], name: str) -> list[tuple[object, Type]]:
        if len(types) == 1:
            return [(result, types[0])]
        if not isinstance(result, (tuple, list)) or len(result) != len(types):
            raise DeviceError(
                f"`{name}` returned {reprlib.repr(result)}; a tuple of {len(types)} sensing results is needed"
            )
        return list(zip(result, types, strict=True))

    def _checked(self, value: object, type_: Type, binding: Binding) -> Value:
        meant = golc_value(translated(binding, value), type_)
        if meant in type_:
            return meant
        call = f"`{function_name(binding)}` in {self._file.path}"
        raise DeviceError(f"{call} returned {reprlib.repr(value)}, which is not of type {describe(type_)}")


def function_name(binding: Binding) -> str:
    """The function that a binding names; without a behaviour it is called like the action."""
    return binding.behaviour.function if isinstance(binding.behaviour, ByCall) else binding.action


@contextmanager
def _failing() -> Iterator[None]:
    """What is wrong with Python code is a failure of the device."""
    try:
        yield
    except PythonError as error:
        raise DeviceError(str(error), error.help) from error
