"""Hints for declarations and their lines: a part that is missing, or that another word or sign begins."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic, Span
from golc.syntax.failure import LAYOUT, Failure, Hint
from golc.syntax.hints.fixes import instead, removal, sign_at
from golc.syntax.hints.keywords import AFTER
from golc.syntax.hints.signs import OPERATORS
from golc.syntax.spelling import closest

WITHOUT_COLON = {
    "initially": "a formula",
    "poss": "a formula",
    "causes": "an effect",
    "senses": "a term",
    "cost": "a number",
    "given": "a formula",
    "run": "a procedure",
    "until": "a formula",
    "expect": "what is expected",
    "test": "a formula",
}
"""Words that a colon does not follow, and what does."""

PARAMETERLESS = {
    "const": "with parameters it is a `static`",
    "goal": "write `forall x: type. …` behind the colon",
    "invariant": "write `forall x: type. …` behind the colon",
    "prune": "write `exists x: type. …` behind the colon",
    "type": "a type of other types is `list[t]`, `set[t]` or `t?`",
    "scenario": "leave them out",
}
"""Declarations that have no parameters, and what helps."""

OTHER_CLAUSES = {
    **dict.fromkeys(("possible", "when", "if", "pre", "precondition", "requires", "needs", "where"), "poss"),
    **dict.fromkeys(("effect", "effects", "makes", "sets", "post", "then"), "causes"),
}
"""What begins the clause of an action elsewhere."""


def colon_behind_word(failure: Failure) -> Diagnostic | None:
    """``poss: φ``."""
    match failure.words, failure.kind:
        case [word], "COLON" if word in WITHOUT_COLON and "COLON" not in failure.accepts:
            message = f"behind `{word}` stands {WITHOUT_COLON[word]}, without a colon"
            return failure.finding(Code.SYNTAX, message, help="remove the colon", fix=removal(failure.here()))
    return None


def other_word(failure: Failure) -> Diagnostic | None:
    """Words that begin a part elsewhere, where golc has another one."""
    match failure.words, str(failure.bad or ""):
        case [], word if word in OTHER_CLAUSES and "POSS" in failure.accepts:
            ours = OTHER_CLAUSES[word]
            what = "a precondition" if ours == "poss" else "an effect"
            return _replaced(failure, f"{what} begins with `{ours}`, not with `{word}`", failure.here(), ours)
        case ["exog", *_], ("by" | "via" | "at" | "of") as word if "FROM" in failure.accepts:
            return _replaced(failure, f"who reports it stands behind `from`, not `{word}`", failure.here(), "from")
        case ["on", *_], "and" if {"COMMA", "WHEN"} <= failure.accepts and "AND" not in failure.accepts:
            return failure.finding(Code.FOREIGN, "commas separate what happens at once", help="write `,`")
        case [*_, "on" | "any" | "some" | "none"], "of":
            last = failure.line[-1]
            message, help = f"`{last}` is no word here", "did you mean `one`?"
            return failure.finding(Code.SYNTAX, message, failure.span(last), help)
    return None


def _replaced(failure: Failure, message: str, span: Span, ours: str) -> Diagnostic:
    return failure.finding(Code.FOREIGN, message, span, f"write `{ours}`", fix=instead(span, ours))


def no_parameters(failure: Failure) -> Diagnostic | None:
    """``const c(x: t) = 3``; ``axiom f(x: t)``, whose parameters have the fluent's types."""
    match failure.words, failure.kind:
        case [kind, _], "LPAR" if kind in PARAMETERLESS:
            return failure.finding(Code.SYNTAX, f"a {kind} has no parameters", help=PARAMETERLESS[kind])
        case ["axiom", _, "(", *_], "COLON" if failure.brackets:
            message = "the parameters of an axiom are names without types"
            return failure.finding(Code.SYNTAX, message, help="leave the type out: the fluent has it")
        case [*_, "call" | "start", name], "LPAR":
            message = "a behaviour is named without parentheses"
            return failure.finding(
                Code.SYNTAX, message, help=f"write `{name}` alone: it is given the action's arguments"
            )
    return None


def effect(failure: Failure) -> Diagnostic | None:
    """An effect without its value, as a formula, with `if`, or joined to another one."""
    words, signs = failure.words, [token.type for token in failure.line]
    if not words or words[0] not in ("causes", "after"):
        return None
    if words[-1] == "when" and signs[-2] == "ASSIGN":
        return failure.finding(Code.MISSING, "an expression is missing after `:=`", _behind(failure, -2), VALUE)
    if words == ["causes", "not"]:
        message = "an effect is an assignment, not a formula"
        return failure.finding(Code.SYNTAX, message, failure.span(failure.line[1]), "write `causes f := false`")
    if "IF" in signs and "ELSE" in failure.accepts and failure.kind in LAYOUT:
        word = failure.line[signs.index("IF")]
        message = "the condition of an effect begins with `when`, not with `if`"
        return _replaced(failure, message, failure.span(word), "when")
    joined = failure.kind == "COMMA" or (failure.kind == "ASSIGN" and signs[-1] != "ASSIGN")
    if joined and "ASSIGN" in signs and not failure.brackets:
        place = next((token for token in reversed(failure.line) if token.type == "AND"), failure.bad)
        help = f"begin another line with `{words[0]}`"
        span = failure.here() if place is None else failure.span(place)
        return failure.finding(Code.SYNTAX, "a line has one effect", span, help)
    return None


def bare_values(failure: Failure) -> Diagnostic | None:
    """``type t = a, b``, ``type t = a | b``, ``type t = (a, b)``."""
    match failure.words, failure.rest[:1]:
        case ["type", _, "=", *_], "{" if "PLUS" in failure.accepts:
            gap = failure.gap()
            message, help = "`+` is missing between two types", "write `+`: it joins types"
            return failure.finding(Code.MISSING, message, gap, help, fix=sign_at(gap, "+"))
        case ["type", _, "=", *_], "," | "|" | "(" if {"{", "["}.isdisjoint(failure.words):
            message = "the values of an enumeration stand in braces"
            return failure.finding(Code.SYNTAX, message, help="write `{a, b}`; `+` joins types")
    return None


def missing_name(failure: Failure) -> Diagnostic | None:
    """A name that is missing before a word that was then read as the name."""
    match failure.words, failure.kind:
        case ["exog", "from"], "NAME":
            return _nameless(failure, "exog", 0)
        case ["prune", _, ":", *_], "WHEN":
            gap = failure.at(failure.line[2].end_pos or 0, failure.line[2].end_pos or 0)
            message, help = f"`after` is missing before `{failure.line[3]}`", "write `after`"
            return failure.finding(Code.MISSING, message, gap, help, fix=sign_at(gap, "after"))
        case ["define", _, "(", word], kind if kind != "COLON" and word in AFTER:
            gap = _behind(failure, 1)
            message = f"`:=` is missing after `{failure.line[1]}`"
            return failure.finding(Code.MISSING, message, gap, "write `:=`", fix=sign_at(gap, ":="))
        case [*_, "after", "when"], "NAME" if "WHEN" in failure.accepts:
            return _nameless(failure, "after", -2)
        case [("for" | "pick") as word, "in"], "NAME":
            return _nameless(failure, word, 0)
        case [("goal" | "invariant" | "prune") as kind, _], sign if sign in OPERATORS - {"EQ"} | {"AND", "OR"}:
            help = f"write `{kind} name: …`"
            return failure.finding(Code.MISSING, f"this {kind} has no name", _behind(failure, 0), help)
        case [*_, ":", "where"], _ if failure.kind not in LAYOUT:
            help = "name a type, or write `1..6`, `{a, b}`"
            return failure.finding(Code.MISSING, "a type is missing", _behind(failure, -2), help)
        case [*before, "by"], "CALL" | "START" | "PROMPT" if not before or failure.line[-2].type in ("INT", "RANGE"):
            message, help = "an action is missing before `by`", "write which action is done so"
            return failure.finding(Code.MISSING, message, failure.span(failure.line[-1]), help)
    return None


def missing_end(failure: Failure) -> Diagnostic | None:
    """The last part of a line is missing."""
    if failure.kind not in LAYOUT | {"$END"}:
        return None
    match failure.words:
        case ["static", name, *_] if "EQ" in failure.accepts:
            return failure.finding(Code.MISSING, f"static `{name}` has no value", failure.gap(), "add `= …` at the end")
        case ["on", *_] if {"AFTER", "WHEN"} <= failure.accepts:
            message = "nothing says when this happens"
            return failure.finding(Code.MISSING, message, failure.gap(), "add for example `after 3` or `when waiting`")
        case [*_, "by"] if {"CALL", "START", "PROMPT"} & failure.accepts:
            help = 'write `by call f`, `by start t` or `by prompt "…"`'
            return failure.finding(Code.MISSING, "nothing says how it is done", failure.gap(), help)
    return None


def device_line(failure: Failure) -> Diagnostic | None:
    """A setting without its word or with a sign; a table without a value or a colon."""
    match failure.words, failure.kind:
        case [name], "INT" | "REAL" if "BY" in failure.accepts:
            message, help = "a setting begins with `set`", f"write `set {name} {failure.rest}`"
            return failure.finding(Code.MISSING, message, failure.span(failure.line[0]), help)
        case ["set", _], "EQ" | "ASSIGN" | "COLON":
            message = f"the value of a setting stands without `{failure.bad}`"
            return failure.finding(Code.SYNTAX, message, help="remove it")
        case [*_, _], "RBRACE" | "COMMA" if _in_table(failure):
            message = f"the value of `{failure.previous}` is missing"
            return failure.finding(Code.MISSING, message, failure.gap(), f"write `{failure.previous}: …`")
        case [*_, _], "NAME" | "INT" | "TRUE" | "FALSE" if _in_table(failure):
            message = f"`:` is missing between `{failure.previous}` and `{failure.bad}`"
            return failure.finding(Code.MISSING, message, failure.gap(), "write `:`")
    return None


def expected_actions(failure: Failure) -> Diagnostic | None:
    """``expect actions a, b``, ``expect action [a, b]``."""
    match failure.words, failure.kind:
        case ["expect", "actions"], "NAME":
            message = "the actions that are expected stand in brackets"
            return failure.finding(Code.SYNTAX, message, help="write `expect actions [a, b]`")
        case ["expect", name, "[", *_], _ if name != "actions" and closest(name, ["actions"]) is not None:
            span = failure.span(failure.line[1])
            message, help = f"`{name}` is no word here", "did you mean `actions`?"
            return failure.finding(Code.SYNTAX, message, span, help, fix=instead(span, "actions"))
    return None


VALUE = "write what belongs there"


def _behind(failure: Failure, place: int) -> Span:
    """The place behind a word of the line."""
    end = failure.line[place].end_pos or 0
    return failure.at(end, end)


def _nameless(failure: Failure, word: str, place: int) -> Diagnostic:
    message = f"a name is missing after `{word}`"
    return failure.finding(Code.MISSING, message, _behind(failure, place), "write a name")


def _in_table(failure: Failure) -> bool:
    """Whether a key of a table has been read, and its colon could come."""
    return bool(failure.brackets) and failure.brackets[-1].type == "LBRACE" and "COLON" in failure.accepts


HINTS: tuple[Hint, ...] = (
    colon_behind_word,
    other_word,
    no_parameters,
    effect,
    bare_values,
    missing_name,
    missing_end,
    device_line,
    expected_actions,
)
