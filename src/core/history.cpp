#include "history.hpp"

#include <cmath>

namespace viscontact {

void weighted_sum(double *sum, std::ptrdiff_t size, const std::vector<double> &weights,
                  const std::vector<const double *> &fields, int threads) {
    constexpr std::ptrdiff_t LINE = 512;  // numbers that stay in the cache between fields
    of_blocks(
        (size + LINE - 1) / LINE, LINE, threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            for (std::ptrdiff_t line = begin; line < end; ++line) {
                const std::ptrdiff_t first = line * LINE, count = std::min(LINE, size - first);
                double total[LINE] = {};
                for (std::size_t k = 0; k < fields.size(); ++k) {
                    const double weight = weights[k], *field = fields[k] + first;
#pragma omp simd
                    for (std::ptrdiff_t j = 0; j < count; ++j) total[j] += weight * field[j];
                }
                std::copy(total, total + count, sum + first);
            }
        });
}

namespace {

struct Mean {
    std::ptrdiff_t count = 0;
    double total = 0;
};

}  // namespace

double mean_change(const Field<Flag> &where, const Field<double> &field, const Field<double> *other,
                   int threads) {
    const auto parts = of_blocks(
        where.rows, where.columns, threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            Mean here;
            for (std::ptrdiff_t i = begin; i < end; ++i) {
                const Flag *counts = where.row(i);
                const double *late = field.row(i), *early = other ? other->row(i) : nullptr;
                std::ptrdiff_t count = 0;
                double total = 0;
                if (early) {
#pragma omp simd reduction(+ : count, total)
                    for (std::ptrdiff_t j = 0; j < where.columns; ++j) {
                        count += counts[j];
                        total += counts[j] ? std::abs(late[j] - early[j]) : 0.0;
                    }
                } else {
#pragma omp simd reduction(+ : count, total)
                    for (std::ptrdiff_t j = 0; j < where.columns; ++j) {
                        count += counts[j];
                        total += counts[j] ? std::abs(late[j]) : 0.0;
                    }
                }
                here.count += count, here.total += total;
            }
            return here;
        });
    Mean sum;
    for (const Mean &part : parts) sum.count += part.count, sum.total += part.total;
    return sum.count ? sum.total / static_cast<double>(sum.count) : 0.0;
}

namespace {

// One value of a trend: the change from its last extreme counts beyond a part of it and an error.
inline void follow_value(double given, double error, double factor, double extreme, bool rises,
                         double &later, Flag &later_rises) {
    const bool further = rises ? given > extreme : given < extreme;
    const bool turned = rises ? factor * given + error < extreme : factor * extreme + error < given;
    later = (turned | further) ? given : extreme;
    later_rises = rises != turned;
}

}  // namespace

void follow_trends(const Field<double> &gap, const Field<double> &pressure,
                   const Field<Flag> &in_contact, double error, double turns,
                   const ContactTrend &before, const ContactTrend &after, int threads) {
    const double factor = 1 + turns;
    of_blocks(gap.rows, gap.columns, threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            const double *open = gap.row(i), *p = pressure.row(i);
            const double *gap_extreme = before.gap.extreme.row(i),
                         *p_extreme = before.pressure.extreme.row(i);
            const Flag *touches = in_contact.row(i), *gap_rises = before.gap.rises.row(i);
            const Flag *p_rises = before.pressure.rises.row(i), *left = before.left.row(i);
            double *gap_later = after.gap.extreme.row(i), *p_later = after.pressure.extreme.row(i);
            Flag *gap_then = after.gap.rises.row(i), *p_then = after.pressure.rises.row(i);
            Flag *left_later = after.left.row(i);
            for (std::ptrdiff_t j = 0; j < gap.columns; ++j) {
                const double closed = touches[j] || open[j] < 0 ? 0.0 : open[j];
                follow_value(closed, error, factor, gap_extreme[j], gap_rises[j], gap_later[j],
                             gap_then[j]);
                follow_value(p[j], 0.0, factor, p_extreme[j], p_rises[j], p_later[j], p_then[j]);
                left_later[j] = touches[j] || (left[j] && gap_then[j]);
            }
        }
    });
}

}  // namespace viscontact
