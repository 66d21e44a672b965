"""The LaTeX of pages: that it can be set with amsmath alone, as far as that can be told without a TeX."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from golc.explain.pages import explain
from golc.explain.rendering import as_latex, as_text
from golc.loading import load
from golc.theory.theory import BasicActionTheory

ROOT = Path(__file__).parents[2]
FILES = [
    *sorted((ROOT / "examples").glob("*/*.gl")),
    *(ROOT / "tests" / "programs" / f"{name}.gl" for name in ("lift", "delivery_wait")),
]
_MACROS = r"""
    \paragraph \subparagraph \begin \end \text \mathit \mathbf \mathrm \mathrel \quad \textbackslash \textasciicircum
    \textasciitilde \land \lor \lnot \supset \equiv \exists \forall \in \notin \cup \setminus \frown \neq \leq \geq
    \cdot \bmod \sum \min \max \mid \lvert \rvert \lfloor \rfloor \ldots \gamma \pi \Sigma \parallel \langle \rangle \to
    \sqsubseteq \\ \{ \} \_ \# \% \$ \& \; \, \! \␣
    """
MACROS = frozenset(_MACROS.split())
"""What LaTeX itself and amsmath define."""


def wrong(text: str) -> list[str]:
    """What could not be set: unknown macros, unbalanced groups, characters out of place, rows without their mark."""
    macros = {found.replace("\\ ", "\\␣") for found in re.findall(r"\\(?:[A-Za-z]+|.)", text)}
    found = [f"macro {macro}" for macro in sorted(macros - MACROS)]
    bare = re.sub(r"\\[^A-Za-z]", "", text)
    depth = 0
    for character in bare:
        depth += (character == "{") - (character == "}")
        if depth < 0:
            return [*found, "a brace closes nothing"]
    found += ["a brace is not closed"] * (depth > 0)
    outside = re.sub(r"\\text\{(?:[^{}]|\{\})*\}", "", bare)
    found += [f"character {each}" for each in set(outside) if not each.isascii() or each in "#$%~"]
    for block in re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", text, re.DOTALL):
        rows = block.split("\\\\\n")
        found += [f"row {row}" for row in rows if not row.startswith("& ") or re.findall(r"(?<!\\)&", row) != ["&"]]
    return found


def names(theory: BasicActionTheory) -> list[str]:
    tables = (theory.fluents, theory.actions, theory.procedures, theory.definitions, theory.statics, theory.prunes)
    return [*dict.fromkeys(name for table in (*tables, theory.types, theory.constants) for name in table)]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_all_names_of_a_domain_can_be_set(path: Path) -> None:
    theory = load(path)
    for name in names(theory):
        assert wrong(as_latex(explain(theory, name))) == [], name
        assert all(line.isprintable() for line in as_text(explain(theory, name)).splitlines())


@pytest.mark.parametrize(
    ("text", "what"),
    [
        (r"\unknown x", ["macro \\unknown"]),
        ("{", ["a brace is not closed"]),
        (r"\{ }", ["a brace closes nothing"]),
        ("a ∧ b", ["character ∧"]),
        (r"\text{∧}", []),
        ("\\begin{align*}\n& a \\\\\nb\n\\end{align*}", ["row b"]),
    ],
)
def test_what_cannot_be_set_is_seen(text: str, what: list[str]) -> None:
    assert wrong(text) == what


TERMS = """type t = {a, b}
fluent f(x: t): int = 0
fluent g(x: t): t = unknown
define d := (count x: t where f(x) % 2 = 1. f(x) < 3) + (sum x: t. f(x) // 2 * -abs(f(x)))
define e := d if f(a) != 1 and (f(b) <= 2 iff d >= 3) else min(1, d)
fluent seen: set[t] = {}
fluent route: list[t] = [b, a]
fluent note: string = "50% {{a_b}}"
define j := len(route) > 1 and route[0] in seen + {y for y: t where f(y) > 1} - {a} and [first(route)] = rest(route)
define k(x: t) := knows(f(x) = 1) or possible(g(x) = a) implies known(g(x)) and x not in {a}
action rest(x: t)
action spin(x: t):
    poss exists y: t where y = x. forall z: t. z in t and poss(rest(z))
    causes g(x) := one of {a, b} when f(x) > e
"""


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="there is no TeX")
def test_tex_sets_it(theory: Callable[[str], BasicActionTheory], tmp_path: Path) -> None:
    theories = [theory(TERMS), *(load(path) for path in FILES)]
    pages = [as_latex(explain(each, name)) for each in theories for name in names(each)]
    document = ["\\documentclass{article}", "\\usepackage{amsmath}", "\\begin{document}", *pages, "\\end{document}"]
    (tmp_path / "pages.tex").write_text("\n".join(document), encoding="utf-8")
    command = ["pdflatex", "-halt-on-error", "-interaction=nonstopmode", "pages.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout[-2000:]


def test_terms_of_every_kind_can_be_set(theory: Callable[[str], BasicActionTheory]) -> None:
    built = theory(TERMS)
    assert {name: wrong(as_latex(explain(built, name))) for name in names(built)} == {name: [] for name in names(built)}


def test_an_axiom(theory: Callable[[str], BasicActionTheory]) -> None:
    built = theory(
        "fluent door_open(n: 1..2) = false\naction go(n: 1..2, s: 1..3):\n    poss not door_open(n)\n"
        "    causes door_open(n) := true when s != 1\n"
    )
    assert as_latex(explain(built, "door_open")) == (
        "\\paragraph{relational fluent door\\_open(n: 1..2)}\n"
        "\\subparagraph{Initially}\n"
        "\\begin{align*}\n"
        "& \\lnot \\mathit{door\\_open}(n, S_0)\n"
        "\\end{align*}\n"
        "\\subparagraph{Successor state axiom}\n"
        "\\begin{align*}\n"
        "& \\mathit{door\\_open}(n, \\mathit{do}(a, s)) \\equiv "
        "\\gamma^{+}(n, a, s) \\lor \\mathit{door\\_open}(n, s) \\\\\n"
        "& \\gamma^{+}(n, a, s) \\equiv \\exists s_{1}.\\; a = \\mathit{go}(n, s_{1}) \\land s_{1} \\neq 1\n"
        "\\end{align*}"
    )


def test_messages_are_text(theory: Callable[[str], BasicActionTheory]) -> None:
    built = theory('fluent n: int = 0\nproc p:\n    say "100% of {n} in \\\\a_b {{#}} $5 ~^ & \\"it\\""\n')
    latex = as_latex(explain(built, "p"))
    assert wrong(latex) == []
    assert (
        r"\text{100\% of }\{n\}\text{ in \textbackslash{}a\_b \{\#\} \$5 \textasciitilde{}\textasciicircum{} \& "
        in latex
    )
