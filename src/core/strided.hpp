// Numbers in any layout of one or two axes.
#pragma once

#include <cstddef>

namespace viscontact {

/// Numbers of two axes in memory; steps between neighbours count in numbers, and may be negative.
template <typename Real>
struct Strided {
    const Real *first;
    std::ptrdiff_t rows, columns;
    std::ptrdiff_t row_step, column_step;
};

/// Largest absolute value; NaN if one of the numbers is.
template <typename Real>
double largest(const Strided<Real> &field);

}  // namespace viscontact
