"""The files of `deploy/`, with the programs that they are for where those are on this machine."""
