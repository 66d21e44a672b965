"""Mistakes do not hide each other: ten of the corpus in one file, or several in one declaration, are all shown."""

from __future__ import annotations

import random
import re
import shutil
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from golc.diagnostics import Severity
from golc.loading import examine
from tests.checks.slips import CORPUS, DOMAIN, Mistake, mistakes

Said = tuple[str, str]
"""The code and the message of a finding."""

WHOLE = re.compile(r"GL(04|06|07)|GL(033|053|080|086|096)$")
"""What is only asked of a theory without errors: values, proofs, who does or reports an action, files of devices."""


def said_alone(mistake: Mistake) -> Said | None:
    """What is said of a mistake if it is an error that needs no sound theory around it to be seen."""
    found = re.fullmatch(r"\d+:\d+\+\d+ (GL\d{3}) (?!warning|note)(.*)", mistake.said[0])
    return None if found is None or WHOLE.match(found[1]) else (found[1], found[2])


ALONE = [(mistake, said) for mistake in mistakes() if (said := said_alone(mistake)) is not None]


def lines_of(mistake: Mistake) -> set[int]:
    """The lines that a mistake is made in."""
    return {line for start, end, _ in mistake.edits for line in range(start, max(end, start + 1))}


def chosen(choice: random.Random, among: list[tuple[Mistake, Said]], most: int) -> list[tuple[Mistake, Said]]:
    """Mistakes by chance that lie in different places."""
    found: list[tuple[Mistake, Said]] = []
    taken: set[int] = set()
    for mistake, said in choice.sample(among, len(among)):
        if len(found) < most and taken.isdisjoint(lines_of(mistake)):
            found.append((mistake, said))
            taken |= lines_of(mistake)
    return found


def together(made: list[tuple[Mistake, Said]]) -> str:
    text, read = [], 0
    for start, end, new in sorted(edit for mistake, _ in made for edit in mistake.edits):
        text += [*DOMAIN[read:start], *new]
        read = end
    return "\n".join([*text, *DOMAIN[read:]]) + "\n"


@pytest.fixture
def found_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Counter[Said]]:
    monkeypatch.chdir(shutil.copytree(CORPUS, tmp_path / "depot"))

    def find(text: str) -> Counter[Said]:
        Path("depot.gl").write_text(text, encoding="utf-8")
        findings = [finding for finding in examine("depot.gl").findings if finding.severity is Severity.ERROR]
        places = [finding.span.start for finding in findings if finding.span.source.name == "depot.gl"]
        assert places == sorted(places)
        return Counter((finding.code.code, finding.message) for finding in findings)

    return find


def shown(files: Iterator[list[tuple[Mistake, Said]]], find: Callable[[str], Counter[Said]]) -> tuple[int, int, int]:
    """How many mistakes there are in some files, how many of them are shown, and how many findings there are beside."""
    made = right = more = 0
    for mistakes_of_file in files:
        wanted, found = Counter(said for _, said in mistakes_of_file), find(together(mistakes_of_file))
        made, right, more = made + wanted.total(), right + (wanted & found).total(), more + (found - wanted).total()
    return made, right, more


def test_ten_mistakes_by_chance_are_shown_together(found_in: Callable[[str], Counter[Said]]) -> None:
    """Some cannot be: a declaration without a name may be what declares each name that is declared nowhere; and where
    three mistakes meet, what one of them did is no longer clear."""
    choice = random.Random(1)
    made, right, more = shown((chosen(choice, ALONE, 10) for _ in range(60)), found_in)
    assert made == 600
    assert right >= 0.93 * made
    assert more <= 0.02 * made


def test_mistakes_in_one_declaration_are_shown_together(found_in: Callable[[str], Counter[Said]]) -> None:
    starts = [line for line, text in enumerate(DOMAIN) if text[:1].isalpha()]
    blocks = list(zip(starts, [*starts[1:], len(DOMAIN)], strict=True))
    choice = random.Random(2)
    files = []
    for start, end in blocks:
        inside = [each for each in ALONE if all(start <= a and b <= end for a, b, _ in each[0].edits)]
        several = [chosen(choice, inside, 4) for _ in range(6)]
        files += [each for each in several if len(each) > 1]
    made, right, more = shown(iter(files), found_in)
    assert made > 150
    assert right >= 0.93 * made
    assert more <= 0.02 * made
