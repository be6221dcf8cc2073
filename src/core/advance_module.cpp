// One iteration of the search, for Python.
#include "advance.hpp"
#include "triples.hpp"

namespace {

using viscontact::Plane;
using Filter = viscontact::SpectralFilter<float>;
using Near = nb::ndarray<const float, nb::shape<3, 3>, nb::device::cpu, nb::c_contig>;
using Work = nb::ndarray<float, nb::ndim<1>, nb::device::cpu, nb::c_contig>;
using Pressures = std::tuple<Array<const double>, Array<double>>;
using Actives = std::tuple<Array<bool>, Array<const bool>>;
using Residuals = std::tuple<Array<float>, Array<const float>>;
using Directions = std::tuple<Array<float>, Array<float>, Array<float>, Array<float>>;

viscontact::Operators operators(const Filter &convolution, const Filter &preconditioner,
                                const Filter &stiffness, Near near, std::ptrdiff_t few) {
    for (const Filter *other : {&preconditioner, &stiffness})
        if (other->first().cells != convolution.first().cells ||
            other->second().cells != convolution.second().cells)
            throw std::invalid_argument("operators of one patch have its cells");
    viscontact::Operators found{&convolution, &preconditioner, &stiffness, {}, nullptr, few};
    std::copy(near.data(), near.data() + 9, found.near.begin());
    return found;
}

std::ptrdiff_t work_of(const viscontact::Operators &of) {
    return std::max({of.convolution->work(), of.preconditioner->work(), of.stiffness->work()});
}

std::tuple<double, bool, double, double> advance(const Plane &plane,
                                                 const viscontact::Operators &given, Work work,
                                                 Pressures pressures, Actives actives,
                                                 Residuals residuals, Directions directions,
                                                 Triple targets, FreeTriple free, double cell_area,
                                                 double arm, Entries inverse, double correction,
                                                 double last_slope, double length, double unit) {
    if (given.convolution->first().cells != plane.rows() ||
        given.convolution->second().cells != plane.columns())
        throw std::invalid_argument("the operators are those of another patch");
    if (static_cast<std::ptrdiff_t>(work.shape(0)) < work_of(given))
        throw std::invalid_argument("the filters need more numbers to work in");
    viscontact::Operators operators = given;
    operators.work = work.data();
    const auto &[pressure, ahead] = pressures;
    const auto &[active, last] = actives;
    const auto &[residual, last_residual] = residuals;
    const auto &[direction, spare, change, stiffness] = directions;
    const viscontact::Iterate of{
        field(plane, pressure),  field(plane, ahead),    field(plane, active),
        field(plane, last),      field(plane, residual), field(plane, last_residual),
        field(plane, direction), field(plane, spare),    field(plane, change),
        field(plane, stiffness),
    };
    const viscontact::Balances balances{motion(targets), free_of(free), cell_area, arm};
    const auto found = viscontact::advance(plane, operators, of, balances, matrix(inverse),
                                           correction, last_slope, length, unit);
    return {found.slope, found.projected, found.curvature, found.along};
}

}  // namespace

void define_advance(nb::module_ &module) {
    nb::class_<viscontact::Operators>(module, "Operators")
        .def(
            "__init__",
            [](viscontact::Operators *self, const Filter &convolution, const Filter &preconditioner,
               const Filter &stiffness, Near near, std::ptrdiff_t few) {
                new (self) viscontact::Operators(
                    operators(convolution, preconditioner, stiffness, near, few));
            },
            nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>())
        .def_prop_ro("work", &work_of);
    define(module, "advance", &advance);
}
