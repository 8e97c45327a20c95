// Conversion of NumPy arrays.
#include "arrays.hpp"

#include <cmath>
#include <cstring>

#include <fmt/core.h>

#include <dsc/base/error.hpp>

namespace dsc::python {
namespace {

using Shape = std::vector<py::ssize_t>;

std::string shape_text(const py::array& array) {
    std::string text = "(";
    for (py::ssize_t k = 0; k < array.ndim(); ++k)
        text += (k == 0 ? "" : ", ") + std::to_string(array.shape(k));
    return text + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void refuse(const char* code, const std::string& name, const std::string& cause,
                         const std::string& remedy) {
    throw UsageError(code, name, cause, remedy);
}

/// The array of an argument, with numbers of a kind out of `kinds` ("fiub": NumPy's letters).
py::array array_from(const py::handle& values, const std::string& name, std::string_view kinds,
                     const std::string& wanted) {
    py::array array;
    try {
        array = py::array::ensure(values);
    } catch (const py::error_already_set&) {
        PyErr_Clear();
    }
    if (!array || values.is_none()) {
        PyErr_Clear();
        refuse("array.type", name,
               fmt::format("is {}, which is not an array of numbers",
                           std::string(py::str(py::type::of(values).attr("__name__")))),
               "give " + wanted);
    }
    if (kinds.find(array.dtype().kind()) == std::string_view::npos) {
        refuse(
            "array.type", name,
            fmt::format("has the data type {}", std::string(py::str(array.dtype()))),
            "give " + wanted +
                (array.dtype().kind() == 'b' ? "; numpy.flatnonzero(mask) makes indices of a mask"
                                             : ""));
    }
    return array;
}

/// `columns` 0: one dimension.
void require_shape(const py::array& array, const std::string& name, std::size_t columns,
                   const std::string& wanted) {
    const py::ssize_t dimensions = columns == 0 ? 1 : 2;
    const bool fits = array.ndim() == dimensions &&
                      (columns == 0 || array.shape(1) == static_cast<py::ssize_t>(columns));
    if (!fits) refuse("array.shape", name, "has the shape " + shape_text(array), "give " + wanted);
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::size_t rows_of(const py::array& array) { return static_cast<std::size_t>(array.shape(0)); }

void require_finite(const Numbers& numbers, const std::string& name, std::size_t columns) {
    const double* const data = numbers.data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(numbers.size()); ++i) {
        if (std::isfinite(data[i])) continue;
        refuse("array.not_finite", name,
               fmt::format("contains {} in row {}",
                           std::isnan(data[i]) ? "NaN" : "an infinite number", i / columns),
               "leave out such rows, for example points[numpy.isfinite(points).all(axis=1)]");
    }
}

/// Real numbers in C order; `columns` 0: one dimension.
Numbers numbers_of(const py::handle& values, const std::string& name, std::size_t columns) {
    const std::string wanted =
        columns == 0 ? "an array of real numbers of shape (n,)"
                     : fmt::format("an array of real numbers of shape (n, {})", columns);
    const py::array array = array_from(values, name, "fiu", wanted);
    require_shape(array, name, columns, wanted);
    return Numbers(array);
}

std::vector<Vec3> vectors_of(const Numbers& numbers) {
    std::vector<Vec3> vectors(rows_of(numbers));
    if (!vectors.empty())
        std::memcpy(static_cast<void*>(vectors.data()), numbers.data(),
                    vectors.size() * sizeof(Vec3));
    return vectors;
}

/// Integers in C order, each from 0 to below `limit`.
Integers integers_from(const py::handle& values, const std::string& name, std::size_t columns,
                       std::size_t limit, const std::string& wanted) {
    const py::array array = array_from(values, name, "iu", wanted);
    require_shape(array, name, columns, wanted);
    const Integers integers(array);
    for (std::size_t i = 0; i < static_cast<std::size_t>(integers.size()); ++i) {
        const std::int64_t value = integers.data()[i];
        if (value >= 0 && static_cast<std::uint64_t>(value) < limit) continue;
        refuse("array.range", name,
               fmt::format("contains {} in row {}", value, i / std::max<std::size_t>(columns, 1)),
               fmt::format("give integers from 0 to {}", limit == 0 ? 0 : limit - 1));
    }
    return integers;
}

template <class T>
py::array owned(const T* data, std::size_t rows, std::size_t columns) {
    Shape shape = {static_cast<py::ssize_t>(rows)};
    if (columns > 0) shape.push_back(static_cast<py::ssize_t>(columns));
    py::array_t<T> array(shape);
    if (array.size() > 0)
        std::memcpy(array.mutable_data(), data, static_cast<std::size_t>(array.size()) * sizeof(T));
    return array;
}

}  // namespace

std::vector<Vec3> vectors_from(const py::handle& values, const std::string& name) {
    const Numbers numbers = numbers_of(values, name, 3);
    require_finite(numbers, name, 3);
    return vectors_of(numbers);
}

std::vector<Vec3> answer_from(const py::handle& values, const std::string& name, std::size_t rows) {
    const Numbers numbers = numbers_of(values, name, 3);
    require_size(rows_of(numbers), rows, name, "vertices");
    return vectors_of(numbers);
}

std::vector<double> numbers_answer_from(const py::handle& values, const std::string& name,
                                        std::size_t rows) {
    const Numbers numbers = numbers_of(values, name, 0);
    require_size(rows_of(numbers), rows, name, "vertices");
    return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<double> numbers_from(const py::handle& values, const std::string& name) {
    const Numbers numbers = numbers_of(values, name, 0);
    require_finite(numbers, name, 1);
    return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<cloud::Colour> colours_from(const py::handle& values, const std::string& name) {
    const std::string wanted =
        "an array of shape (n, 3), integers from 0 to 255 or real numbers from 0 to 1";
    const py::array array = array_from(values, name, "fiu", wanted);
    require_shape(array, name, 3, wanted);
    const bool real = array.dtype().kind() == 'f';
    const Numbers numbers(array);
    require_finite(numbers, name, 3);
    std::vector<cloud::Colour> colours(rows_of(numbers));
    for (std::size_t i = 0; i < 3 * colours.size(); ++i) {
        const double value = numbers.data()[i];
        if (value < 0.0 || value > (real ? 1.0 : 255.0)) {
            refuse("array.range", name, fmt::format("contains {} in row {}", value, i / 3),
                   "give " + wanted);
        }
        colours[i / 3][i % 3] =
            static_cast<std::uint8_t>(std::lround(real ? 255.0 * value : value));
    }
    return colours;
}

template <std::size_t Width>
std::vector<std::array<std::uint32_t, Width>> rows_from(const py::handle& values,
                                                        const std::string& name,
                                                        std::size_t limit) {
    const Integers integers = integers_from(
        values, name, Width, limit, fmt::format("an array of integers of shape (n, {})", Width));
    std::vector<std::array<std::uint32_t, Width>> rows(rows_of(integers));
    for (std::size_t i = 0; i < rows.size() * Width; ++i)
        rows[i / Width][i % Width] = static_cast<std::uint32_t>(integers.data()[i]);
    return rows;
}
template std::vector<std::array<std::uint32_t, 2>> rows_from<2>(const py::handle&,
                                                                const std::string&, std::size_t);
template std::vector<std::array<std::uint32_t, 3>> rows_from<3>(const py::handle&,
                                                                const std::string&, std::size_t);
template std::vector<std::array<std::uint32_t, 4>> rows_from<4>(const py::handle&,
                                                                const std::string&, std::size_t);

std::vector<std::uint32_t> indices_from(const py::handle& values, const std::string& name,
                                        std::size_t limit) {
    const Integers integers =
        integers_from(values, name, 0, limit, "an array of integers of shape (n,)");
    std::vector<std::uint32_t> indices(rows_of(integers));
    for (std::size_t i = 0; i < indices.size(); ++i)
        indices[i] = static_cast<std::uint32_t>(integers.data()[i]);
    return indices;
}

void require_size(std::size_t size, std::size_t wanted, const std::string& name,
                  const std::string& of) {
    if (size == wanted) return;
    refuse("array.shape", name, fmt::format("has {} rows, but there are {} {}", size, wanted, of),
           fmt::format("give one row per row of {}", of));
}

py::array copy_of(const std::vector<Vec3>& values) {
    return owned(reinterpret_cast<const double*>(values.data()), values.size(), 3);
}
py::array copy_of(const std::vector<double>& values) {
    return owned(values.data(), values.size(), 0);
}
py::array copy_of(const std::vector<std::int32_t>& values) {
    return owned(values.data(), values.size(), 0);
}
py::array copy_of(const std::vector<std::uint32_t>& values) {
    return owned(values.data(), values.size(), 0);
}
py::array copy_of(const std::vector<cloud::Colour>& values) {
    return owned(reinterpret_cast<const std::uint8_t*>(values.data()), values.size(), 3);
}
py::array copy_of(const std::vector<bool>& values) {
    py::array_t<bool> array(static_cast<py::ssize_t>(values.size()));
    std::copy(values.begin(), values.end(), array.mutable_data());
    return array;
}
template <std::size_t Width>
py::array copy_of(const std::vector<std::array<std::uint32_t, Width>>& values) {
    return owned(reinterpret_cast<const std::uint32_t*>(values.data()), values.size(), Width);
}
template py::array copy_of<3>(const std::vector<std::array<std::uint32_t, 3>>&);
template py::array copy_of<4>(const std::vector<std::array<std::uint32_t, 4>>&);

template <class T>
py::array view_of(const T* data, std::size_t rows, std::size_t columns, std::size_t stride) {
    Shape shape = {static_cast<py::ssize_t>(rows)};
    Shape strides = {static_cast<py::ssize_t>(stride)};
    if (columns > 0) {
        shape.push_back(static_cast<py::ssize_t>(columns));
        strides.push_back(static_cast<py::ssize_t>(sizeof(T)));
    }
    // With a base NumPy copies nothing; it owns nothing either.
    py::array array(py::dtype::of<T>(), shape, strides, data, py::none());
    array.attr("setflags")(py::arg("write") = false);
    return array;
}
template py::array view_of(const bool*, std::size_t, std::size_t, std::size_t);
template py::array view_of(const double*, std::size_t, std::size_t, std::size_t);
template py::array view_of(const std::uint8_t*, std::size_t, std::size_t, std::size_t);
template py::array view_of(const std::uint32_t*, std::size_t, std::size_t, std::size_t);
template py::array view_of(const std::int32_t*, std::size_t, std::size_t, std::size_t);

py::array view_of(const Vec3* data, std::size_t size) {
    return view_of(reinterpret_cast<const double*>(data), size, 3, sizeof(Vec3));
}

}  // namespace dsc::python
