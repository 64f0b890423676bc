"""What Gmsh's .msh files of version 4.1 tell of CAD entities and of their partitions. Layout: Gmsh reference manual,
MSH file format."""

from .sections import Section

# By dimension and tag: the first physical group (0: none) and the tag of the CAD entity; None: the entity lies between
# partitions alone.
Entities = dict[tuple[int, int], tuple[int, int | None]]


def entities(section: Section) -> Entities:
    found: Entities = {}
    for dimension, count in enumerate([section.size("u8", "entities") for _ in range(4)]):
        for _ in range(count):
            tag = int(section.take("i4", 1)[0])
            found[dimension, tag] = _rest(section, dimension), tag
    return found


def partitioned(section: Section, told: Entities) -> Entities:
    """Entities of partitions: they stand for their parent where it has their dimension, and bound partitions where it
    has another."""
    section.size("u8", "partitions")
    section.take("i4", 2 * section.size("u8", "ghost entities"))
    found: Entities = {}
    for dimension, count in enumerate([section.size("u8", "entities") for _ in range(4)]):
        for _ in range(count):
            tag, of_dimension, parent = section.take("i4", 3).tolist()
            section.take("i4", section.size("u8", "partitions"))
            group = _rest(section, dimension)
            found[dimension, tag] = (
                told.get((dimension, parent), (0, parent))[0] or group,
                parent if of_dimension == dimension else None,
            )
    return found


def _rest(section: Section, dimension: int) -> int:
    """Box, groups and boundary; the first group or 0."""
    section.take("f8", 6 if dimension else 3)
    groups = section.take("i4", section.size("u8", "groups"))
    if dimension:
        section.take("i4", section.size("u8", "boundaries"))
    return int(groups[0]) if len(groups) else 0
