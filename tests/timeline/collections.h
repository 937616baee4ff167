// Reads a .pvd as a viewer does.
#pragma once

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace espalier {

struct DataSetEntry {
    double time = 0;
    int part = 0;
    std::string name, file;
};

/// Throws if the file is not well-formed XML with one Collection.
inline std::vector<DataSetEntry> read_collection(const std::filesystem::path& path) {
    vtkNew<vtkXMLDataParser> parser;
    parser->SetFileName(path.c_str());
    if (!parser->Parse()) throw std::runtime_error(path.string() + " is not XML");
    vtkXMLDataElement* root = parser->GetRootElement();
    vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
    if (!collection || std::string(root->GetAttribute("type")) != "Collection")
        throw std::runtime_error("no Collection");
    std::vector<DataSetEntry> entries;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* element = collection->GetNestedElement(i);
        DataSetEntry entry;
        element->GetScalarAttribute("timestep", entry.time);
        element->GetScalarAttribute("part", entry.part);
        entry.name = element->GetAttribute("name");
        entry.file = element->GetAttribute("file");
        entries.push_back(entry);
    }
    return entries;
}

}  // namespace espalier
