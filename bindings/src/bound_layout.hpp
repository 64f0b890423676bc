// A quad layout as Python has it: with the field and options that it can be made again from.
#pragma once

#include <memory>

#include "octafield/surface/motorcycle_graph.hpp"

namespace octafield::bindings {

struct BoundLayout {
    surface::ImposedField field;
    surface::LayoutCurveOptions options;
    bool cut_annuli = true;
    bool t_mesh = false;  // of motorcycle_graph
    std::shared_ptr<const surface::QuadLayout> layout;
};

inline BoundLayout bound_layout(const surface::ImposedField& field, const surface::LayoutCurveOptions& options,
                                bool cut_annuli, bool t_mesh, const Progress& progress) {
    auto made = std::make_shared<const surface::QuadLayout>(t_mesh ? motorcycle_graph(field, options, progress)
                                                                   : quad_layout(field, options, cut_annuli, progress));
    return {field, options, cut_annuli, t_mesh, std::move(made)};
}

}  // namespace octafield::bindings
