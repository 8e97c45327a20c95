#pragma once
// NumPy arrays in and out.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <dsc/cloud/cloud.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::python {

namespace py = pybind11;

/// Vectors of an argument: an array-like of shape (n, 3) of finite real numbers, of any layout.
/// Throws UsageError "array.type", "array.shape", "array.not_finite", each with the name of the
/// argument.
std::vector<Vec3> vectors_from(const py::handle& values, const std::string& name);

/// Real numbers of shape (n,), finite. Throws the same.
std::vector<double> numbers_from(const py::handle& values, const std::string& name);

/// What a strategy returned: `rows` vectors or numbers, which need not be finite, because the host
/// tests this. Throws UsageError "array.type", "array.shape".
std::vector<Vec3> answer_from(const py::handle& values, const std::string& name, std::size_t rows);
std::vector<double> numbers_answer_from(const py::handle& values, const std::string& name,
                                        std::size_t rows);

/// Colours of shape (n, 3): integers 0 to 255 or real numbers 0 to 1. Throws the same and
/// UsageError "array.range".
std::vector<cloud::Colour> colours_from(const py::handle& values, const std::string& name);

/// Rows of `Width` indices below `limit`, shape (n, Width). Throws the same.
template <std::size_t Width>
std::vector<std::array<std::uint32_t, Width>> rows_from(const py::handle& values,
                                                        const std::string& name, std::size_t limit);
/// Integers of shape (n,) that fit into 32 bits, at least 0. Throws the same.
std::vector<std::uint32_t> indices_from(const py::handle& values, const std::string& name,
                                        std::size_t limit);

/// Throws UsageError "array.shape" if the sizes differ.
void require_size(std::size_t size, std::size_t wanted, const std::string& name,
                  const std::string& of);

/// A new array that owns a copy of the values.
py::array copy_of(const std::vector<Vec3>& values);
py::array copy_of(const std::vector<double>& values);
py::array copy_of(const std::vector<std::int32_t>& values);
py::array copy_of(const std::vector<std::uint32_t>& values);
py::array copy_of(const std::vector<cloud::Colour>& values);
py::array copy_of(const std::vector<bool>& values);
template <std::size_t Width>
py::array copy_of(const std::vector<std::array<std::uint32_t, Width>>& values);

/// A read-only array on memory that somebody else owns: `rows` rows of `columns` elements, the rows
/// `stride` bytes apart; one-dimensional if `columns` is 0.
template <class T>
py::array view_of(const T* data, std::size_t rows, std::size_t columns, std::size_t stride);

/// The same for contiguous vectors.
py::array view_of(const Vec3* data, std::size_t size);
template <class T>
py::array view_of(const T* data, std::size_t size) {
    return view_of(data, size, 0, sizeof(T));
}

}  // namespace dsc::python
