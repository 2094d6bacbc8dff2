#include "io/dicom/unread.h"

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>
#include <set>

#include "io/regular_file.h"
#include "io/zip_archive.h"
#include "viewer/volume/listed_first.h"

namespace volumen::dicom {
namespace {

std::string folderOf(const std::string& path) { return path.substr(0, path.find_last_of('/') + 1); }

/// Returns the pattern that names of slices share: the name with "#" for each number in it.
std::string patternOf(const std::string& name) {
  std::string pattern;
  for (const char c : name) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c));
    if (!digit || !pattern.ends_with('#')) pattern += digit ? '#' : c;
  }
  return pattern;
}

/// The folders and name patterns of the files of a series.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Series& series) {
    for (const std::string& file : series.files) {
      const std::string path = lastingPath(file), folder = folderOf(path);
      folders_.insert(folder);
      names_.insert(folder + patternOf(fileName(path)));
      if (const std::string end = dicomSuffix(path); !end.empty()) names_.insert(folder + "/" + end);
    }
  }
  bool holds(const std::string& file) const { return folders_.contains(folderOf(lastingPath(file))); }
  bool namesAlike(const std::string& file) const {
    if (!holds(file)) return false;
    const std::string path = lastingPath(file), name = fileName(path), pattern = patternOf(name);
    if (name.starts_with('.')) return false;  // left beside files by file systems and editors
    return (pattern != name && names_.contains(folderOf(path) + pattern)) ||
           names_.contains(folderOf(path) + "/" + dicomSuffix(path));
  }

 private:
  static std::string dicomSuffix(const std::string& path) {
    std::string end = path.substr(path.size() - std::min<std::size_t>(path.size(), 4));
    std::ranges::transform(end, end.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return end == ".dcm" || end == ".dic" || end == ".ima" ? end : std::string();
  }
  std::set<std::string> folders_, names_;  // no name begins with "/": those are endings
};

bool isOf(const LostFile& lost, const Series& series, const Neighbourhood& around) {
  if (lost.ifNamedAlike) return around.namesAlike(lost.file.path);
  if (lost.file.beside) return around.holds(lost.file.path);
  return lost.identity.seriesUid == series.seriesUid && lost.identity.studyUid == series.studyUid;
}

/// Returns the number of interpolated slices at positions of unread slices.
int countInPlace(const std::vector<Unread>& unread, const Series::Regular& regular) {
  const VoxelGeometry& g = regular.geometry;
  const glm::dvec3 step = g.patientFromVoxelStep[2];
  int count = 0;
  for (std::size_t k = 0; k < regular.copies.size(); ++k)
    if (regular.copies[k] < 0)
      count += std::ranges::any_of(unread, [&](const Unread& file) {
        if (!file.position) return false;
        const double off = glm::dot(*file.position - g.patientFromVoxel(glm::dvec3(0, 0, double(k))), step);
        return std::abs(off) < 0.5 * glm::dot(step, step);
      });
  return count;
}

std::string namesOf(const std::vector<const Unread*>& files) {
  constexpr std::size_t most = 20;
  std::vector<std::string> names;  // a file may hold several slices
  for (const Unread* file : files)
    if (std::ranges::find(names, fileName(file->path)) == names.end()) names.push_back(fileName(file->path));
  return listedFirst(names, most);
}

/// Returns the warning about unread files of the series. `interpolated` of their slices were interpolated.
std::string sentenceOf(const std::vector<const Unread*>& files, int interpolated) {
  const std::string& reason = files[0]->reason;
  if (files.size() == 1)
    return "Slice " + namesOf(files) + " could not be read and " +
           (interpolated ? "was interpolated: " : "is left out: ") + reason;
  const std::string some = std::to_string(interpolated) + " of them " + (interpolated == 1 ? "was" : "were") +
                           " interpolated, the others are left out";
  const std::string became = interpolated == 0                   ? "they are left out"
                             : interpolated >= int(files.size()) ? "they were interpolated"
                                                                 : some;
  return std::to_string(files.size()) + " slices could not be read: " + namesOf(files) + "; " + became +
         ". The first: " + reason;
}

/// Returns the warning about unread files that may belong to the series.
std::string besideSentenceOf(const std::vector<const Unread*>& files, int interpolated) {
  const std::string made =
      interpolated == 1 ? "the slice that was interpolated" : "the slices that were interpolated";
  const std::string became = interpolated ? " It may have held " + made + "." : "";
  if (files.size() == 1)
    return namesOf(files) + ", beside the files of this series, could not be read: " + files[0]->reason +
           became;
  return std::to_string(files.size()) +
         " files beside those of this series could not be read: " + namesOf(files) +
         ". The first: " + files[0]->reason + (interpolated ? " They may have held " + made + "." : "");
}

}  // namespace

void addUnread(const std::vector<LostFile>& lost, std::vector<Series>& volumes) {
  for (Series& series : volumes) {
    const Neighbourhood around(series);
    for (const LostFile& file : lost)
      if (isOf(file, series, around)) series.unread.push_back(file.file);
    warnOfUnread(series.unread, series.regular, series.warnings);
  }
}

void warnOfUnread(const std::vector<Unread>& unread, const std::optional<Series::Regular>& regular,
                  std::vector<Warning>& warnings) {
  if (unread.empty()) return;
  std::vector<const Unread*> own, beside;
  int unplaced = 0;
  for (const Unread& file : unread) {
    (file.beside ? beside : own).push_back(&file);
    unplaced += file.position ? 0 : 1;
  }
  const bool someMissing =
      std::ranges::find(warnings, WarningKind::missingSlices, &Warning::kind) != warnings.end();
  const int missing = regular && someMissing ? regular->interpolatedSlices : 0;
  int inPlace = regular ? countInPlace(unread, *regular) : 0, guessed = 0;
  if (const int rest = missing - inPlace; rest > 0 && unplaced >= rest) guessed = rest;
  if (someMissing && inPlace + guessed >= missing)
    std::erase_if(warnings, [](const Warning& w) { return w.kind == WarningKind::missingSlices; });
  if (!own.empty()) {
    const int more = std::min(guessed, int(own.size()) - inPlace);
    inPlace += std::max(0, more), guessed -= std::max(0, more);
    warnings.emplace_back(sentenceOf(own, inPlace), WarningKind::unread);
  }
  if (!beside.empty()) warnings.emplace_back(besideSentenceOf(beside, guessed), WarningKind::unread);
}

}  // namespace volumen::dicom
