"""Denavit-Hartenberg tables: from and to descriptions, compared with chains, and worked out in symbols.

- `tables`: DH table ↔ description.
- `compare`: whether a table describes a chain, and where it is wrong if not.
- `written`: tables as text for other programs.
- `derive`, `lagrangian`: the symbolic parts of a worked solution; `worked` joins them with numbers.
"""
