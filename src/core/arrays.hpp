// Arrays of Python as fields of the core, of one kind and one shape, or refused.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <type_traits>

#include "fields.hpp"
#include "plane.hpp"

namespace nb = nanobind;

template <class Number>
using Array = nb::ndarray<Number, nb::ndim<2>, nb::device::cpu>;

// Numbers of rows and columns.
struct Shape {
    std::ptrdiff_t rows, columns;
};

template <class Number>
Shape shape_of(const Array<Number> &array) {
    return {static_cast<std::ptrdiff_t>(array.shape(0)),
            static_cast<std::ptrdiff_t>(array.shape(1))};
}

inline Shape shape_of(const viscontact::Plane &plane) { return {plane.rows(), plane.columns()}; }

// Booleans are one byte each in NumPy.
template <class Number>
using Stored = std::conditional_t<std::is_same_v<std::remove_const_t<Number>, bool>,
                                  viscontact::Flag, std::remove_const_t<Number>>;

// The memory of an array of a shape; what is beyond it is not to be touched. Inputs may be
// read-only, and are not written to.
template <class Number>
viscontact::Field<Stored<Number>> field(const Shape &shape, const Array<Number> &array) {
    const Shape own = shape_of(array);
    if (own.rows != shape.rows || own.columns != shape.columns)
        throw std::invalid_argument("the arrays do not have the same shape");
    if (own.columns > 1 && array.stride(1) != 1)
        throw std::invalid_argument("the numbers of a row must be contiguous");
    const void *first = array.data();
    return {static_cast<Stored<Number> *>(const_cast<void *>(first)), own.rows, own.columns,
            array.stride(0)};
}

template <class Number>
auto field(const viscontact::Plane &plane, const Array<Number> &array) {
    return field(shape_of(plane), array);
}

// An array is never converted: results written to a copy would be lost.
template <class Given>
auto argument() {
    if constexpr (std::is_arithmetic_v<std::decay_t<Given>>)
        return nb::arg();
    else
        return nb::arg().noconvert();
}

template <class... Given, class Found>
void define_with(nb::module_ &module, const char *name, Found (*work)(Given...)) {
    module.def(name, work, nb::call_guard<nb::gil_scoped_release>(), argument<Given>()...);
}

// Defines a function that runs without the lock of Python.
template <class Work>
void define(nb::module_ &module, const char *name, Work work) {
    define_with(module, name, +work);
}

void define_search(nb::module_ &module);
void define_history(nb::module_ &module);
void define_rim(nb::module_ &module);
void define_filters(nb::module_ &module);
void define_advance(nb::module_ &module);
