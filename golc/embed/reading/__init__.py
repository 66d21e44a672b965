"""Translates functions of Python: from Python's tree to the tree of the language."""
