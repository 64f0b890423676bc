"""Holonomies round nodes of four singular curves, from the binary octahedral group alone (docs/analysis.md)."""

import itertools

import numpy as np
import octafield as of
import pytest

IDENTITY = (1.0, 0, 0, 0)


def multiplied(a, b):
    (p, u), (q, v) = (a[0], a[1:]), (b[0], b[1:])
    return np.r_[p * q - u @ v, p * v + q * u + np.cross(u, v)]


def group():
    """The 48 unit quaternions, their products and inverses by number."""
    rotations = np.asarray(of.frames.octahedral_group())
    elements = np.concatenate([rotations, -rotations])
    number = lambda q: int(np.abs(elements - q).sum(axis=1).argmin())
    product = np.array([[number(multiplied(a, b)) for b in elements] for a in elements])
    return elements, product, (product == number(IDENTITY)).argmax(axis=1), number(IDENTITY)


def classes(types, elements, product, inverse, one):
    """Classes of four quarter turns with product 1, each on a curve of its type, under braid moves and conjugation:
    (number of members, whether all turn about one axis)."""
    quarter = np.flatnonzero(np.isclose(elements[:, 0], np.sqrt(0.5)))
    axis = np.abs(elements[:, 1:]).argmax(axis=1)
    tuples = [
        t for t in itertools.product(quarter, repeat=4) if product[product[t[0], t[1]], product[t[2], t[3]]] == one
    ]
    left = {(t, kinds) for t in tuples for kinds in set(itertools.permutations(types))}
    found = []
    while left:
        stack = [left.pop()]
        members = [stack[0]]
        while stack:
            turns, kinds = stack.pop()
            reached = [(tuple(product[product[g, x], inverse[g]] for x in turns), kinds) for g in quarter]
            for i in range(3):
                a, b = turns[i], turns[i + 1]
                swapped = (b, product[product[inverse[b], a], b])
                reached.append(
                    (turns[:i] + swapped + turns[i + 2 :], kinds[:i] + (kinds[i + 1], kinds[i]) + kinds[i + 2 :])
                )
            for state in reached:
                if state in left:
                    left.remove(state)
                    stack.append(state)
                    members.append(state)
        found.append((len(members), all(len({axis[x] for x in turns}) == 1 for turns, _ in members)))
    return sorted(found)


@pytest.mark.parametrize("valence3, valence5", [(4, 0), (2, 2), (1, 3), (0, 4)])
def test_all_holonomies_of_a_node_are_alike_but_those_about_one_axis(valence3, valence5):
    assert of.volume.hex_vertex_exists(valence3, valence5)
    found = classes((3,) * valence3 + (5,) * valence5, *group())
    several = [members for members, one_axis in found if not one_axis]
    assert len(several) == 1 and several[0] >= 96
    assert len(found) > 1  # the others turn about one axis
