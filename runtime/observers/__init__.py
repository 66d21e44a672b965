"""Who is told what happens: the trace on the terminal, the journal on disk."""
