"""Dictionaries in translated functions as tables."""

from __future__ import annotations

import ast

from golc.embed.errors import meaningless
from golc.embed.reading.bodies import Bodies
from golc.embed.tables import table_of
from golc.syntax import tree


class Tables(Bodies):
    """Translates what a static returns that is a table, and what a binding makes of numbers."""

    def table(self, node: ast.expr) -> tree.Table:
        """A dictionary as a table; a key of several arguments is a tuple."""
        if isinstance(node, ast.Dict):
            entries = []
            for key, value in zip(node.keys, node.values, strict=True):
                if key is None:
                    raise meaningless(
                        "`**` spreads no table", self.span(value), "make the dictionary outside the function"
                    )
                parts = key.elts if isinstance(key, ast.Tuple) else [key]
                made = tuple(self.expr(part) for part in parts)
                span = self.span(key).to(self.span(value))
                entries.append(tree.TableEntry(made, self.expr(value), span=span))
            return tree.Table(tuple(entries), span=self.span(node))
        found = self.python(node)
        if not isinstance(found, dict):
            raise meaningless("this is no table", self.span(node), "write a dictionary: `{hall: kitchen}`")
        return table_of(found, self.span(node))

    def is_table(self, node: ast.expr) -> bool:
        """Whether a static returns a table."""
        return isinstance(node, ast.Dict) or isinstance(self.python(node), dict)
