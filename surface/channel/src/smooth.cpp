#include "smooth.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double diagonal = 0.7071067811865476;
const std::array<Vector2, 8> ways{
    Vector2(1, 0),  Vector2(diagonal, diagonal),   Vector2(0, 1),  Vector2(-diagonal, diagonal),
    Vector2(-1, 0), Vector2(-diagonal, -diagonal), Vector2(0, -1), Vector2(diagonal, -diagonal)};

class Mover {
public:
    explicit Mover(PlaneQuads& quads) : quads_(quads) {}

    // Whether it moved.
    bool operator()(Index v) {
        cost_ = quads_.cost_round(v);
        Vector2 mean(0, 0);
        int count = 0;
        for (const Index q : quads_.quads_round(v))
            for (int k = 0; k < 4; ++k)
                if (quads_.quad(q)[k] == v) {
                    mean += quads_.point(quads_.quad(q)[(k + 1) % 4]);
                    ++count;
                }
        mean /= count;
        double length = 0;
        for (const Index q : quads_.quads_round(v))
            for (int k = 0; k < 4; ++k)
                if (quads_.quad(q)[k] == v)
                    length += (quads_.point(quads_.quad(q)[(k + 1) % 4]) - quads_.point(v)).norm() / count;
        bool moved = try_place(v, mean);
        for (const double part : {0.2, 0.05, 0.0125})
            for (const Vector2& way : ways)
                if (try_place(v, quads_.point(v) + part * length * way)) {
                    moved = true;
                    break;
                }
        return moved;
    }

private:
    PlaneQuads& quads_;
    double cost_ = 0;

    bool try_place(Index v, const Vector2& to) {
        const Vector2 before = quads_.point(v);
        quads_.move(v, to);
        const double cost = quads_.cost_round(v);
        if (cost < cost_ - 1e-4 * std::min(cost_, 1.)) {
            cost_ = cost;
            return true;
        }
        quads_.move(v, before);
        return false;
    }
};

}  // namespace

std::vector<Index> smooth(PlaneQuads& quads, int sweeps) {
    std::vector<Index> movable;
    for (Index v = 0; v < quads.vertex_count(); ++v) {
        bool at_channel = false;
        for (const Index q : quads.quads_round(v)) at_channel = at_channel || !quads.kept(q);
        if (quads.hold(v) != Hold::fixed && at_channel) movable.push_back(v);
    }
    Mover move(quads);
    std::vector<char> ever(quads.vertex_count(), false);
    for (int sweep = 0; sweep < sweeps && !movable.empty(); ++sweep) {
        std::vector<char> near(quads.vertex_count(), false);
        bool any = false;
        for (const Index v : movable)
            if (move(v)) {
                any = true;
                ever[v] = true;
                for (const Index q : quads.quads_round(v))
                    for (const Index w : quads.quad(q)) near[w] = true;
            }
        if (!any) break;
        std::erase_if(movable, [&](Index v) { return !near[v]; });
    }
    std::vector<Index> moved;
    for (Index v = 0; v < quads.vertex_count(); ++v)
        if (ever[v]) moved.push_back(v);
    return moved;
}

}  // namespace octafield::surface::detail
