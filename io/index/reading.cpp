#include "io/index/reading.h"

#include <unordered_set>

#include "io/dicom/attribute_list.h"
#include "io/dicom/data_set.h"
#include "io/open.h"

namespace volumen {

Result<FurtherIdentity> furtherIdentity(const std::string& path) {
  FurtherIdentity further;
  const Result<std::vector<dicom::AttributeLine>> lines = dicom::listAttributes(path);
  if (!lines) return lines.error();
  const std::pair<const char*, std::string FurtherIdentity::*> wanted[] = {
      {"(0008,0080)", &FurtherIdentity::institution},
      {"(0008,0021)", &FurtherIdentity::seriesDate},
      {"(0008,0030)", &FurtherIdentity::studyTime},
      {"(0008,0031)", &FurtherIdentity::seriesTime},
      {"(0008,0050)", &FurtherIdentity::accessionNumber},
      {"(0010,0030)", &FurtherIdentity::birthDate},
      {"(0010,0040)", &FurtherIdentity::sex}};
  for (const dicom::AttributeLine& line : *lines)
    for (const auto& [tag, field] : wanted)
      if (line.depth == 0 && line.tag == tag) further.*field = line.value;
  for (std::string FurtherIdentity::*field : {&FurtherIdentity::studyTime, &FurtherIdentity::seriesDate,
                                              &FurtherIdentity::seriesTime, &FurtherIdentity::birthDate})
    further.*field = dicom::dateOrTime(further.*field);
  return further;
}

namespace {

// Returns files that nothing in a study names: copies of images that it left out.
std::vector<std::string> unnamed(const std::vector<std::string>& paths, const Study& study,
                                 const std::vector<FoundSeries>& series) {
  std::unordered_set<std::string> named;
  for (const FoundSeries& s : series)
    for (const FoundFile& file : s.files) named.insert(file.path);
  for (const Refused& file : study.refused) named.insert(file.path);
  for (const Other& file : study.other) named.insert(file.path);
  std::vector<std::string> rest;
  for (const std::string& path : paths)
    if (!named.contains(path)) rest.push_back(path);
  return rest;
}

// Adds refused files and other files that series lost or may have lost, with the reasons that the study
// gives.
void addRefused(const Study& study, ReadFiles& read) {
  std::unordered_set<std::string> known, others;
  for (const ReadSeries& series : read.series)
    for (const FoundFile& file : series.files) known.insert(file.path);
  for (const Other& other : study.other) others.insert(other.path);
  for (const Refused& file : study.refused)
    if (known.insert(file.path).second) read.refused.push_back(file);
  for (const Series& volume : study.volumes)
    for (const Unread& file : volume.unread)
      if (known.insert(file.path).second)
        (others.contains(file.path) ? read.lacking : read.refused).push_back(file);
}

}  // namespace

Result<ReadFiles> readFiles(const std::vector<std::string>& paths, const Progress& progress,
                            const CancelToken& cancel) {
  Result<Study> study = openFiles(paths, progress, cancel);
  if (!study) return study.error();
  std::vector<FoundSeries> series = seriesOf(*study);
  // Each round finds one of several copies of an image.
  std::vector<std::string> left = unnamed(paths, *study, series);
  while (!left.empty()) {
    const Result<Study> copies = openFiles(left, {}, cancel);
    if (!copies) return copies.error();
    addCopies(*copies, series);
    const std::vector<std::string> still = unnamed(left, *copies, series);
    if (still.size() == left.size()) break;
    left = still;
  }
  ReadFiles read;
  for (FoundSeries& s : series) {
    if (cancel.cancelled()) return Error{"Interrupted."};
    warnOfOtherBytes(s);
    FurtherIdentity further;
    if (s.isDicom)
      if (Result<FurtherIdentity> found = furtherIdentity(s.files[0].path)) further = std::move(*found);
    read.series.push_back({std::move(s), std::move(further)});
  }
  addRefused(*study, read);
  return read;
}

}  // namespace volumen
