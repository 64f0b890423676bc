# %% [markdown]
# # Test an idea in an afternoon
#
# A scheme made in Python, against sh4 and su2 on three meshes. The page *Test an idea in an afternoon* of the
# documentation explains the parts; `python scripts/docs/notebook.py docs/notebooks/own_scheme.py` makes this notebook.

# %%
import matplotlib.pyplot as plt
import numpy as np
import octafield
from octafield.domain.generators import generate
from octafield.laws import EmbeddingLaws
from octafield.volume import EmbeddingScheme, scheme_energy

# %% [markdown]
# ## The idea
#
# A frame is six bumps on the sphere, one round each end of its axes; a hundred directions look at them. How sharp the
# bumps are decides how far apart frames feel each other.

# %%
turn, height = np.pi * (3 - 5**0.5) * np.arange(100), (np.arange(100) + 0.5) / 100
radius = np.sqrt(1 - height**2)
directions = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height])


def bumps(frames):
    cosines = np.einsum("di,kia->kda", directions, octafield.frames.rotation_matrices(frames))
    return np.exp(4 * (cosines**2 - 1)).sum(axis=2) / 10


scheme = EmbeddingScheme("bumps", bumps)
scheme

# %% [markdown]
# ## Its laws
#
# What every embedding of frames obeys, as tests; here without pytest.

# %%
laws = type("Laws", (EmbeddingLaws,), {"scheme": scheme})()
for name in sorted(dir(laws)):
    if name.startswith("test_"):
        getattr(laws, name)()
        print("holds:", name.removeprefix("test_").replace("_", " "))

# %% [markdown]
# ## Three meshes
#
# Each mesh and its cross field are prepared once; every scheme begins with the same rounds in sh4 and ends in its own
# minimum. Energies compare on one mesh only: `E` is that of sh4, `bumps` what the new scheme minimises.

# %%
problems = {
    name: octafield.prepare_field(octafield.prepare_mesh(generate(name), octafield.MeshOptions(edge_length=length)))
    for name, length in (("ball", 0.25), ("cylinder", 0.2), ("torus", 0.2))
}
print(f"{'mesh':10}{'scheme':8}{'tets':>7}{'E':>11}{'bumps':>10}{'edges':>7}{'length':>9}{'steps':>7}")
fields = {}
for name, problem in problems.items():
    for which in ("sh4", "su2", scheme):
        result = octafield.run_field(problem, octafield.FieldOptions(representation=which))
        record = result.record
        fields[name, record["representation"]] = result
        energy = scheme_energy(scheme, result.tets, result.frames)
        print(
            f"{name:10}{record['representation']:8}{record['tets']:7}{record['energy']:11.3f}{energy:10.3f}"
            f"{record['singular_edges']:7}{record['singular_length']:9.3f}{record['iterations']:7}"
        )

# %% [markdown]
# ## How far apart are the fields?
#
# Angles between the frames of two schemes on the same mesh, in degrees: median, and largest.

# %%
for name in problems:
    for other in ("su2", "bumps"):
        angles = np.degrees(octafield.frames.distance(fields[name, "sh4"].frames, fields[name, other].frames))
        print(f"{name:10}sh4 and {other:8}{np.median(angles):8.3f}{angles.max():8.2f}")

# %% [markdown]
# ## Look at it
#
# Singular curves on the torus, by the three schemes.

# %%
figure, axes = plt.subplots(1, 3, figsize=(9, 3.2))
for axis, which in zip(axes, ("sh4", "su2", "bumps"), strict=True):
    axis.imshow(fields["torus", which].scene().screenshot(return_img=True, window_size=(400, 400)))
    axis.set_title(which)
    axis.axis("off")
figure
