"""Expressions that stand in no file, with the meaning that the declarations of a file give them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from golc.diagnostics import Findings, Severity, Source, UserError
from golc.syntax import tree
from golc.syntax.parse import parse_expression
from golc.theory import elaborate_values as values
from golc.theory.context import Context
from golc.theory.declare import declare
from golc.theory.elaborate import RESOLVERS
from golc.theory.elaborate_terms import formula, term
from golc.theory.python_file import PythonFiles
from golc.theory.recursion import deep_recursion
from golc.theory.scope import Scope
from golc.theory.terms import Term


@dataclass(frozen=True)
class Queries:
    """Elaborates texts against a file without errors, whose imports have been joined.

    ``constants`` are as for ``load``; ``python`` are the files that the theory may call.
    Every method raises ``UserError`` for a text that has no meaning; ``name`` is what its findings call the text.
    """

    file: tree.File
    source: Source
    constants: Mapping[str, str]
    python: PythonFiles

    def term(self, text: str, name: str = "<term>") -> Term:
        """The typed term of an expression without free variables."""
        return self._elaborated(text, name, lambda context, node: term(context, Scope(), node))

    def formula(self, text: str, name: str = "<formula>") -> Term:
        """The same, of type ``bool``."""
        return self._elaborated(text, name, lambda context, node: formula(context, Scope(), node, "a formula"))

    def _elaborated(self, text: str, name: str, meaning: Callable[[Context, tree.Expr], Term]) -> Term:
        findings, found = Findings(), None
        node = parse_expression(Source(name, text), findings)
        if node is not None:
            with deep_recursion():
                declared = declare(self.file, Findings(), frozenset())
                context = Context(
                    self.source, declared, findings, self.constants, RESOLVERS, values.constant_value, self.python
                )
                found = meaning(context, node)
                context.complaints.finish()
        if found is None or findings.has_errors or context.gaps:
            wrong = [each for each in findings.diagnostics if each.severity is Severity.ERROR]
            raise UserError(*(wrong or findings.diagnostics))
        return found
