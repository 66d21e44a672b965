"""Which bricks of a theory somebody means."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic, Span, UserError
from golc.nqc.toolchain import Target
from golc.theory.forms import add_a_brick
from golc.theory.theory import BasicActionTheory, Device


def target_of(option: str) -> Target:
    """The firmware that a name stands for; raises ``ValueError`` if none does."""
    for target in Target:
        if target.option == option:
            return target
    raise ValueError(f"there is no target {option!r}; there is {', '.join(target.option for target in Target)}")


def chosen(theory: BasicActionTheory, name: str | None) -> tuple[Device, ...]:
    """The brick of a name, or all of them; ``ValueError`` for an unknown name, ``UserError`` if there is none."""
    bricks = theory.bricks
    if name is not None:
        known = ", ".join(brick.name for brick in bricks) or "none"
        bricks = tuple([brick for brick in bricks if brick.name == name])
        if not bricks:
            raise ValueError(f"there is no brick {name!r}; there is {known}")
    if not bricks:
        message = f"the domain `{theory.name}` has no device of kind `rcx`, for which a program could be generated"
        place = Span(theory.source, 0, 0)
        raise UserError(Diagnostic(Code.NO_DEVICE, message, place, help=add_a_brick(place)))
    return bricks
