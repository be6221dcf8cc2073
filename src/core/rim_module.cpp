// The rim of a contact, for Python.
#include "arrays.hpp"
#include "rim.hpp"

namespace {

using viscontact::EdgeLaw;

// Crossings between the centres of a field.
template <class Number>
viscontact::Rim crossings(const Shape &shape, const Array<Number> &along_x,
                          const Array<Number> &along_y) {
    return {field({shape.rows - 1, shape.columns}, along_x),
            field({shape.rows, shape.columns - 1}, along_y)};
}

}  // namespace

void define_rim(nb::module_ &module) {
    nb::class_<EdgeLaw>(module, "EdgeLaw")
        .def("__init__", [](EdgeLaw *self, double threshold, std::tuple<double, double> growth,
                            std::vector<double> slopes, std::vector<double> offsets) {
            if (slopes.empty() || slopes.size() != offsets.size())
                throw std::invalid_argument("each slope has an offset");
            new (self)
                EdgeLaw{threshold, std::get<0>(growth), std::get<1>(growth), slopes, offsets};
        });
    using GivenLines = std::tuple<Array<const double>, Array<const double>>;
    using Receding =
        std::tuple<Array<const double>, Array<const bool>, Array<const bool>, Array<const bool>>;
    define(module, "locate_rim",
           [](Array<const bool> contact, Array<const double> gap, const EdgeLaw &gap_x,
              const EdgeLaw &gap_y, const EdgeLaw &pressure_x, const EdgeLaw &pressure_y,
              std::optional<Receding> recession, std::optional<GivenLines> ends,
              std::tuple<bool, bool> mirrored, Array<double> along_x, Array<double> along_y) {
               const Shape shape = shape_of(contact);
               const auto [even_x, even_y] = mirrored;
               if ((even_x && shape.rows % 2) || (even_y && shape.columns % 2))
                   throw std::invalid_argument("an even block has even numbers of cells");
               const EdgeLaw gaps[] = {gap_x, gap_y}, pressures[] = {pressure_x, pressure_y};
               viscontact::Recession receding;
               if (recession) {
                   const auto &[pressure, falls, opens, left] = *recession;
                   receding = {field(shape, pressure), field(shape, falls), field(shape, opens),
                               field(shape, left)};
               }
               viscontact::Rim at_ends;
               if (ends) at_ends = crossings(shape, std::get<0>(*ends), std::get<1>(*ends));
               viscontact::locate_rim(field(shape, contact), field(shape, gap), gaps, pressures,
                                      recession ? &receding : nullptr, ends ? &at_ends : nullptr,
                                      {even_x, even_y},
                                      crossings(shape, along_x, along_y));
           });
    define(module, "segment",
           [](Array<const bool> contact, Array<const double> gap,
              std::tuple<double, double, double> of) {
               const auto [whole, loss, least] = of;
               const Shape shape = shape_of(contact);
               const viscontact::Segments segments{whole, loss, least};
               return segments.of(field(shape, contact), field(shape, gap));
           });
    define(module, "measure_rim",
           [](Array<const bool> contact, Array<const double> along_x, Array<const double> along_y,
              double segment) {
               const Shape shape = shape_of(contact);
               const auto cells = field(shape, contact);
               const auto rim = crossings(shape, along_x, along_y);
               const auto found = viscontact::extents(cells, rim);
               return std::tuple(viscontact::enclosed_squares(cells, rim, segment), found.along_x,
                                 found.along_y, found.rows, found.columns);
           });
    define(module, "spans", [](Array<const bool> cells) {
        const auto found = viscontact::spans(field(shape_of(cells), cells));
        return std::tuple(found[0], found[1], found[2], found[3]);
    });
}
