"""Findings for other programs (SARIF, GitHub), and which of them are wanted (selection, ignore comments)."""
