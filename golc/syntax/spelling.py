"""Which word of the language was probably meant by one that is not of it."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from golc.syntax.words import DECLARATIONS, OTHER_NAMES


def closest(word: str, words: Iterable[str]) -> str | None:
    """The word that was probably meant; short ones have to be nearer."""
    found = close(word, words)
    return found[0] if found else None


def close(word: str, words: Iterable[str]) -> list[str]:
    """The words that may have been meant, the closest first; those with the same letters exclude all others."""
    candidates, lower = list(words), word.lower()
    swapped = [candidate for candidate in candidates if sorted(candidate) == sorted(lower)]
    near = difflib.get_close_matches(lower, candidates, n=3, cutoff=0.7 if len(word) > 3 else 0.8)
    return swapped or (near if len(word) > 2 else [])


def meant_declaration(word: str) -> str | None:
    """The word that begins a declaration and was probably meant by one that does not."""
    return OTHER_NAMES.get(word.lower()) or closest(word, DECLARATIONS)
