"""Names that come into being in Python: what may be one."""

from __future__ import annotations

import re
import unicodedata

from golc.diagnostics import Code, Span
from golc.embed.errors import refused
from golc.embed.values import described
from golc.syntax import tree
from golc.syntax.python_names import golc_name
from golc.syntax.words import RESERVED

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


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
