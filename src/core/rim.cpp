#include "rim.hpp"

#include <cmath>

#include "rows.hpp"

namespace viscontact {

namespace {

// As in straight_edge.py and rim_crossings.py.
constexpr double MAX_CURVATURE = 0.3, MAX_DISTANCE = 1.5, LEAST_DESCENT = 1e-6;
constexpr std::ptrdiff_t LEAST_CHORD = 4;

struct Cell {
    std::ptrdiff_t row, column;

    Cell moved(const Cell &step, std::ptrdiff_t times = 1) const {
        return {row + times * step.row, column + times * step.column};
    }
};

template <class Number>
Number at(const Field<Number> &field, const Cell &cell, Number outside) {
    if (cell.row < 0 || cell.column < 0 || cell.row >= field.rows || cell.column >= field.columns)
        return outside;
    return field.row(cell.row)[cell.column];
}

// Interval between neighbouring centres in which contact changes.
struct Interval {
    int axis;  // 0: along x
    Cell start, inner, outer;
    Cell outwards, across;  // steps to the open cell and to the next line
    double located = NONE, slope = 0;
};

double at_most(double value, double limit) { return value > limit ? limit : value; }

double at_least(double value, double limit) { return value < limit ? limit : value; }

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

}  // namespace

double EdgeLaw::distance(double first, double second, double third) const {
    const double b = first_growth, c = second_growth, slack = second - (1 + b) * first;
    const double t = first < MAX_DISTANCE * slack ? first / slack : MAX_DISTANCE;
    // Change of t with the curvature, and second and third gap over the slope of the first: by the
    // law, and what a unit curvature adds.
    const double shift = -t * (1 + t) / 2;
    const double second_gap = 1 + (1 + b) * t, third_gap = 2 + b + (1 + b + c) * t;
    const double second_bend = ((1 + t) * (1 + t) + b * (t * t)) / 2 - (1 + b) * shift;
    const double third_bend =
        ((2 + t) * (2 + t) + b * ((1 + t) * (1 + t)) + c * (t * t)) / 2 - (1 + b + c) * shift;
    const double ratio = std::isnan(third) ? third_gap / second_gap : third / second;
    const double curvature = (ratio * second_gap - third_gap) / (third_bend - ratio * second_bend);
    return threshold + t - at_most(at_least(curvature, -MAX_CURVATURE), MAX_CURVATURE) * shift;
}

double EdgeLaw::offset(double slope) const {
    const double size = std::abs(slope);
    if (size >= slopes.back()) return offsets.back();
    if (slopes.size() == 1 || !(size > slopes.front()))
        return std::isnan(size) ? size : offsets.front();
    std::size_t k = 0;
    while (k + 2 < slopes.size() && size >= slopes[k + 1]) ++k;
    const double part = (offsets[k + 1] - offsets[k]) / (slopes[k + 1] - slopes[k]);
    return part * (size - slopes[k]) + offsets[k];
}

namespace {

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

// Writes how many corners of each square are inside, 0 in place of all four; returns how many
// squares have all four.
FOR_PROCESSORS
std::ptrdiff_t count_corners(const Flag *near, const Flag *far, std::ptrdiff_t squares,
                             Flag *count) {
    std::int32_t whole = 0;
    for (std::ptrdiff_t j = 0; j < squares; ++j)
        count[j] = near[j] + near[j + 1] + far[j] + far[j + 1];
#pragma omp simd reduction(+ : whole)
    for (std::ptrdiff_t j = 0; j < squares; ++j) whole += count[j] >> 2;
    for (std::ptrdiff_t j = 0; j < squares; ++j) count[j] &= 3;
    return whole;
}

double enclosed_squares(const Field<Flag> &contact, const Rim &rim, double segment) {
    const auto crossing = [](double value) { return std::isnan(value) ? 0.0 : value; };
    double enclosed = 0;
    std::vector<Flag> count(contact.columns);
    const std::ptrdiff_t squares = contact.columns - 1;
    for (std::ptrdiff_t i = 0; i + 1 < contact.rows; ++i) {
        const Flag *near = contact.row(i), *far = contact.row(i + 1);
        const double *along_x = rim.along_x.row(i);
        const double *lower_y = rim.along_y.row(i), *upper_y = rim.along_y.row(i + 1);
        enclosed += static_cast<double>(count_corners(near, far, squares, count.data()));
        each_marked(count.data(), squares, [&](std::ptrdiff_t j) {
            const double left = crossing(along_x[j]), right = crossing(along_x[j + 1]);
            const double lower = crossing(lower_y[j]), upper = crossing(upper_y[j]);
            const double u = left + right, v = lower + upper;
            // One corner inside: a triangle. Two neighbours: a trapezium between the crossings of
            // the two edges that leave their side. Three: the square without a triangle. Signed
            // areas where a crossing lies beyond the square: their sum is that of the polygons.
            if (count[j] == 1)
                enclosed += u * v / 2 + segment;
            else if (count[j] == 3)
                enclosed += 1 - (1 - u) * (1 - v) / 2 - segment;
            else if (near[j] != far[j + 1])
                enclosed += (u + v) / 2;
            else  // opposite corners: two separate triangles
                enclosed +=
                    (near[j] ? left * lower + right * upper : left * upper + right * lower) / 2 +
                    2 * segment;
        });
    }
    return enclosed;
}

// Extent along one axis, by flags and crossings at (line, place on it).
template <class Contact, class Crossing>
double extent(std::ptrdiff_t lines, std::ptrdiff_t places, std::ptrdiff_t first,
              std::ptrdiff_t last, Contact contact, Crossing crossing) {
    double begin = static_cast<double>(lines - 1), end = 0;
    // A crossing lies between half a cell inside and one outside of its inner centre: two lines
    // contain the extreme ones. A chord may cross its line elsewhere.
    const auto each = [&](std::ptrdiff_t line, auto note) {
        for (std::ptrdiff_t at = std::max<std::ptrdiff_t>(line - 1, 0);
             at < std::min(line + 1, lines - 1); ++at)
            for (std::ptrdiff_t place = 0; place < places; ++place)
                if (std::abs(crossing(at, place)) <= 1) note(at, place, static_cast<double>(at));
    };
    each(first, [&](std::ptrdiff_t at, std::ptrdiff_t place, double centre) {
        if (contact(at + 1, place)) begin = std::min(begin, centre + 1 - crossing(at, place));
    });
    each(last, [&](std::ptrdiff_t at, std::ptrdiff_t place, double centre) {
        if (contact(at, place)) end = std::max(end, centre + crossing(at, place));
    });
    return end - begin;
}

}  // namespace

std::array<std::ptrdiff_t, 4> spans(const Field<Flag> &cells) {
    std::ptrdiff_t first_row = -1, last_row = -1, first = cells.columns, last = -1;
    for (std::ptrdiff_t i = 0; i < cells.rows; ++i) {
        const Flag *row = cells.row(i), *end = row + cells.columns;
        const auto *begin = static_cast<const Flag *>(std::memchr(row, 1, cells.columns));
        if (!begin) continue;
        if (first_row < 0) first_row = i;
        last_row = i;
        first = std::min<std::ptrdiff_t>(first, begin - row);
        while (!*(end - 1)) --end;
        last = std::max<std::ptrdiff_t>(last, end - row - 1);
    }
    return {first_row, last_row, last < 0 ? -1 : first, last};
}

namespace {

Extent measured(const Field<Flag> &contact, const Rim &rim, double segment) {
    Extent found{enclosed_squares(contact, rim, segment), 0, 0, 0, 0};
    const auto [first_row, last_row, first_column, last_column] = spans(contact);
    std::vector<Flag> touched(contact.columns, 0);
    for (std::ptrdiff_t i = 0; i < contact.rows; ++i) {
        const Flag *row = contact.row(i);
        found.rows += std::memchr(row, 1, contact.columns) != nullptr;
        for (std::ptrdiff_t j = 0; j < contact.columns; ++j) touched[j] |= row[j];
    }
    found.columns = std::count(touched.begin(), touched.end(), Flag{1});
    if (found.rows == 0) return found;
    found.along_x = extent(
        contact.rows, contact.columns, first_row, last_row,
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return contact.row(line)[place]; },
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return rim.along_x.row(line)[place]; });
    found.along_y = extent(
        contact.columns, contact.rows, first_column, last_column,
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return contact.row(place)[line]; },
        [&](std::ptrdiff_t line, std::ptrdiff_t place) { return rim.along_y.row(place)[line]; });
    return found;
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
    return measured(part(contact, inner, false, false), rim, segment);
}

namespace {

FOR_PROCESSORS
std::int32_t count(const Flag *row, std::ptrdiff_t cells) {
    std::int32_t found = 0;
#pragma omp simd reduction(+ : found)
    for (std::ptrdiff_t j = 0; j < cells; ++j) found += row[j];
    return found;
}

// Marked cells whose partners in another row are not.
FOR_PROCESSORS
std::int32_t count_without(const Flag *row, const Flag *other, std::ptrdiff_t cells) {
    std::int32_t found = 0;
#pragma omp simd reduction(+ : found)
    for (std::ptrdiff_t j = 0; j < cells; ++j) found += row[j] & ~other[j];
    return found;
}

// Cells in contact, and the numbers of chords of consecutive ones along x and y.
std::array<std::ptrdiff_t, 3> chords(const Field<Flag> &contact) {
    std::array<std::ptrdiff_t, 3> found{};
    const std::vector<Flag> nothing(contact.columns, 0);
    for (std::ptrdiff_t i = 0; i < contact.rows; ++i) {
        const Flag *row = contact.row(i), *before = i ? contact.row(i - 1) : nothing.data();
        found[0] += count(row, contact.columns);
        found[1] += count_without(row, before, contact.columns);
        found[2] += row[0] + count_without(row + 1, row, contact.columns - 1);
    }
    return found;
}

}  // namespace

double Segments::of(const Field<Flag> &contact, const Field<double> &gap) const {
    const auto [cells, lines_x, lines_y] = chords(contact);
    if (cells == 0) return whole;
    const double count = static_cast<double>(cells);
    const double along_x = count / static_cast<double>(lines_x);
    const double along_y = count / static_cast<double>(lines_y);
    // Crossings at the body's outline have no such error.
    std::ptrdiff_t at_end = 0, outside = 0;
    for (std::ptrdiff_t i = 0; i < gap.rows; ++i) {
        const double *row = gap.row(i);
        int here = 0;
        for (std::ptrdiff_t j = 0; j < gap.columns; ++j) here += std::abs(row[j]) == BEYOND;
        outside += here;
    }
    for (std::ptrdiff_t i = 0; outside && i < contact.rows; ++i) {
        const Flag *row = contact.row(i);
        for (std::ptrdiff_t j = 0; j < contact.columns; ++j) {
            if (!row[j]) continue;
            const auto beyond = [&](std::ptrdiff_t r, std::ptrdiff_t c) {
                return std::isinf(at(gap, {r, c}, 0.0));
            };
            at_end += beyond(i - 1, j) + beyond(i + 1, j) + beyond(i, j - 1) + beyond(i, j + 1);
        }
    }
    double by_gap = 1;
    if (at_end) {
        const double ends = 2 * count * (1 / along_x + 1 / along_y);
        by_gap = std::max(1 - static_cast<double>(at_end) / ends, 0.0);
    }
    const double lost = loss / std::max(std::sqrt(along_x * along_y), 1.0);
    return whole * (1 - by_gap * std::min(lost, 1 - least));
}

}  // namespace viscontact
