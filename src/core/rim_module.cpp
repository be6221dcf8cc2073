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
    define(module, "trace_rim",
           [](Array<const bool> contact, Array<const double> gap, const EdgeLaw &gap_x,
              const EdgeLaw &gap_y, const EdgeLaw &pressure_x, const EdgeLaw &pressure_y,
              std::optional<Receding> recession, std::optional<GivenLines> ends,
              std::tuple<bool, bool> mirrored,
              std::tuple<std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t> inner,
              double segment) {
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
               const auto [first_row, last_row, first_column, last_column] = inner;
               const auto within = [](std::ptrdiff_t first, std::ptrdiff_t last,
                                      std::ptrdiff_t count) {
                   return 0 <= first && first < last && last <= count;
               };
               if (!(within(first_row, last_row, shape.rows) &&
                     within(first_column, last_column, shape.columns)))
                   throw std::invalid_argument("the inner block lies within the fields");
               const auto found = viscontact::trace_rim(
                   field(shape, contact), field(shape, gap), gaps, pressures,
                   recession ? &receding : nullptr, ends ? &at_ends : nullptr, {even_x, even_y},
                   {first_row, last_row, first_column, last_column}, segment);
               return std::tuple(found.squares, found.along_x, found.along_y, found.rows,
                                 found.columns);
           });
    define(module, "segment",
           [](Array<const bool> contact, Array<const double> gap,
              std::tuple<double, double, double> of) {
               const auto [whole, loss, least] = of;
               const Shape shape = shape_of(contact);
               const viscontact::Segments segments{whole, loss, least};
               return segments.of(field(shape, contact), field(shape, gap));
           });
    define(module, "spans", [](Array<const bool> cells) {
        const auto found = viscontact::spans(field(shape_of(cells), cells));
        return std::tuple(found[0], found[1], found[2], found[3]);
    });
}
