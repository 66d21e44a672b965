"""The alphabet of the papers, in Unicode and in LaTeX (of which amsmath is the only package needed)."""

from __future__ import annotations

import re

from golc.explain.document import Text

AND = Text("∧ ", r"\land ")
OR = Text("∨ ", r"\lor ")
NOT = Text("¬", r"\lnot ")
IMPLIES = Text("⊃ ", r"\supset ")
EQUIVALENT = Text("≡ ", r"\equiv ")
EQUALS = Text("= ", "= ")
EXISTS = Text("∃", r"\exists ")
FORALL = Text("∀", r"\forall ")
IN = Text(" ∈ ", r" \in ")
NOT_IN = Text(" ∉ ", r" \notin ")
UNION = Text(" ∪ ", r" \cup ")
INITIAL = Text("S₀", "S_0")
ACTION = Text("a", "a")
SITUATION = Text("s", "s")
SUCCESSOR = Text("s′", "s'")
SECOND_SUCCESSOR = Text("s″", "s''")
GAMMA = Text("γ", r"\gamma")
GAMMA_PLUS = Text("γ⁺", r"\gamma^{+}")
GAMMA_MINUS = Text("γ⁻", r"\gamma^{-}")
PICK = Text("π", r"\pi ")
SEARCH = Text("Σ", r"\Sigma ")
CHOOSE = Text("| ", r"\mid ")
TOGETHER = Text("∥ ", r"\parallel ")
PREFER = Text("⟩⟩ ", r"\mathrel{\rangle\!\rangle} ")
STAR = Text("*", "^{*}")
TOGETHER_STAR = Text("^∥", r"^{\parallel}")
BEGIN_INTERRUPT = Text("⟨", r"\langle ")
END_INTERRUPT = Text("⟩", r" \rangle")
BELOW = Text(" ⊑ ", r" \sqsubseteq ")

COLON = Text(": ", r"{:}\,")
DOT = Text(". ", r".\;")

SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
TEX_TEXT = str.maketrans(
    {
        "\\": r"\textbackslash{}",
        "{": r"\{",
        "}": r"\}",
        "$": r"\$",
        "&": r"\&",
        "#": r"\#",
        "%": r"\%",
        "_": r"\_",
        "^": r"\textasciicircum{}",
        "~": r"\textasciitilde{}",
    }
)
"""How LaTeX's text writes the characters that mean something to it."""

_WORD = re.compile(r'("(?:\\.|[^"\\])*")|([A-Za-z]\w*)|([{}_])|(\.\.)', re.DOTALL)


def sign(text: str) -> Text:
    """Brackets, commas and the like, the same in both."""
    return Text(text, text)


def words(text: str) -> Text:
    """Names, numbers and strings as golc writes them: ``station``, ``{1, 2}``, ``"at home"``."""
    return Text(text, _WORD.sub(_tex, text))


def _tex(found: re.Match[str]) -> str:
    string, name, special, dots = found.groups()
    if string is not None:
        return string_piece(string).tex
    if name is not None:
        return name if len(name) == 1 else rf"\mathit{{{name.translate(TEX_TEXT)}}}"
    return r"\ldots " if dots else f"\\{special}"


def string_piece(text: str) -> Text:
    """Text of a message."""
    return Text(text, rf"\text{{{text.translate(TEX_TEXT)}}}")


def keyword(text: str) -> Text:
    """A word of the language of programs, with the spaces around it."""
    bold = rf"\mathbf{{{text.strip()}}}"
    return Text(text, ("\\ " if text[:1] == " " else "") + bold + ("\\ " if text[-1:] == " " else ""))


def indexed(name: str, index: int) -> Text:
    """A name with a number below it."""
    return Text(f"{name}{str(index).translate(SUBSCRIPTS)}", f"{words(name).tex}_{{{index}}}")


def primed(text: Text) -> Text:
    return Text(f"{text.plain}′", f"{text.tex}'")
