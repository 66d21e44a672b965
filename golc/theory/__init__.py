"""The basic action theory that a tree describes, and what its terms mean.

The finished value is ``theory``, with its ``types``, ``terms``, ``statements`` and ``scenarios``. ``elaborate`` makes
it of a tree: ``declare`` collects the names (``scope``), the ``elaborate_*`` modules give each declaration a meaning,
with what they share (``context``); ``expectations`` and ``relations`` say what fits where (``fitting``), ``complaints``
and ``blame`` say each mistake once, where the fault lies, in the form in which the theory is written (``forms``,
``suggest``). Nothing is said of what was not read (``unread``).

``closed`` has the values that need no situation, ``evaluate`` the meaning of every term (``operations``, ``order``,
``errors``). Functions of Python come in over the ``border`` (``foreign``, ``python_file``, ``python_text``). ``ground``
and ``queries`` read actions and formulas that people write where there is a theory already.
"""
