"""Did you mean: the declared name that somebody who wrote an unknown one probably had in mind."""

from __future__ import annotations

from collections.abc import Iterable


def closest(word: str, candidates: Iterable[str]) -> str | None:
    """The candidate with the fewest typing slips between it and the word; the first one wins a tie.

    None if all are far away. A slip is a letter too many, too few, wrong, or swapped with its neighbour; one for every
    four letters is allowed.
    """
    best, fewest = None, allowance(word) + 1
    for candidate in candidates:
        if abs(len(candidate) - len(word)) < fewest and candidate != word:
            slips = distance(word.lower(), candidate.lower(), fewest)
            if slips < fewest:
                best, fewest = candidate, slips
    return best


def did_you_mean(word: str, candidates: Iterable[str]) -> str | None:
    """The question whether somebody meant the closest candidate, for the help of a finding."""
    best = closest(word, candidates)
    return None if best is None else f"did you mean `{best}`?"


def allowance(word: str) -> int:
    """How many slips a word of this length may have: none for a single letter, at most four."""
    return min(4, (len(word) + 2) // 4)


def distance(a: str, b: str, limit: int) -> int:
    """The number of slips that lead from one word to the other, or ``limit`` if it is at least that.

    Optimal string alignment (Damerau 1964, with each pair of letters swapped at most once).
    """
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, letter in enumerate(a, start=1):
        before, last, row = row, before, [i]
        for j, other in enumerate(b, start=1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != other))
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == other:
                cost = min(cost, last[j - 2] + 1)
            row.append(cost)
        if min(row) >= limit:
            return limit
    return min(row[-1], limit)
