"""Reading a text with mistakes: as much of it as can be, and every mistake once.

``declarations`` divides the file; each declaration is a piece (``pieces``), which ``mending`` reads from mistake to
mistake. It edits a ``draft`` of the piece, by the fix of a hint or by one of the ``omissions``, and tries the next
``reading`` of that, until one succeeds or nothing leads on.
"""
