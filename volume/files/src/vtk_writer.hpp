// What all writers of VTK's XML files have in common.
#pragma once

#include <vtkCallbackCommand.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <filesystem>

#include "octafield/temporary_file.hpp"
#include "octafield/volume/write_vtk.hpp"

namespace octafield::volume::detail {

// Binary, compressed, to a temporary that is renamed. Throws IoError.
template <class Writer, class DataSet>
void write_xml(const std::filesystem::path& target, DataSet* data) {
    TemporaryFile file(target);
    vtkNew<vtkCallbackCommand> silent;  // observed errors are not printed; the error code tells what happened
    silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    vtkNew<Writer> writer;
    writer->AddObserver(vtkCommand::ErrorEvent, silent);
    writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silent);
    writer->SetFileName(file.path().c_str());
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->SetCompressorTypeToZLib();
    if (writer->Write() != 1 || writer->GetErrorCode() != vtkErrorCode::NoError)
        file.fail(writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError ? "the disk is full" : "writing failed");
    file.move_to_target();
}

// As bytes: meshio refuses strings.
inline void add_metadata(vtkUnstructuredGrid* data, const Metadata& metadata) {
    for (const auto& [name, text] : metadata) {
        if (text.empty()) continue;  // nor does meshio read an empty array
        vtkNew<vtkUnsignedCharArray> array;
        array->SetName(name.c_str());
        array->SetNumberOfTuples(static_cast<vtkIdType>(text.size()));
        std::copy(text.begin(), text.end(), array->GetPointer(0));
        data->GetFieldData()->AddArray(array);
    }
}

inline void add_metadata(vtkPolyData* data, const Metadata& metadata) {
    for (const auto& [name, text] : metadata) {
        vtkNew<vtkStringArray> array;
        array->SetName(name.c_str());
        array->InsertNextValue(text);
        data->GetFieldData()->AddArray(array);
    }
}

inline vtkNew<vtkPoints> to_points(const Points& rows) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) points->SetPoint(i, rows(i, 0), rows(i, 1), rows(i, 2));
    return points;
}

// Adds an array of `count` tuples, tuple i = value(i), any indexable row of the given number of components.
template <class Array, class Value>
vtkNew<Array> add_array(vtkFieldData* to, const char* name, int components, Eigen::Index count, const Value& value) {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto tuple = value(i);
        for (int c = 0; c < components; ++c)
            array->SetTypedComponent(i, c, static_cast<typename Array::ValueType>(tuple[c]));
    }
    to->AddArray(array);
    return array;
}

}  // namespace octafield::volume::detail
