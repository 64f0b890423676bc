// What holds a frame: each kind of constraint is a type, the set of frames that it allows as a manifold to move on and
// as a set of sh4 vectors to project to. Solvers, checks and Python walk ConstraintKinds at the end of this page: a new
// kind is a type here and its place in that list (docs/extend.md).
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

#include "octafield/frames/quaternion.hpp"
#include "octafield/frames/sh4.hpp"

namespace octafield::volume {

// Place of a kind in ConstraintKinds: what arrays and files hold.
enum class VertexConstraint : std::uint8_t { free = 0, axis = 1, fixed = 2 };

// A site's rows of BoundaryConstraints.
struct SiteConstraint {
    frames::Vector3 axis;   // unit where the kind takes_axis, else without meaning
    frames::Vector4 frame;  // unit quaternion w x y z; a mere start unless the kind takes_frame
};

// Laws (tests/volume/constraint_kind_laws.hpp), M the frames that the kind allows at a site:
// - name, meaning: its word in Python and files; what the user reads of it, in one clause;
// - unknowns: the dimension of M. 0: one frame. 3: all frames. 1 or 2: a PartialConstraintKind;
// - takes_axis, takes_frame: which rows of SiteConstraint it reads;
// - moved(q): a frame of M near q, and q itself on M;
// - held_lengths, length_columns(q): of odeco_lengths (smooth.hpp): how many of the axes' lengths are held; for each
//   axis of q in M, the column of BoundaryConstraints::lengths that gives its length, or -1: free.
template <class Kind>
concept BasicConstraintKind = std::constructible_from<Kind, const SiteConstraint&> &&
    requires(const Kind& kind, const frames::Quaternion& q) {
    { Kind::name } -> std::convertible_to<std::string_view>;
    { Kind::meaning } -> std::convertible_to<std::string_view>;
    { Kind::unknowns } -> std::convertible_to<int>;
    { Kind::takes_axis } -> std::convertible_to<bool>;
    { Kind::takes_frame } -> std::convertible_to<bool>;
    { Kind::held_lengths } -> std::convertible_to<int>;
    { kind.moved(q) } -> std::same_as<frames::Quaternion>;
    { kind.length_columns(q) } -> std::same_as<std::array<int, 3>>;
};

// Tangents of M: rotation vectors (radians, world axes).
template <int Unknowns>
using TangentBasis = Eigen::Matrix<double, 3, Unknowns>;
template <int Unknowns>
using Turn = Eigen::Matrix<double, Unknowns, 1>;

// - tangents(q): an orthonormal basis of the rotation vectors that do not leave M at q in M, to first order;
// - turned(q, t): a chart of M about q: turned(q, 0) = q, its derivative at 0 is tangents(q), and it stays on M;
// - turn_between(p, q): its inverse: turned(p, turn_between(p, q)) = q near p;
// - Space(kind, q), q in M: the sh4 vectors of M. They lie in centre() + a linear space, onto which reached(v) is the
//   orthogonal projection; nearest(v, fallback) is the one nearest to v, or `fallback`, one of them, where all are;
//   frame(point) is the frame of one of them.
template <class Kind>
concept PartialConstraintKind = BasicConstraintKind<Kind> &&
    std::constructible_from<typename Kind::Space, const Kind&, const frames::Quaternion&> &&
    requires(const Kind& kind, const frames::Quaternion& q, const Turn<Kind::unknowns>& turn,
             const typename Kind::Space& space, const frames::Sh4::Vector& v) {
    { kind.tangents(q) } -> std::same_as<TangentBasis<Kind::unknowns>>;
    { kind.turned(q, turn) } -> std::same_as<frames::Quaternion>;
    { kind.turn_between(q, q) } -> std::same_as<Turn<Kind::unknowns>>;
    { space.centre() } -> std::convertible_to<frames::Sh4::Vector>;
    { space.reached(v) } -> std::same_as<frames::Sh4::Vector>;
    { space.nearest(v, v) } -> std::same_as<frames::Sh4::Vector>;
    { space.frame(v) } -> std::same_as<frames::Quaternion>;
};

template <class Kind>
concept ConstraintKind =
    BasicConstraintKind<Kind> && (Kind::unknowns == 0 || Kind::unknowns == 3 || PartialConstraintKind<Kind>);

struct FreeFrame {
    static constexpr std::string_view name = "free", meaning = "nothing held";
    static constexpr int unknowns = 3, held_lengths = 0;
    static constexpr bool takes_axis = false, takes_frame = false;

    explicit FreeFrame(const SiteConstraint&) {}
    frames::Quaternion moved(const frames::Quaternion& q) const { return q; }
    std::array<int, 3> length_columns(const frames::Quaternion&) const { return {-1, -1, -1}; }
};

// Frames with one fixed axis have the sh4 vectors centre + radius (cos(4t) u + sin(4t) v): a circle in a plane (Ray,
// Sokolov, Levy 2016, section 3; Palmer, Bommes, Solomon 2020, section 4.2).
class TwistCircle {
public:
    TwistCircle(const frames::Quaternion& reference, const frames::Vector3& axis);

    const frames::Sh4::Vector& centre() const { return centre_; }
    frames::Sh4::Vector reached(const frames::Sh4::Vector& v) const { return plane_ * (plane_.transpose() * v); }
    frames::Sh4::Vector nearest(const frames::Sh4::Vector& v, const frames::Sh4::Vector& fallback) const;
    frames::Quaternion frame(const frames::Sh4::Vector& point) const;

private:
    frames::Quaternion reference_;
    frames::Vector3 axis_;
    frames::Sh4::Vector centre_;
    Eigen::Matrix<double, frames::Sh4::dimension, 2> plane_;  // orthonormal columns u, v
};

struct FixedAxis {
    static constexpr std::string_view name = "axis",
                                      meaning = "one axis of the frame is the given one, about which it may turn";
    static constexpr int unknowns = 1, held_lengths = 1;
    static constexpr bool takes_axis = true, takes_frame = false;
    struct Space : TwistCircle {
        Space(const FixedAxis& kind, const frames::Quaternion& q) : TwistCircle(q, kind.axis) {}
    };

    explicit FixedAxis(const SiteConstraint& given) : axis(given.axis) {}
    // By the least rotation that puts the nearest axis on the given one.
    frames::Quaternion moved(const frames::Quaternion& q) const;
    TangentBasis<1> tangents(const frames::Quaternion&) const { return axis; }
    frames::Quaternion turned(const frames::Quaternion& q, const Turn<1>& turn) const {
        return (frames::exp(turn[0] * axis) * q).normalized();
    }
    Turn<1> turn_between(const frames::Quaternion& from, const frames::Quaternion& to) const {
        return Turn<1>(axis.dot(frames::log(to * from.conjugate())));
    }
    std::array<int, 3> length_columns(const frames::Quaternion& q) const;  // column 0: along the given axis

    frames::Vector3 axis;
};

struct FixedFrame {
    static constexpr std::string_view name = "fixed", meaning = "the frame is the given one";
    static constexpr int unknowns = 0, held_lengths = 3;
    static constexpr bool takes_axis = false, takes_frame = true;

    explicit FixedFrame(const SiteConstraint& given) : frame(frames::from_wxyz(given.frame.normalized())) {}
    frames::Quaternion moved(const frames::Quaternion&) const { return frame; }
    std::array<int, 3> length_columns(const frames::Quaternion&) const { return {0, 1, 2}; }

    frames::Quaternion frame;
};

// What is known of a kind without a site.
struct ConstraintKindInfo {
    std::string_view name, meaning;
    int unknowns, held_lengths;
    bool takes_axis, takes_frame;
};

namespace detail {
template <class Kind>
struct SpaceOf {
    using type = std::tuple<>;
};
template <PartialConstraintKind Kind>
struct SpaceOf<Kind> {
    using type = std::tuple<typename Kind::Space>;
};
template <class Tuple>
struct AnyOf;
template <class... Part>
struct AnyOf<std::tuple<Part...>> {
    using type = std::variant<Part...>;
};
}  // namespace detail

template <ConstraintKind... Kind>
struct ConstraintKindList {
    static constexpr std::array<ConstraintKindInfo, sizeof...(Kind)> info = {
        ConstraintKindInfo{Kind::name, Kind::meaning, Kind::unknowns, Kind::held_lengths, Kind::takes_axis,
                           Kind::takes_frame}...};

    // The sh4 vectors of a site that is held in part: one of the kinds' Space.
    using Space = typename detail::AnyOf<decltype(std::tuple_cat(
        std::declval<typename detail::SpaceOf<Kind>::type>()...))>::type;

    // visit(kind), an object of the type at that place.
    template <class Visit>
    static void visit(VertexConstraint place, const SiteConstraint& given, Visit&& visit) {
        std::size_t next = 0;
        ((next++ == static_cast<std::size_t>(place) && (visit(Kind(given)), true)) || ...);
    }
};

// In the order of VertexConstraint, which has a name for each that the library itself gives to sites.
using ConstraintKinds = ConstraintKindList<FreeFrame, FixedAxis, FixedFrame>;

inline bool is_known(VertexConstraint kind) { return static_cast<std::size_t>(kind) < ConstraintKinds::info.size(); }
// kind: is_known.
constexpr const ConstraintKindInfo& info(VertexConstraint kind) {
    return ConstraintKinds::info[static_cast<std::size_t>(kind)];
}
static_assert(info(VertexConstraint::free).name == FreeFrame::name);
static_assert(info(VertexConstraint::axis).name == FixedAxis::name);
static_assert(info(VertexConstraint::fixed).name == FixedFrame::name);

std::string listed_kinds();  // "0 free, 1 axis, 2 fixed", for messages

}  // namespace octafield::volume
