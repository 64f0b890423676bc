#include "octafield/volume/periodic_map.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <string>

#include "axis_numbers.hpp"
#include "edge_fans.hpp"
#include "element_assembly.hpp"
#include "integer_constraints.hpp"
#include "octafield/parallel.hpp"
#include "phase_system.hpp"
#include "phase_unknowns.hpp"
#include "require_frames.hpp"
#include "tet_corners.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;
using std::numbers::pi;

constexpr std::int64_t most_cells = 15000;  // along an edge of a tet: coordinates stay in 32 bits

// What an edge asks of its phases: lengths along the axes of the fan's first tet, in cells.
struct EdgeLengths {
    double weight = 0;
    Vector3 mean = Vector3::Zero();
    std::array<std::complex<double>, 3> turn{};  // sum of weights times exp(2 pi i length)
};

class MapBuilder {
public:
    MapBuilder(const TetDomain& domain, const Quaternions& of_tets, const Points& lengths,
               const PeriodicMapOptions& options)
        : domain_(domain),
          mesh_(domain.mesh()),
          frames_(of_tets),
          lengths_(lengths),
          options_(options),
          matching_(triangle_matchings(domain.triangles(), of_tets, options.threads)),
          tets_at_edges_(tets_at_edges(mesh_, domain.triangles(), options.threads)),
          constraints_(domain, of_tets, options.hold_angle) {}

    PeriodicMap run(const Progress& progress) {
        PeriodicMap result;
        result.faces = face_matchings(domain_, frames_, options_.threads);
        PhaseUnknowns unknowns(mesh_, result.faces);
        const std::vector<std::int32_t> phase = phases(unknowns, progress);
        set_jumps(unknowns, phase);
        set_coordinates(unknowns, phase, result);
        join(result);
        result.frames = frames_;
        return result;
    }

private:
    EdgeLengths lengths_of(const EdgeFan& fan) const {
        EdgeLengths result;
        const Vector3 edge = (mesh_.vertices.row(fan.b) - mesh_.vertices.row(fan.a)).transpose();
        for (const FanTet& at : fan.tets) {
            const Gradients g = hat_gradients(tet_edges(mesh_, at.tet));
            const int a = corner_of(mesh_, at.tet, fan.a), b = corner_of(mesh_, at.tet, fan.b);
            const double volume = tet_edges(mesh_, at.tet).determinant() / 6;
            // The cotangent's weight, kept positive.
            const double weight = std::max(-volume * g.row(a).dot(g.row(b)), 0.02 * std::cbrt(volume));
            const Vector3 in_frame = frames::from_wxyz(frames_.row(at.tet)).conjugate() * edge;
            result.weight += weight;
            for (int i = 0; i < 3; ++i) {
                const int axis = at.axes[i] % 3;
                const double length = (at.axes[i] < 3 ? 1 : -1) * in_frame[i] / lengths_(at.tet, i);
                result.mean[axis] += weight * length;
                result.turn[axis] += std::polar(weight, 2 * pi * length);
            }
        }
        result.mean /= result.weight;
        return result;
    }

    // Phases of the unknowns, in units of the map, in [0, periodic_unit).
    std::vector<std::int32_t> phases(PhaseUnknowns& unknowns, const Progress& progress) const {
        std::vector<PhaseSystem::Coupling> couplings;
        const TriangleTable& table = domain_.triangles();
        for_each_fan(tets_at_edges_, table, matching_, [&](const EdgeFan& fan) {
            const Index tet = fan.tets[0].tet;
            const int a = corner_of(mesh_, tet, fan.a), b = corner_of(mesh_, tet, fan.b);
            const int fixed = constraints_.fixed_axes(fan);
            const EdgeLengths wanted = lengths_of(fan);
            for (int i = 0; i < 3; ++i) {
                const SignedUnknown from = unknowns.at(tet, a, i), to = unknowns.at(tet, b, i);
                if (fixed >> i & 1) unknowns.hold(from.unknown), unknowns.hold(to.unknown);
                if (constraints_.corner(fan.a)) unknowns.hold(from.unknown);
                if (constraints_.corner(fan.b)) unknowns.hold(to.unknown);
                if (!fan.returns(i)) continue;
                // to = turn from; both conjugated where `from` has the opposite sign.
                const std::complex<double> turn = wanted.turn[i] / wanted.weight;
                const bool conjugate = from.sign != to.sign;
                const bool backwards = to.sign < 0;
                couplings.push_back(
                    {from.unknown, to.unknown, conjugate, wanted.weight, backwards ? std::conj(turn) : turn});
            }
        });
        std::vector<std::uint8_t> held(unknowns.count());
        for (Index k = 0; k < unknowns.count(); ++k) held[k] = unknowns.held(k);
        PhaseSystem system(unknowns.count(), held, couplings);
        if (!system.arbitrary().empty()) {
            for (const Index k : system.arbitrary()) held[k] = 1;
            system = PhaseSystem(unknowns.count(), held, couplings);
        }
        couplings = {};
        return rounded(minimised(system, progress));
    }

    Phases minimised(const PhaseSystem& system, const Progress& progress) const {
        Phases z = system.start();
        report_or_throw(progress, "periodic map", 0, 0);
        system.diffuse(0, 1e-4, z, options_.threads);
        system.normalize(z);
        for (int round = 0; round < options_.rounds; ++round) {
            const double shift = 0.01 * std::pow(100.0, static_cast<double>(round) / std::max(options_.rounds - 1, 1));
            system.diffuse(shift, 1e-3, z, options_.threads);
            system.normalize(z);
            report_or_throw(progress, "periodic map", (round + 1.0) / options_.rounds, 0);
        }
        return z;
    }

    static std::vector<std::int32_t> rounded(const Phases& z) {
        std::vector<std::int32_t> phase(z.size());
        for (std::size_t k = 0; k < z.size(); ++k) {
            const double turns = std::arg(z[k]) / (2 * pi);
            phase[k] =
                static_cast<std::int32_t>(std::lround((turns - std::floor(turns)) * periodic_unit)) % periodic_unit;
        }
        return phase;
    }

    static std::int32_t phase_at(const PhaseUnknowns& unknowns, const std::vector<std::int32_t>& phase, Index tet,
                                 int corner, int axis) {
        const SignedUnknown u = unknowns.at(tet, corner, axis);
        return u.sign * phase[u.unknown];
    }

    // Integers to be added to the difference of the phases along each edge of each tet.
    void set_jumps(const PhaseUnknowns& unknowns, const std::vector<std::int32_t>& phase) {
        jumps_.setZero(mesh_.tets.rows(), 18);
        for_each_fan(tets_at_edges_, domain_.triangles(), matching_, [&](const EdgeFan& fan) {
            const Index first = fan.tets[0].tet;
            const int a = corner_of(mesh_, first, fan.a), b = corner_of(mesh_, first, fan.b);
            const int fixed = constraints_.fixed_axes(fan);
            const EdgeLengths wanted = lengths_of(fan);
            std::array<std::int64_t, 3> jump{};
            for (int i = 0; i < 3; ++i) {
                if (fixed >> i & 1) continue;
                const double from = phase_at(unknowns, phase, first, a, i), to = phase_at(unknowns, phase, first, b, i);
                // Round a singular curve the axes that it exchanges do not change along it.
                if (!fan.returns(i) && from == 0 && to == 0) continue;
                const double nearest = wanted.mean[i] - (to - from) / periodic_unit;
                if (!(std::abs(nearest) <= most_cells))
                    throw InvalidInput("the edge of the vertices " + std::to_string(fan.a) + " and " +
                                           std::to_string(fan.b) + " is more than " + std::to_string(most_cells) +
                                           " cells long; give a larger edge length",
                                       "edge_length", {fan.a, fan.b});
                jump[i] = std::llround(nearest);
            }
            for (const FanTet& at : fan.tets) {
                const int from = corner_of(mesh_, at.tet, fan.a), to = corner_of(mesh_, at.tet, fan.b);
                const int edge = edge_number(from, to), way = from < to ? 1 : -1;
                for (int i = 0; i < 3; ++i)
                    jumps_(at.tet, 3 * edge + i) =
                        static_cast<std::int16_t>(way * (at.axes[i] < 3 ? 1 : -1) * jump[at.axes[i] % 3]);
            }
        });
    }

    // Of the edges 01, 02, 03, 12, 13, 23.
    static int edge_number(int a, int b) {
        if (a > b) std::swap(a, b);
        return a == 0 ? b - 1 : a + b;
    }

    void set_coordinates(const PhaseUnknowns& unknowns, const std::vector<std::int32_t>& phase, PeriodicMap& result) {
        const Eigen::Index m = mesh_.tets.rows();
        result.coordinates.resize(m, 12);
        result.usable.assign(m, 0);
        std::vector<std::uint8_t> sums(m, 0);
        parallel_for(m, options_.threads, [&](std::int64_t t) {
            const Index tet = static_cast<Index>(t);
            bool consistent = true;
            for (int i = 0; i < 3; ++i) {
                const auto jump = [&](int c, int d) { return int(jumps_(t, 3 * edge_number(c, d) + i)); };
                for (int c = 0; c < 4; ++c)
                    result.coordinates(t, 3 * c + i) =
                        phase_at(unknowns, phase, tet, c, i) + (c ? jump(0, c) * periodic_unit : 0);
                for (int c = 1; c < 4; ++c)
                    for (int d = c + 1; d < 4; ++d) consistent &= jump(c, d) == jump(0, d) - jump(0, c);
            }
            sums[t] = consistent;
            result.usable[t] = consistent && volume_of(result.coordinates, t) > 0;
        });
        for (Eigen::Index t = 0; t < m; ++t) {
            result.inconsistent += !sums[t];
            result.turned_over += sums[t] && !result.usable[t];
        }
    }

    static double volume_of(const Rows<std::int32_t, 12>& coordinates, Eigen::Index t) {
        Matrix3 edges;
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 3; ++i) edges(i, c) = double(coordinates(t, 3 * (c + 1) + i)) - coordinates(t, i);
        return edges.determinant() / (double(periodic_unit) * periodic_unit * periodic_unit) - 1e-9;
    }

    void join(PeriodicMap& result) const {
        const Eigen::Index count = result.faces.tets.rows();
        result.translation.setZero(count, 3);
        result.joined.assign(count, 0);
        parallel_for(count, options_.threads, [&](std::int64_t f) {
            const Index one = result.faces.tets(f, 0), other = result.faces.tets(f, 1);
            if (!result.usable[one] || !result.usable[other]) return;
            bool same = true;
            for (int k = 0; k < 3; ++k) {
                const int c = corner_of(mesh_, one, result.faces.triangles(f, k)),
                          d = corner_of(mesh_, other, result.faces.triangles(f, k));
                for (int i = 0; i < 3; ++i) {
                    const int axis = turned_axis(result.faces.matching[f], i);
                    const std::int32_t here = (axis < 3 ? 1 : -1) * result.coordinates(one, 3 * c + axis % 3);
                    const std::int32_t shift = result.coordinates(other, 3 * d + i) - here;
                    if (k == 0) result.translation(f, i) = shift / periodic_unit;
                    same &= shift % periodic_unit == 0 && shift / periodic_unit == result.translation(f, i);
                }
            }
            result.joined[f] = same;
        });
    }

    const TetDomain& domain_;
    const TetMesh& mesh_;
    const Quaternions& frames_;
    const Points& lengths_;
    const PeriodicMapOptions& options_;
    std::vector<std::uint8_t> matching_;
    std::vector<TetAtEdge> tets_at_edges_;
    IntegerConstraints constraints_;
    Rows<std::int16_t, 18> jumps_;
};

void require_lengths(const Points& lengths, Eigen::Index tets) {
    if (lengths.rows() != tets)
        throw InvalidInput("lengths has " + std::to_string(lengths.rows()) + " rows; give three lengths per tet, " +
                               std::to_string(tets) + " rows",
                           "wrong_size");
    std::vector<Index> bad;
    for (Eigen::Index t = 0; t < tets; ++t)
        if (!(lengths.row(t).minCoeff() > 0) || !lengths.row(t).allFinite()) bad.push_back(static_cast<Index>(t));
    if (!bad.empty())
        throw InvalidInput("lengths of cells in tets " + first_few(bad) + " are not above 0", "edge_length", bad);
}

}  // namespace

PeriodicMap periodic_map(const TetDomain& domain, const Quaternions& of_tets, const Points& lengths,
                         const PeriodicMapOptions& options, const Progress& progress) {
    require_frames(of_tets, domain.tet_count());
    require_lengths(lengths, domain.tet_count());
    if (!(options.hold_angle >= 0 && options.hold_angle <= pi / 2))
        throw InvalidInput("hold_angle must be from 0 to pi / 2", "hold_angle");
    if (options.rounds < 0) throw InvalidInput("rounds must not be negative", "rounds");
    return MapBuilder(domain, of_tets, lengths, options).run(progress);
}

}  // namespace octafield::volume
