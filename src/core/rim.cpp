#include "rim.hpp"

#include <cmath>
#include <vector>

#include "cell.hpp"
#include "rows.hpp"

namespace viscontact {

namespace {

// As in rim_crossings.py.
constexpr double LEAST_DESCENT = 1e-6;
constexpr std::ptrdiff_t LEAST_CHORD = 4;

// Interval between neighbouring centres in which contact changes.
struct Interval {
    int axis;  // 0: along x
    Cell start, inner, outer;
    Cell outwards, across;  // steps to the open cell and to the next line
    double located = NONE, slope = 0;
};

double slope_of(double behind, double before, double far, double near) {
    return (behind - before) / (2 * (far - near));
}

void locate_by_gaps(Interval &here, const EdgeLaw &law, const Field<Flag> &contact,
                    const Field<double> &gap) {
    const Cell second = here.outer.moved(here.outwards);
    double near = at_least(at(gap, here.outer, BEYOND), 0.0), far = at(gap, second, BEYOND);
    double farther = at(gap, second.moved(here.outwards), BEYOND);
    // The middle, if the second gap is not wider (a groove of one cell, the body's end).
    const bool known = std::isfinite(far) && far > near && !at<Flag>(contact, second, 0);
    if (!known) {
        here.located = 0.5, here.slope = 0;
        return;
    }
    if (!std::isfinite(farther)) farther = NONE;
    double behind = at(gap, second.moved(here.across), BEYOND);
    double before = at(gap, second.moved(here.across, -1), BEYOND);
    if (!(std::isfinite(behind) && std::isfinite(before))) behind = before = 0;
    const auto power = [far](double of) { return std::cbrt(of / far * (of / far)); };
    here.slope = slope_of(power(behind), power(before), 1.0, power(near));
    here.located = at_least(1 - (law.distance(near, far, farther) - law.offset(here.slope)), -0.5);
}

// Where the pressure locates a receding rim.
void locate_by_pressures(Interval &here, const EdgeLaw &law, const Recession &recession) {
    if (!(at<Flag>(recession.opens, here.outer, 0) && at<Flag>(recession.falls, here.inner, 0)))
        return;
    const Cell second = here.inner.moved(here.outwards, -1);
    const auto pressure = [&](const Cell &cell) { return at(recession.pressure, cell, 0.0); };
    const double near = pressure(here.inner), far = pressure(second);
    const double farther = pressure(second.moved(here.outwards, -1));
    // A few cells between two rims do not tell them apart.
    const double beyond = pressure(here.inner.moved(here.outwards, -LEAST_CHORD));
    if (!(near > 0 && far > near && farther > 0 && beyond > 0)) return;
    const auto square = [far](double of) { return of / far * (of / far); };
    const double behind = square(pressure(second.moved(here.across)));
    const double before = square(pressure(second.moved(here.across, -1)));
    const double slope = -slope_of(behind, before, 1.0, square(near));
    const double distance = at_most(law.distance(near, far, farther) - law.offset(slope), 1.5);
    const bool left = at<Flag>(recession.left, here.outer.moved(here.outwards), 0);
    if (std::isnan(distance) || !(left || distance < here.located)) return;
    here.located = distance, here.slope = slope;
}

// Crossing of a chord between the nearest crossings along the other axis; not a number without
// both.
double chord(const Interval &here, const Field<Flag> &contact, const Rim &found) {
    const bool opens = here.slope > 0;
    const std::ptrdiff_t up = opens ? 1 : -1;
    const auto touches = [&](const Cell &cell, std::ptrdiff_t times) {
        return at<Flag>(contact, cell.moved(here.across, times), 0);
    };
    if (!(touches(here.inner, -up) && touches(here.outer, -up))) return NONE;
    if (touches(here.inner, up) || touches(here.outer, up)) return NONE;
    const auto &other = here.axis == 0 ? found.along_y : found.along_x;
    // From the line of centres up to the chord at the inner cell, down to it at the outer one.
    const double height = at(other, opens ? here.inner : here.inner.moved(here.across, -1), NONE);
    const double depth = at(other, opens ? here.outer.moved(here.across, -1) : here.outer, NONE);
    double descent = height + 1 - depth;
    if (std::abs(descent) < LEAST_DESCENT) descent = LEAST_DESCENT;
    return height / descent;
}

// Intervals of the part of an even block beyond its middle; in the middle nothing changes.
std::vector<Interval> changes(const Field<Flag> &contact, const Mirrored &mirrored) {
    std::vector<Interval> found;
    const Cell along_x{1, 0}, along_y{0, 1};
    const auto note = [&](int axis, std::ptrdiff_t i, std::ptrdiff_t j) {
        const Cell step = axis == 0 ? along_x : along_y, start{i, j}, end = start.moved(step);
        const bool begins_inside = contact.row(i)[j];
        Interval here{axis,
                      start,
                      begins_inside ? start : end,
                      begins_inside ? end : start,
                      {0, 0},
                      axis == 0 ? along_y : along_x};
        here.outwards = {here.outer.row - here.inner.row, here.outer.column - here.inner.column};
        found.push_back(here);
    };
    const std::ptrdiff_t first_row = mirrored.along_x ? contact.rows / 2 : 0;
    const std::ptrdiff_t first = mirrored.along_y ? contact.columns / 2 : 0;
    std::vector<Flag> marks(contact.columns, 0);
    for (std::ptrdiff_t i = first_row; i < contact.rows; ++i) {
        const Flag *row = contact.row(i), *next = i + 1 < contact.rows ? contact.row(i + 1) : row;
        for (std::ptrdiff_t j = 0; j < contact.columns; ++j) marks[j] = row[j] ^ next[j];
        for (std::ptrdiff_t j = 0; j + 1 < contact.columns; ++j) marks[j] |= row[j] ^ row[j + 1];
        each_marked(marks.data() + first, contact.columns - first, [&](std::ptrdiff_t beyond) {
            const std::ptrdiff_t j = first + beyond;
            if (row[j] != next[j]) note(0, i, j);
            if (j + 1 < contact.columns && row[j] != row[j + 1]) note(1, i, j);
        });
    }
    return found;
}

// Numbers of crossings up to which their memory is kept: 16 MB.
constexpr std::ptrdiff_t MOST_KEPT = 1 << 21;

// Crossings of the lines with the rim. There are few beside the contact's cells; all others stay
// not a number in memory that is kept.
class Crossings {
  public:
    Crossings(const Field<Flag> &contact, const Mirrored &mirrored) : mirrored_(mirrored) {
        thread_local std::vector<double> kept;
        const std::ptrdiff_t nx = contact.rows, ny = contact.columns, count = 2 * nx * ny;
        std::vector<double> &memory = count > MOST_KEPT ? own_ : kept;
        if (static_cast<std::ptrdiff_t>(memory.size()) < count) memory.assign(count, NONE);
        rim.along_x = {memory.data(), nx - 1, ny, ny};
        rim.along_y = {memory.data() + nx * ny, nx, ny - 1, ny};
    }

    ~Crossings() {
        for (double *each : written_) *each = NONE;
    }

    Crossings(const Crossings &) = delete;
    Crossings &operator=(const Crossings &) = delete;

    void write(const Interval &here) {
        const auto &along = here.axis == 0 ? rim.along_x : rim.along_y;
        const std::ptrdiff_t i = here.start.row, j = here.start.column;
        const std::ptrdiff_t image_i = along.rows - 1 - i, image_j = along.columns - 1 - j;
        const auto put = [&](std::ptrdiff_t row, std::ptrdiff_t column) {
            written_.push_back(along.row(row) + column);
            *written_.back() = here.located;
        };
        put(i, j);
        if (mirrored_.along_x) put(image_i, j);
        if (mirrored_.along_y) put(i, image_j);
        if (mirrored_.along_x && mirrored_.along_y) put(image_i, image_j);
    }

    Rim rim;

  private:
    Mirrored mirrored_;
    std::vector<double *> written_;
    std::vector<double> own_;  // of a large block
};

void locate(Crossings &crossings, const Field<Flag> &contact, const Field<double> &gap,
            const EdgeLaw (&gaps)[2], const EdgeLaw (&pressures)[2], const Recession *recession,
            const Rim *ends, const Mirrored &mirrored) {
    std::vector<Interval> oblique;
    for (Interval &here : changes(contact, mirrored)) {
        locate_by_gaps(here, gaps[here.axis], contact, gap);
        if (recession) locate_by_pressures(here, pressures[here.axis], *recession);
        if (ends && std::isinf(at(gap, here.outer, BEYOND))) {
            here.located = at(here.axis == 0 ? ends->along_x : ends->along_y, here.start, NONE);
            if (std::isnan(here.located)) here.located = 0.5;
        }
        // A line that the rim crosses at a small angle does not locate it well.
        if (std::abs(here.slope) > 1)
            oblique.push_back(here);
        else
            crossings.write(here);
    }
    for (Interval &here : oblique) {
        const double by_chord = chord(here, contact, crossings.rim);
        if (!std::isnan(by_chord)) here.located = by_chord;
    }
    for (const Interval &here : oblique) crossings.write(here);
}

template <class Number>
Field<Number> part(const Field<Number> &of, const Block &block, bool less_rows, bool less_columns) {
    return {of.row(block.first_row) + block.first_column,
            block.last_row - block.first_row - less_rows,
            block.last_column - block.first_column - less_columns, of.distance};
}

}  // namespace

Extent trace_rim(const Field<Flag> &contact, const Field<double> &gap, const EdgeLaw (&gaps)[2],
                 const EdgeLaw (&pressures)[2], const Recession *recession, const Rim *ends,
                 const Mirrored &mirrored, const Block &inner, double segment) {
    Crossings crossings(contact, mirrored);
    locate(crossings, contact, gap, gaps, pressures, recession, ends, mirrored);
    const Rim rim{part(crossings.rim.along_x, inner, true, false),
                  part(crossings.rim.along_y, inner, false, true)};
    return extent_of(part(contact, inner, false, false), rim, segment);
}

}  // namespace viscontact
