#include "octafield/volume/all_hex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "block_arcs.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/cell_quality.hpp"

namespace octafield::volume {
namespace {

constexpr double fit = 0.1;  // of an edge: how far vertices leave the surface so that chords keep the volume
constexpr int proof_depth = 8;
// Of the wanted number, until one leaves no hexahedra inverted.
constexpr std::array factors{1., 1.05, 0.95, 1.1, 0.9, 1.2, 0.8, 1.4};

void require(const AllHexOptions& options) {
    const auto refuse = [](const std::string& message) { throw InvalidInput(message, "option_out_of_range"); };
    if (options.cells < 0) refuse("cells must be 0 or more");
    if (!(options.edge_length >= 0 && std::isfinite(options.edge_length))) refuse("the edge length must be 0 or more");
    if (options.cells > 0 && options.edge_length > 0)
        refuse("an edge length decides the number of cells; give one of both");
    if (options.most_nodes < 1) refuse("most_nodes must be at least 1");
    if (options.most_hexahedra < 1) refuse("most_hexahedra must be at least 1");
    if (options.sweeps < 0) refuse("sweeps must be 0 or more");
    if (!(options.good > 0 && options.good < 1)) refuse("good must lie between 0 and 1");
}

double wanted_cells(const TetDomain& domain, const AllHexOptions& options) {
    const double length =
        options.edge_length > 0 ? options.edge_length : surface::mean_edge_length(domain.surface().mesh);
    const double wanted = options.cells > 0 ? options.cells : tet_volumes(domain.mesh()).sum() / std::pow(length, 3);
    if (wanted > options.most_hexahedra)
        throw InvalidInput(
            (wanted < 1e15 ? "about " + std::to_string(std::llround(wanted)) : std::string("over 1e15")) +
                " hexahedra are asked for, and at most " + std::to_string(options.most_hexahedra) +
                " are made (most_hexahedra); ask for fewer or larger ones",
            "too_many_cells");
    return std::max(wanted, 1.);
}

// The map with the features of the domain.
SeamlessMap with_features(SeamlessMap map, const TetDomain& domain) {
    const surface::FeatureGraph& features = domain.features();
    const std::vector<Index>& vertices = domain.surface().vertex_map;
    map.features.resize(features.edges.rows(), 2);
    for (Index e = 0; e < features.edges.rows(); ++e)
        for (int k = 0; k < 2; ++k) map.features(e, k) = vertices[features.edges(e, k)];
    map.corners.clear();
    for (const Index corner : features.corners) map.corners.push_back(vertices[corner]);
    return map;
}

void note_lost_features(const SeamlessMap& map, const BlockComplex& blocks, std::vector<std::string>& notes) {
    std::set<detail::EdgeKey> held;
    for (const BlockArc& arc : blocks.arcs)
        for (std::size_t i = 0; i + 1 < arc.vertices.size(); ++i)
            held.insert(detail::edge_key(arc.vertices[i], arc.vertices[i + 1]));
    Index lost = 0;
    for (Index e = 0; e < map.features.rows(); ++e)
        lost += !held.count(detail::edge_key(map.features(e, 0), map.features(e, 1)));
    if (lost > 0)
        notes.push_back(std::to_string(lost) + " of " + std::to_string(map.features.rows()) +
                        " feature edges lie on no arc of the map: hexahedra cut across them");
}

// Whole numbers for a wanted number of hexahedra.
class NumberSearch {
public:
    NumberSearch(const BlockComplex& blocks, double volume, double wanted, const AllHexOptions& options,
                 const Progress& progress)
        : blocks_(blocks),
          wanted_(wanted),
          options_(options),
          progress_(progress),
          scale_(std::cbrt(wanted / volume)) {}

    ArcNumbers nearest_numbers() {
        try_scales();
        if (miss(nearest()) > near) try_single_arcs();
        return nearest();
    }

private:
    static constexpr int scales = 8, rounds = 3, arcs_tried = 24;
    static constexpr double near = 0.02, worth = 0.05;

    double miss(const ArcNumbers& numbers) const { return std::abs(std::log(numbers.hexahedra / wanted_)); }
    const ArcNumbers& nearest() const {
        return *std::min_element(found_.begin(), found_.end(),
                                 [&](const ArcNumbers& a, const ArcNumbers& b) { return miss(a) < miss(b); });
    }
    ArcNumbers solve(double scale, const std::vector<int>& least) {
        report_or_throw(progress_, "numbers", -1, std::nan(""));
        ArcNumbers numbers = arc_numbers(blocks_, scale, least, options_.most_nodes);
        const bool known = std::any_of(found_.begin(), found_.end(),
                                       [&](const ArcNumbers& other) { return other.numbers == numbers.numbers; });
        if (!known) found_.push_back(numbers);
        return numbers;
    }

    // Between a scale with too few hexahedra and one with too many.
    void try_scales() {
        const std::vector<int> ones(blocks_.arcs.size(), 1);
        double scale = scale_, many = std::numeric_limits<double>::infinity();
        for (int k = 0; k < scales; ++k) {
            const ArcNumbers numbers = solve(scale, ones);
            if (miss(numbers) < near) return;
            const double ratio = numbers.hexahedra / wanted_;
            if (ratio > 1) {
                many = scale;
            } else {
                few_ = scale;
                low_ = numbers.numbers;
            }
            scale = few_ > 0 && std::isfinite(many) ? std::sqrt(few_ * many)
                                                    : scale / std::cbrt(ratio) * (ratio > 1 ? 0.97 : 1.03);
        }
    }

    // Arcs of one length turn to the next number all at once; here one of them and what has to follow does.
    void try_single_arcs() {
        if (miss(nearest()) < worth || low_.empty()) return;
        for (int round = 0; round < rounds; ++round) {
            std::vector<int> next;
            double best = std::numeric_limits<double>::infinity();
            const std::size_t step = std::max<std::size_t>(1, low_.size() / arcs_tried);
            for (std::size_t a = 0; a < low_.size(); a += step) {
                std::vector<int> least = low_;
                ++least[a];
                const ArcNumbers numbers = solve(few_, least);
                if (numbers.hexahedra > wanted_ || miss(numbers) >= best) continue;
                best = miss(numbers);
                next = numbers.numbers;
            }
            if (next.empty() || miss(nearest()) < near) return;
            low_ = std::move(next);
        }
    }

    const BlockComplex& blocks_;
    double wanted_;
    const AllHexOptions& options_;
    const Progress& progress_;
    double scale_, few_ = 0;
    std::vector<int> low_;  // of the largest scale with too few hexahedra
    std::vector<ArcNumbers> found_;
};

void require_few(const ArcNumbers& numbers, const AllHexOptions& options) {
    if (numbers.hexahedra > options.most_hexahedra)
        throw InvalidInput("these blocks get " + std::to_string(numbers.hexahedra) + " hexahedra, and at most " +
                               std::to_string(options.most_hexahedra) +
                               " are made (most_hexahedra); ask for fewer or larger ones",
                           "too_many_cells");
}

void note_other_number(const ArcNumbers& numbers, double wanted, std::vector<std::string>& notes) {
    if (std::abs(numbers.hexahedra / wanted - 1) <= 0.1) return;
    notes.push_back(std::to_string(numbers.hexahedra) + " hexahedra, " + std::to_string(std::lround(wanted)) +
                    " wanted: each arc of the blocks has one at least, and few numbers fit all arcs");
}

std::vector<Index> inverted_cells(const MixedMesh& mesh) {
    const Eigen::VectorXd quality = scaled_jacobians(mesh);
    std::vector<Index> result;
    for (Index c = 0; c < quality.size(); ++c)
        if (!(quality[c] > 0)) result.push_back(c);
    return result;
}

std::vector<Index> unproven_cells(const MixedMesh& mesh, int threads) {
    const std::vector<std::uint8_t> proven = proven_positive(mesh, proof_depth, threads);
    std::vector<Index> result;
    for (std::size_t c = 0; c < proven.size(); ++c)
        if (!proven[c]) result.push_back(static_cast<Index>(c));
    return result;
}

void move_vertices(BlockHexahedra& made, const TetDomain& domain, const AllHexOptions& options) {
    VertexSupport support;
    for (const std::uint8_t kind : made.support) support.kind.push_back(static_cast<VertexSupport::Kind>(kind));
    ImproveOptions improve;
    improve.sweeps = options.sweeps;
    improve.good = options.good;
    improve.threads = options.threads;
    improve.fit_surface = true;
    improve.tolerance = fit * std::cbrt(cell_volumes(made.mesh).cwiseAbs().mean());
    made.mesh = improve_cells(std::move(made.mesh), support, domain.surface().mesh, domain.features(), improve);
}

}  // namespace

AllHexMesh all_hex(const SeamlessMap& given, const AllHexOptions& options, const Progress& progress) {
    require(options);
    report_or_throw(progress, "blocks", 0, std::nan(""));
    AllHexMesh result;
    const double volume = seamless_report(given).volume;
    const TetDomain domain = map_domain(given);
    const SeamlessMap map = with_features(given, domain);
    const BlockComplex blocks = block_complex(map);
    result.block_count = blocks.block_count();
    note_lost_features(map, blocks, result.notes);
    const double wanted = wanted_cells(domain, options);
    result.wanted = static_cast<Index>(std::lround(wanted));
    std::vector<std::vector<int>> tried;
    std::vector<Index> bad, bad_in_part;
    const auto keep = [&](BlockHexahedra& made, const ArcNumbers& numbers, Index inverted) {
        require_valid(made.mesh);
        result.numbers = numbers;
        result.inverted = inverted;
        result.mesh = std::move(made.mesh);
        result.blocks = std::move(made.blocks);
        result.support = std::move(made.support);
    };
    for (const double factor : factors) {
        const ArcNumbers numbers = NumberSearch(blocks, volume, factor * wanted, options, progress).nearest_numbers();
        if (factor == factors[0]) require_few(numbers, options);
        if (numbers.hexahedra > options.most_hexahedra) continue;
        if (std::find(tried.begin(), tried.end(), numbers.numbers) != tried.end()) continue;
        tried.push_back(numbers.numbers);
        report_or_throw(progress, "hexahedra", -1, std::nan(""));
        BlockHexahedra made = block_hexahedra(map, blocks, numbers.numbers);
        const auto inverted = static_cast<Index>(inverted_cells(made.mesh).size());
        report_or_throw(progress, "improve", -1, std::nan(""));
        if (options.sweeps > 0) move_vertices(made, domain, options);
        const std::vector<Index> left = inverted_cells(made.mesh);
        if (tried.size() == 1) bad = left;
        if (!left.empty()) continue;
        const std::vector<Index> unproven = unproven_cells(made.mesh, options.threads);
        if (bad_in_part.empty()) bad_in_part = unproven;
        if (!unproven.empty()) continue;
        keep(made, numbers, inverted);
        if (tried.size() > 1)
            result.notes.push_back(
                "nearer numbers of hexahedra leave some of them turned over in part, so that another one was taken");
        note_other_number(numbers, wanted, result.notes);
        return result;
    }
    if (bad.empty())
        throw SolverError(
            "hexahedra " + first_few(bad_in_part) +
                " stay turned over in part however their vertices move; ask for more cells, or another map",
            "inverted_cells", bad_in_part);
    throw SolverError(
        "hexahedra " + first_few(bad) +
            (options.sweeps > 0 ? " stay inverted however their vertices move; ask for more cells, or another map"
                                : " are inverted where the map puts them; allow sweeps that move vertices"),
        "inverted_cells", bad);
}

}  // namespace octafield::volume
