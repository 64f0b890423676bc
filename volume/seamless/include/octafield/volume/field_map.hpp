// From a frame field to a seamless map: singular curves become edges, parameters follow the axes, tets are unfolded.
#pragma once

#include <vector>

#include "octafield/progress.hpp"
#include "octafield/volume/seamless_map.hpp"

namespace octafield::volume {

struct FieldMapOptions {
    double edge_length = 0;  // of a unit of the parameters, input unit; 0: the mean edge of the tets
    int threads = 0;
};

struct FieldMap {
    SeamlessMap map;            // without walls; of tets that are parts of the field's
    std::vector<Index> parent;  // (m) tet of the field that each is part of
    Edges curves{0, 2};         // singular edges, lower vertex first, in order
    Index added_vertices = 0;
    int turns = 0;     // places where curves of the field go on with another type, which no hex mesh has
    int unzipped = 0;  // of these, how many are no more: both parts of the curve are led to the surface
    Index unknowns = 0;
    std::vector<Index> locked;   // tets that are flat in every map with these singular curves and this surface
    std::vector<Index> flipped;  // tets turned over or flat in the end
    Index flipped_at_first = 0;  // before unfolding
    int steps = 0;               // of Newton's method
    double angle_at_first = 0;   // between axes and gradients, radians: mean over axes, by volume; before unfolding
    double angle = 0;
};

// frames: (n, 4) unit quaternions w x y z at the vertices. Curves that go on with another type are unzipped (Liu,
// Bommes 2023) where there is a way to the surface or to another such place; tets near it are cut into eight for that
// if need be. Transitions are exact: parameters are whole multiples of a power of two. Boundary triangles keep the
// parameter whose axis is nearest to their normal, feature edges two, singular edges those that turn round them.
// Parameters are at first those with gradients nearest to the axes (least squares over all that is left free; Nieser,
// Reitebuch, Polthier 2011), then of least distortion without folds (Garanzha et al. 2021). Tets that stay flipped are
// told, not refused. Near linear but for sparse factorizations. The same result at any thread count. Throws
// InvalidInput ("option_out_of_range", "several_regions", frames), GeometryError (unsound mesh), SolverError
// ("singular_map", "no_translations"), Cancelled.
FieldMap field_map(const TetDomain& domain, const Quaternions& frames, const FieldMapOptions& options = {},
                   const Progress& progress = {});

}  // namespace octafield::volume
