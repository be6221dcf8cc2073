// Python module viscontact.backend._core.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <vector>

#include "history.hpp"
#include "rim.hpp"
#include "search.hpp"
#include "spectra.hpp"
#include "strided.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace {

template <class Number>
using Array = nb::ndarray<Number, nb::ndim<2>, nb::device::cpu>;
using Triple = std::tuple<double, double, double>;
using FreeTriple = std::tuple<bool, bool, bool>;
using Entries = std::tuple<Triple, Triple, Triple>;
using Square = nb::ndarray<const double, nb::shape<3, 3>, nb::device::cpu, nb::c_contig>;

viscontact::Field<viscontact::Flag> flags(const viscontact::Field<bool> &of) {
    return {reinterpret_cast<viscontact::Flag *>(of.first), of.rows, of.columns, of.distance};
}

template <class Number>
viscontact::Field<Number> as_field(const Array<Number> &array) {
    if (array.shape(1) > 1 && array.stride(1) != 1)
        throw std::invalid_argument("the numbers of a row must be contiguous");
    return {array.data(), static_cast<std::ptrdiff_t>(array.shape(0)),
            static_cast<std::ptrdiff_t>(array.shape(1)), array.stride(0)};
}

template <class Number>
viscontact::Field<Number> as_given(const Array<const Number> &array) {
    if (array.shape(1) > 1 && array.stride(1) != 1)
        throw std::invalid_argument("the numbers of a row must be contiguous");
    return {const_cast<Number *>(array.data()), static_cast<std::ptrdiff_t>(array.shape(0)),
            static_cast<std::ptrdiff_t>(array.shape(1)), array.stride(0)};
}

auto field(const Array<bool> &array) { return flags(as_field(array)); }
template <class Number>
auto field(const Array<Number> &array) {
    return as_field(array);
}
// Inputs may be read-only.
auto given(const Array<const bool> &array) { return flags(as_given(array)); }
template <class Number>
auto given(const Array<const Number> &array) {
    return as_given(array);
}

viscontact::Motion motion(const Triple &of) { return {std::get<0>(of), std::get<1>(of), std::get<2>(of)}; }
viscontact::Free free_of(const FreeTriple &of) { return {std::get<0>(of), std::get<1>(of), std::get<2>(of)}; }
Triple triple(const viscontact::Motion &of) { return {of[0], of[1], of[2]}; }
Entries entries(const viscontact::Matrix &of) {
    return {{of[0], of[1], of[2]}, {of[3], of[4], of[5]}, {of[6], of[7], of[8]}};
}
viscontact::Matrix matrix(const Square &of) {
    viscontact::Matrix found;
    std::copy(of.data(), of.data() + 9, found.begin());
    return found;
}

using Line = nb::ndarray<const double, nb::ndim<1>, nb::device::cpu, nb::c_contig>;

using Step = std::tuple<Array<const double>, Array<const float>, Array<const float>, double, double>;

template <class Gap>
std::tuple<Triple, Entries, double, double> measure(const viscontact::Plane &plane, Array<double> pressure,
                                                    Array<double> displacement, Array<const double> open_gap,
                                                    double compliance, Triple at, FreeTriple free, double unit,
                                                    Array<bool> contact, Array<Gap> gap, std::optional<Step> step) {
    viscontact::StepAhead ahead;
    if (step) {
        const auto &[to, by, change, part, of] = *step;
        ahead = {given(to), given(by), given(change), part, of};
    }
    const auto found = viscontact::measure<Gap>(plane, field(pressure), field(displacement), given(open_gap),
                                                compliance, motion(at), free_of(free), unit, field(contact),
                                                field(gap), step ? &ahead : nullptr);
    return {triple(found.motion), entries(found.inverse), found.largest, found.error};
}

using viscontact::ContactTrend;
using viscontact::EdgeLaw;
using Trends = std::tuple<Array<double>, Array<bool>, Array<double>, Array<bool>, Array<bool>>;
using GivenTrends =
    std::tuple<Array<const double>, Array<const bool>, Array<const double>, Array<const bool>, Array<const bool>>;

ContactTrend trends(const Trends &of) {
    const auto &[gap, opens, pressure, rises, left] = of;
    return {{field(gap), field(opens)}, {field(pressure), field(rises)}, field(left)};
}

ContactTrend trends(const GivenTrends &of) {
    const auto &[gap, opens, pressure, rises, left] = of;
    return {{given(gap), given(opens)}, {given(pressure), given(rises)}, given(left)};
}

// Arrays of another kind are refused, as results written to a copy would be lost.
template <class Given>
auto argument() {
    if constexpr (std::is_arithmetic_v<std::decay_t<Given>>)
        return nb::arg();
    else
        return nb::arg().noconvert();
}

template <class... Given, class Found>
void define_with(nb::module_ &module, const char *name, Found (*work)(Given...)) {
    module.def(name, work, nb::call_guard<nb::gil_scoped_release>(),
               argument<Given>()...);
}

template <class Work>
void define(nb::module_ &module, const char *name, Work work) {
    define_with(module, name, +work);
}

template <class Number, class Real>
void filter(Array<Number> spectrum, Array<const Real> symbol, int axis) {
    const auto shape = field(spectrum);
    const auto factors = given(symbol);
    const bool along_rows = axis == 0;
    const auto whole = along_rows ? shape.rows : shape.columns, known = along_rows ? factors.rows : factors.columns;
    const bool fits = along_rows ? shape.columns == factors.columns : shape.rows == factors.rows;
    if (!fits || known > whole || known < whole / 2 + 1)
        throw std::invalid_argument("the symbol has no half of the spectrum");
    viscontact::filter(shape, factors, axis);
}

// Numbers of an array of one or two axes.
template <class Real>
double largest(const nb::ndarray<const Real, nb::device::cpu> &array) {
    viscontact::Strided<Real> numbers{array.data(), 1, 1, 0, 0};
    if (array.ndim() != 1 && array.ndim() != 2)
        throw std::invalid_argument("expected an array of one or two axes");
    if (array.size() == 0) throw std::invalid_argument("an array without numbers has no largest one");
    const std::size_t last = array.ndim() - 1;
    numbers.columns = static_cast<std::ptrdiff_t>(array.shape(last));
    numbers.column_step = array.stride(last);
    if (last) numbers.rows = static_cast<std::ptrdiff_t>(array.shape(0)), numbers.row_step = array.stride(0);
    const nb::gil_scoped_release released;
    return viscontact::largest(numbers);
}

}  // namespace

NB_MODULE(_core, module) {
    module.doc() = "Inner loops of `viscontact`, as it has them in NumPy too.";
    module.attr("INTERFACE") = 2;
    module.attr("SOURCES") = VISCONTACT_SOURCES;
    module.def("largest", &largest<double>, nb::arg("array").noconvert());
    module.def("largest", &largest<float>, nb::arg("array").noconvert());
    using viscontact::Plane;
    nb::class_<Plane>(module, "Plane")
        .def("__init__",
             [](Plane *self, Line x, Line y, std::tuple<double, double> cell_size,
                std::tuple<bool, bool> mirrored, int threads) {
                 new (self) Plane({x.data(), x.data() + x.shape(0)}, {y.data(), y.data() + y.shape(0)},
                                  std::get<0>(cell_size), std::get<1>(cell_size), std::get<0>(mirrored),
                                  std::get<1>(mirrored), threads);
             });
    define(module, "measure", &measure<double>);
    define(module, "measure", &measure<float>);
    define(
        module, "release",
        [](const Plane &plane, Array<bool> active, Array<const bool> last, Array<float> gap, FreeTriple free) {
            const auto found =
                viscontact::release(plane, field(active), given(last), field(gap), free_of(free));
            return std::tuple(found.released, found.changed, entries(found.inverse));
        });
    define(
        module, "follow",
        [](Array<float> stiffness, Array<const bool> active, Array<const bool> last,
           nb::ndarray<const float, nb::shape<3, 3>, nb::device::cpu, nb::c_contig> near) {
            std::array<float, 9> around;
            std::copy(near.data(), near.data() + 9, around.begin());
            viscontact::follow(field(stiffness), given(active), given(last), around);
        });
    define(
        module, "direct",
        [](const Plane &plane, Array<float> found, Array<float> direction, Array<const float> residual,
           Array<const float> last_residual, Array<const bool> active, Array<const float> stiffness,
           double correction, double shift, Square inverse, double last_slope, bool changed) {
            return viscontact::direct(plane, field(found), field(direction), given(residual),
                                      given(last_residual), given(active), given(stiffness), correction, shift,
                                      matrix(inverse), last_slope, changed);
        });
    define(
        module, "trial",
        [](const Plane &plane, Array<const double> pressure, Array<const float> direction, double length,
           Array<double> ahead, Triple targets, FreeTriple free, double cell_area, double arm, double scale,
           Array<float> step) {
            return viscontact::trial(plane, given(pressure), given(direction), length, field(ahead),
                                     motion(targets), free_of(free), cell_area, arm, scale, field(step));
        });
    define(
        module, "balance",
        [](const Plane &plane, Array<double> pressure, Triple targets, FreeTriple free, double cell_area,
           double arm) {
            return viscontact::balance(plane, field(pressure), motion(targets), free_of(free), cell_area, arm);
        });
    define(
        module, "difference",
        [](const Plane &plane, Array<const double> ahead, Array<const double> pressure, double scale,
           Array<float> step) {
            viscontact::difference(plane, given(ahead), given(pressure), scale, field(step));
        });
    define(
        module, "inner",
        [](const Plane &plane, Array<const float> one, Array<const float> first, Array<const float> second) {
            const auto found = viscontact::inner(plane, given(one), given(first), given(second));
            return std::tuple(found[0], found[1]);
        });
    define(
        module, "move",
        [](const Plane &plane, Array<double> pressure, Array<double> displacement, Array<const float> step,
           Array<const float> change, double length) {
            return viscontact::move(plane, field(pressure), field(displacement), given(step), given(change),
                                    length);
        });
    define(
        module, "sums",
        [](const Plane &plane, Array<const double> values) {
            return triple(viscontact::sums(plane, given(values)));
        });
    using Flat = nb::ndarray<double, nb::device::cpu, nb::c_contig>;
    using GivenFlat = nb::ndarray<const double, nb::device::cpu, nb::c_contig>;
    define(module, "weighted_sum",
           [](Flat sum, std::vector<double> weights, std::vector<GivenFlat> fields, int threads) {
               std::vector<const double *> given;
               for (const auto &each : fields) {
                   if (each.size() != sum.size()) throw std::invalid_argument("fields of one size are added");
                   given.push_back(each.data());
               }
               viscontact::weighted_sum(sum.data(), static_cast<std::ptrdiff_t>(sum.size()), weights, given,
                                        threads);
           });
    define(module, "mean_change",
           [](Array<const bool> where, Array<const double> late, std::optional<Array<const double>> early,
              int threads) {
               if (!early) return viscontact::mean_change(given(where), given(late), nullptr, threads);
               const auto other = given(*early);
               return viscontact::mean_change(given(where), given(late), &other, threads);
           });
    define(module, "follow_trends",
           [](Array<const double> gap, Array<const double> pressure, Array<const bool> in_contact, double error,
              double turns, GivenTrends before, Trends after, int threads) {
               viscontact::follow_trends(given(gap), given(pressure), given(in_contact), error, turns,
                                         trends(before), trends(after), threads);
           });
    define(module, "unfold", [](Array<const double> part, Array<double> whole) {
        viscontact::unfold(given(part), field(whole));
    });
    define(module, "unfold_flags", [](Array<const bool> part, Array<bool> whole) {
        viscontact::unfold(given(part), field(whole));
    });
    nb::class_<EdgeLaw>(module, "EdgeLaw")
        .def("__init__", [](EdgeLaw *self, double threshold, std::tuple<double, double> growth,
                            std::vector<double> slopes, std::vector<double> offsets) {
            new (self) EdgeLaw{threshold, std::get<0>(growth), std::get<1>(growth), slopes, offsets};
        });
    using GivenLines = std::tuple<Array<const double>, Array<const double>>;
    using Receding = std::tuple<Array<const double>, Array<const bool>, Array<const bool>, Array<const bool>>;
    define(module, "locate_rim",
           [](Array<const bool> contact, Array<const double> gap, const EdgeLaw &gap_x, const EdgeLaw &gap_y,
              const EdgeLaw &pressure_x, const EdgeLaw &pressure_y, std::optional<Receding> recession,
              std::optional<GivenLines> ends, Array<double> along_x, Array<double> along_y) {
               const EdgeLaw gaps[] = {gap_x, gap_y}, pressures[] = {pressure_x, pressure_y};
               viscontact::Recession receding;
               if (recession) {
                   const auto &[pressure, falls, opens, left] = *recession;
                   receding = {given(pressure), given(falls), given(opens), given(left)};
               }
               viscontact::Rim at_ends;
               if (ends) at_ends = {given(std::get<0>(*ends)), given(std::get<1>(*ends))};
               viscontact::locate_rim(given(contact), given(gap), gaps, pressures,
                                      recession ? &receding : nullptr, ends ? &at_ends : nullptr,
                                      {field(along_x), field(along_y)});
           });
    define(module, "enclosed_squares",
           [](Array<const bool> contact, Array<const double> along_x, Array<const double> along_y,
              double segment) {
               return viscontact::enclosed_squares(given(contact), {given(along_x), given(along_y)}, segment);
           });
    define(module, "rim_extents",
           [](Array<const bool> contact, Array<const double> along_x, Array<const double> along_y) {
               const auto found = viscontact::extents(given(contact), {given(along_x), given(along_y)});
               return std::tuple(found.along_x, found.along_y, found.rows, found.columns);
           });
    define(module, "filter", &filter<float, float>);
    define(module, "filter", &filter<double, double>);
    define(module, "filter", &filter<std::complex<float>, float>);
    define(module, "filter", &filter<std::complex<double>, double>);
    define(module, "spans", [](Array<const bool> cells) {
        const auto found = viscontact::spans(given(cells));
        return std::tuple(found[0], found[1], found[2], found[3]);
    });
    define(module, "chords", [](Array<const bool> contact) {
        const auto found = viscontact::chords(given(contact));
        return std::tuple(found[0], found[1], found[2]);
    });
}
