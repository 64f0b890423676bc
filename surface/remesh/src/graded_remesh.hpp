// Remeshing by a size field that is lowered where the result would not be the input's surface.
#pragma once

#include <functional>
#include <optional>

#include "octafield/surface/size_field.hpp"
#include "remesh_judge.hpp"

namespace octafield::surface {

struct GradedResult {
    std::optional<Attempt> best;  // none where no attempt was sound
    SizeField field;              // as first planned
    std::string range;            // of the lengths of the best
    bool uniform = false;         // the field is: nothing was tried
};

// alive: called now and then with a fraction; may throw.
GradedResult graded_remesh(const TriangleMesh& mesh, const FeatureGraph& features, RemeshJudge& judge, double max_cells,
                           int rounds, const std::function<void(double)>& alive);

}  // namespace octafield::surface
