"""The manual as a site: it is built without a warning, and reads without a network."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from pygments.token import Comment, Keyword, Name, Operator, String, Token, _TokenType

from golc.diagnostics import Code
from golc.highlighting import GolcLexer
from golc.syntax.words import RESERVED

ROOT = Path(__file__).parents[2]
RESOURCE = re.compile(r"<(?:link|script|img|iframe)\b[^>]*?\b(?:href|src)=\"([^\"]*)\"")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    built = subprocess.run([*command, ROOT / "docs", folder], capture_output=True, text=True, check=False)
    assert (built.stderr, built.returncode) == ("", 0)
    return folder


def test_every_page_is_reached_from_the_front_page(site: Path) -> None:
    pages = {path.relative_to(ROOT / "docs").with_suffix(".html") for path in (ROOT / "docs").rglob("*.md")}
    front = (site / "index.html").read_text(encoding="utf-8")
    missing = [str(page) for page in pages if f'href="{page}"' not in front]
    assert sorted(missing) == ["README.html", "index.html"]


def test_every_code_has_a_section(site: Path) -> None:
    page = (site / "codes.html").read_text(encoding="utf-8")
    assert re.findall(r"<h2>(GL\d{3}): ", page) == sorted(code.code for code in Code)


def test_site_needs_no_network(site: Path) -> None:
    pages = list(site.rglob("*.html"))
    resources = {link for page in pages for link in RESOURCE.findall(page.read_text(encoding="utf-8"))}
    assert resources
    assert [link for link in resources if "//" in link] == []


def test_links_to_files_outside_the_manual_are_kept(site: Path) -> None:
    assert 'href="_downloads/' in (site / "examples.html").read_text(encoding="utf-8")


FILES = [*sorted((ROOT / "examples").glob("*/*.gl")), *sorted((ROOT / "tests/programs").glob("*.gl"))]


@pytest.mark.parametrize("file", FILES, ids=lambda path: path.name)
def test_lexer_knows_every_sign(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    tokens = list(GolcLexer().get_tokens(text))
    assert [token for token in tokens if token[0] is Token.Error] == []
    assert "".join(value for _, value in tokens).strip() == text.strip()


def kinds(text: str) -> list[tuple[_TokenType, str]]:
    """The tokens of a text that are more than names, numbers, signs and space."""
    plain = {Token.Name, Token.Text.Whitespace, Token.Literal.Number.Integer, Token.Punctuation, Token.Operator}
    return [(kind, value) for kind, value in GolcLexer().get_tokens(text) if kind not in plain]


def test_words_of_the_language_are_told_from_names() -> None:
    assert kinds("action run(n: int):\n    poss n in 1..3  # why\n") == [
        (Keyword.Declaration, "action"),
        (Name.Function, "run"),
        (Keyword.Type, "int"),
        (Keyword, "poss"),
        (Operator.Word, "in"),
        (Comment.Single, "# why"),
    ]


def test_word_that_is_free_for_names_is_a_keyword_only_at_the_start_of_a_line() -> None:
    assert kinds("    run(2)\n    test run = poss\n    run p\n") == [(Keyword, "test"), (Keyword, "run")]


def test_expressions_in_messages_are_expressions() -> None:
    assert kinds('    say "a{not b}"\n') == [
        (Keyword, "say"),
        (String.Double, '"'),
        (String.Double, "a"),
        (String.Interpol, "{"),
        (Operator.Word, "not"),
        (String.Interpol, "}"),
        (String.Double, '"'),
    ]


@pytest.mark.parametrize("word", sorted(RESERVED))
def test_reserved_word_is_no_name(word: str) -> None:
    assert (Name, word) not in list(GolcLexer().get_tokens(word))


def test_other_tools_find_the_lexer() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["entry-points"]["pygments.lexers"] == {"golc": "golc.highlighting:GolcLexer"}
