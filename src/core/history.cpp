#include "history.hpp"

#include <cmath>

#include "rows.hpp"

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

struct Changes {
    std::ptrdiff_t count = 0;
    double size = 0, rate = 0, change = 0;

    void add(const Changes &other) {
        count += other.count, size += other.size, rate += other.rate, change += other.change;
    }
};

FOR_PROCESSORS
void add_row(Changes &found, const double *p, const double *p_before, const double *late,
             const double *early, double each, const double *rate_before, double *rate,
             std::ptrdiff_t columns) {
    double count = 0, size = 0, rates = 0, changes = 0;
    for (std::ptrdiff_t j = 0; j < columns; ++j) rate[j] = each * late[j] + -each * early[j];
#pragma omp simd reduction(+ : count, size, rates)
    for (std::ptrdiff_t j = 0; j < columns; ++j) {
        const double touches = (p[j] > 0) | (p_before[j] > 0) ? 1.0 : 0.0;
        count += touches;
        size += touches != 0 ? std::abs(late[j]) : 0.0;
        rates += touches != 0 ? std::abs(rate[j]) : 0.0;
    }
    if (rate_before) {
#pragma omp simd reduction(+ : changes)
        for (std::ptrdiff_t j = 0; j < columns; ++j)
            changes += (p[j] > 0) | (p_before[j] > 0) ? std::abs(rate[j] - rate_before[j]) : 0.0;
    }
    found.count += static_cast<std::ptrdiff_t>(count);
    found.size += size, found.rate += rates, found.change += changes;
}

}  // namespace

StepChange step_change(const Field<double> &pressure, const Field<double> &pressure_before,
                       const Field<double> &late, const Field<double> &early, double duration,
                       const Field<double> *rate_before, const Field<double> &rate, int threads) {
    const auto total = total_of(
        of_blocks(late.rows, late.columns, threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
            Changes here;
            for (std::ptrdiff_t i = begin; i < end; ++i)
                add_row(here, pressure.row(i), pressure_before.row(i), late.row(i), early.row(i),
                        1 / duration, rate_before ? rate_before->row(i) : nullptr, rate.row(i),
                        late.columns);
            return here;
        }));
    if (total.count == 0) return {0, 0, 0};
    const double cells = static_cast<double>(total.count);
    return {total.size / cells, total.rate / cells, total.change / cells};
}

double largest_mean(const std::vector<double> &values, double window) {
    const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(values.size());
    std::vector<double> before(values.size() + 1, 0.0);
    for (std::ptrdiff_t k = 0; k < count; ++k) before[k + 1] = before[k] + values[k];
    const auto sum_to = [&](double place) {
        const auto edge = std::min(static_cast<std::ptrdiff_t>(place), count - 1);
        return before[edge] + (before[edge + 1] - before[edge]) * (place - edge);
    };
    const double last = static_cast<double>(count) - window;
    double largest = -BEYOND;
    // A mean is largest where the window begins or ends with a value.
    const auto begin_at = [&](double place) {
        const double start = std::min(std::max(place, 0.0), last);
        largest = std::max(largest, sum_to(start + window) - sum_to(start));
    };
    for (std::ptrdiff_t edge = 0; edge <= count; ++edge) {
        begin_at(static_cast<double>(edge));
        begin_at(static_cast<double>(edge) - window);
    }
    return largest / window;
}

namespace {

// A row of trends: a change from the last extreme counts beyond a part of it and an error.
FOR_PROCESSORS
void follow_row(const double *given, double error, double factor, const double *extreme,
                const Flag *rises, double *later, Flag *later_rises, std::ptrdiff_t count) {
    // Bytes and numbers in one loop would not be worked on several at once.
    constexpr std::ptrdiff_t LINE = 256;
    double rose[LINE], turned[LINE];
    for (std::ptrdiff_t first = 0; first < count; first += LINE) {
        const std::ptrdiff_t length = std::min(LINE, count - first);
        for (std::ptrdiff_t j = 0; j < length; ++j) rose[j] = rises[first + j];
#pragma omp simd
        for (std::ptrdiff_t j = 0; j < length; ++j) {
            const double value = given[first + j], last = extreme[first + j];
            const double before = rose[j] != 0 ? last : value, after = rose[j] != 0 ? value : last;
            turned[j] = factor * after + error < before ? 1.0 : 0.0;
            later[first + j] = turned[j] != 0 || after > before ? value : last;
        }
        for (std::ptrdiff_t j = 0; j < length; ++j)
            later_rises[first + j] = static_cast<Flag>(std::abs(rose[j] - turned[j]));
    }
}

}  // namespace

void follow_trends(const Field<double> &gap, const Field<double> &pressure,
                   const Field<Flag> &in_contact, double error, double turns,
                   const ContactTrend &before, const ContactTrend &after, int threads) {
    const double factor = 1 + turns;
    const std::ptrdiff_t columns = gap.columns;
    of_blocks(gap.rows, columns, threads, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        std::vector<double> closed(columns);
        for (std::ptrdiff_t i = begin; i < end; ++i) {
            const double *open = gap.row(i);
            const Flag *touches = in_contact.row(i), *left = before.left.row(i);
            for (std::ptrdiff_t j = 0; j < columns; ++j) closed[j] = touches[j];
            for (std::ptrdiff_t j = 0; j < columns; ++j)
                closed[j] = closed[j] != 0 || open[j] < 0 ? 0.0 : open[j];
            Flag *opens = after.gap.rises.row(i), *left_later = after.left.row(i);
            follow_row(closed.data(), error, factor, before.gap.extreme.row(i),
                       before.gap.rises.row(i), after.gap.extreme.row(i), opens, columns);
            follow_row(pressure.row(i), 0.0, factor, before.pressure.extreme.row(i),
                       before.pressure.rises.row(i), after.pressure.extreme.row(i),
                       after.pressure.rises.row(i), columns);
            for (std::ptrdiff_t j = 0; j < columns; ++j)
                left_later[j] = touches[j] | (left[j] & opens[j]);
        }
    });
}

}  // namespace viscontact
