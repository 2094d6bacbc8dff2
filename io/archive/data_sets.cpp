#include "io/archive/data_sets.h"

#include <algorithm>
#include <charconv>

#include "io/dicom/data_set.h"

namespace volumen {

DcmDataset keysAt(const char* level, const std::string& studyUid) {
  DcmDataset keys;
  putKey(keys, DCM_SpecificCharacterSet, "ISO_IR 192");
  putKey(keys, DCM_QueryRetrieveLevel, level);
  if (!studyUid.empty()) putKey(keys, DCM_StudyInstanceUID, studyUid);
  return keys;
}

std::vector<DcmDataset> keysForInstances(const std::string& studyUid, const std::string& seriesUid,
                                         const std::vector<std::string>& sopInstanceUids) {
  constexpr std::size_t atOnce = 100;
  DcmDataset keys = keysAt(sopInstanceUids.empty() ? "SERIES" : "IMAGE", studyUid);
  putKey(keys, DCM_SeriesInstanceUID, seriesUid);
  if (sopInstanceUids.empty()) return {keys};
  std::vector<DcmDataset> all;
  for (std::size_t first = 0; first < sopInstanceUids.size(); first += atOnce) {
    std::string list;
    for (std::size_t n = first; n < std::min(sopInstanceUids.size(), first + atOnce); ++n)
      list += (list.empty() ? "" : "\\") + sopInstanceUids[n];
    putKey(keys, DCM_SOPInstanceUID, list);
    all.push_back(keys);
  }
  return all;
}

void putKey(DcmDataset& keys, const DcmTagKey& tag, const std::string& value) {
  keys.putAndInsertOFStringArray(tag, OFString(value.c_str(), value.size()));
}

void askFor(DcmDataset& keys, std::initializer_list<DcmTagKey> tags) {
  for (const DcmTagKey& tag : tags) keys.insertEmptyElement(tag);
}

Answer::Answer(DcmDataset& data, const std::string& usualSet) : data_(data), set_(usualSet) {
  if (const std::string own = bytes(DCM_SpecificCharacterSet); !own.empty()) set_ = own;
}

std::string Answer::text(const DcmTagKey& tag) const { return dicom::toUtf8(bytes(tag), set_); }
std::string Answer::date(const DcmTagKey& tag) const { return dicom::dateOrTime(bytes(tag)); }

int Answer::count(const DcmTagKey& tag) const {
  const std::string digits = bytes(tag);
  int count = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  return error == std::errc() && end == digits.data() + digits.size() && count >= 0 ? count : -1;
}

std::string Answer::bytes(const DcmTagKey& tag) const {
  OFString value;
  if (data_.findAndGetOFStringArray(tag, value).bad()) return {};
  const std::string all(value.c_str(), value.length());
  const std::size_t first = all.find_first_not_of(' '), last = all.find_last_not_of(std::string(" \0", 2));
  return first == std::string::npos || last == std::string::npos || last < first
             ? std::string()
             : all.substr(first, last - first + 1);
}

}  // namespace volumen
