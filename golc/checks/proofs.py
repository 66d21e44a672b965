"""What ``golc check`` proves of all situations of a theory (rows 3 to 6)."""

from __future__ import annotations

from dataclasses import dataclass

from golc.checks.aims import check_aims
from golc.checks.effects import check_effects
from golc.checks.flow import Flow
from golc.checks.obligations import Obligations
from golc.diagnostics import Diagnostic, Findings
from golc.proofs.among import Among
from golc.proofs.prover import Prover
from golc.proofs.reachable import Scope
from golc.theory.recursion import deep_recursion
from golc.theory.theory import BasicActionTheory


@dataclass(frozen=True)
class Proofs:
    """What came of proving: the findings, how many questions were asked, and how many were not decided.

    ``scope``: the states that can be reached, if that was asked for.
    """

    findings: tuple[Diagnostic, ...]
    asked: int
    undecided: int
    scope: Scope | None


def prove(theory: BasicActionTheory, reachable: bool = False) -> Proofs:
    """Ask whether anything can go wrong in any situation of the right types in which the theory's invariants hold, or,
    if these can be gone through and that is wanted, in those that are ``reachable``."""
    prover = Among(theory) if reachable else Prover(theory)
    obligations = Obligations(theory, prover, Findings())
    with deep_recursion():
        check_effects(obligations)
        Flow(obligations).check()
        check_aims(obligations)
    scope = prover.scope if isinstance(prover, Among) else None
    return Proofs(tuple(obligations.findings.diagnostics), obligations.asked, obligations.undecided, scope)
