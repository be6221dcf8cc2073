// Filters of fields by their spectra, for Python.
#include "arrays.hpp"
#include "spectral_filter.hpp"

namespace {

using viscontact::Axis;
using viscontact::SpectralFilter;

template <class Real>
SpectralFilter<Real> made(std::tuple<int, int> cells, std::tuple<int, int> lengths,
                          std::tuple<bool, bool> even, Array<const double> symbol, int threads) {
    const Axis<Real> first(std::get<0>(cells), std::get<0>(lengths), std::get<0>(even));
    const Axis<Real> second(std::get<1>(cells), std::get<1>(lengths), std::get<1>(even));
    return {first, second, field(shape_of(symbol), symbol), threads};
}

template <class Real, class Given, class Found>
void apply(const SpectralFilter<Real> &filter, Array<const Given> given, double size,
           Array<Found> found, nb::ndarray<Real, nb::ndim<1>, nb::device::cpu, nb::c_contig> work) {
    const Shape shape{filter.first().cells, filter.second().cells};
    if (static_cast<std::ptrdiff_t>(work.shape(0)) < filter.work())
        throw std::invalid_argument("the filter needs more numbers to work in");
    filter.apply(field(shape, given), size, field(shape, found), work.data());
}

template <class Real>
nb::class_<SpectralFilter<Real>> define_filter(nb::module_ &module, const char *name) {
    return nb::class_<SpectralFilter<Real>>(module, name)
        .def(
            "__init__",
            [](SpectralFilter<Real> *self, std::tuple<int, int> cells, std::tuple<int, int> lengths,
               std::tuple<bool, bool> even, Array<const double> symbol, int threads) {
                new (self) SpectralFilter<Real>(made<Real>(cells, lengths, even, symbol, threads));
            })
        .def_prop_ro("work", &SpectralFilter<Real>::work)
        .def(
            "read_symbol",
            [](const SpectralFilter<Real> &filter, Array<double> into) {
                filter.read_symbol(
                    field(Shape{filter.first().waves(), filter.second().waves()}, into));
            },
            nb::arg().noconvert());
}

template <class Real, class Given, class Found, class Class>
void define_apply(Class &of) {
    of.def("apply", &apply<Real, Given, Found>, nb::call_guard<nb::gil_scoped_release>(),
           nb::arg().noconvert(), nb::arg(), nb::arg().noconvert(), nb::arg().noconvert());
}

}  // namespace

void define_filters(nb::module_ &module) {
    auto single = define_filter<float>(module, "SingleFilter");
    define_apply<float, float, float>(single);
    define_apply<float, double, double>(single);
    define_apply<float, double, float>(single);
    define_apply<float, float, double>(single);
    auto twice = define_filter<double>(module, "DoubleFilter");
    define_apply<double, double, double>(twice);
}
