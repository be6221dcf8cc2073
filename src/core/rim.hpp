// Rim of a contact between cell centres: see rim_crossings.py, whose rules these are, interval by
// interval, and rim_extent.py.
#pragma once

#include <array>

#include "fields.hpp"
#include "straight_edge.hpp"

namespace viscontact {

// Where a contact recedes.
struct Recession {
    Field<double> pressure;
    Field<Flag> falls, opens, left;
};

struct Rim {
    Field<double> along_x, along_y;
};

// Axes along which a block of cells is even about its own middle.
struct Mirrored {
    bool along_x, along_y;
};

// A block of cells: first rows and columns, and those after the last ones.
struct Block {
    std::ptrdiff_t first_row, last_row, first_column, last_column;
};

// Extent of a contact: squares between four neighbouring centres that the polygons through the
// crossings enclose, extents between its farthest crossings along x and y, in cells, and the
// numbers of rows and columns that it touches.
struct Extent {
    double squares, along_x, along_y;
    std::ptrdiff_t rows, columns;
};

// Measures a contact by the crossings of its rim, and the area between rim and chord per quarter
// turn.
Extent extent_of(const Field<Flag> &contact, const Rim &rim, double segment);

// Locates the rim, and measures the contact in an inner block. Ends are distances to the body's
// outline along x, shape (nx - 1, ny), and y, (nx, ny - 1); laws are those along x and y.
Extent trace_rim(const Field<Flag> &contact, const Field<double> &gap, const EdgeLaw (&gaps)[2],
                 const EdgeLaw (&pressures)[2], const Recession *recession, const Rim *ends,
                 const Mirrored &mirrored, const Block &inner, double segment);

// Area between the rim and its chords per quarter turn: `whole` of it, of which `loss` over the
// mean chord is the error of crossings by the gap, as long as a `least` part is left.
struct Segments {
    double whole, loss, least;

    double of(const Field<Flag> &contact, const Field<double> &gap) const;
};

// First and last rows and columns with marked cells; -1 without any.
std::array<std::ptrdiff_t, 4> spans(const Field<Flag> &cells);

}  // namespace viscontact
