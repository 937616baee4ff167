// VTK's XML files as the timeline writes them: inline compressed data, the same bytes for the same content.
#pragma once

#include <vtkSmartPointer.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

class vtkFieldData;
class vtkImageData;
class vtkPolyData;

namespace espalier {

/// Complete or not at all; throws RunError. VTK itself prints nothing.
void write_vtk(const std::filesystem::path& path, vtkPolyData& data);
void write_vtk(const std::filesystem::path& path, vtkImageData& data);

/// A VTK array over memory that the caller keeps until the file is written.
template <class Array, class T>
vtkSmartPointer<Array> array_over(const char* name, T* values, std::size_t count, int components = 1) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    static_assert(sizeof(typename Array::ValueType) == sizeof(T));
    if (count > 0) {
        array->SetArray(reinterpret_cast<typename Array::ValueType*>(values), static_cast<vtkIdType>(count), 1);
    }
    return array;
}

/// Texts that travel with the data set.
void add_texts(vtkFieldData& data, const char* name, const std::vector<std::string>& texts);
/// What ParaView shows as the time of a file opened without its index.
void add_time(vtkFieldData& data, double time, int step);

}  // namespace espalier
