"""Writes `forms.md`, the page that shows both forms of the language side by side: `python docs/forms.py`.

What stands here is golc; its Python is what `golc convert` writes. A test compares the page with what this file makes,
reads both sides of each row, and looks whether every construct has one.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent, indent
from typing import Literal

from golc.diagnostics import Findings, Source
from golc.embed.printing import python_text
from golc.syntax.parse import parse_file

PAGE = Path(__file__).with_name("forms.md")

CONTEXT = """domain lift

type floor = 1..6
type door = {open, closed}

fluent at: floor = 1
fluent gate: door = closed
fluent wanted: floor? = none
fluent lit(n: floor) = false
fluent stops: list[floor] = []

initially gate != open

action go(n: floor):
    causes at := n

action turn_off(n: floor):
    causes lit(n) := false

action look:
    senses lit(at)

exog call(n: floor):
    causes lit(n) := true

proc serve(n: floor):
    go(n)
    turn_off(n)

proc control:
    serve(1)
"""
"""What the rows speak of."""


@dataclass(frozen=True)
class Row:
    """A piece of golc; ``also``: other Python that says the same."""

    golc: str
    also: tuple[str, ...] = ()


Kind = Literal["head", "declaration", "statement", "expression"]


@dataclass(frozen=True)
class Section:
    """Rows of one kind under a title."""

    title: str
    kind: Kind
    rows: tuple[Row, ...]
    text: str = ""


def row(golc: str, *also: str) -> Row:
    return Row(dedent(golc).strip("\n"), tuple(dedent(each).strip("\n") for each in also))


SECTIONS = (
    Section(
        "Imports",
        "head",
        (
            row(
                'import "beds.gl"\nfluent bed_at: bed = north',
                """
                theory.import_("beds.gl")
                bed_at = theory.fluent("bed_at", "bed", names("north"))
                """,
            ),
        ),
        "What the imported file declares is named by `names` and `types`.",
    ),
    Section(
        "Types, constants and fluents",
        "declaration",
        (
            row("const top = 6", "@theory.const\ndef top():\n    return 6"),
            row("type storey = 0..9"),
            row("type heading = {-1, 1}"),
            row(
                """
                type phase = {moving, stopped}
                fluent motion: phase = stopped
                """,
                """
                phase = theory.type("phase", enum("moving", "stopped"))
                motion = theory.fluent("motion", phase, phase.stopped)
                """,
            ),
            row("type place = door + {table}\nfluent thing: place = table"),
            row("fluent side: {left, right} = left"),
            row(
                "fluent aim: floor? = none",
                'aim = theory.fluent("aim", optional("floor"), None)',
                """
                @theory.fluent
                def aim() -> floor | None:
                    return None
                """,
            ),
            row("fluent seen: set[floor] = {}"),
            row(
                """
                fluent tank: real = 1.5
                fluent visitor: string? = none
                fluent rounds: int = 0
                fluent awake: bool = true
                """
            ),
            row("type near = 1..reach\nconst reach = 2 * 3"),
            row("fluent calm = true"),
            row("fluent lost: floor = unknown"),
            row(
                "fluent hidden: floor = one of {1, 2}",
                'hidden = theory.fluent("hidden", floor, one_of({1, 2}))',
            ),
            row(
                "fluent warm(n: floor) = n > 3",
                'warm = theory.fluent("warm", initial=lambda n: n > 3, parameters={"n": floor})',
            ),
            row("fluent load(n: floor): 0..3 = 0"),
            row("fluent forgotten(n: floor)"),
        ),
        "A call has its arguments computed by Python. What Python would change (`2 * 3`, the order of a set) and what\n"
        "is declared further down stand in a function, which is translated.",
    ),
    Section(
        "Statics, definitions, constraints and goals",
        "declaration",
        (
            row("static pi: real = 3.14"),
            row("static distance(a: floor, b: floor): int = abs(a - b)"),
            row("static turned(d: door): door = {open: closed, closed: open}"),
            row("static weight(n: 1..2, d: 1..1): int = {(1, 1): 2, (2, 1): 3}"),
            row('extern price(n: floor): int from "prices.py"'),
            row("define bright(n: floor) := lit(n) and n != at"),
            row(
                "initially at = 1 or lit(2)",
                "theory.initially((at == 1) | lit(2))",
            ),
            row(
                "invariant closed_up: at = 6 implies gate = closed",
                'theory.invariant("closed_up", implies(at == 6, gate == closed))',
            ),
            row(
                "goal dark: not exists n: floor. lit(n)",
                'theory.goal("dark", ~exists(floor, lambda n: lit(n)))',
            ),
            row("prune too_high: at > 5"),
            row("prune back: after go(n) when before(at) = n"),
        ),
    ),
    Section(
        "Actions",
        "declaration",
        (
            row("action ring"),
            row(
                """
                action up:
                    poss at + 1 in floor
                    causes at := at + 1
                    cost 2
                """
            ),
            row(
                """
                action shake(n: floor):
                    causes gate := unknown
                    causes wanted := one of {1, n} when lit(n)
                """
            ),
            row(
                """
                action all_off:
                    causes forall n: floor. lit(n) := false
                    causes forall n: floor, m in stops where n < m. lit(n) := true
                """
            ),
            row(
                """
                action peek:
                    senses gate
                    senses at > 3
                """
            ),
            row("exog arrive expected from operator, brick:\n    causes at := 1"),
            row(
                """
                fluent on_top(n: floor) = false
                axiom on_top(n):
                    after go(n) := true
                    after go(m) := unknown when m > n
                    after turn_off(1) := false
                    otherwise unchanged
                """
            ),
        ),
    ),
    Section(
        "Programs",
        "statement",
        (
            row("go(3)\nlook\ncontrol"),
            row("skip"),
            row("test lit(at)"),
            row(
                """
                if lit(1):
                    go(1)
                elif lit(2):
                    go(2)
                else:
                    go(3)
                """
            ),
            row("while lit(at):\n    turn_off(at)"),
            row("choose:\n    go(1)\nor:\n    go(2)"),
            row("pick n: floor where lit(n):\n    serve(n)"),
            row("pick n in stops, m: floor:\n    go(n)\n    go(m)"),
            row("star:\n    look"),
            row("star at most 3:\n    look"),
            row("for n: floor:\n    turn_off(n)"),
            row("for n in stops where n > 1:\n    serve(n)"),
            row("let n = at + 1:\n    go(n)"),
            row("together:\n    go(1)\nand:\n    look"),
            row("together star:\n    look"),
            row("prefer:\n    go(1)\nover:\n    look"),
            row(
                """
                interrupts:
                    on lit(at):
                        turn_off(at)
                    on some n: floor where lit(n):
                        go(n)
                    on true:
                        wait
                """
            ),
            row("guard gate = closed:\n    go(1)"),
            row("search:\n    control"),
            row("search shortest at most 20 steps within 2 s:\n    control"),
            row("wait"),
            row("wait until lit(1)"),
            row("wait 0.5 s"),
            row('within 10 s:\n    go(1)\nelse:\n    abort "too late"'),
            row('say "at {at}, {{braces}}"'),
        ),
        "Each is the body of a function under `@theory.proc`: `proc serve(n: floor):` is `def serve(n: floor):`.",
    ),
    Section(
        "Terms and formulas",
        "expression",
        (
            row("at = 1 and gate != closed or not lit(3)"),
            row("1 < at and at <= 5", "1 < at <= 5"),
            row("at > 1 and at >= 2"),
            row("lit(1) implies lit(2)"),
            row("lit(1) iff lit(2)"),
            row("at in {1, 2} and at not in 3..6"),
            row("at + 1 in floor"),
            row("(at + 2 * 3 - 1) // 2 % 2 = -1"),
            row("(1 if lit(1) else 2) = at"),
            row("wanted = none or true != false"),
            row("abs(at - 3) = min(at, 2) + max(at, 2)"),
            row("exists n: floor where n > at. lit(n)"),
            row("forall n in stops. lit(n)"),
            row("exists n in floor. lit(n)"),
            row("exists n: 1..3, m: {1, 2}. n = m"),
            row("(count n: floor. lit(n)) > 1"),
            row("(sum n: floor where lit(n). n) = 6"),
            row("(min n: floor. n) < (max n in stops. n)"),
            row("stops[0] = first(stops) and len(rest(stops)) = 1"),
            row("stops = [1, 2] + [] and {at} != {}"),
            row("[n + 1 for n in stops] = [2]"),
            row("1 in {n for n: floor where lit(n)}"),
            row("poss(go(3)) and poss(look)"),
            row("knows(gate = open) or possible(lit(1))"),
            row("known(gate)"),
        ),
        "In a translated function. [Outside](embedding.md#two-kinds-of-python) `&`, `|` and `~` stand for `and`,\n"
        "`or` and `not`.",
    ),
    Section(
        "Scenarios",
        "declaration",
        (
            row(
                """
                scenario a_day:
                    given lit(2)
                    run serve(2)
                    on call(3) after 1
                    on call(4), call(5) when at = 2
                    on call(6) when waiting
                    until at = 6
                    expect go at least 1
                    expect go(2) at most 2
                    expect look exactly 0
                    expect actions [go(2), turn_off(2)]
                    expect not lit(2)
                """
            ),
        ),
    ),
    Section(
        "Devices",
        "declaration",
        (
            row(
                """
                device rcx "lift.nqc":
                    0 look by call lookAround timeout 9 s {0: false, 1: true}
                    1 .. go(n: floor) by start goTo
                    call
                    set poll 0.25 s
                    set range 1
                """
            ),
            row('device rcx upper "upper.nqc":\n    8 turn_off(3) by call lightOff\n    9 .. turn_off(n: 4..6)'),
            row('device operator:\n    go by prompt "Please bring me to floor {n}"'),
            row('device host "helpers.py":\n    look by call photograph'),
            row("device self"),
        ),
    ),
)


def golc_file(section: Section, each: Row) -> str:
    """A whole file with a row in it, its last declarations."""
    match section.kind:
        case "head" | "declaration":
            return f"{_context(section)}\n{each.golc}\n"
        case "statement":
            return f"{CONTEXT}\nproc p:\n{indent(each.golc, '    ')}\n"
        case "expression":
            return f"{CONTEXT}\ngoal g: {each.golc}\n"


def python_file(section: Section, python: str) -> str:
    """The same with the row in Python."""
    match section.kind:
        case "head" | "declaration":
            body = python
        case "statement":
            body = f"@theory.proc\ndef p():\n{indent(python, '    ')}"
        case "expression":
            body = f"@theory.goal\ndef g():\n    return {python}"
    head = "from __future__ import annotations\n\nfrom golc.embed import *\n"
    return f"{head}\n{_below_imports(_context(section))}\n\n{body}\n"


def python_of(section: Section, each: Row) -> str:
    """The Python of a row as `golc convert` writes it."""
    before, whole = _below_imports(_context(section)), _below_imports(golc_file(section, each))
    assert whole.startswith(before), whole
    python = whole[len(before) :].strip("\n")
    match section.kind:
        case "head" | "declaration":
            return python
        case "statement":
            return dedent(python.partition("def p():\n")[2])
        case "expression":
            return python.partition("    return ")[2]


def _context(section: Section) -> str:
    return CONTEXT.partition("\n")[0] + "\n" if section.kind == "head" else CONTEXT


def _below_imports(text: str) -> str:
    """The Python of a file from the line on that makes the theory."""
    file = parse_file(Source("forms.gl", text), Findings())
    assert file is not None, text
    return "theory = " + python_text(file).partition("theory = ")[2]


def page() -> str:
    """The page as Markdown."""
    parts = [HEAD, *(part for section in SECTIONS for part in _section(section))]
    return "\n\n".join(parts) + "\n"


HEAD = """# Both forms, side by side

Every construct of the language as text and [in Python](embedding.md). The Python is what
[`golc convert`](command-line.md#golc-convert) writes; below a line stands other Python that says the same. The rows
speak of a lift with these declarations: `floor`, `door` with the symbols `open` and `closed`; the fluents `at`, `gate`,
`wanted`, `lit(n)` and `stops`; the actions `go(n)`, `turn_off(n)` and `look`, the exogenous action `call(n)`; the
procedures `serve(n)` and `control`.

`domain lift` is `theory = Theory("lift")`, at the head of the file below `from golc.embed import …`."""


def _section(section: Section) -> list[str]:
    parts = [f"## {section.title}", *([section.text] if section.text else [])]
    if section.kind == "expression":
        lines = [f"| {_code(each.golc)} | {_python_cell(section, each)} |" for each in section.rows]
        return [*parts, "\n".join(["| golc | Python |", "|---|---|", *lines])]
    cells = [_cells(section, each) for each in section.rows]
    return [*parts, "\n\n".join(["<table>\n<tr><th>golc</th><th>Python</th></tr>", *cells, "</table>"])]


def _python_cell(section: Section, each: Row) -> str:
    return "<br>".join(_code(python) for python in (python_of(section, each), *each.also))


def _code(text: str) -> str:
    return f"`{text.replace('|', chr(92) + '|')}`"


def _cells(section: Section, each: Row) -> str:
    blocks = "\n\n---\n\n".join(_block("python", python) for python in (python_of(section, each), *each.also))
    return f"<tr><td>\n\n{_block('golc', each.golc)}\n\n</td><td>\n\n{blocks}\n\n</td></tr>"


def _block(language: str, text: str) -> str:
    return f"```{language}\n{text}\n```"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
