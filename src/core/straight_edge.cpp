#include "straight_edge.hpp"

#include <cmath>

namespace viscontact {

namespace {

// As in straight_edge.py.
constexpr double MAX_CURVATURE = 0.3, MAX_DISTANCE = 1.5;

}  // namespace

double EdgeLaw::distance(double first, double second, double third) const {
    const double b = first_growth, c = second_growth, slack = second - (1 + b) * first;
    const double t = first < MAX_DISTANCE * slack ? first / slack : MAX_DISTANCE;
    // Change of t with the curvature, and second and third gap over the slope of the first: by the
    // law, and what a unit curvature adds.
    const double shift = -t * (1 + t) / 2;
    const double second_gap = 1 + (1 + b) * t, third_gap = 2 + b + (1 + b + c) * t;
    const double second_bend = ((1 + t) * (1 + t) + b * (t * t)) / 2 - (1 + b) * shift;
    const double third_bend =
        ((2 + t) * (2 + t) + b * ((1 + t) * (1 + t)) + c * (t * t)) / 2 - (1 + b + c) * shift;
    const double ratio = std::isnan(third) ? third_gap / second_gap : third / second;
    const double curvature = (ratio * second_gap - third_gap) / (third_bend - ratio * second_bend);
    return threshold + t - at_most(at_least(curvature, -MAX_CURVATURE), MAX_CURVATURE) * shift;
}

double EdgeLaw::offset(double slope) const {
    const double size = std::abs(slope);
    if (size >= slopes.back()) return offsets.back();
    if (slopes.size() == 1 || !(size > slopes.front()))
        return std::isnan(size) ? size : offsets.front();
    std::size_t k = 0;
    while (k + 2 < slopes.size() && size >= slopes[k + 1]) ++k;
    const double part = (offsets[k + 1] - offsets[k]) / (slopes[k + 1] - slopes[k]);
    return part * (size - slopes[k]) + offsets[k];
}

}  // namespace viscontact
