#include "timeline/vtk_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

namespace espalier {
namespace {

// The file is made in memory and written by us, so that a full disk is told from every other trouble.
template <class Writer, class Data>
void write(const std::filesystem::path& path, Data& data) {
    std::string errors;  // VTK prints them unless somebody listens
    vtkNew<vtkCallbackCommand> listener;
    listener->SetClientData(&errors);
    listener->SetCallback([](vtkObject*, unsigned long, void* client, void* message) {
        if (message) static_cast<std::string*>(client)->append(static_cast<const char*>(message));
    });
    vtkNew<Writer> writer;
    writer->AddObserver(vtkCommand::ErrorEvent, listener);
    writer->AddObserver(vtkCommand::WarningEvent, listener);
    writer->SetInputDataObject(&data);
    // Inline, not appended: readers older than VTK 9.3 mistake appended data for XML where the system's expat (2.5 of
    // Debian 12 as updated, 2.6) defers its parsing; Debian's ParaView 5.11 is one of them.
    writer->SetDataModeToBinary();
    writer->SetHeaderTypeToUInt64();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);
    writer->WriteToOutputStringOn();
    const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
    if (!written || !errors.empty()) {
        throw RunError(fmt::format("cannot write {}: {}{}", path.string(), errors.empty() ? "VTK says: " : errors,
                                   vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
    }
    write_text(path, writer->GetOutputString());
}

}  // namespace

void write_vtk(const std::filesystem::path& path, vtkPolyData& data) {
    write<vtkXMLPolyDataWriter>(path, data);
}

void write_vtk(const std::filesystem::path& path, vtkImageData& data) {
    write<vtkXMLImageDataWriter>(path, data);
}

void add_texts(vtkFieldData& data, const char* name, const std::vector<std::string>& texts) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& text : texts) array->InsertNextValue(text);
    data.AddArray(array);
}

void add_time(vtkFieldData& data, double time, int step) {
    vtkNew<vtkDoubleArray> times;
    times->SetName("TimeValue");
    times->InsertNextValue(time);
    data.AddArray(times);
    vtkNew<vtkIntArray> steps;
    steps->SetName("step");
    steps->InsertNextValue(step);
    data.AddArray(steps);
}

}  // namespace espalier
