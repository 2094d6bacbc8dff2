#pragma once

#include <QString>
#include <vector>

#include "io/index/index.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// A series, or one picture of a series of projections (isOfProjections()).
struct SeriesPicture {
  const Series* series = nullptr;  ///< null: none
  int frame = -1;                  ///< index of its frame, from 0; -1: the series as such
  explicit operator bool() const { return series != nullptr; }
  bool operator==(const SeriesPicture&) const = default;
};
/// Returns series of projections picture by picture, the first of each file and projection, and other series
/// as such.
std::vector<SeriesPicture> picturesOf(const std::vector<const Series*>& series);
/// Returns the picture in a view.
SeriesPicture pictureIn(const Workspace& workspace, ViewId view);

/// The open studies of one patient, seen from one of them.
struct PatientStudies {
  std::vector<const Series*> current;              ///< series of that study
  std::vector<std::vector<const Series*>> priors;  ///< studies of earlier days, the latest first
};

/// Returns the studies around that of `current`. `open` are all open pictures; the pointers are kept.
PatientStudies studiesAround(const std::vector<const Series*>& open, const Series& current);

/// Returns the earlier studies with a series of one of these modalities, "CR|DX"; empty: all of them.
std::vector<std::vector<const Series*>> priorsOf(const PatientStudies& studies, const std::string& modality);

/// Returns how alike two pictures are, in points up to 100. Plane counts 30, weighting or kernel 25, words of
/// the description 20, contrast agent 15, thickness 10. Projections count laterality and view position as
/// plane; PA and AP are nearly alike. Returns 0 if modality or body part differ, or if only one is a volume.
double likeness(const SeriesPicture& a, const SeriesPicture& b);
/// The least likeness() of pictures that count as the same.
inline constexpr double leastLikeness = 50;

/// Returns the picture in `among` most like `picture`; of equals the one with the lowest series number.
/// Returns no series if none is alike enough.
SeriesPicture mostLike(const SeriesPicture& picture, const std::vector<const Series*>& among);

/// Returns the same picture of the latest earlier study that has one; no series if none is open.
SeriesPicture priorOf(const SeriesPicture& picture, const std::vector<const Series*>& open);

/// Returns series of the same patient from a known day, earlier than `series` and later than `after`
/// ("YYYYMMDD"; empty: no limit). The patient is identified by ID and name, and by birth date and sex if both
/// give them. Empty without an ID.
std::vector<const Series*> earlierOf(const Series& series, const std::vector<const Series*>& among,
                                     const std::string& after);

/// Returns listed studies that are not open and may hold an earlier such picture, the latest first. They have
/// the patient (as in earlierOf()) and the modality of `series`, are earlier, and later than `after`.
std::vector<IndexedStudy> unopenedPriors(const Series& series, const std::vector<IndexedStudy>& listed,
                                         const std::vector<const Series*>& open, const std::string& after);

/// Returns whether the description of a listed study shares a word with a series, its study or its body part.
/// Also true if one has no words. Numbers and words of one or two letters do not count.
bool soundsLike(const Series& series, const IndexedStudy& study);

/// Returns the picture most likely wanted beside a series: another weighting or kernel of its study, plane
/// and frame of reference, else its prior. Returns no series if there is neither.
SeriesPicture likelySecond(const Workspace& workspace, const SeriesPicture& picture,
                           const std::vector<const Series*>& open);

/// Shows the overlay of the first view, else likelySecond(), in the first empty comparison view.
Workspace withLikelySecond(Workspace workspace, const std::vector<const Series*>& open);

/// Shows both side by side as they are read: frames, or acquired slices that scroll together. The current one
/// is left and in focus. Neither view keeps a window of its own.
Workspace comparedWithPrior(Workspace workspace, const SeriesPicture& current, const SeriesPicture& prior);

/// Returns the date of a view's study if views on screen show several days, else an empty text. While names
/// are hidden, the latest is "Current" and earlier ones are "Prior".
QString dateToTellApart(const Workspace& workspace, ViewId view);

}  // namespace volumen
