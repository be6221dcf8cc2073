#include "strided.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace viscontact {

namespace {

template <typename Real>
struct Largest {
    Real found = 0;
    Real nans = 0;  // how many: they are never larger, and would be passed over

    void take_row(const Real *row, std::ptrdiff_t length, std::ptrdiff_t step) {
        Real most = found;
        Real passed = nans;
        // Neither depends on the order in which numbers are taken.
#pragma omp simd reduction(max : most) reduction(+ : passed)
        for (std::ptrdiff_t column = 0; column < length; ++column) {
            const Real size = std::abs(row[column * step]);
            most = size > most ? size : most;
            passed += size == size ? Real(0) : Real(1);
        }
        found = most;
        nans = passed;
    }

    double value() const {
        return nans > 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(found);
    }
};

}  // namespace

template <typename Real>
double largest(const Strided<Real> &given) {
    Strided<Real> field = given;
    // Along the axis on which neighbours are near.
    if (std::abs(field.row_step) < std::abs(field.column_step)) {
        std::swap(field.rows, field.columns);
        std::swap(field.row_step, field.column_step);
    }
    Largest<Real> result;
    for (std::ptrdiff_t row = 0; row < field.rows; ++row) {
        const Real *start = field.first + row * field.row_step;
        if (field.column_step == 1)
            result.take_row(start, field.columns,
                            1);  // a constant: loads of several numbers at once
        else
            result.take_row(start, field.columns, field.column_step);
    }
    return result.value();
}

template double largest(const Strided<float> &);
template double largest(const Strided<double> &);

}  // namespace viscontact
