// Distance of a straight edge from the cells beside it: see straight_edge.py.
#pragma once

#include <vector>

namespace viscontact {

// Limits that keep what is not a number.
inline double at_most(double value, double limit) { return value > limit ? limit : value; }

inline double at_least(double value, double limit) { return value < limit ? limit : value; }

// Gaps or pressures next to a straight edge, along lines of the grid that cross it.
struct EdgeLaw {
    double threshold, first_growth, second_growth;
    std::vector<double> slopes, offsets;

    double distance(double first, double second, double third) const;
    double offset(double slope) const;
};

}  // namespace viscontact
