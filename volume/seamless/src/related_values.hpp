// Numbers that differ by sign and translation, and what is left free of them.
#pragma once

#include <utility>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::volume::detail {

// A sum of coefficients times translations, ascending, none 0. Coefficients are whole numbers or halves, quarters, ...
using Form = std::vector<std::pair<Index, double>>;
Form sum(const Form& a, double factor, const Form& b);  // a + factor b

// Numbers joined by equations a = sign b + form: sets in which each is known by one of them. Near linear where forms
// are short.
class RelatedValues {
public:
    RelatedValues(Index numbers, Index translations);

    void relate(Index a, Index b, double sign, const Form& form);
    void set_zero(Index a) { relate(a, a, -1, {}); }
    bool are_equal(Index a, Index b);  // by the equations so far, but for what follows among translations

    // What all depends on: row r of `rows` gives number r as (unknown, coefficient), denominators removed. Ends the
    // joining. Throws SolverError ("no_translations").
    struct Free {
        std::vector<Form> rows;  // of the numbers, then of the translations
        Index count = 0;
        double multiple = 1;  // of which unknowns are multiples so that all terms are whole, thirds rounded
    };
    Free free();

private:
    struct Known {
        Index root;
        double sign;
        Form form;
    };
    Known find(Index a);

    Index translations_;
    std::vector<Index> parent_, size_;
    std::vector<double> sign_;
    std::vector<Form> form_;
    std::vector<std::uint8_t> pinned_;   // roots that are a form alone
    std::vector<Form> pin_, relations_;  // forms that are 0
};

}  // namespace octafield::volume::detail
