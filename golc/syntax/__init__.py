"""The text of a golc file and its abstract syntax tree, each from the other.

From text to tree (``parse``): ``text`` reads the file, ``layout`` makes tokens of line ends and indentation, ``parser``
is the LALR parser of the grammar, ``build`` makes the ``tree`` of what it parses, one function a rule (``rules``,
``expression_rules``, ``messages``).

A text that does not follow the grammar is read once more, declaration by declaration (``recovery``): where the parser
stops is a ``failure``, and ``hints`` say what is wrong there. What they put right is read so; what nobody can put right
is passed over, so that one mistake does not hide the next. ``words``, ``terminals`` and ``spelling`` are what both know
of the words of the language.

From tree to text: ``unparse`` prints a tree with the ``notation`` of its expressions. ``format`` keeps the words of a
text, with its ``comments``, and puts in order what stands between them (``spacing``, ``breaks``, ``parentheses``).

The other form of the language, Python, is read and printed by ``golc.embed``; what a name is called there is said here
(``python_names``), for messages speak of it, too.
"""
