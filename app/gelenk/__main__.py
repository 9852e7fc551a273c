"""`python -m gelenk`: the same as the command `gelenk`."""

from gelenk.cli.main import main

main()
