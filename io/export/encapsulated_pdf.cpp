#include "io/export/encapsulated_pdf.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <new>

#include "io/export/dicom_file.h"

namespace volumen {

namespace {

DicomElements documentElements(const StudyObject& object, const PdfTags& tags, std::size_t length) {
  const ObjectTags& dated = object.tags();
  DicomElements all = {{0x00080023, dated.date},
                       {0x00080033, dated.time},
                       {0x0008002a, ""},
                       {0x00080064, "WSD"},
                       {0x00200013, "1"},
                       {0x00280301, tags.hasNames ? "YES" : "NO"},
                       {0x00420010, firstCharacters(tags.title, 1024)},
                       {0x00420012, "application/pdf"},
                       {0x00420015, std::to_string(length)}};
  append(all, codeSequence(0x0040a043, {"18748-4", "LN", "Diagnostic Imaging Report"}, 0));
  append(all, references(0x00420013, object.pictures(), 0));
  return all;
}

}  // namespace

bool isPdf(std::string_view bytes) {
  constexpr std::size_t whereItBegins = 1024;
  return bytes.substr(0, whereItBegins).find("%PDF-") != std::string_view::npos;
}

Status writeEncapsulatedPdf(std::string_view pdf, const Series& series, const PdfTags& tags,
                            const std::string& path, const Progress& progress,
                            const CancelToken& cancel) try {
  constexpr std::size_t longest = 0xfffffffe;
  if (!isPdf(pdf)) return Error{"Cannot write " + path + ": the document is no PDF."};
  if (pdf.size() > longest)
    return Error{"Cannot write " + path + ": the PDF is more than the 4 GB that a DICOM file holds."};
  const auto object = StudyObject::of(series, tags, progress, cancel);
  if (!object) return object.error();
  DcmFileFormat file;
  DcmDataset& data = *file.getDataset();
  object->put(UID_EncapsulatedPDFStorage, "DOC", documentElements(*object, tags, pdf.size()), data);
  std::string even(pdf);
  if (even.size() % 2) even += '\0';
  const OFCondition done =
      data.putAndInsertUint8Array(DCM_EncapsulatedDocument, reinterpret_cast<const Uint8*>(even.data()),
                                  static_cast<unsigned long>(even.size()));
  if (done.bad()) return Error{"Cannot write " + path + ": " + done.text() + "."};
  return writeNewDicom(file, path, cancel);
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path + ": there is not enough memory."};
}

}  // namespace volumen
