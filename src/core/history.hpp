// Passes over fields between the solutions of two steps.
#pragma once

#include <vector>

#include "fields.hpp"

namespace viscontact {

// Sum of weighted fields of one size, in a field that may be one of them.
void weighted_sum(double *sum, std::ptrdiff_t size, const std::vector<double> &weights,
                  const std::vector<const double *> &fields, int threads);

// Mean absolute difference of two fields over some cells; without the second, of the first to zero.
double mean_change(const Field<Flag> &where, const Field<double> &field, const Field<double> *other,
                   int threads);

// Rate of a field over a step, and means over the cells under pressure at one of its ends: of the
// field's size at its end, of the rate's size, and of its change from the rate before it, if given.
struct StepChange {
    double size, rate, change;
};

StepChange step_change(const Field<double> &pressure, const Field<double> &pressure_before,
                       const Field<double> &late, const Field<double> &early, double duration,
                       const Field<double> *rate_before, const Field<double> &rate, int threads);

// Largest mean of a line of values over a window of so many of them, which may begin between two.
double largest_mean(const std::vector<double> &values, double window);

// Values at their last turns and whether they rise since then: see recession.py.
struct Trend {
    Field<double> extreme;
    Field<Flag> rises;
};

struct ContactTrend {
    Trend gap, pressure;
    Field<Flag> left;
};

void follow_trends(const Field<double> &gap, const Field<double> &pressure,
                   const Field<Flag> &in_contact, double error, double turns,
                   const ContactTrend &before, const ContactTrend &after, int threads);

// A field with its mirror images before the first row, the first column, or both.
template <class Number>
void unfold(const Field<Number> &part, const Field<Number> &whole) {
    const std::ptrdiff_t above = whole.rows - part.rows, left = whole.columns - part.columns;
    for (std::ptrdiff_t i = 0; i < part.rows; ++i) {
        const Number *from = part.row(i);
        Number *to = whole.row(above + i);
        std::copy(from, from + part.columns, to + left);
        if (left) std::reverse_copy(from, from + part.columns, to);
        if (above) std::copy(to, to + whole.columns, whole.row(above - 1 - i));
    }
}

}  // namespace viscontact
