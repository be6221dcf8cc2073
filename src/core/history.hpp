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
