"""Names: how Python writes a name that it needs for itself, and what may be one."""

from __future__ import annotations

import keyword
import re
import unicodedata

from golc.diagnostics import Code, Span
from golc.embed.errors import refused
from golc.embed.values import described
from golc.syntax import tree
from golc.syntax.words import RESERVED

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
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def golc_name(name: str) -> str:
    """The name that a Python name stands for: one underscore at its end is taken off if Python or this package needs
    the name without them."""
    return name[:-1] if name.endswith("_") and name.rstrip("_") in _PYTHONS else name


def python_name(name: str) -> str:
    """The Python name that stands for a name: the reverse of ``golc_name``."""
    return name + "_" if name.rstrip("_") in _PYTHONS else name


def new_name(text: object, span: Span, used: bool = False) -> tree.Ident:
    """A name that comes into being at a place, or is only ``used`` there. Raises ``Refused`` if it cannot be one."""
    if not isinstance(text, str) or not _NAME.fullmatch(text):
        what = f"`{text}`" if isinstance(text, str) else described(text)
        help_ = "begin it with a letter and go on with letters (without accents), digits and `_`"
        near = _nearest_name(text) if isinstance(text, str) else ""
        if isinstance(text, str) and text and not text.strip("_"):
            help_ = "what is not used has a name, too: `k`"
        raise refused(
            Code.PYTHON_MEANING, f"{what} cannot be a name", span, f"{help_}, as in `{near}`" if near else help_
        )
    if text in RESERVED and not used:
        free = [each for each in (f"{text}_", f"the_{text}") if golc_name(each) != text]
        help_ = f"choose another name, for example {' or '.join(f'`{each}`' for each in free)}"
        raise refused(Code.RESERVED, f"`{text}` is a word of the language and cannot be a name", span, help_)
    return tree.Ident(text, span=span)


def _nearest_name(text: str) -> str:
    """A text as a name: letters without their accents, `_` for all else; empty if no letter begins it then."""
    plain = unicodedata.normalize("NFKD", text.replace("ß", "ss"))
    letters = "".join(each for each in plain if not unicodedata.combining(each))
    name = re.sub(r"[^A-Za-z0-9]+", "_", letters).strip("_")
    return name if _NAME.fullmatch(name) else ""
