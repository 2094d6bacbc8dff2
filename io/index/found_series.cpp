#include "io/index/found_series.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "io/files/same_bytes.h"
#include "io/regular_file.h"
#include "io/study/study.h"

namespace volumen {
namespace {

// Attributes that identify a series in a study.
using Key = std::tuple<std::string, std::string, std::string, std::string, std::string>;

Key keyOf(const SeriesIdentity& s, const std::string& path) {
  const bool named = !s.seriesUid.empty();
  return {s.patientName, s.patientId, s.studyUid, s.seriesUid, named ? std::string() : path};
}

// Collects files and volumes by series.
class Collector {
 public:
  void add(const Series& volume) {
    FoundSeries& series = seriesFor(volume, volume.files.empty() ? volume.path : volume.files[0]);
    if (!series.isVolume) series.time = volume.time;
    series.isDicom = volume.format == "DICOM";
    series.isVolume = true;
    std::vector<const Series*>& volumes = volumes_[&series - all_.data()];
    volumes.push_back(&volume);
    for (std::size_t n = 0; n < volume.files.size(); ++n)
      addFile(series, volume.files[n],
              volume.sopInstanceUids.empty() ? std::string() : volume.sopInstanceUids[n], int(volumes.size()),
              series.isDicom ? 1 : volume.acquired.size.z);
    for (const Warning& warning : volume.warnings)
      if (std::ranges::find(series.warnings, warning.sentence) == series.warnings.end())
        series.warnings.push_back(warning.sentence);
  }
  void add(const Image& image) {
    addFile(seriesFor(image, image.path), image.path, image.sopInstanceUid, 0, image.frames);
  }
  void add(const DerivedObject& object) {
    addFile(seriesFor(object, object.path), object.path, object.sopInstanceUid, 0, 0);
  }
  std::vector<FoundSeries> take() {
    for (const auto& [n, volumes] : volumes_) all_[std::size_t(n)].label = whatVaries(volumes);
    return std::move(all_);
  }

 private:
  FoundSeries& seriesFor(const SeriesIdentity& identity, const std::string& path) {
    const auto [it, isNew] = index_.emplace(keyOf(identity, path), all_.size());
    if (isNew) all_.push_back({identity, true, {}, {}, false, {}, {}});
    return all_[it->second];
  }
  void addFile(FoundSeries& series, const std::string& path, const std::string& sop, int volume, int frames) {
    const auto [it, isNew] = files_.emplace(path, series.files.size());
    if (isNew)
      series.files.push_back({path, sop, volume, frames});
    else
      series.files[it->second].frames += frames;
  }

  std::vector<FoundSeries> all_;
  std::map<Key, std::size_t> index_;
  std::unordered_map<std::string, std::size_t> files_;  // position of a path in its series
  std::map<std::ptrdiff_t, std::vector<const Series*>> volumes_;
};

std::string counted(std::size_t n, const char* what) { return std::to_string(n) + " " + what; }

// Counts the different parts of volume labels that begin with `word`.
std::size_t countLabelled(const std::vector<const Series*>& volumes, const std::string& word) {
  std::set<std::string> values;
  for (const Series* volume : volumes) {
    const std::size_t at = volume->label.find(word);
    if (at == std::string::npos || (at > 0 && volume->label[at - 1] != ' ')) continue;
    values.insert(volume->label.substr(at, volume->label.find(',', at) - at));
  }
  return values.size();
}

}  // namespace

std::vector<FoundSeries> seriesOf(const Study& study) {
  Collector collector;
  for (const Series& volume : study.volumes) collector.add(volume);
  for (const Image& image : study.images) collector.add(image);
  for (const DerivedObject& object : study.derived) collector.add(object);
  return collector.take();
}

void addCopies(const Study& copies, std::vector<FoundSeries>& series) {
  for (FoundSeries& found : seriesOf(copies)) {
    const Key key = keyOf(found.identity, found.files[0].path);
    const auto same = std::ranges::find_if(
        series, [&](const FoundSeries& s) { return keyOf(s.identity, s.files[0].path) == key; });
    if (same == series.end()) {
      series.push_back(std::move(found));
      continue;
    }
    for (FoundFile& file : found.files) same->files.push_back({file.path, file.sopInstanceUid, 0, 0});
  }
}

void warnOfOtherBytes(FoundSeries& series) {
  std::unordered_map<std::string, std::string> first;
  for (const FoundFile& file : series.files) {
    if (file.sopInstanceUid.empty()) continue;
    const auto [it, isNew] = first.emplace(file.sopInstanceUid, file.path);
    if (!isNew && haveSameBytes(it->second, file.path) == false)
      series.warnings.push_back(fileName(file.path) + " has the SOP Instance UID of " + fileName(it->second) +
                                ", but other bytes: both are kept.");
  }
}

std::string whatVaries(const std::vector<const Series*>& volumes) {
  if (volumes.size() < 2) return {};
  std::vector<std::string> parts;
  for (const auto& [value, what] :
       {std::pair(&Series::timePoint, "time points"), std::pair(&Series::echoTime, "echoes"),
        std::pair(&Series::bValue, "b-values")}) {
    std::set<std::string> values;
    for (const Series* volume : volumes) values.insert(volume->*value);
    if (values.size() > 1) parts.push_back(counted(values.size(), what));
  }
  for (const auto& [word, what] :
       {std::pair("direction ", "directions"), std::pair("component ", "components"),
        std::pair("trigger ", "trigger times")})
    if (const std::size_t n = countLabelled(volumes, word); n > 1) parts.push_back(counted(n, what));
  if (parts.empty()) return counted(volumes.size(), "volumes");
  std::string text = parts[0];
  for (std::size_t n = 1; n < parts.size(); ++n) text += ", " + parts[n];
  return text;
}

}  // namespace volumen
