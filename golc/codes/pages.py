"""Reads the pages about codes, which stand beside this module as Markdown."""

from __future__ import annotations

import re
from dataclasses import dataclass
from importlib.resources import files

from golc.diagnostics import Code

EXAMPLE = "example.gl"
"""The file of a block whose fence names no other."""

_SECTION = re.compile(r"^## (Wrong|Right)\n", re.MULTILINE)
FENCE = re.compile(r"^```(?P<language>\w+) ?(?P<name>.*)\n(?P<text>(?:.*\n)*?)```$", re.MULTILINE)
"""A block of an example, with the name of its file; the command is a block of the language ``console``."""


@dataclass(frozen=True)
class Example:
    """Files by their names, and the command that shows what is found in them."""

    files: dict[str, str]
    command: str


@dataclass(frozen=True)
class Page:
    """A page: ``text`` is all of it below its title, as Markdown; ``example`` is the file of blocks without a name."""

    code: Code
    text: str
    example: str = EXAMPLE

    @property
    def meaning(self) -> str:
        """What stands above the examples."""
        return _SECTION.split(self.text)[0].strip()

    @property
    def wrong(self) -> Example:
        """An example that has the finding."""
        return self._shown(2, Example({}, f"golc check {self.example}"))

    @property
    def right(self) -> Example:
        """One that has not; of what it does not show, the files and the command are those of the wrong one."""
        return self._shown(4, self.wrong)

    def _shown(self, section: int, default: Example) -> Example:
        found, command = dict(default.files), default.command
        for language, name, text in FENCE.findall(_SECTION.split(self.text)[section]):
            if language == "console":
                command = text.removeprefix("$ ").strip()
            else:
                found[name or self.example] = text
        return Example(found, command)


def page(code: Code) -> Page:
    """The page about a code."""
    return Page(code, files("golc.codes").joinpath(f"{code.code}.md").read_text(encoding="utf-8"))
