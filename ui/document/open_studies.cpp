#include "ui/document/open_studies.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "io/study/frame_series.h"
#include "results/series/time_points.h"
#include "results/text/text.h"

namespace volumen {

const Series* OpenStudy::seriesAt(std::size_t n) const {
  const std::size_t volumes = study->volumes.size();
  if (n < volumes) return &study->volumes[n];
  return n < volumes + frames.size() ? &frames[n - volumes] : nullptr;
}

std::vector<std::vector<std::size_t>> OpenStudy::rows() const {
  std::vector<std::vector<const Series*>> volumes;
  std::map<std::string_view, std::vector<std::size_t>> ofSeries;  // rows of each series
  for (const Series& series : study->volumes) {
    std::vector<std::size_t>& known = ofSeries[series.seriesUid];
    const auto row = std::ranges::find_if(
        known, [&](std::size_t n) { return areTimePoints(*volumes[n].front(), series); });
    if (row != known.end() && !opensAsFrames(series)) {
      volumes[*row].push_back(&series);
      continue;
    }
    known.push_back(volumes.size());
    volumes.push_back({&series});
  }
  std::vector<std::vector<std::size_t>> all;
  for (std::vector<const Series*>& row : volumes) {
    sortTimePoints(row);
    all.emplace_back();
    for (const Series* series : row) all.back().push_back(numberOf(*series));
  }
  for (std::size_t n = 0; n < frames.size(); ++n) all.push_back({study->volumes.size() + n});
  return all;
}

void OpenStudies::add(const QString& path, const std::shared_ptr<const Study>& study) {
  std::erase_if(all_, [&](const OpenStudy& opened) { return opened.path == path; });
  all_.push_back({path, study, frameSeries(*study)});
  Q_EMIT added(path);
  Q_EMIT changed();
}

void OpenStudies::setUnlisted(const Unlisted& unlisted) {
  if (unlisted == unlisted_) return;
  const Unlisted before = std::exchange(unlisted_, unlisted);
  const auto comesBack = [](const auto& were, const auto& are) { return !std::ranges::includes(are, were); };
  Q_EMIT unlistedChanged(comesBack(before.series, unlisted.series) ||
                         comesBack(before.derived, unlisted.derived));
  Q_EMIT changed();
}

void OpenStudies::forgetEmpty() {
  std::erase_if(all_, [](const OpenStudy& o) { return !o.seriesAt(0) && o.study->derived.empty(); });
}

const OpenStudy* OpenStudies::find(const QString& path) const {
  const auto opened = std::ranges::find(all_, path, &OpenStudy::path);
  return opened == all_.end() ? nullptr : &*opened;
}

std::shared_ptr<const Study> OpenStudies::studyOf(const QString& path) const {
  const OpenStudy* opened = find(path);
  return opened && isListed(*opened) ? opened->study : nullptr;
}

bool OpenStudies::isListed(const OpenStudy& opened) const {
  for (std::size_t n = 0; const Series* series = opened.seriesAt(n); ++n)
    if (isListed(*series)) return true;
  const std::vector<DerivedObject>& objects = opened.study->derived;
  return std::ranges::any_of(objects, [this](const DerivedObject& object) { return isListed(object); }) ||
         (!opened.seriesAt(0) && objects.empty());
}

std::vector<const Series*> OpenStudies::volumes() const {
  std::vector<const Series*> found;
  for (const OpenStudy& opened : all_)
    for (const Series& series : opened.study->volumes)
      if (isListed(series)) found.push_back(&series);
  return found;
}

std::vector<const Series*> OpenStudies::pictures() const {
  std::vector<const Series*> found = volumes();
  for (const OpenStudy& opened : all_)
    for (const Series& frames : opened.frames)
      if (isListed(frames)) found.push_back(&frames);
  return found;
}

std::vector<DerivedObjectPtr> OpenStudies::derived() const {
  std::vector<DerivedObjectPtr> found;
  for (const OpenStudy& opened : all_)
    for (const DerivedObject& object : opened.study->derived)
      if (isListed(object)) found.emplace_back(opened.study, &object);
  return found;
}

QStringList OpenStudies::filesWithoutPixels() const {
  QStringList files;
  for (const OpenStudy& opened : all_) {
    if (!isListed(opened)) continue;
    for (const Other& other : opened.study->other) {
      const bool isDerivedObject = std::ranges::find(opened.study->derived, other.path,
                                                     &DerivedObject::path) != opened.study->derived.end();
      if (!isDerivedObject && other.kind.find("without pixel data") != std::string::npos)
        files << QStringLiteral("%1: %2.").arg(pathText(other.path), shownText(other.kind));
    }
  }
  return files;
}

Unlisted OpenStudies::everything() const {
  Unlisted found;
  for (const OpenStudy& opened : all_) {
    for (std::size_t n = 0; const Series* series = opened.seriesAt(n); ++n)
      found.series.insert(keyOf(*series));
    for (const DerivedObject& object : opened.study->derived) found.derived.insert(keyOf(object));
  }
  return found;
}

}  // namespace volumen
