// A quad layout as Python has it: with the field and options that it can be made again from.
#pragma once

#include <memory>

#include "octafield/surface/quad_layout.hpp"

namespace octafield::bindings {

struct BoundLayout {
    surface::ImposedField field;
    surface::LayoutCurveOptions options;
    bool cut_annuli = true;
    std::shared_ptr<const surface::QuadLayout> layout;
};

inline BoundLayout bound_layout(const surface::ImposedField& field, const surface::LayoutCurveOptions& options,
                                bool cut_annuli, const Progress& progress) {
    auto made = std::make_shared<const surface::QuadLayout>(quad_layout(field, options, cut_annuli, progress));
    return {field, options, cut_annuli, std::move(made)};
}

}  // namespace octafield::bindings
