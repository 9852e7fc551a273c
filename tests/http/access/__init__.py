"""Who may come in, what every answer carries, and what is kept of it."""
