#pragma once
// Common parts of the VTK formats: conversion of arrays, threads, and capture of VTK's messages.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLReader.h>
#include <vtkXMLWriter.h>

#include <dsc/geometry/vec.hpp>
#include <dsc/io/data_array.hpp>

namespace dsc::io {

/// During its lifetime, VTK works on the thread that calls it. Otherwise it starts a thread per
/// core, whatever number of threads the user has chosen.
class OneThreadScope {
public:
    OneThreadScope();
    ~OneThreadScope();
    OneThreadScope(const OneThreadScope&) = delete;
    OneThreadScope& operator=(const OneThreadScope&) = delete;

private:
    std::string before_;  // VTK's name of the way in which loops run
};

class VtkMessages;

/// During its lifetime, VTK's messages are collected here and not printed.
class CaptureScope {
public:
    CaptureScope();
    ~CaptureScope();
    CaptureScope(const CaptureScope&) = delete;
    CaptureScope& operator=(const CaptureScope&) = delete;

    bool quiet() const;
    /// The first meaningful line of VTK's messages, without its object and file names.
    std::string cause() const;

private:
    vtkSmartPointer<vtkOutputWindow> before_;
    vtkLogger::Verbosity verbosity_;
    vtkSmartPointer<VtkMessages> capture_;
};

template <class Array, class Value>
vtkSmartPointer<Array> make_array(const char* name, const std::vector<Value>& values) {
    auto array = vtkSmartPointer<Array>::New();
    if (name != nullptr) array->SetName(name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
}

/// Reads a file's content. Throws IoError "io.syntax" with the message that `capture` has caught.
void read_content(vtkXMLReader& reader, const std::string& content, std::string_view file,
                  const CaptureScope& capture);

/// The file with this data; its numbers are appended in binary form, compressed with zlib if this
/// is requested. Throws IoError "io.write" with the remedy.
std::string written(vtkXMLWriter& writer, vtkDataObject* data, bool compressed,
                    std::string_view file, std::string_view remedy);

/// As doubles; every bit is kept.
vtkSmartPointer<vtkPoints> make_points(const std::vector<Vec3>& points);

/// Cells of N corners each.
template <class Corners>
vtkSmartPointer<vtkCellArray> make_cells(const std::vector<Corners>& cells) {
    constexpr std::size_t size = std::tuple_size_v<Corners>;
    vtkNew<vtkTypeInt64Array> offsets, corners;
    offsets->SetNumberOfTuples(static_cast<vtkIdType>(cells.size() + 1));
    corners->SetNumberOfTuples(static_cast<vtkIdType>(size * cells.size()));
    vtkTypeInt64* offset = offsets->GetPointer(0);
    vtkTypeInt64* corner = corners->GetPointer(0);
    for (std::size_t i = 0; i <= cells.size(); ++i) *offset++ = static_cast<vtkTypeInt64>(size * i);
    for (const Corners& cell : cells) corner = std::copy(cell.begin(), cell.end(), corner);
    auto out = vtkSmartPointer<vtkCellArray>::New();
    out->SetData(offsets, corners);
    return out;
}

/// Throws IoError "io.not_finite" for a point that is NaN or infinite.
std::vector<Vec3> points_of(vtkPointSet& data, std::string_view file);

/// The array if it has a name and contains doubles, `components` of them per element; else null.
vtkDoubleArray* doubles_of(vtkFieldData& data, int index, int components, std::size_t elements);

/// Appends all arrays of one double per element.
void read_arrays(vtkFieldData& from, std::size_t elements, std::vector<DataArray>& out);

}  // namespace dsc::io
