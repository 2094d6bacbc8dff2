#include "io/dicom/identity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

namespace volumen::dicom {
namespace {

using Files = std::vector<const FileHeader*>;

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::string patientWords(const FileHeader& file) {
  const std::string name = file.patientName.empty() ? "(no name)" : quoted(file.patientName);
  if (file.patientId.empty()) return name;
  const std::string issuer = file.patientIdIssuer.empty() ? "" : " of " + file.patientIdIssuer;
  return name + " (ID " + file.patientId + issuer + ")";
}

/// Returns "A and B" or "A, B and C".
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t n = 0; n < words.size(); ++n)
    text += (n == 0 ? "" : n + 1 == words.size() ? " and " : ", ") + words[n];
  return text;
}

/// Returns the distinct values of a field in order of first occurrence, without empty ones.
std::vector<std::string> valuesOf(const Files& files, std::string FileHeader::*field) {
  std::vector<std::string> values;
  std::set<std::string> seen;
  for (const FileHeader* file : files)
    if (const std::string& value = file->*field; !value.empty() && seen.insert(value).second)
      values.push_back(value);
  return values;
}

/// Groups files by a key, in order of first occurrence.
template <class Key>
std::vector<Files> groupedBy(const Files& files, Key key) {
  std::map<std::string, std::size_t> index;
  std::vector<Files> groups;
  for (const FileHeader* file : files) {
    const auto [it, isNew] = index.emplace(key(*file), groups.size());
    if (isNew) groups.emplace_back();
    groups[it->second].push_back(file);
  }
  return groups;
}

/// Groups files by patient. An ID without issuer gets the only issuer of that ID here. A file without ID gets
/// the only ID that occurs with its name here.
std::vector<Files> byPatient(const Files& files) {
  std::map<std::string, std::set<std::string>> issuersOfId, idsOfName;
  for (const FileHeader* file : files) {
    if (file->patientId.empty()) continue;
    if (!file->patientIdIssuer.empty()) issuersOfId[file->patientId].insert(file->patientIdIssuer);
    idsOfName[file->patientName].insert(file->patientId);
  }
  const auto idKey = [&](const std::string& id, const std::string& own) {
    const std::set<std::string>& issuers = issuersOfId[id];
    const std::string issuer = own.empty() && issuers.size() == 1 ? *issuers.begin() : own;
    return "id " + id + '\0' + issuer;
  };
  return groupedBy(files, [&](const FileHeader& file) {
    if (!file.patientId.empty()) return idKey(file.patientId, file.patientIdIssuer);
    const std::set<std::string>& ids = idsOfName[file.patientName];
    if (ids.size() == 1 && !file.patientName.empty()) return idKey(*ids.begin(), {});
    return "name " + file.patientName;
  });
}

bool isPlaced(const FileHeader& file) {
  return std::ranges::any_of(file.slices, [](const Slice& s) { return dicom::isPlaced(s); });
}

/// Returns the sorted positions of slices along the normal of the first, mm.
std::vector<double> placesOf(const Files& files) {
  const Slice* first = nullptr;
  std::vector<double> places;
  for (const FileHeader* file : files)
    for (const Slice& s : file->slices) {
      if (!dicom::isPlaced(s)) continue;
      if (!first) first = &s;
      places.push_back(
          glm::dot(*s.position, glm::cross(first->orientation->row, first->orientation->column)));
    }
  std::ranges::sort(places);
  return places;
}

/// Returns whether positions form a complete, even stack.
bool areEven(const std::vector<double>& places) {
  if (places.size() < 2) return false;
  const double step = (places.back() - places.front()) / double(places.size() - 1);
  for (std::size_t n = 1; n < places.size(); ++n)
    if (std::abs(places[n] - places[n - 1] - step) > 0.05 * step) return false;
  return step > 0;
}

/// Groups files if only some name a frame of reference, and all those name the same. The others join it
/// unless both groups are whole stacks that interleave.
std::vector<Files> withSomeUnnamed(const Files& files, std::vector<Warning>& warnings) {
  const auto byName = groupedBy(files, [](const FileHeader& file) {
    return !isPlaced(file) ? "no place" : file.frameOfReferenceUid.empty() ? "none" : "named";
  });
  Files named, none;
  for (const Files& some : byName)
    if (isPlaced(*some[0])) (some[0]->frameOfReferenceUid.empty() ? none : named) = some;
  if (none.empty() || named.empty()) return {files};
  const std::vector<double> a = placesOf(named), b = placesOf(none);
  const bool interleave = a.front() <= b.back() && b.front() <= a.back();
  if (interleave && areEven(a) && areEven(b)) {
    warnings.emplace_back(std::to_string(none.size()) + " of its " + std::to_string(files.size()) +
                          " files name no frame of reference and lie between the others: positions may not "
                          "be compared, and each is a volume of its own.");
    return byName;
  }
  warnings.push_back({std::to_string(none.size()) + " of its " + std::to_string(files.size()) +
                          " files name no frame of reference: they were taken to be in that of the others.",
                      WarningKind::notSeparated});
  return {files};
}

/// Groups files with positions by frame of reference. Files that name none join the only one that is named.
std::vector<Files> byFrameOfReference(const Files& files, std::vector<Warning>& warnings) {
  const Files placed = [&] {
    Files some;
    std::ranges::copy_if(files, std::back_inserter(some), [](const FileHeader* f) { return isPlaced(*f); });
    return some;
  }();
  const std::vector<std::string> frames = valuesOf(placed, &FileHeader::frameOfReferenceUid);
  if (frames.empty()) return {files};
  if (frames.size() == 1) return withSomeUnnamed(files, warnings);
  const bool singlePictures =
      std::ranges::all_of(files, [](const FileHeader* f) { return f->slices.size() == 1; });
  if (frames.size() > 3 && frames.size() == files.size() && singlePictures) {
    warnings.emplace_back(
        "Each of its " + std::to_string(files.size()) +
        " files names a frame of reference of its own, as careless de-identification does: they "
        "are taken as one.");
    return {files};
  }
  warnings.emplace_back(
      "This series has " + std::to_string(frames.size()) +
      " frames of reference, between which positions cannot be compared: each is a volume of "
      "its own.");
  return groupedBy(files, [](const FileHeader& file) {
    return isPlaced(file) ? "in " + file.frameOfReferenceUid : std::string();
  });
}

/// Returns warnings about contradictory data of one patient.
std::vector<std::string> contradictions(const Files& files) {
  std::vector<std::string> warnings;
  const std::string whose = files[0]->patientId.empty() ? "" : " of patient " + files[0]->patientId;
  if (const auto names = valuesOf(files, &FileHeader::patientName); names.size() > 1) {
    std::vector<std::string> words;
    std::ranges::transform(names, std::back_inserter(words), quoted);
    warnings.push_back("The name" + whose + " is written in " + std::to_string(names.size()) +
                       " ways: " + listed(words) + ".");
  }
  const std::pair<std::string FileHeader::*, const char*> facts[] = {
      {&FileHeader::patientBirthDate, "birth dates"}, {&FileHeader::patientSex, "sexes"}};
  for (const auto& [field, what] : facts)
    if (const auto values = valuesOf(files, field); values.size() > 1)
      warnings.push_back("The files" + whose + " give " + std::to_string(values.size()) + " " + what + " (" +
                         listed(values) + "): they may be of different patients.");
  const bool someLackId =
      std::ranges::any_of(files, [](const FileHeader* f) { return f->patientId.empty(); });
  if (someLackId && !files[0]->patientId.empty())
    warnings.push_back("Some files have no PatientID and are taken for those" + whose + " by their name.");
  const std::size_t withIssuer = std::size_t(
      std::ranges::count_if(files, [](const FileHeader* f) { return !f->patientIdIssuer.empty(); }));
  if (withIssuer > 0 && withIssuer < files.size())
    warnings.push_back("Some files do not say who issued the ID" + whose + " (" +
                       valuesOf(files, &FileHeader::patientIdIssuer)[0] +
                       " in the others): they are taken for those of the same patient.");
  return warnings;
}

std::string studyWords(const Files& files) {
  return files[0]->studyUid.empty() ? "(no study)" : files[0]->studyUid;
}

/// Returns warnings about a SeriesInstanceUID that is shared by several studies or patients.
std::vector<std::string> sharedSeries(const std::vector<Files>& studies, const std::vector<Files>& patients) {
  std::vector<std::string> warnings, words;
  if (studies.size() > 1) {
    std::ranges::transform(studies, std::back_inserter(words), studyWords);
    warnings.push_back(std::to_string(studies.size()) + " studies share this series UID (" + listed(words) +
                       "): each is shown by itself.");
  }
  if (patients.size() > 1) {
    words.clear();
    for (const Files& of : patients) words.push_back(patientWords(*of[0]));
    warnings.push_back(std::to_string(patients.size()) + " patients share this series UID, " + listed(words) +
                       ": each is shown by itself.");
  }
  return warnings;
}

void addSeries(const Files& series, std::vector<SameIdentity>& all) {
  const std::vector<Files> studies = groupedBy(series, [](const FileHeader& f) { return f.studyUid; });
  const std::vector<std::string> shared = sharedSeries(studies, byPatient(series));
  for (const Files& study : studies)
    for (const Files& patient : byPatient(study)) {
      std::vector<Warning> warnings;
      addSentences(warnings, shared);
      addSentences(warnings, contradictions(patient));
      const std::vector<Files> frames = byFrameOfReference(patient, warnings);
      for (const Files& frame : frames) all.push_back({frame, warnings});
    }
}

}  // namespace

std::vector<SameIdentity> byIdentity(const std::vector<FileHeader>& files) {
  Files pointers;
  for (const FileHeader& file : files) pointers.push_back(&file);
  std::vector<SameIdentity> all;
  const auto key = [](const FileHeader& f) {
    return f.seriesUid.empty() ? "file " + f.path : "series " + f.seriesUid;
  };
  for (const Files& series : groupedBy(pointers, key)) addSeries(series, all);
  return all;
}

}  // namespace volumen::dicom
