"""python -m octafield: the command line."""

from .cli import main

main()
