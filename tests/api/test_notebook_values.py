"""How values show themselves in notebooks: well-formed HTML whose text is that of the domain, whatever it says."""

from __future__ import annotations

from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

import golc

ROOT = Path(__file__).parents[2]
ALLOWED = {"div", "p", "b", "i", "pre", "table", "thead", "tbody", "tr", "th", "td", "ol", "ul", "li"}
INSIDE = {"ol": {"li"}, "ul": {"li"}, "table": {"thead", "tbody"}, "thead": {"tr"}, "tbody": {"tr"}, "tr": {"th", "td"}}


class Reader(HTMLParser):
    """Reads HTML into a list of its texts, each after a tab for each list that it stands in."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.texts: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag in ALLOWED
        if self.open and self.open[-1] in INSIDE:
            assert tag in INSIDE[self.open[-1]]
        self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        assert self.open
        self.texts.append("\t" * sum(tag in ("ol", "ul") for tag in self.open) + data)


def texts(html: str) -> list[str]:
    """The texts of a well-formed piece of HTML."""
    reader = Reader()
    reader.feed(html)
    reader.close()
    assert reader.open == []
    return reader.texts


EVIL = """domain evil
fluent note: string = "<script>alert(1)</script> & more"
fluent less(n: 1..3): int = n
fluent on(n: 1..3) = n < 3
fluent colour: {dark, light} = unknown
action do_it(n: 1..3):
    poss 1 < n and less(n) < 3
    causes note := "<b>{n}</b>"
action look:
    senses colour
exog happens
proc control:
    do_it(2)
    say "<i>{note}</i>"
    look
    if colour = dark:
        do_it(2)
        do_it(2)
device host "eyes.py":
    do_it(n: 1..3)
    look
"""


@pytest.fixture
def evil(tmp_path: Path) -> golc.Theory:
    (tmp_path / "evil.gl").write_text(EVIL)
    (tmp_path / "eyes.py").write_text('def do_it(n): pass\ndef look(): return "light"\n')
    return golc.load(tmp_path / "evil.gl")


def test_a_state_has_a_row_for_each_fluent(evil: golc.Theory) -> None:
    assert texts(evil.initial()._repr_html_()) == [
        *("fluent", "value"),
        *("note", '"<script>alert(1)</script> & more"'),
        *("less", "1: 1; 2: 2; 3: 3"),
        *("on", "true for 1, 2"),
        *("colour", "dark or light"),
        "2 possible worlds",
    ]


def test_a_state_with_many_values_is_short(tmp_path: Path) -> None:
    (tmp_path / "many.gl").write_text(
        "domain many\nfluent depth(x: 1..9, y: 1..9): int = 7 if x = y and x < 3 else 1\nfluent dry(x: 1..3) = false\n"
        "fluent even(x: 1..9): int = 4\n"
    )
    assert texts(golc.load(tmp_path / "many.gl").initial()._repr_html_())[2:] == [
        *("depth", "(1, 1): 7; (2, 2): 7; all others: 1"),
        *("dry", "true for nothing"),
        *("even", "all: 4"),
    ]


def test_a_theory_shows_what_it_declares(evil: golc.Theory) -> None:
    shown = texts(evil._repr_html_())
    assert shown[:2] == ["evil", f" ({evil.path}): 4 fluents, 3 actions, 1 procedure, 1 device"]
    row = shown.index("do_it(n: 1..3)")
    assert shown[row + 1] == "1 < n and less(n) < 3"
    assert shown[shown.index("look") + 1] == "senses colour"
    assert shown[shown.index("happens") + 1] == "exogenous"
    assert shown[-7:] == ["procedure", "control", "device", "file", "host", "eyes.py", "2 lines"]


EMBEDDED = """from golc.embed import Theory, causes, interval, poss
theory = Theory("lift")
at = theory.fluent("at", interval(1, 3), 1)
@theory.action
def up():
    poss(at < top)
    causes(at, at + 1)
"""


def test_a_theory_in_python_shows_what_is_loaded_of_it(tmp_path: Path) -> None:
    names: dict[str, Any] = {}
    path = tmp_path / "lift.py"
    path.write_text(EMBEDDED)
    exec(compile(EMBEDDED, str(path), "exec"), names)
    theory = names["theory"]

    assert texts(theory._repr_html_()) == [
        *("lift", f" ({path}): not finished, 1 finding"),
        *("declared so far", "fluent", "at", "action", "up"),
        f"error[GL012]: `top` is neither a Python constant nor declared\n --> {path}:6:15\n  |\n"
        "6 |     poss(at < top)\n  |               ^^^\n"
        "  = help: assign it, declare it with the theory, or import it from `golc.embed`",
    ]
    assert str(theory).splitlines()[:5] == [
        f"domain lift ({path}): not finished, 1 finding",
        "",
        "declared so far",
        "  fluent         at",
        "  action         up",
    ]

    names["top"] = 3

    assert theory._repr_html_() == golc.load(theory)._repr_html_()
    assert str(theory) == str(golc.load(theory))


def test_a_theory_in_python_is_shown_without_its_helpers(tmp_path: Path) -> None:
    text = (
        "from golc.embed import Theory\ntheory = Theory('d')\n"
        "@theory.extern(file='helpers.py')\ndef f(n: int) -> int: ...\n"
        "@theory.const\ndef c():\n    return f(1)\n"
    )
    names: dict[str, Any] = {}
    (tmp_path / "helpers.py").write_text("raise SystemExit\ndef f(n): pass\n")
    (tmp_path / "d.py").write_text(text)
    exec(compile(text, str(tmp_path / "d.py"), "exec"), names)

    shown = texts(names["theory"]._repr_html_())

    assert shown[2:7] == ["declared so far", "const", "c", "static", "f"]
    assert "helpers.py is not executed" in shown[7]


def test_a_plan_is_a_numbered_tree(evil: golc.Theory) -> None:
    assert texts(evil.plan()._repr_html_()) == [
        "\tdo_it(2)",
        "\tlook",
        "\t\tcolour = dark:",
        "\t\t\tdo_it(2)",
        "\t\t\tdo_it(2)",
        "\t\tcolour = light: nothing more",
    ]
    assert '<ol start="3"><li>do_it(2)' in evil.plan()._repr_html_()


def test_each_plan_of_a_search_shows_itself_with_its_cost(tmp_path: Path) -> None:
    (tmp_path / "paid.gl").write_text(
        "domain paid\naction a:\n    cost 2\naction b\n"
        "proc control:\n    choose:\n        a\n        a\n    or:\n        b\n        a\n"
    )
    theory = golc.load(tmp_path / "paid.gl")

    assert [texts(plan._repr_html_()) for plan in theory.planning(every=True)] == [["\ta", "\ta"], ["\tb", "\ta"]]
    assert texts(theory.plan(strategy="cheapest")._repr_html_()) == ["\tb", "\ta", "cost 3"]


def test_a_long_plan_is_cut_off_and_a_short_one_says_so(tmp_path: Path) -> None:
    (tmp_path / "long.gl").write_text(
        "domain long\nfluent n: int = 0\naction inc:\n    causes n := n + 1\n"
        "proc control:\n    while n < 300:\n        inc\nproc nothing:\n    test n = 0\n"
    )
    theory = golc.load(tmp_path / "long.gl")
    shown = texts(theory.plan()._repr_html_())
    assert (len(shown), shown[-1]) == (200, "\tinc …")
    assert texts(theory.plan("nothing")._repr_html_()) == ["nothing is to be done"]


def test_a_run_shows_what_happened(evil: golc.Theory) -> None:
    run = golc.run(evil)
    shown = texts(run._repr_html_())
    assert shown[0].startswith("evil: control: the program is final, after 2 actions and 0 exogenous actions in ")
    assert [text for text in shown if text in ("do_it(2)", "look: light", "“<i><b>2</b></i>”")] == [
        "do_it(2)",
        "look: light",
        "“<i><b>2</b></i>”",
    ]
    assert shown[-2:] == ["colour", "light"]


def test_a_report_shows_its_findings(tmp_path: Path) -> None:
    (tmp_path / "wrong.gl").write_text("domain wrong\nfluent n: int = 1 < 2\n")
    shown = texts(golc.check(tmp_path / "wrong.gl")._repr_html_())
    assert shown[0] == "1 error"
    assert "fluent n: int = 1 < 2" in shown[1]


def test_texts_are_for_people(evil: golc.Theory) -> None:
    assert str(evil).splitlines()[2:5] == [
        "fluent           type           at first",
        '  note           string         "<script>alert(1)</script> & more"',
        "  less(n: 1..3)  int            n",
    ]
    assert repr(evil.initial()) == (
        '<State: note = "<script>alert(1)</script> & more", colour = dark or light; '
        "less(1) = 1, less(2) = 2, less(3) = 3; on holds for 1, 2>"
    )
