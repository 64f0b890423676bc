#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "octafield/error.hpp"
#include "octafield/surface/atlas.hpp"

namespace octafield::surface {
namespace {

constexpr double gap = 0.02;  // between boxes, of a box's larger side

struct Box {
    Eigen::RowVector2d low = Eigen::RowVector2d::Constant(1e300), high = -low, place = {0, 0};
    double factor = 1;  // surface lengths over plane lengths, on average
    Eigen::RowVector2d size() const {
        const Eigen::RowVector2d extent = (high - low) * factor;
        return extent.array() + gap * extent.maxCoeff();
    }
};

// In rows from the highest boxes to the lowest; returns the side of the square that holds them.
double place(std::vector<Box>& boxes) {
    std::vector<Index> order(boxes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return boxes[a].size()[1] > boxes[b].size()[1]; });
    double area = 0, widest = 0;
    for (const Box& box : boxes) {
        area += box.size().prod();
        widest = std::max(widest, box.size()[0]);
    }
    const double width = std::max(widest, 1.1 * std::sqrt(area));
    double x = 0, y = 0, row = 0, right = 0;
    for (const Index i : order) {
        const Eigen::RowVector2d size = boxes[i].size();
        if (x + size[0] > width * (1 + 1e-12)) {
            y += row;
            x = row = 0;
        }
        boxes[i].place << x, y;
        x += size[0];
        row = std::max(row, size[1]);
        right = std::max(right, x);
    }
    return std::max(right, y + row);
}

void require_charts(const Atlas& atlas) {
    const auto below = [](const auto& ids, Eigen::Index count) {
        return std::all_of(ids.begin(), ids.end(), [&](Index i) { return i >= 0 && i < count; });
    };
    const auto corners = atlas.uv_triangles.reshaped();
    if (atlas.uv_triangles.rows() != static_cast<Eigen::Index>(atlas.charts.size()) ||
        !below(atlas.charts, static_cast<Eigen::Index>(atlas.chart_list.size())) || !below(corners, atlas.uv.rows()) ||
        !atlas.uv.allFinite())
        throw InvalidInput("the atlas' arrays do not fit together", "bad_shape");
}

}  // namespace

PlanePoints packed_uv(const Atlas& atlas, double* scale) {
    require_charts(atlas);
    std::vector<Box> boxes(atlas.chart_list.size());
    std::vector<Index> chart_of(atlas.uv.rows(), 0);
    for (Index t = 0; t < atlas.uv_triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) chart_of[atlas.uv_triangles(t, k)] = atlas.charts[t];
    for (std::size_t v = 0; v < chart_of.size(); ++v) {
        Box& box = boxes[chart_of[v]];
        box.low = box.low.cwiseMin(atlas.uv.row(static_cast<Index>(v)));
        box.high = box.high.cwiseMax(atlas.uv.row(static_cast<Index>(v)));
    }
    for (std::size_t c = 0; c < boxes.size(); ++c)
        boxes[c].factor = std::sqrt(atlas.chart_list[c].area / std::numbers::pi);
    const double side = place(boxes);
    if (scale) *scale = 1 / side;
    PlanePoints result(atlas.uv.rows(), 2);
    for (std::size_t v = 0; v < chart_of.size(); ++v) {
        const Box& box = boxes[chart_of[v]];
        const Eigen::RowVector2d margin = Eigen::RowVector2d::Constant(gap / 2 * (box.high - box.low).maxCoeff());
        result.row(static_cast<Index>(v)) =
            (box.place + (atlas.uv.row(static_cast<Index>(v)) - box.low + margin) * box.factor) / side;
    }
    return result;
}

}  // namespace octafield::surface
