"""Writing the NQC program of a brick: the program, the event loop, the action map, and what the user's files lack."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from golc.diagnostics import Code, Findings, Source, Span
from golc.nqc.actionmap import ActionMap
from golc.nqc.behaviours import Wanted, lacking
from golc.nqc.dispatch import Names, facts
from golc.nqc.files import Written, open_seal, remove, seal, write
from golc.nqc.program import Program, control
from golc.nqc.review import review
from golc.nqc.source import NqcSource
from golc.nqc.userfiles import CONTROL, program_name, user_file, user_files
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
    stem = program_name(theory.name, actions.device)
    own = user_file(actions.device)
    nqc = user_files(theory.name, actions.device, folder)
    user, fresh = nqc.all, nqc.fresh
    program = Program(theory, actions, user, tones)
    review(program, user, findings)
    if findings.has_errors:
        return None
    stubs = lacking(actions, user)
    files = [] if own is None or nqc.own is None else [os.path.relpath(own, folder)]
    files += [path.name for path in nqc.edited]
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


def _json(theory: BasicActionTheory, actions: ActionMap) -> str:
    head = {
        "golc": version("golc"),
        "seal": open_seal(),
        "domain": theory.name,
        "device": actions.device.name,
        "protocol": "classic",
    }
    return seal(json.dumps({**head, **facts(actions, Names(actions))}, indent=2, ensure_ascii=False) + "\n")
