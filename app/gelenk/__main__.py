"""`python -m gelenk`: the same as `gelenk`."""

from gelenk.cli.main import main

main()
