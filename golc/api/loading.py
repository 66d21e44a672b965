"""From a domain file to the public API."""

from __future__ import annotations

from collections.abc import Mapping

from golc.api.report import Report, report_of
from golc.api.theory import Theory
from golc.loading import Domain, examine


def load(domain: Domain, constants: Mapping[str, str] | None = None, *, trust: bool = True) -> Theory:
    """The theory of a domain file and of what it imports; a file that ends in ``.py`` is run.

    A theory that was built in this program with ``golc.embed`` can stand in place of a path.
    ``constants`` replace consts of the file, name to text, as ``-D`` does. Python code that the domain names
    (``extern``) is executed when a function of it is needed, which may be now, for a constant; without ``trust`` never,
    and what needs it fails. Raises ``UserError`` with every error of the file if there is one; warnings are for
    ``check``.

    >>> import golc
    >>> golc.load("examples/elevator/elevator.gl", {"top": "9"})
    <Theory elevator: 2 fluents, 5 actions, 9 procedures, 1 device>
    """
    return Theory(examine(domain, constants, trust=trust))


def check(
    domain: Domain,
    constants: Mapping[str, str] | None = None,
    *,
    proofs: bool = True,
    reachable: bool = False,
    trust: bool = False,
) -> Report:
    """What is to be said of a domain, as for ``load``, which may be wrong or not even there.

    ``constants`` are as for ``load``. Without ``proofs``, what takes all situations into account is left out; if it
    is to be ``reachable``, only states that can be reached are looked at where these can be gone through.
    Python code that the domain names (``extern``) is executed only with ``trust``; without it, what depends on it is
    not worked out, and notes say so.

    >>> import golc
    >>> golc.check("examples/elevator/elevator.gl")
    <Report: nothing found>
    >>> [(finding.code.code, finding.message) for finding in golc.check("missing.gl").findings]
    [('GL001', 'cannot read `missing.gl`: there is no such file')]
    """
    examined = examine(domain, constants, trust=trust)
    return report_of(examined, None if examined.theory is None else Theory(examined), proofs, reachable)
