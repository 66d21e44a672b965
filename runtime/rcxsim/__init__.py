"""Simulated bricks behind one line: one that a theory drives, and a machine that executes what nqc compiles."""
