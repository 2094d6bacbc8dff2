#pragma once

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"
#include "viewer/segment/code.h"

namespace volumen::dicom {

/// Returns the kind of a SOP class, or nothing if its objects refer to no pictures.
std::optional<DerivedKind> derivedKind(const std::string& sopClassUid);

/// Returns the pictures named in `scope`, each once, with their series if given. References to procedures,
/// patients and work lists are left out.
std::vector<ReferencedPicture> readPictures(const DataSet& data, DataSet::Scope scope);

/// Reads the label, date and referenced pictures of a file of kind `kind`.
DerivedObject readDerivedObject(const DataSet& data, const FileHeader& header, DerivedKind kind);

/// Returns the code in an item of a code sequence. Its value is in one of three attributes (PS3.3 8.8).
Code codeIn(const DataSet& data, DataSet::Scope item);
/// Returns the first code of a sequence, empty if there is none.
Code codeAt(const DataSet& data, std::uint32_t sequence, DataSet::Scope scope);

/// Opens an object of kind `kind` and reads its elements. An Error is a sentence that names the file and why
/// it is no such object.
Result<InspectedFile> openObject(const std::string& path, DerivedKind kind);

/// Adds the remarks of `data` to the notes or warnings of `value`.
template <class Value>
void tellRemarks(const DataSet& data, const std::string& path, Value& value) {
  for (const std::string& remark : data.remarks()) {
    if constexpr (requires { value.notes; })
      value.notes.push_back(path + ": " + remark + ".");
    else if constexpr (requires { value.warnings; })
      value.warnings.push_back(sentenceOf(remark));
  }
}

/// Returns read() of the object's data set. An Error of `read`, a reason without full stop, gets the file's
/// name.
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
