"""The public Python API: a theory, its states, and what can be asked of them. `golc` itself offers the names."""
