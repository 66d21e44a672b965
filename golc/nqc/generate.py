"""Writing the NQC program of a brick: the program, the event loop, the action map, and what the user's files lack."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from golc.diagnostics import Code, Findings, Source, Span
from golc.nqc.actionmap import ActionMap
from golc.nqc.behaviours import Wanted, check_behaviours, check_reports, check_timer, lacking
from golc.nqc.busy import check_rests
from golc.nqc.dispatch import Names, facts
from golc.nqc.files import Written, is_untouched, open_seal, remove, seal, write
from golc.nqc.program import TIMER, Program, control, queue_of
from golc.nqc.source import NqcSource
from golc.nqc.userfiles import CONTROL, merge, scan_file, user_file
from golc.theory.theory import BasicActionTheory


@dataclass(frozen=True)
class Generated:
    """What was made for a brick: ``path`` is the file to compile, ``folders`` is where its includes are looked up."""

    actions: ActionMap
    path: Path
    folders: tuple[Path, ...]
    written: tuple[Written, ...]
    removed: tuple[Path, ...]
    stubs: tuple[Wanted, ...]
    user: NqcSource
    program: Program


def generate(
    theory: BasicActionTheory, actions: ActionMap, folder: Path, findings: Findings, tones: bool = False
) -> Generated | None:
    """Write the program of a brick into a folder; None if its files do not fit, which the findings say.

    ``actions`` is a map for which ``number_device`` has found nothing wrong. Raises UserError where a file cannot be
    read or written.
    """
    stem = f"{theory.name}-{actions.device.name}"
    own = user_file(actions.device)
    scanned = None if own is None else scan_file(own)
    edited, fresh = _stub_files(folder, stem)
    found = [nqc for nqc in (scanned, *map(scan_file, edited)) if nqc is not None]
    user = merge(found)
    program = Program(theory, actions, user, tones)
    _check(program, actions, user, findings)
    if findings.has_errors:
        return None
    stubs = lacking(actions, user)
    files = [] if own is None or scanned is None else [os.path.relpath(own, folder)]
    files += [path.name for path in edited]
    texts = {}
    if stubs:
        files.append(fresh.name)
        texts[fresh] = program.stubs(fresh.name, stubs)
    path = folder / f"{stem}.nqc"
    include = "" if own is None else f"-I{os.path.relpath(own.parent, folder)} "
    texts = {path: program.text(path.name, files, include), folder / CONTROL: control(), **texts}
    texts[folder / f"{stem}.json"] = _json(theory, actions)
    written = tuple(write(file, text) for file, text in texts.items())
    _say_kept(written, findings)
    removed = () if stubs or not remove(fresh) else (fresh,)
    folders = (folder,) if own is None else (folder, own.parent)
    return Generated(actions, path, folders, written, removed, tuple(stubs), user, program)


def _say_kept(written: tuple[Written, ...], findings: Findings) -> None:
    for file in written:
        if file.kept is not None:
            source = Source(str(file.kept), file.kept.read_bytes().decode("utf-8", "replace"))
            first = source.line(1)
            findings.warning(
                Code.NQC_EDITED,
                f"`{file.kept.name}` has been edited and is left as it is",
                Span(source, 0, len(first)),
                help=f"what golc would have written is in `{file.path.name}`; to get it, remove your file",
            )


def _stub_files(folder: Path, stem: str) -> tuple[list[Path], Path]:
    """The files of stubs that somebody has edited, and the first name that is free for new ones."""
    edited = []
    number = 1
    while not is_untouched(path := folder / f"{stem}-stubs{'' if number == 1 else number}.nqc"):
        edited.append(path)
        number += 1
    return edited, path


def _check(program: Program, actions: ActionMap, user: NqcSource, findings: Findings) -> None:
    check_behaviours(actions, user, {*program.variables, *program.macros}, findings)
    check_timer(user, TIMER, findings)
    check_rests(user, findings)
    if program.sampled:
        findings.warning(
            Code.NQC_SAMPLED,
            "`exogAction` holds one event at a time: the first of two that come quickly may be lost",
            actions.device.span,
            help="report with `golc_report(EXOG_…);` instead, which loses none",
        )
    elif user.sources:
        check_reports(actions, {counter.name: counter.entry for counter in program.counters}, user, findings)
    queue = queue_of(actions)
    if program.counters and not queue.depth:
        findings.error(
            Code.NUMBER_RANGE,
            f"the numbers of the exogenous actions lie too far apart: {queue.first} to {queue.last}",
            actions.device.span,
            help="give them numbers that follow each other",
        )


def _json(theory: BasicActionTheory, actions: ActionMap) -> str:
    head = {
        "golc": version("golc"),
        "seal": open_seal(),
        "domain": theory.name,
        "device": actions.device.name,
        "protocol": "classic",
    }
    return seal(json.dumps({**head, **facts(actions, Names(actions))}, indent=2, ensure_ascii=False) + "\n")
