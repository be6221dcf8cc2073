// What Python sees of the core: checked arguments, the lock of Python released.
#include "core.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <stdexcept>

namespace nb = nanobind;

namespace {

template <typename Real>
using Array = nb::ndarray<const Real, nb::device::cpu>;

/// Numbers of an array of one or two axes.
template <typename Real>
viscontact::Field<Real> field_of(const Array<Real>& array) {
  if (array.ndim() == 1)
    return {array.data(), 1, static_cast<std::ptrdiff_t>(array.shape(0)), 0,
            static_cast<std::ptrdiff_t>(array.stride(0))};
  if (array.ndim() != 2) throw std::invalid_argument("expected an array of one or two axes");
  return {array.data(), static_cast<std::ptrdiff_t>(array.shape(0)),
          static_cast<std::ptrdiff_t>(array.shape(1)), static_cast<std::ptrdiff_t>(array.stride(0)),
          static_cast<std::ptrdiff_t>(array.stride(1))};
}

template <typename Real>
double largest(const Array<Real>& array) {
  const viscontact::Field<Real> field = field_of(array);
  if (field.rows == 0 || field.columns == 0)
    throw std::invalid_argument("an array without numbers has no largest one");
  const nb::gil_scoped_release released;
  return viscontact::largest(field);
}

}  // namespace

NB_MODULE(_core, module) {
  module.doc() = "Compiled twins of functions of `viscontact`, on arrays in single and double precision.";
  module.attr("INTERFACE") = 1;
  module.attr("SOURCES") = VISCONTACT_SOURCES;
  // An array is never converted: a copy would be a cost that nobody sees.
  module.def("largest", &largest<double>, nb::arg("array").noconvert(),
             "Largest absolute value of an array of one or two axes; NaN if it has one.");
  module.def("largest", &largest<float>, nb::arg("array").noconvert());
}
