#include "app/exports/chosen_pictures.h"

#include <algorithm>
#include <map>

#include "app/open_volume.h"
#include "io/files/same_bytes.h"
#include "io/presentation.h"
#include "io/study/choose.h"
#include "io/study/frame_series.h"
#include "results/text/text.h"

namespace volumen {

namespace {

bool holds(const Series& series, const std::string& instance) {
  return std::ranges::find(series.sopInstanceUids, instance) != series.sopInstanceUids.end();
}

/// Finds series of a study, volumes before other pictures.
class SeriesFinder {
 public:
  SeriesFinder(const std::string& path, const Study& study)
      : path_(path), study_(study), frames_(frameSeries(study)) {}

  // Returns whether a series found is a volume.
  bool isVolume(const Series* series) const {
    return std::ranges::any_of(study_.volumes, [&](const Series& one) { return &one == series; });
  }
  std::size_t count() const { return study_.volumes.size() + frames_.size(); }

  Result<const Series*> named(const std::string& name) const {
    if (const auto volume = chooseSeries(study_, name)) return &study_.volumes[*volume];
    const auto image = std::ranges::find(study_.images, name, &Image::id);
    const auto* found = find([&](const Series& series) {
      return series.id == name || series.seriesUid == name ||
             (image != study_.images.end() && holds(series, image->sopInstanceUid));
    });
    if (found) return found;
    return Error{"--series " + name + " names no series of " + path_ +
                 "; \"volumen info --json\" lists their ids."};
  }

  Result<const Series*> holding(const std::string& instance) const {
    const auto* found = find([&](const Series& series) { return holds(series, instance); });
    if (found) return found;
    return Error{"No image here has the SOPInstanceUID " + instance + "."};
  }

  Result<const Series*> largest() const {
    if (count() == 0) return nothingToShow(path_, study_);
    if (study_.volumes.empty()) return &frames_.front();
    return &study_.volumes[*chooseSeries(study_, {})];
  }

 private:
  template <class Is>
  const Series* find(const Is& is) const {
    for (const auto* all : {&study_.volumes, &frames_})
      if (const auto found = std::ranges::find_if(*all, is); found != all->end()) return &*found;
    return nullptr;
  }

  const std::string& path_;
  const Study& study_;
  const std::vector<Series> frames_;
};

// Returns the frames of a series that images mean, or the Error that names one that it lacks.
Result<std::vector<int>> indicesOf(const Series& series, const std::vector<ReferencedPicture>& images) {
  const auto isAt = [&](std::size_t n, const ReferencedPicture& image) {
    return namesFrame({image}, series.sopInstanceUids[n], series.frames[n]);
  };
  std::vector<int> all;
  for (std::size_t n = 0; n < series.sopInstanceUids.size(); ++n)
    if (images.empty() || std::ranges::any_of(images, [&](const auto& image) { return isAt(n, image); }))
      all.push_back(int(n));
  for (const ReferencedPicture& image : images) {
    if (!holds(series, image.sopInstanceUid))
      return Error{"--images: " + image.sopInstanceUid + " is no picture of " + series.id + "."};
    for (const int frame : image.frames)
      if (std::ranges::none_of(all, [&](int n) {
            return isAt(std::size_t(n), {image.sopInstanceUid, {}, {frame}, {}});
          }))
        return Error{"--images: " + image.sopInstanceUid + " has no frame " + std::to_string(frame + 1) +
                     "."};
  }
  return all;
}

// Leaves out the pictures of files that are copies of others.
std::vector<int> withoutCopies(const Series& series, const std::vector<int>& indices) {
  std::map<std::pair<std::string, int>, const std::string*> files;  // by instance and frame
  FileCopies copies;
  std::vector<int> kept;
  for (const int index : indices) {
    const auto n = std::size_t(index);
    const std::string &uid = series.sopInstanceUids[n], &file = series.files[n];
    const auto [first, isNew] = files.emplace(std::pair(uid, series.frames[n]), &file);
    if (uid.empty() || isNew || !copies.areAlike(*first->second, file)) kept.push_back(index);
  }
  return kept;
}

}  // namespace

Result<ChosenPictures> choosePictures(const std::string& path, const Study& study, const std::string& series,
                                      const std::vector<ReferencedPicture>& images,
                                      const std::string& instance) {
  const SeriesFinder finder(path, study);
  const std::string& held = images.empty() ? instance : images.front().sopInstanceUid;
  const auto found = !series.empty() ? finder.named(series)
                     : !held.empty() ? finder.holding(held)
                                     : finder.largest();
  if (!found) return found.error();
  ChosenPictures chosen{**found, {}, finder.isVolume(*found), {}};
  if (chosen.series.format != "DICOM") return Error{chosen.series.path + " holds no DICOM images."};
  if (series.empty() && held.empty() && finder.count() > 1)
    chosen.notes.push_back(path + " holds several series; the pictures are those of \"" +
                           seriesText(chosen.series).toStdString() + "\". Choose others with --series.");
  const auto indices = indicesOf(chosen.series, images);
  if (!indices) return indices.error();
  chosen.indices = withoutCopies(chosen.series, *indices);
  return chosen;
}

}  // namespace volumen
