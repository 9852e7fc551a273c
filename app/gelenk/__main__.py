"""`python -m gelenk`: the same as the command `gelenk`."""

from gelenk.cli.start import main

main()
