#include "io/deidentify/deidentify_files.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

#include "io/deidentify/deidentify_file.h"
#include "io/deidentify/faceless_series.h"
#include "io/deidentify/made_folder.h"
#include "io/dicom/parallel.h"
#include "io/files/name_for_uid.h"
#include "io/files/private_folder.h"
#include "io/open.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

class Copies {
 public:
  Copies(const std::string& folder, const Deidentification& how, const CancelToken& cancel)
      : folder_(folder), how_(how), cancel_(cancel) {}

  void add(const std::string& path) {
    const Result<DeidentifiedFile> file = deidentifiedFile(path, how_, cancel_);
    if (cancel_.cancelled()) return;
    if (!file) return leaveOut(path, file.message());
    write(path, *file, false);
  }

  // Writes copies with the pixels of a faceless series. Files whose pixels cannot be replaced are left to
  // add().
  void addFaceless(const FacelessSeries& series, const Progress& progress) {
    dicom::forEachParallel(series.size(), "writing", progress, cancel_, [&](std::size_t n) {
      const auto pixels = series.pixels(n);
      if (!pixels || hasProblem()) return;
      const auto file = facelessFile(series.file(n), *pixels, how_, cancel_);
      if (!file || cancel_.cancelled()) return;
      write(series.file(n), *file, true);
      const std::lock_guard lock(mutex_);
      done_.insert(series.file(n));
    });
  }
  bool isDone(const std::string& path) const { return done_.contains(path); }

  // Compares files whose instance UID was already taken with the copy that has it. An earlier run may have
  // written that copy from one of them.
  void compareAll() {
    constexpr const char* sameUid = "another file with other contents has the same instance UID";
    std::set<std::string> owned;
    for (const Later& one : later_) {
      if (!isWrittenAt(one.file, one.path, one.target))
        report_.leftOut.push_back({one.path, sameUid});
      else if (const bool isFirst = owned.insert(one.target).second; isFirst && others_.contains(one.target))
        note(one.file, one.target, true, one.isFaceless);
      else
        ++report_.twice;
    }
    for (const auto& [target, path] : others_)
      report_.leftOut.push_back(
          {path, owned.contains(target) ? sameUid : target + " is there already, with other contents"});
  }

  // Returns the number of copies that are whole.
  int complete() const { return report_.written + report_.alreadyThere; }

  Result<DeidentifyReport> report() && {
    if (cancel_.cancelled() || !problem_) removeEmptyFolders();
    if (cancel_.cancelled()) return Error{"cancelled"};
    if (!problem_) return problem_.error();
    std::ranges::sort(report_.leftOut, {}, &Refused::path);
    report_.withText.assign(withText_.begin(), withText_.end());
    report_.withFaces.assign(withFaces_.begin(), withFaces_.end());
    report_.withoutSuv.assign(withoutSuv_.begin(), withoutSuv_.end());
    report_.withoutMosaic.assign(withoutMosaic_.begin(), withoutMosaic_.end());
    report_.faceless.assign(faceless_.begin(), faceless_.end());
    return std::move(report_);
  }
  bool hasProblem() {
    const std::lock_guard lock(mutex_);
    return !problem_;
  }

 private:
  struct Later {
    std::string path, target;
    DeidentifiedFile file;
    bool isFaceless;
  };

  // Removes the folders of copies that could not be written.
  void removeEmptyFolders() const {
    std::error_code ignored;
    for (const std::string& target : targets_) {
      const fs::path series = fs::path(target).parent_path();
      if (fs::remove(series, ignored)) fs::remove(series.parent_path(), ignored);
    }
  }

  void write(const std::string& path, const DeidentifiedFile& file, bool isFaceless) {
    const std::string series =
        (fs::path(folder_) / nameForUid(file.studyUid) / nameForUid(file.seriesUid)).string();
    const std::string target = series + "/" + nameForUid(file.instanceUid) + ".dcm";
    if (!claim(target)) return compareLater({path, target, file, isFaceless});
    std::error_code ignored;
    const bool isThere = fs::exists(target, ignored);
    Status written = makePrivateFolder(series);
    if (written && !isThere) written = writeDeidentified(file, path, target);
    const bool isSame = !isThere || isWrittenAt(file, path, target);
    const std::lock_guard lock(mutex_);
    if (!written) {
      if (problem_) problem_ = written;
      return;
    }
    if (isSame)
      note(file, target, isThere, isFaceless);
    else
      others_.emplace(target, path);
  }
  // Counts a copy and what its pixels may show.
  void note(const DeidentifiedFile& file, const std::string& target, bool isThere, bool isFaceless) {
    const std::string series = fs::path(target).parent_path().string();
    ++(isThere ? report_.alreadyThere : report_.written);
    if (file.mayShowText) withText_.insert(series);
    if (file.mayShowFace) withFaces_.insert(series);
    if (file.hasLostSuv) withoutSuv_.insert(series);
    if (file.hasLostMosaic) withoutMosaic_.insert(series);
    if (isFaceless) faceless_.insert(series);
  }
  bool claim(const std::string& target) {
    const std::lock_guard lock(mutex_);
    return targets_.insert(target).second;
  }
  void compareLater(Later file) {
    const std::lock_guard lock(mutex_);
    later_.push_back(std::move(file));
  }
  void leaveOut(const std::string& path, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (reason == noDicomFile)
      ++report_.notDicom;
    else
      report_.leftOut.push_back({path, reason});
  }

  const std::string folder_;
  const Deidentification& how_;
  const CancelToken& cancel_;
  std::mutex mutex_;
  Status problem_;  // why the folder cannot be written
  DeidentifyReport report_;
  std::vector<Later> later_;
  std::map<std::string, std::string> others_;  // copies that were there already, and the files that differ
  std::set<std::string> targets_, withText_, withFaces_, withoutSuv_, withoutMosaic_, faceless_;
  std::set<std::string> done_;  // files whose copies have other pixels
};

// Writes the faceless copies. Leaves series that show no head, or cannot be loaded, to the caller.
Status addFaceless(Copies& copies, const std::vector<std::string>& files, const Progress& progress,
                   const CancelToken& cancel) {
  const auto study = openFiles(files, progress, cancel);
  if (!study) return study.error();
  for (const Series& series : study->volumes) {
    if (!FacelessSeries::mayBeOf(series)) continue;
    const auto faceless = FacelessSeries::of(series, progress, cancel);
    if (faceless) copies.addFaceless(*faceless, progress);
  }
  return {};
}

}  // namespace

Result<DeidentifyReport> deidentifyFiles(const std::vector<std::string>& files, const std::string& folder,
                                         const Deidentification& how, const Progress& progress,
                                         const CancelToken& cancel, int* complete) {
  const MadeFolder ours(folder);
  if (Status made = makePrivateFolder(folder); !made) return made.error();
  Copies copies(folder, how, cancel);
  if (how.deface)
    if (Status s = addFaceless(copies, files, progress, cancel); !s) return s.error();
  dicom::forEachParallel(files.size(), "writing", progress, cancel, [&](std::size_t n) {
    if (!copies.hasProblem() && !copies.isDone(files[n])) copies.add(files[n]);
  });
  copies.compareAll();
  if (complete) *complete = copies.complete();
  return std::move(copies).report();
}

}  // namespace volumen
