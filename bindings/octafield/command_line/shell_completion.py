"""What the shell is offered for the values of options."""

from collections.abc import Callable, Iterable


def words(values: Iterable[str]) -> Callable[[str], list[str]]:
    """For an option that takes one of `values`."""
    known = tuple(values)
    return lambda incomplete: [word for word in known if word.startswith(incomplete)]


def lists(values: Iterable[str], *alone: str) -> Callable[[str], list[str]]:
    """For an option that takes several, with commas between; `alone`: words that stand by themselves."""
    known = tuple(values)

    def offer(incomplete: str) -> list[str]:
        before, comma, last = incomplete.rpartition(",")
        taken = before.split(",")
        offered = [before + comma + word for word in known if word.startswith(last) and word not in taken]
        return offered + [word for word in alone if not comma and word.startswith(incomplete)]

    return offer
