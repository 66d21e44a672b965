"""How Python writes names that it, or ``golc.embed``, needs for itself."""

from __future__ import annotations

import keyword

_WORDS = """
Theory abort after before bind branch causes choose cost count each enum exists expect first forall given guard iff
implies interrupts interval known knows let names on one_of optional otherwise pick poss possible prefer rest run say
search senses setting star symbols test together together_star types union unknown until values var wait within
"""
_BUILTINS = "abs all any bool enumerate float int len list max min range set sorted str sum zip"

WORDS = frozenset(_WORDS.split())
"""The words of ``golc.embed``."""

BUILTINS = frozenset(_BUILTINS.split())
"""The builtins that have a meaning in a theory."""

_PYTHONS = WORDS | BUILTINS | frozenset(keyword.kwlist) | {"theory"}


def golc_name(name: str) -> str:
    """The name that a Python name stands for: one underscore at its end is taken off if Python or this package needs
    the name without them."""
    return name[:-1] if name.endswith("_") and name.rstrip("_") in _PYTHONS else name


def python_name(name: str) -> str:
    """The Python name that stands for a name: the reverse of ``golc_name``."""
    return name + "_" if name.rstrip("_") in _PYTHONS else name
