"""A mesh that is there already cannot follow other options of the mesh: they are refused by name."""

import octafield as of
import pytest
from octafield.domain.generators import generate


@pytest.mark.parametrize(
    "name, value", [("edge_length", 0.2), ("features", "none"), ("remesh", False), ("split", True)]
)
def test_run_refuses_options_it_would_ignore(name, value):
    problem = of.prepare_field(of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.4)))
    with pytest.raises(of.InvalidInput, match=f"{name}={value!r}") as caught:
        of.run_field(problem, of.FieldOptions(**{name: value}))
    assert caught.value.kind == "ignored_options"


def test_the_options_of_the_preparation_and_defaults_are_accepted():
    problem = of.prepare_field(of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.4)))
    for options in (of.FieldOptions(edge_length=0.4), of.FieldOptions()):
        assert of.run_field(problem, options).record["singular_edges"] == 0
