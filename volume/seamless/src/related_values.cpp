#include "related_values.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "octafield/error.hpp"

namespace octafield::volume::detail {
namespace {

constexpr double largest_denominator = 1 << 20;

// Gauss's elimination among the translations: each pivot as a form of those that stay.
class Elimination {
public:
    explicit Elimination(Index count) : of_(count), is_pivot_(count, 0) {}

    void add(const Form& relation) {
        const Form left = reduced(relation);
        if (left.empty()) return;
        // The least coefficient, and a power of two where there is one, keeps denominators small.
        auto best = left.begin();
        for (auto at = left.begin(); at != left.end(); ++at)
            if (cost(at->second) < cost(best->second)) best = at;
        const Index pivot = best->first;
        const double by = best->second;
        Form form;
        for (const auto& [t, c] : left)
            if (t != pivot) form.emplace_back(t, -c / by);
        is_pivot_[pivot] = 1;
        of_[pivot] = form;
        for (const Index other : users_[pivot]) of_[other] = replaced(of_[other], pivot);
        for (const Index other : users_[pivot])
            for (const auto& entry : of_[other]) use(entry.first, other);
        users_.erase(pivot);
        for (const auto& entry : form) use(entry.first, pivot);
    }
    Form reduced(const Form& form) const {
        Form result;
        for (const auto& [t, c] : form) result = is_pivot_[t] ? sum(result, c, of_[t]) : sum(result, c, {{t, 1.0}});
        return result;
    }
    bool is_pivot(Index t) const { return is_pivot_[t]; }

private:
    static double cost(double c) {
        int exponent;
        return std::abs(c) + (std::frexp(std::abs(c), &exponent) == 0.5 ? 0 : 1000);
    }
    void use(Index translation, Index by) {
        auto& list = users_[translation];
        if (std::find(list.begin(), list.end(), by) == list.end()) list.push_back(by);
    }
    Form replaced(const Form& form, Index pivot) const {
        const auto found = std::find_if(form.begin(), form.end(), [&](const auto& e) { return e.first == pivot; });
        if (found == form.end()) return form;
        const double c = found->second;
        return sum(sum(form, -c, {{pivot, 1.0}}), c, of_[pivot]);
    }

    std::vector<Form> of_;
    std::vector<std::uint8_t> is_pivot_;
    std::map<Index, std::vector<Index>> users_;  // pivots in whose form a translation is
};

}  // namespace

Form sum(const Form& a, double factor, const Form& b) {
    Form result;
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() || j != b.end()) {
        if (j == b.end() || (i != a.end() && i->first < j->first)) {
            result.push_back(*i++);
        } else if (i == a.end() || j->first < i->first) {
            result.emplace_back(j->first, factor * j->second);
            ++j;
        } else {
            const double c = i->second + factor * j->second;
            if (std::abs(c) > 1e-9) result.emplace_back(i->first, c);
            ++i, ++j;
        }
    }
    return result;
}

RelatedValues::RelatedValues(Index numbers, Index translations)
    : translations_(translations),
      parent_(numbers),
      size_(numbers, 1),
      sign_(numbers, 1),
      form_(numbers),
      pinned_(numbers, 0),
      pin_(numbers) {
    std::iota(parent_.begin(), parent_.end(), 0);
}

// After it the number hangs on its root itself.
RelatedValues::Known RelatedValues::find(Index a) {
    std::vector<Index> path;
    while (parent_[a] != a) {
        path.push_back(a);
        a = parent_[a];
    }
    for (std::size_t i = path.size(); i-- > 0;) {
        const Index v = path[i], up = parent_[v];
        if (up == a) continue;  // up hangs on the root by now
        form_[v] = sum(form_[v], sign_[v], form_[up]);
        sign_[v] *= sign_[up];
        parent_[v] = a;
    }
    if (path.empty()) return {a, 1, {}};
    return {a, sign_[path[0]], form_[path[0]]};
}

void RelatedValues::relate(Index a, Index b, double sign, const Form& form) {
    Known one = find(a), other = find(b);
    // one.root = s other.root + g
    double s = one.sign * sign * other.sign;
    Form g = sum(sum({}, one.sign * sign, other.form), one.sign, sum(form, -1, one.form));
    if (one.root == other.root) {
        if (s > 0) {
            if (!g.empty()) relations_.push_back(std::move(g));
        } else if (pinned_[one.root]) {
            relations_.push_back(sum(pin_[one.root], -0.5, g));
        } else {
            pinned_[one.root] = 1;
            pin_[one.root] = sum({}, 0.5, g);
        }
        return;
    }
    if (size_[one.root] > size_[other.root]) {
        std::swap(one, other);
        g = sum({}, -s, g);
    }
    // one.root hangs on other.root now.
    parent_[one.root] = other.root;
    sign_[one.root] = s;
    size_[other.root] += size_[one.root];
    if (pinned_[one.root]) {
        const Form pin = sum(sum({}, s, pin_[one.root]), -s, g);
        if (pinned_[other.root]) {
            relations_.push_back(sum(pin_[other.root], -1, pin));
        } else {
            pinned_[other.root] = 1;
            pin_[other.root] = pin;
        }
    }
    form_[one.root] = std::move(g);
}

bool RelatedValues::are_equal(Index a, Index b) {
    const auto told = [&](Index number) {
        Known known = find(number);
        if (!pinned_[known.root]) return known;
        return Known{-1, 1, sum(known.form, known.sign, pin_[known.root])};
    };
    const Known one = told(a), other = told(b);
    return one.root == other.root && one.sign == other.sign && one.form == other.form;
}

RelatedValues::Free RelatedValues::free() {
    Elimination elimination(translations_);
    std::stable_sort(relations_.begin(), relations_.end(),
                     [](const Form& a, const Form& b) { return a.size() < b.size(); });
    for (const Form& relation : relations_) elimination.add(relation);
    Free result;
    const Index numbers = static_cast<Index>(parent_.size());
    std::vector<Index> of_translation(translations_, -1), of_root(numbers, -1);
    for (Index t = 0; t < translations_; ++t)
        if (!elimination.is_pivot(t)) of_translation[t] = result.count++;
    const auto renamed = [&](const Form& form) {
        Form row = elimination.reduced(form);
        for (auto& [t, c] : row) t = of_translation[t];
        std::sort(row.begin(), row.end());
        return row;
    };
    for (Index a = 0; a < numbers; ++a) {
        const Known known = find(a);
        if (pinned_[known.root]) {
            result.rows.push_back(renamed(sum(known.form, known.sign, pin_[known.root])));
            continue;
        }
        if (of_root[known.root] < 0) of_root[known.root] = result.count++;
        Form row = known.form.empty() ? Form{} : renamed(known.form);
        row.emplace_back(of_root[known.root], known.sign);
        std::sort(row.begin(), row.end());
        result.rows.push_back(std::move(row));
    }
    for (Index t = 0; t < translations_; ++t) result.rows.push_back(renamed({{t, 1.0}}));
    for (const Form& row : result.rows)
        for (const auto& entry : row) {
            double c = entry.second * result.multiple, by = 1;
            while (by <= largest_denominator && std::abs(c * by - std::round(c * by)) > 1e-6) ++by;
            if (by > largest_denominator)
                throw SolverError("the cut's translations depend on one another by large numbers", "no_translations");
            result.multiple *= by;
        }
    return result;
}

}  // namespace octafield::volume::detail
