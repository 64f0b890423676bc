"""python -m octafield: the command line."""

from .command_line.fields import main

main()
