"""The device ``host``: functions of a Python file beside the domain."""

from __future__ import annotations

import importlib.util
import sys
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType

from golc.diagnostics import DeviceError
from golc.runtime.devices.base import Args, Bindings, Device, translated
from golc.theory.foreign import golc_value
from golc.theory.ground import describe
from golc.theory.suggest import did_you_mean
from golc.theory.theory import BasicActionTheory, Binding, ByCall
from golc.theory.types import Type, Value

Function = Callable[..., object]


class Host(Device):
    """Calls a Python function for each action; the function returns what the action senses.

    Arguments are passed as golc's values: integers, truth values, ``None``, symbols and texts as strings, real numbers
    that are not whole as ``Fraction``, sets as ``frozenset``, lists as ``tuple``. Whatever a function raises is a
    ``DeviceError``: an exception in a behaviour is an outcome and must not end the run with a robot moving.
    """

    def __init__(self, name: str, path: Path, bindings: tuple[Binding, ...], theory: BasicActionTheory) -> None:
        super().__init__(name)
        self._path = path
        self._all = bindings
        self._bindings = Bindings(bindings)
        self._theory = theory
        self._functions: dict[str, Function] = {}

    def open(self) -> None:
        """Load the file and look up every function that a binding names."""
        module = load_module(self._path)
        for binding in self._all:
            name = function_name(binding)
            self._functions[name] = self._look_up(module, name)

    def _look_up(self, module: ModuleType, name: str) -> Function:
        function = getattr(module, name, None)
        if callable(function):
            return function  # type: ignore[no-any-return]
        if function is not None:
            raise DeviceError(f"`{name}` in {self._path} is not a function")
        names = [key for key, value in vars(module).items() if callable(value)]
        help_ = did_you_mean(name, names) or f"define it: `def {name}(…): …`"
        raise DeviceError(f"{self._path} has no function `{name}`", help=help_)

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
        result = guarded(lambda: self._functions[name](*args), f"`{name}`", self._path)
        types = [term.type for term in self._theory.actions[action].senses]
        if not types:
            return ()
        return tuple(self._checked(value, type_, binding) for value, type_ in self._paired(result, types, name))

    def _paired(self, result: object, types: Sequence[Type], name: str) -> list[tuple[object, Type]]:
        if len(types) == 1:
            return [(result, types[0])]
        if not isinstance(result, (tuple, list)) or len(result) != len(types):
            raise DeviceError(f"`{name}` returned {result!r}; a tuple of {len(types)} sensing results is needed")
        return list(zip(result, types, strict=True))

    def _checked(self, value: object, type_: Type, binding: Binding) -> Value:
        meant = golc_value(translated(binding, value), type_)
        if meant in type_:
            return meant
        call = f"`{function_name(binding)}` in {self._path}"
        raise DeviceError(f"{call} returned {value!r}, which is not of type {describe(type_)}")


def function_name(binding: Binding) -> str:
    """The function that a binding names; without a behaviour it is called like the action."""
    return binding.behaviour.function if isinstance(binding.behaviour, ByCall) else binding.action


def load_module(path: Path) -> ModuleType:
    """Run a Python file as a module of its own; its folder is on the path for what it imports."""
    if not path.is_file():
        raise DeviceError(f"cannot read the Python file {path} of the device `host`", help="write it beside the domain")
    spec = importlib.util.spec_from_file_location(f"golc_host_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise DeviceError(f"{path} is not a Python file", help="its name ends in `.py`")
    module = importlib.util.module_from_spec(spec)
    folder = str(path.parent.resolve())
    if folder not in sys.path:
        sys.path.insert(0, folder)
    loader = spec.loader
    guarded(lambda: loader.exec_module(module), f"loading {path.name}", path)
    return module


def guarded(call: Callable[[], object], what: str, path: Path) -> object:
    """The result of foreign code; whatever it raises, but an interrupt of the run, is a device failure."""
    try:
        return call()
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        why = traceback.format_exception_only(error)[-1].strip()
        raise DeviceError(f"{what} failed at {_place(error, path)}: {why}") from error


def _place(error: BaseException, path: Path) -> str:
    """The last line of the file that the exception went through."""
    file = path.resolve()
    if isinstance(error, SyntaxError) and error.filename is not None and Path(error.filename).resolve() == file:
        return f"{path}:{error.lineno}"
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if Path(frame.filename).resolve() == file]
    return f"{path}:{lines[-1]}" if lines else str(path)
