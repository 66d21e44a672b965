"""Where and how a parse failed: what was read, what came, what could have come."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

from lark import Token, Tree, UnexpectedCharacters, UnexpectedToken
from lark.parsers.lalr_interactive_parser import InteractiveParser
from lark.parsers.lalr_parser_state import ParserState

from golc.diagnostics import Code, Diagnostic, Fix, Label, Severity, Span
from golc.syntax.layout import CLOSING, OPENING
from golc.syntax.parser import parser
from golc.syntax.terminals import words

LAYOUT = frozenset({"_NL", "_INDENT", "_DEDENT"})

MOST_KEPT = 1_000_000
"""How many states of the parser are kept of a line: each word of a chain such as ``a implies b implies …`` has a deeper
stack than the one before."""


@dataclass(frozen=True)
class Failure:
    """The state of the parser before the first token that does not fit, or the first character that begins none.

    ``start`` is the symbol that the part was parsed from; ``tokens`` were read; ``bad`` came next, None for a
    character; ``place`` is its offset in the part; ``accepts`` are the terminals that could have come, ``chosen_from``
    those that could have come instead of the last token read; ``stack`` is the parser's where it failed, ``stacks`` are
    those before each word of the current line, as far as they are kept.
    """

    part: Span
    start: str
    tokens: tuple[Token, ...]
    bad: Token | None
    place: int
    accepts: frozenset[str]
    chosen_from: frozenset[str]
    stack: tuple[int, ...]
    stacks: tuple[tuple[int, ...], ...]

    @property
    def kind(self) -> str:
        """The type of the bad token, or nothing."""
        return "" if self.bad is None else self.bad.type

    @property
    def text(self) -> str:
        return self.part.text

    @property
    def rest(self) -> str:
        """The line from the bad place on."""
        return self.part.text[self.place :].split("\n", 1)[0].rstrip("\r")

    @cached_property
    def previous(self) -> Token | None:
        """The last word or sign read."""
        return next((token for token in reversed(self.tokens) if token.type not in LAYOUT), None)

    @cached_property
    def line(self) -> list[Token]:
        """The words and signs read of the current line; line ends inside brackets do not count."""
        words: list[Token] = []
        for token in reversed(self.tokens):
            if token.type in LAYOUT:
                break
            words.append(token)
        return words[::-1]

    @cached_property
    def words(self) -> list[str]:
        """What has been read of the current line, as text."""
        return [str(token) for token in self.line]

    @cached_property
    def line_before(self) -> list[Token]:
        """The words and signs of the last line read that has any, if the current one has none."""
        tokens = list(self.tokens)
        while tokens and tokens[-1].type in LAYOUT:
            tokens.pop()
        words: list[Token] = []
        while tokens and tokens[-1].type not in LAYOUT:
            words.append(tokens.pop())
        return words[::-1]

    @cached_property
    def brackets(self) -> list[Token]:
        """The brackets that are open."""
        stack: list[Token] = []
        for token in self.tokens:
            if token.type in OPENING:
                stack.append(token)
            elif token.type in CLOSING and stack:
                stack.pop()
        return stack

    @property
    def wants_expression(self) -> bool:
        """Whether an expression could begin here."""
        return {"NAME", "INT", "LPAR", "TRUE"} <= self.accepts

    @property
    def wants_type(self) -> bool:
        """Whether a type could begin here."""
        return {"NAME", "INT", "LBRACE", "SET"} <= self.accepts

    def begins_line(self) -> bool:
        """Whether the bad token is the first of its line."""
        return self.part.text[: self.place].rpartition("\n")[2].strip() == ""

    def at(self, start: int, end: int) -> Span:
        """A span of the part, by offsets in it."""
        return Span(self.part.source, self.part.start + start, self.part.start + end)

    def span(self, token: Token) -> Span:
        """Where a token stands."""
        return self.at(token.start_pos or 0, token.end_pos or 0)

    def here(self) -> Span:
        """The bad token or character; for one without width, such as a missing end, the place itself."""
        return self.at(self.place, self.place + (1 if self.bad is None else len(self.bad)))

    def gap(self) -> Span:
        """The place where something is missing: the end of the last word."""
        end = (self.previous.end_pos or 0) if self.previous is not None else self.place
        return self.at(end, end)

    def finding(
        self,
        code: Code,
        message: str,
        span: Span | None = None,
        help: str | None = None,
        labels: tuple[Label, ...] = (),
        fix: Fix | None = None,
    ) -> Diagnostic:
        """An error, at the bad token if no other place is given."""
        return Diagnostic(code, message, span or self.here(), Severity.ERROR, labels=labels, help=help, fix=fix)


Hint: TypeAlias = Callable[[Failure], Diagnostic | None]
"""A rule that recognises a kind of mistake."""


def read(part: Span, start: str, text: str) -> Tree[Token] | Failure:
    """The parse tree of a text that begins at a part of a source, or where its parser fails; raises ``LayoutError``."""
    interactive = parser().parse_interactive(text, start=start)
    stack = interactive.parser_state.state_stack
    lex: Any = interactive.lexer_thread.lex
    feed_eof: Any = interactive.feed_eof
    tokens: list[Token] = []
    line: list[tuple[int, ...]] = []
    before = current = tuple(stack)
    kept = 0
    try:
        for token in lex(interactive.parser_state):
            interactive.feed_token(token)
            tokens.append(token)
            if token.type in LAYOUT:
                line.clear()
                kept = 0
            elif (kept := kept + len(current)) <= MOST_KEPT:
                line.append(current)
            before, current = current, tuple(stack)
        parsed: Tree[Token] = feed_eof(tokens[-1] if tokens else None)
        return parsed
    except UnexpectedToken as error:
        bad: Token | None = _as_word(error.token)
        place = (tokens[-1].end_pos or 0) if error.token.type == "$END" and tokens else error.token.start_pos or 0
    except UnexpectedCharacters as error:
        bad, place = None, error.pos_in_stream
    # The parser reduces before it finds that a token does not fit: what it accepts is asked of the state before that.
    accepts, chosen_from = _accepts(interactive, current), _accepts(interactive, before)
    return Failure(part, start, tuple(tokens), bad, place, accepts, chosen_from, current, tuple(line))


def wants(start: str, stack: Iterable[int], terminal: str) -> bool:
    """Whether a terminal could come when the parser's stack is this one."""
    no_lexer: Any = None
    state = ParserState(without_trees(start), no_lexer, list(stack), [])
    try:
        state.feed_token(Token(terminal, ""))
    except UnexpectedToken:
        return False
    return True


def without_trees(start: str) -> Any:
    """What the parser needs to go on from a stack when it need not build trees, so that it needs no values of what it
    has read."""
    conf = copy(parser().parse_interactive(start=start).parser_state.parse_conf)
    conf.callbacks = {}
    return conf


def _as_word(token: Token) -> Token:
    """A word that came where only names are read as words: as the terminal that it is elsewhere."""
    terminal = words().get(str(token)) if token.type == "NAME" else None
    return token if terminal is None else Token.new_borrow_pos(terminal, str(token), token)


def _accepts(interactive: InteractiveParser, stack: Iterable[int]) -> frozenset[str]:
    """The terminals that could come when the parser's stack is this one."""
    interactive.parser_state.state_stack[:] = stack
    accepts: Any = interactive.accepts
    return frozenset(accepts())
