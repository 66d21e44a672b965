"""What a theory declares, as users see it."""

from __future__ import annotations

from collections.abc import Mapping

from golc.api.contents import as_text, tables
from golc.diagnostics import counted
from golc.loading import Examined, theory_of
from golc.theory.theory import Action, BasicActionTheory, Constant, Definition, Device, Fluent, Procedure, Static
from golc.theory.types import Type


class Declared:
    """The declarations of a theory, each kind by name in the order of declaration; and what it shows of itself."""

    def __init__(self, examined: Examined) -> None:
        """Raises ``UserError`` with every error of the domain if there is one."""
        self._examined = examined
        self.elaborated: BasicActionTheory = theory_of(examined)
        """As the rooms inside golc have it."""

    @property
    def name(self) -> str:
        """The name in the first line of the domain."""
        return self.elaborated.name

    @property
    def path(self) -> str:
        """The file that declares it, as it was named."""
        return self.elaborated.source.name

    @property
    def overrides(self) -> Mapping[str, str]:
        """The constants that were replaced when it was loaded."""
        return self._examined.constants

    @property
    def constants(self) -> Mapping[str, Constant]:
        """By name, in the order of declaration, as are all that follow."""
        return self.elaborated.constants

    @property
    def types(self) -> Mapping[str, Type]:
        """The named types; ``values`` lists those of a finite one."""
        return self.elaborated.types

    @property
    def fluents(self) -> Mapping[str, Fluent]:
        """What changes: each with ``parameters`` and ``type``."""
        return self.elaborated.fluents

    @property
    def statics(self) -> Mapping[str, Static]:
        """The functions that never change."""
        return self.elaborated.statics

    @property
    def definitions(self) -> Mapping[str, Definition]:
        """The names of terms and formulas; goals and invariants, too."""
        return self.elaborated.definitions

    @property
    def actions(self) -> Mapping[str, Action]:
        """What can be done, and what may happen (``exogenous``): each with ``parameters``."""
        return self.elaborated.actions

    @property
    def procedures(self) -> Mapping[str, Procedure]:
        """The programs: each with ``parameters``."""
        return self.elaborated.procedures

    @property
    def goals(self) -> tuple[str, ...]:
        """The names of the definitions that are goals."""
        return self.elaborated.goals

    @property
    def devices(self) -> tuple[Device, ...]:
        """Who does the actions: each with ``kind``, ``name`` and ``bindings``."""
        return self.elaborated.devices

    def __repr__(self) -> str:
        return f"<Theory {self.name}: {self.counts()}>"

    def __str__(self) -> str:
        lines = [f"domain {self.name} ({self.path})"]
        for table in tables(self.elaborated):
            lines += ["", *as_text(table)]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        from golc.notebook import theory_html

        return theory_html(self)

    def counts(self) -> str:
        """``1 fluent, 2 actions, 1 procedure, 0 devices``: how much it declares."""
        parts = (
            (self.fluents, "fluent"),
            (self.actions, "action"),
            (self.procedures, "procedure"),
            (self.devices, "device"),
        )
        return ", ".join(counted(len(part), what) for part, what in parts)
