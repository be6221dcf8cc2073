#include "spectra.hpp"

namespace viscontact {

namespace {

template <class Number, class Real>
void scale(Number *spectrum, const Real *symbol, std::ptrdiff_t count) {
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < count; ++j) spectrum[j] *= symbol[j];
}

template <class Real>
void scale(std::complex<Real> *spectrum, const Real *symbol, std::ptrdiff_t count) {
    Real *parts = reinterpret_cast<Real *>(spectrum);
#pragma omp simd
    for (std::ptrdiff_t j = 0; j < count; ++j) {
        parts[2 * j] *= symbol[j];
        parts[2 * j + 1] *= symbol[j];
    }
}

}  // namespace

template <class Number, class Real>
void filter(const Field<Number> &spectrum, const Field<Real> &symbol, int axis) {
    for (std::ptrdiff_t i = 0; i < spectrum.rows; ++i) {
        Number *row = spectrum.row(i);
        if (axis == 0) {
            scale(row, symbol.row(i < symbol.rows ? i : spectrum.rows - i), spectrum.columns);
            continue;
        }
        const Real *factors = symbol.row(i);
        scale(row, factors, symbol.columns);
        for (std::ptrdiff_t j = symbol.columns; j < spectrum.columns; ++j)
            row[j] *= factors[spectrum.columns - j];
    }
}

template void filter(const Field<float> &, const Field<float> &, int);
template void filter(const Field<double> &, const Field<double> &, int);
template void filter(const Field<std::complex<float>> &, const Field<float> &, int);
template void filter(const Field<std::complex<double>> &, const Field<double> &, int);

}  // namespace viscontact
