"""Energies of the user's own, by which a comparison judges the fields of all methods."""

import math
from collections.abc import Callable, Sequence

from .. import _core
from ..errors import InvalidInput
from ..fields.analysed import AnalysedField
from ..schemes import OwnScheme, is_in_file, loaded

# A scheme: what it minimises. Else a number of a field, small where it is good; its name is the function's.
Energy = OwnScheme | str | Callable[[AnalysedField], float]


def named_energies(energies: Sequence[Energy]) -> dict[str, Energy]:
    """FILE.py:NAME as what it names. Raises IoError, InvalidInput."""
    found: dict[str, Energy] = {}
    for given in energies:
        energy = loaded(given) if isinstance(given, str) and is_in_file(given) else given
        name = energy.name if isinstance(energy, OwnScheme) else getattr(energy, "__name__", "")
        if isinstance(energy, str) or not (isinstance(energy, OwnScheme) or callable(energy)) or not name:
            raise InvalidInput(
                f"{given!r} is no energy; give an EmbeddingScheme, an EdgeScheme, a function of a result with a name,"
                " or FILE.py:NAME of one",
                "bad_energy",
            )
        if name in found:
            raise InvalidInput(f"two energies are called {name!r}; rename one", "repeated_value")
        found[name] = energy
    return found


def energies_of(result: AnalysedField, energies: dict[str, Energy], threads: int) -> dict[str, float]:
    """Of one field, by name. Raises InvalidInput where one is no finite number, and what the functions raise."""
    return {name: _energy_of(result, name, energy, threads) for name, energy in energies.items()}


def _energy_of(result: AnalysedField, name: str, energy: Energy, threads: int) -> float:
    if isinstance(energy, OwnScheme):
        if result.tet_frames is not None:
            return _core.scheme_energy(energy, _core.tet_sampling(result.tets), result.tet_frames, threads=threads)
        return _core.scheme_energy(energy, result.tets, result.frames, threads=threads)
    assert callable(energy)
    try:
        value = float(energy(result))
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"energy {name!r} gives no number: {error}", "bad_energy") from error
    if not math.isfinite(value):
        raise InvalidInput(f"energy {name!r} of {result!r} is {value}; it must be finite", "bad_energy")
    return value
