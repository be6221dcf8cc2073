// The search for the pressure of a contact, for Python.
#include "search.hpp"
#include "triples.hpp"

namespace {

using viscontact::Plane;
using Line = nb::ndarray<const double, nb::ndim<1>, nb::device::cpu, nb::c_contig>;

using Step =
    std::tuple<Array<const double>, Array<const float>, Array<const float>, double, double>;

template <class Gap>
std::tuple<Triple, Entries, double, double> measure(const Plane &plane, Array<double> pressure,
                                                    Array<double> displacement,
                                                    Array<const double> open_gap, double compliance,
                                                    Triple at, FreeTriple free, double unit,
                                                    Array<bool> contact, Array<Gap> gap,
                                                    std::optional<Step> step) {
    viscontact::StepAhead ahead;
    if (step) {
        const auto &[to, by, change, part, of] = *step;
        ahead = {field(plane, to), field(plane, by), field(plane, change), part, of};
    }
    const auto found = viscontact::measure<Gap>(
        plane, field(plane, pressure), field(plane, displacement), field(plane, open_gap),
        compliance, motion(at), free_of(free), unit, field(plane, contact), field(plane, gap),
        step ? &ahead : nullptr);
    return {triple(found.motion), entries(found.inverse), found.largest, found.error};
}

}  // namespace

void define_search(nb::module_ &module) {
    nb::class_<Plane>(module, "Plane")
        .def("__init__", [](Plane *self, Line x, Line y, std::tuple<double, double> cell_size,
                            std::tuple<bool, bool> mirrored, int threads) {
            if (x.shape(0) == 0 || y.shape(0) == 0)
                throw std::invalid_argument("a plane has a row and a column at least");
            new (self) Plane({x.data(), x.data() + x.shape(0)}, {y.data(), y.data() + y.shape(0)},
                             std::get<0>(cell_size), std::get<1>(cell_size), std::get<0>(mirrored),
                             std::get<1>(mirrored), threads);
        });
    define(module, "measure", &measure<double>);
    define(module, "measure", &measure<float>);
    define(module, "release",
           [](const Plane &plane, Array<bool> active, Array<const bool> last, Array<float> gap,
              FreeTriple free) {
               const auto found =
                   viscontact::release(plane, field(plane, active), field(plane, last),
                                       field(plane, gap), free_of(free));
               return std::tuple(found.released, found.changed, entries(found.inverse));
           });
    define(module, "follow",
           [](Array<float> stiffness, Array<const bool> active, Array<const bool> last,
              nb::ndarray<const float, nb::shape<3, 3>, nb::device::cpu, nb::c_contig> near) {
               std::array<float, 9> around;
               std::copy(near.data(), near.data() + 9, around.begin());
               const Shape shape = shape_of(active);
               viscontact::follow(field(shape, stiffness), field(shape, active), field(shape, last),
                                  around);
           });
    define(module, "direct",
           [](const Plane &plane, Array<float> found, Array<float> direction,
              Array<const float> residual, Array<const float> last_residual,
              Array<const bool> active, Array<const float> stiffness, double correction,
              double shift, Entries inverse, double last_slope, bool changed) {
               return viscontact::direct(plane, field(plane, found), field(plane, direction),
                                         field(plane, residual), field(plane, last_residual),
                                         field(plane, active), field(plane, stiffness), correction,
                                         shift, matrix(inverse), last_slope, changed);
           });
    define(module, "trial",
           [](const Plane &plane, Array<const double> pressure, Array<const float> direction,
              double length, Array<double> ahead, Triple targets, FreeTriple free, double cell_area,
              double arm, double scale, Array<float> step) {
               return viscontact::trial(plane, field(plane, pressure), field(plane, direction),
                                        length, field(plane, ahead), motion(targets), free_of(free),
                                        cell_area, arm, scale, field(plane, step));
           });
    define(module, "balance",
           [](const Plane &plane, Array<double> pressure, Triple targets, FreeTriple free,
              double cell_area, double arm) {
               return viscontact::balance(plane, field(plane, pressure), motion(targets),
                                          free_of(free), cell_area, arm);
           });
    define(module, "weigh",
           [](const Plane &plane, Array<const double> pressure, Triple targets, FreeTriple free,
              double cell_area, double arm) {
               const auto found = viscontact::weigh(plane, field(plane, pressure), motion(targets),
                                                    free_of(free), cell_area, arm);
               return std::tuple(found[0], found[1]);
           });
    define(module, "difference",
           [](const Plane &plane, Array<const double> ahead, Array<const double> pressure,
              double scale, Array<float> step) {
               viscontact::difference(plane, field(plane, ahead), field(plane, pressure), scale,
                                      field(plane, step));
           });
    define(module, "inner",
           [](const Plane &plane, Array<const float> one, Array<const float> first,
              Array<const float> second) {
               const auto found = viscontact::inner(plane, field(plane, one), field(plane, first),
                                                    field(plane, second));
               return std::tuple(found[0], found[1]);
           });
    define(module, "move",
           [](const Plane &plane, Array<double> pressure, Array<double> displacement,
              Array<const float> step, Array<const float> change, double length) {
               return viscontact::move(plane, field(plane, pressure), field(plane, displacement),
                                       field(plane, step), field(plane, change), length);
           });
    define(module, "sums", [](const Plane &plane, Array<const double> values) {
        return triple(viscontact::sums(plane, field(plane, values)));
    });
    define(module, "press",
           [](const Plane &plane, Array<const double> gap, Triple at, Array<const double> bearing,
              double share, FreeTriple free) {
               const auto found = viscontact::press(plane, field(plane, gap), motion(at),
                                                    field(plane, bearing), share, free_of(free));
               return std::tuple(found.squares, triple(found.sums), entries(found.inverse));
           });
}
