#include "octafield/surface/quad_layout.hpp"

#include <cmath>

#include "layout_assembly.hpp"
#include "layout_input.hpp"

namespace octafield::surface {
namespace {

QuadLayout layout_with(const ImposedField& given, const LayoutCurveOptions& options, const Progress& progress) {
    QuadLayout layout;
    layout.curves = layout_curves(given, options, progress);
    layout.domain = layout.curves.domain;
    report_or_throw(progress, "cut", 0.9, NAN);
    const detail::LayoutInput input(given, options);
    detail::assemble(layout, input.points,
                     std::make_shared<detail::LayoutPieces>(
                         detail::layout_pieces(input.field, input.local, input.points, layout.curves.curves)));
    detail::add_chords(layout);
    return layout;
}

}  // namespace

QuadLayout quad_layout(const ImposedField& field, const LayoutCurveOptions& options, bool cut_annuli,
                       const Progress& progress) {
    LayoutCurveOptions with_cuts = options;
    while (true) {
        QuadLayout layout = layout_with(field, with_cuts, progress);
        const std::size_t before = with_cuts.cut_vertices.size();
        for (const LayoutPatch& patch : layout.patches) {
            const Index cut = cut_annuli ? detail::boundary_cut(layout, patch) : -1;
            if (cut >= 0) with_cuts.cut_vertices.push_back(cut);
        }
        if (with_cuts.cut_vertices.size() == before) return layout;
    }
}

}  // namespace octafield::surface
