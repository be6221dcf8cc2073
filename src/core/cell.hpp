// A cell by its row and column, and the value of a field there.
#pragma once

#include "fields.hpp"

namespace viscontact {

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

}  // namespace viscontact
