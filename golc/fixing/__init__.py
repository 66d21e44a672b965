"""Carrying out the fixes that findings have: on the texts in memory, as long as no text gets worse."""
