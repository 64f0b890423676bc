#include "octafield/frames/registry.hpp"

#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/su2_metric.hpp"

namespace octafield::frames {
namespace {

template <Representation R>
double chordal(const Quaternion& p, const Quaternion& q) {
    return (R::embed(p) - R::embed(q)).norm();
}

double su2_geodesic(const Quaternion& p, const Quaternion& q) {
    return su2_metric::distance(Su2::complex(Su2::embed(p)), Su2::complex(Su2::embed(q)));
}

std::vector<Metric> make_metrics() {
    std::vector<Metric> list = {{"geodesic", "angle of the smallest rotation between the frames", distance, 1}};
    Representations::for_each([&]<Representation R>() {
        double speed = 0;
        if constexpr (Equivariant<R>) speed = R::speed;
        list.push_back({R::name, "Euclidean distance of the embeddings", chordal<R>, speed});
    });
    list.push_back({"su2_end", "su2, pulled-back metric at the first frame", su2_metric::pulled_back_at_end, 1});
    list.push_back({"su2_symmetric", "su2, root mean square of the pulled-back metrics at both frames",
                    su2_metric::pulled_back_symmetric, 1});
    list.push_back({"su2_midpoint", "su2, pulled-back metric half-way", su2_metric::pulled_back_midpoint, 1});
    list.push_back({"su2_geodesic", "su2, geodesic on the model surface through the inverse map", su2_geodesic, 1});
    return list;
}

}  // namespace

void throw_unknown_name(std::string_view what, std::string_view name, const std::vector<std::string>& known) {
    std::string text;
    for (const std::string& each : known) text += (text.empty() ? "" : ", ") + each;
    throw InvalidInput(std::string(what) + " '" + std::string(name) + "' is not one of: " + text,
                       "unknown_option_value");
}

const std::vector<Metric>& metrics() {
    static const std::vector<Metric> list = make_metrics();
    return list;
}

const Metric& metric(std::string_view name) {
    std::vector<std::string> known;
    for (const Metric& each : metrics()) {
        if (each.name == name) return each;
        known.emplace_back(each.name);
    }
    throw_unknown_name("metric", name, known);
}

}  // namespace octafield::frames
