"""Parts of the check whether a DH table describes a chain, and of the search for its mistakes if not.

`screws`: joint axes, and least squares on them · `alignment`: starting values · `placement`: base, tool, zeros and
senses, with errors through Pinocchio · `numbers`: single wrong numbers · `repairs`: tables with mistakes corrected ·
`invariants`: fast filter of tables · `trials`: tests of repaired tables · `several`: wrong numbers with another
mistake · `mistakes`: the search through common mistakes · `words`: their names.
"""
