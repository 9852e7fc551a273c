"""Does a DH table describe a chain, and if not, what is wrong with it.

`screws` chains by their axes, and least squares on them · `alignment` which axis goes where, to start from ·
`placement` base, tool, zeros and senses, with the errors that Pinocchio measures · `rows` numbers that would have to
be others · `mistakes` what people get wrong, tried one after the other · `words` their names.
"""
