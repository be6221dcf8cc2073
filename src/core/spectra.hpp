// Products of spectra and even symbols.
#pragma once

#include <complex>

#include "fields.hpp"

namespace viscontact {

// Multiplies a spectrum by a symbol with the first entries along one axis, 0 or 1, whose others are
// their mirror images.
template <class Number, class Real>
void filter(const Field<Number> &spectrum, const Field<Real> &symbol, int axis);

}  // namespace viscontact
