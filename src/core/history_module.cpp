// What is done to fields between the solutions of two steps, for Python.
#include "arrays.hpp"
#include "history.hpp"

namespace {

using viscontact::ContactTrend;
using Trends = std::tuple<Array<double>, Array<bool>, Array<double>, Array<bool>, Array<bool>>;
using GivenTrends = std::tuple<Array<const double>, Array<const bool>, Array<const double>,
                               Array<const bool>, Array<const bool>>;

template <class Given>
ContactTrend trends(const Shape &shape, const Given &of) {
    const auto &[gap, opens, pressure, rises, left] = of;
    return {{field(shape, gap), field(shape, opens)},
            {field(shape, pressure), field(shape, rises)},
            field(shape, left)};
}

template <class Number>
void unfold(Array<const Number> part, Array<Number> whole) {
    const Shape from = shape_of(part), to = shape_of(whole);
    const auto fits = [](std::ptrdiff_t lines, std::ptrdiff_t all) {
        return all == lines || all == 2 * lines;
    };
    if (!(fits(from.rows, to.rows) && fits(from.columns, to.columns)))
        throw std::invalid_argument("the whole field is as long as its part, or twice as long");
    viscontact::unfold(field(from, part), field(to, whole));
}

}  // namespace

void define_history(nb::module_ &module) {
    using Flat = nb::ndarray<double, nb::device::cpu, nb::c_contig>;
    using GivenFlat = nb::ndarray<const double, nb::device::cpu, nb::c_contig>;
    define(module, "weighted_sum",
           [](Flat sum, std::vector<double> weights, std::vector<GivenFlat> fields, int threads) {
               if (weights.size() != fields.size())
                   throw std::invalid_argument("each field has a weight");
               std::vector<const double *> given;
               for (const auto &each : fields) {
                   if (each.size() != sum.size())
                       throw std::invalid_argument("fields of one size are added");
                   given.push_back(each.data());
               }
               viscontact::weighted_sum(sum.data(), static_cast<std::ptrdiff_t>(sum.size()),
                                        weights, given, threads);
           });
    define(module, "mean_change",
           [](Array<const bool> where, Array<const double> late,
              std::optional<Array<const double>> early, int threads) {
               const Shape shape = shape_of(where);
               if (!early)
                   return viscontact::mean_change(field(shape, where), field(shape, late), nullptr,
                                                  threads);
               const auto other = field(shape, *early);
               return viscontact::mean_change(field(shape, where), field(shape, late), &other,
                                              threads);
           });
    define(module, "step_change",
           [](Array<const double> pressure, Array<const double> pressure_before,
              Array<const double> late, Array<const double> early, double duration,
              std::optional<Array<const double>> rate_before, Array<double> rate, int threads) {
               const Shape shape = shape_of(late);
               viscontact::Field<double> before{};
               if (rate_before) before = field(shape, *rate_before);
               const auto found = viscontact::step_change(
                   field(shape, pressure), field(shape, pressure_before), field(shape, late),
                   field(shape, early), duration, rate_before ? &before : nullptr,
                   field(shape, rate), threads);
               return std::tuple(found.size, found.rate, found.change);
           });
    define(
        module, "largest_mean",
        [](nb::ndarray<const double, nb::ndim<1>, nb::device::cpu, nb::c_contig> values,
           double window) {
            const double *first = values.data();
            const std::vector<double> line(first, first + values.shape(0));
            if (!(window > 0 && window <= static_cast<double>(line.size())))
                throw std::invalid_argument("the window is longer than 0 and fits into the line");
            return viscontact::largest_mean(line, window);
        });
    define(module, "follow_trends",
           [](Array<const double> gap, Array<const double> pressure, Array<const bool> in_contact,
              double error, double turns, GivenTrends before, Trends after, int threads) {
               const Shape shape = shape_of(gap);
               viscontact::follow_trends(field(shape, gap), field(shape, pressure),
                                         field(shape, in_contact), error, turns,
                                         trends(shape, before), trends(shape, after), threads);
           });
    define(module, "unfold", &unfold<double>);
    define(module, "unfold_flags", &unfold<bool>);
}
