#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"
#include "viewer/segment/code.h"

namespace volumen::dicom {

/// The kind of a SOP class; nothing where it is none that refers to pictures.
std::optional<DerivedKind> derivedKind(const std::string& sopClassUid);

/// The pictures that this part of a data set names, each once, with the series that holds them where it is
/// said. References to procedures, patients and work lists are left out.
std::vector<ReferencedPicture> readPictures(const DataSet& data, DataSet::Scope scope);

/// What a file of kind `kind` says of itself.
DerivedObject readDerivedObject(const DataSet& data, const FileHeader& header, DerivedKind kind);

/// The first code of a sequence, empty where there is none; its value may be one of three attributes
/// (PS3.3 8.8).
Code codeAt(const DataSet& data, std::uint32_t sequence, DataSet::Scope scope);

/// The file of an object of kind `kind`, and its elements. An Error is a sentence that names the file and why
/// it is not such an object.
Result<InspectedFile> openObject(const std::string& path, DerivedKind kind);

/// Adds what of an object was read otherwise than it is written to what is told of it.
template <class Value>
void tellRemarks(const DataSet& data, const std::string& path, Value& value) {
  for (const std::string& remark : data.remarks()) {
    if constexpr (requires { value.notes; })
      value.notes.push_back(path + ": " + remark + ".");
    else if constexpr (requires { value.warnings; })
      value.warnings.push_back(sentenceOf(remark));
  }
}

/// Runs `read` on the data set of such a file. Its Error, a reason without full stop, gets the file's name.
template <class Value, class Read>
Result<Value> loadObject(const std::string& path, DerivedKind kind, const Read& read) {
  try {
    const Result<InspectedFile> file = openObject(path, kind);
    if (!file) return file.error();
    const DataSet data(file->scanned.head, file->scanned.dataSet.elements);
    Result<Value> value = read(*file, data);
    if (!value) return Error{path + ": " + value.message() + "."};
    tellRemarks(data, path, *value);
    return value;
  } catch (const std::bad_alloc&) {
    return Error{path + ": there is not enough memory to read it."};
  }
}

}  // namespace volumen::dicom
