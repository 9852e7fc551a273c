"""Links, pairs and Grübler's count.

- `plane`: chains, linkages. `space`: the table of pairs, and an exam about a platform on legs.
"""
