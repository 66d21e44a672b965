"""The online loop: what is taken in, decided and committed to, and how it ends."""
