// Fields of angles given by their turns from edge to edge, and what they miss: coming back to themselves round the
// generators of a surface, and following its boundary curves.
#pragma once

#include <vector>

#include "structure.hpp"

namespace octafield::surface::detail {

// Turns are given per corner, (3F): from the first edge of the corner to the second (crouzeix_raviart.hpp), so that
// the three of a triangle sum to 0. Angles per edge, (E), are those that follow from angle 0 at the root of each
// component: an edge of its first boundary curve, or any edge. They are walked breadth-first through the triangles;
// every other way gives the same but for the conditions.
class Holonomy {
public:
    struct Condition {
        Index component;
        bool boundary;  // the angle at `edge`, of boundary curve `curve` (> 0); otherwise the misfit at it, where two
        Index curve;    // walks meet
        Index edge;
    };

    Holonomy(const SurfaceDomain& domain, const Structure& structure);

    // 2 g + b - 1 per component: its boundary curves but the first, then the generators of a tree-cotree decomposition
    // (Eppstein 2003).
    const std::vector<Condition>& conditions() const { return conditions_; }

    Eigen::VectorXd walked(const std::vector<double>& turns) const;
    // (conditions) what the angles miss; linear in the turns.
    Eigen::VectorXd missed(const std::vector<double>& turns, const Eigen::VectorXd& angles) const;
    // The largest misfit anywhere, modulo a quarter turn, and angle of a boundary edge, in [0, pi/4].
    double closure(const std::vector<double>& turns, const Eigen::VectorXd& angles) const;

    // (E) 1 on edges that the loop through the condition's edge and the root's tree crosses from left to right, seen
    // from lower to higher vertex; -1 from right to left. Closed.
    Eigen::VectorXd crossings(const Condition& generator) const;

private:
    struct Step {
        Index corner, from, to;  // edges
        double sign;             // 1: `to` is the corner's second edge
    };
    struct Parent {
        Index triangle = -1, edge = -1;  // -1: the root
        int depth = 0;
    };

    void walk_from(Index triangle, Index edge, std::vector<bool>& known);
    void add_conditions(const Structure& structure);
    double misfit(const Step& step, const std::vector<double>& turns, const Eigen::VectorXd& angles) const {
        return angles[step.from] + step.sign * turns[step.corner] - angles[step.to];
    }

    SurfaceDomain domain_;
    std::vector<Step> steps_, closings_;
    std::vector<Index> closing_of_edge_;  // (E), -1: none
    std::vector<Parent> parents_;         // (F)
    std::vector<bool> seen_;              // (F)
    std::vector<Condition> conditions_;
};

// The angle modulo a quarter turn, in (-pi/4, pi/4].
double within_quarter(double angle);

// (3F) turns of the function whose differences along edges, from lower to higher vertex, are `form`, (E).
std::vector<double> form_turns(const SurfaceDomain& domain, const Eigen::VectorXd& form);

// (E) per condition: the closed form of least energy that has the condition's crossings, or is the difference of a
// function that is 1 on its boundary curve; such functions are constant on each boundary curve.
std::vector<Eigen::VectorXd> harmonic_forms(const SurfaceDomain& domain, const Structure& structure,
                                            const Holonomy& holonomy);

}  // namespace octafield::surface::detail
