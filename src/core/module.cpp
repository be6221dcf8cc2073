// Python module viscontact.backend._core.
#include "arrays.hpp"
#include "spectra.hpp"
#include "strided.hpp"

namespace {

template <class Number, class Real>
void filter(Array<Number> spectrum, Array<const Real> symbol, int axis) {
    const Shape shape = shape_of(spectrum), factors = shape_of(symbol);
    if (axis != 0 && axis != 1) throw std::invalid_argument("the axis is 0 or 1");
    const bool along_rows = axis == 0;
    const auto whole = along_rows ? shape.rows : shape.columns,
               known = along_rows ? factors.rows : factors.columns;
    const bool fits = along_rows ? shape.columns == factors.columns : shape.rows == factors.rows;
    if (!fits || known > whole || known < whole / 2 + 1)
        throw std::invalid_argument("the symbol has no half of the spectrum");
    viscontact::filter(field(shape, spectrum), field(factors, symbol), axis);
}

// Numbers of an array of one or two axes.
template <class Real>
double largest(const nb::ndarray<const Real, nb::device::cpu> &array) {
    viscontact::Strided<Real> numbers{array.data(), 1, 1, 0, 0};
    if (array.ndim() != 1 && array.ndim() != 2)
        throw std::invalid_argument("expected an array of one or two axes");
    if (array.size() == 0)
        throw std::invalid_argument("an array without numbers has no largest one");
    const std::size_t last = array.ndim() - 1;
    numbers.columns = static_cast<std::ptrdiff_t>(array.shape(last));
    numbers.column_step = array.stride(last);
    if (last)
        numbers.rows = static_cast<std::ptrdiff_t>(array.shape(0)),
        numbers.row_step = array.stride(0);
    const nb::gil_scoped_release released;
    return viscontact::largest(numbers);
}

}  // namespace

NB_MODULE(_core, module) {
    module.doc() = "Inner loops of `viscontact`, as it has them in NumPy too.";
    module.attr("INTERFACE") = 6;
    module.attr("SOURCES") = VISCONTACT_SOURCES;
    module.def("largest", &largest<double>, nb::arg("array").noconvert());
    module.def("largest", &largest<float>, nb::arg("array").noconvert());
    define(module, "filter", &filter<float, float>);
    define(module, "filter", &filter<double, double>);
    define(module, "filter", &filter<std::complex<float>, float>);
    define(module, "filter", &filter<std::complex<double>, double>);
    define_search(module);
    define_history(module);
    define_rim(module);
    define_filters(module);
    define_advance(module);
}
