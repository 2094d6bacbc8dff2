#include "io/export/key_objects_dicom.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>

#include "io/export/dicom_modules.h"

namespace volumen {

namespace {

Status checkTitle(const std::string& value) {
  constexpr const char* rejecting[] = {"113001", "113037", "113038", "113039"};
  if (std::ranges::find(rejecting, value) == std::end(rejecting)) return {};
  return Error{"The title " + value + " rejects images, which archives then hide; choose another one."};
}

ContentItem keyContentOf(const KeyObjects& keys, const DocumentSource& source) {
  ContentItem all = containerItem("", isWhole(keys.title) ? keys.title : keyObjectTitles().front(), "2010");
  if (!keys.text.empty())
    all.content.push_back(textItem("CONTAINS", {"113012", "DCM", "Key Object Description"}, keys.text));
  for (const ReferencedPicture& picture : keys.pictures)
    all.content.push_back(pictureItem("CONTAINS", {}, picture, source));
  return all;
}

}  // namespace

std::span<const Code> keyObjectTitles() {
  static const Code titles[] = {
      {"113000", "DCM", "Of Interest"},    {"113002", "DCM", "For Referring Provider"},
      {"113003", "DCM", "For Surgery"},    {"113004", "DCM", "For Teaching"},
      {"113005", "DCM", "For Conference"}, {"113006", "DCM", "For Therapy"},
      {"113007", "DCM", "For Patient"},    {"113008", "DCM", "For Peer Review"},
      {"113009", "DCM", "For Research"},   {"113013", "DCM", "Best In Set"},
      {"113018", "DCM", "For Printing"},   {"113020", "DCM", "For Report Attachment"}};
  return titles;
}

Result<Code> keyObjectTitle(const std::string& value) {
  if (value.empty()) return keyObjectTitles().front();
  if (Status s = checkTitle(value); !s) return s.error();
  std::string known;
  for (const Code& title : keyObjectTitles()) {
    if (title.value == value) return title;
    known += (known.empty() ? "" : ", ") + title.value + " " + title.meaning;
  }
  return Error{"There is no title " + value + ". Choose one of " + known + "."};
}

Status writeKeyObjects(const KeyObjects& keys, const DocumentSource& source, const std::string& path) {
  if (keys.pictures.empty()) return Error{"There is no key image to write."};
  if (Status s = checkTitle(keys.title.value); !s) return s;
  for (const ReferencedPicture& picture : keys.pictures)
    if (Status s = checkPicture(picture, source); !s) return Error{"Key images: " + s.message() + "."};
  Document document{UID_KeyObjectSelectionDocumentStorage, "KO", "Key images"};
  document.content = keyContentOf(keys, source);
  return writeDocument(document, source, path);
}

}  // namespace volumen
