"""Questions about all situations of a theory, or about those that can be reached, and their answers.

A question (``questions``) is a list of steps: formulas that hold, actions that happen. The ``prover`` answers it by
going through the ``cases`` that compiled terms distinguish (``asking``, ``symbols``, ``domains``), by asking a weaker
question (``weaken``, ``certain``), or by a ``solver``, for which the theory is written out (``encode``, ``encoded``,
``calculated``, ``collected``, ``values``, ``effort``). A witness is made as small as it can be (``smallest``).

Functions of Python that are not executed are ``rigid`` fluents, and a witness must be one whatever they are
(``uniform``). ``among`` asks only about the states that can be reached (``reachable``, ``slices``), ``at_first`` about
the initial ones.
"""
