"""What is wrong where the parser stopped, in the words of the writer: one family of mistakes a module.

A hint is a function from a ``Failure`` to a finding, or to None if the mistake is of another kind; ``diagnosis`` asks
them in order. Those of ``trial`` try what the rest of the line would accept; ``gaps`` has the last one, for anything
else. ``fixes`` are what a hint may put right by itself.
"""
