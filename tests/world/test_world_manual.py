"""The page about worlds says what is so."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from golc.diagnostics import Source, UserError
from golc.rendering import render
from golc.runtime.rcxsim.world.worldfile import parse_world

PAGE = (Path(__file__).parent.parent.parent / "docs/world.md").read_text(encoding="utf-8")
BLOCKS = dict(re.findall(r"^```(toml room|text)[^\n]*\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL))


def test_the_whole_world_is_one() -> None:
    scene = parse_world(Source("room.toml", BLOCKS["toml room"]))
    assert list(scene.floor.stations) == ["door", "window"]
    assert len(scene.robot.sensors) == 3
    assert len(scene.script) == 2


def test_a_mistake_is_told_as_the_page_shows() -> None:
    text = BLOCKS["toml room"].replace("light = 35", "ligth = 35")
    with pytest.raises(UserError) as caught:
        parse_world(Source("room.toml", text))
    missing, unknown = caught.value.diagnostics
    assert missing.message == "`light` is missing in `[lines.track]`"
    assert render(unknown) == BLOCKS["text"].rstrip()


def test_every_key_is_described() -> None:
    described = set(re.findall(r"`(\w+)(?: = [^`]*)?`", PAGE))
    used = set(re.findall(r"^\s*(\w+) =", BLOCKS["toml room"], re.MULTILINE))
    assert used <= described | {"script"}
