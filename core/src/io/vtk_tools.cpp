// Arrays, threads and messages of VTK.
#include "io/vtk_tools.hpp"

#include <SMP/Common/vtkSMPToolsAPI.h>  // because vtkSMPTools.h of VTK 9.1 is not valid C++20
#include <fmt/core.h>
#include <vtkDoubleArray.h>
#include <vtkObjectFactory.h>

#include <dsc/text/reading.hpp>

#include "io/vtu_check.hpp"

namespace dsc::io {
namespace {

vtk::detail::smp::vtkSMPToolsAPI& loops() {
    return vtk::detail::smp::vtkSMPToolsAPI::GetInstance();
}

}  // namespace

OneThreadScope::OneThreadScope() : before_(loops().GetBackend()) {
    loops().SetBackend("Sequential");
}
OneThreadScope::~OneThreadScope() { loops().SetBackend(before_.c_str()); }

/// Receives the messages that VTK would print.
class VtkMessages : public vtkOutputWindow {
public:
    static VtkMessages* New() { VTK_STANDARD_NEW_BODY(VtkMessages); }
    void DisplayText(const char* text) override {
        if (text != nullptr) text_ += text;
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

CaptureScope::CaptureScope()
    : before_(vtkOutputWindow::GetInstance()),
      verbosity_(vtkLogger::GetCurrentVerbosityCutoff()),
      capture_(vtkSmartPointer<VtkMessages>::New()) {
    vtkOutputWindow::SetInstance(capture_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

CaptureScope::~CaptureScope() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
}

bool CaptureScope::quiet() const { return capture_->text().empty(); }

std::string CaptureScope::cause() const {
    text::Lines lines(capture_->text(), "");
    for (std::string_view line; lines.next(line);) {
        const std::size_t colon = line.find("): ");
        if (colon != std::string_view::npos) return std::string(line.substr(colon + 3));
    }
    return "it is not a readable VTK file";
}

void read_content(vtkXMLReader& reader, const std::string& content, std::string_view file,
                  const CaptureScope& capture) {
    reader.ReadFromInputStringOn();
    reader.SetInputString(with_point_data(content));
    reader.Update();
    if (reader.GetErrorCode() != 0 || !capture.quiet())
        text::fail("io.syntax", {file, 0}, "VTK refuses it: " + capture.cause(), text::copy_again);
}

std::string written(vtkXMLWriter& writer, vtkDataObject* data, bool compressed,
                    std::string_view file, std::string_view remedy) {
    const CaptureScope capture;
    writer.SetInputData(data);
    writer.SetDataModeToAppended();
    writer.EncodeAppendedDataOff();
    if (compressed) {
        writer.SetCompressorTypeToZLib();
    } else {
        writer.SetCompressorTypeToNone();
    }
    writer.SetHeaderTypeToUInt64();
    writer.WriteToOutputStringOn();
    if (writer.Write() == 0 || writer.GetErrorCode() != 0 || !capture.quiet())
        text::fail("io.write", {file, 0}, "VTK cannot write it: " + capture.cause(), remedy);
    return writer.GetOutputString();
}

vtkSmartPointer<vtkPoints> make_points(const std::vector<Vec3>& points) {
    vtkNew<vtkDoubleArray> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
    double* to = coordinates->GetPointer(0);
    for (const Vec3& p : points) to = std::copy(p.data(), p.data() + 3, to);
    auto out = vtkSmartPointer<vtkPoints>::New();
    out->SetDataTypeToDouble();
    out->SetData(coordinates);
    return out;
}

std::vector<Vec3> points_of(vtkPointSet& data, std::string_view file) {
    std::vector<Vec3> out;
    const vtkIdType count = data.GetNumberOfPoints();
    out.reserve(static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i) {
        Vec3 p;
        data.GetPoints()->GetPoint(i, p.data());
        if (!p.allFinite()) {
            text::fail("io.not_finite", {file, 0}, fmt::format("point {} is NaN or infinite", i),
                       "export the file again");
        }
        out.push_back(p);
    }
    return out;
}

vtkDoubleArray* doubles_of(vtkFieldData& data, int index, int components, std::size_t elements) {
    auto* array = vtkDoubleArray::SafeDownCast(data.GetAbstractArray(index));
    const bool fits = array != nullptr && array->GetName() != nullptr &&
                      array->GetNumberOfComponents() == components &&
                      array->GetNumberOfTuples() == static_cast<vtkIdType>(elements);
    return fits ? array : nullptr;
}

void read_arrays(vtkFieldData& from, std::size_t elements, std::vector<DataArray>& out) {
    for (int i = 0; i < from.GetNumberOfArrays(); ++i) {
        vtkDoubleArray* array = doubles_of(from, i, 1, elements);
        if (array == nullptr) continue;
        out.push_back({array->GetName(), {array->GetPointer(0), array->GetPointer(0) + elements}});
    }
}

}  // namespace dsc::io
