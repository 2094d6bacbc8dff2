#pragma once

#include <QString>
#include <vector>

#include "io/index/index.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// A series, or one picture of a series of projections (isOfProjections()).
struct SeriesPicture {
  const Series* series = nullptr;  ///< null: none
  int frame = -1;                  ///< of its frames, from 0; -1: the series as such
  explicit operator bool() const { return series != nullptr; }
  bool operator==(const SeriesPicture&) const = default;
};
/// Those of series of projections one by one, of one file and projection the first; of others the series.
std::vector<SeriesPicture> picturesOf(const std::vector<const Series*>& series);
/// What a view shows.
SeriesPicture pictureIn(const Workspace& workspace, ViewId view);

/// What is open of one patient, from one study's point of view.
struct PatientStudies {
  std::vector<const Series*> current;              ///< of that study
  std::vector<std::vector<const Series*>> priors;  ///< of earlier days, a study each, the latest first
};

/// `open`: all pictures that are open; the pointers are kept.
PatientStudies studiesAround(const std::vector<const Series*>& open, const Series& current);

/// The earlier studies that hold a series of one of these modalities, "CR|DX"; empty: all of them.
std::vector<std::vector<const Series*>> priorsOf(const PatientStudies& studies, const std::string& modality);

/// How much two pictures are of the same thing: 100 of plane (or side and view of projections; PA and AP are
/// nearly alike) 30, weighting or kernel 25, words of the description 20, contrast agent 15, thickness 10; 0
/// where modality or body part differ, or one of them alone is a volume.
double likeness(const SeriesPicture& a, const SeriesPicture& b);
/// What likeness() calls the same.
inline constexpr double leastLikeness = 50;

/// The picture of some series most like one, of those alike that of the series with the lowest number; none
/// is like it: no series.
SeriesPicture mostLike(const SeriesPicture& picture, const std::vector<const Series*>& among);

/// The same picture of the latest study before that holds one; no series: none is open.
SeriesPicture priorOf(const SeriesPicture& picture, const std::vector<const Series*>& open);

/// Those of some series that are of the patient of one, of a day that is known, earlier than that of the one
/// and later than `after` ("YYYYMMDD"; empty: however early). The patient is told by ID, name and, where both
/// say them, birth date and sex; without an ID there are none.
std::vector<const Series*> earlierOf(const Series& series, const std::vector<const Series*>& among,
                                     const std::string& after);

/// Of studies that are listed those that may hold such a picture of before and are not open, the latest
/// first: of the patient as earlierOf() has it, of the modality, earlier than the series and later than
/// `after`.
std::vector<IndexedStudy> unopenedPriors(const Series& series, const std::vector<IndexedStudy>& listed,
                                         const std::vector<const Series*>& open, const std::string& after);

/// Whether a study that is listed is described by a word that a series, its study or its body part has, too;
/// also where one of them has none, numbers and words of one or two letters left out.
bool soundsLike(const Series& series, const IndexedStudy& study);

/// What is most likely wanted beside a series: of its study and plane another weighting or kernel, in the
/// same frame of reference; else its prior; no series: nothing.
SeriesPicture likelySecond(const Workspace& workspace, const SeriesPicture& picture,
                           const std::vector<const Series*>& open);

/// With likelySecond() in the first empty view to compare, beside what the first one shows.
Workspace withLikelySecond(Workspace workspace, const std::vector<const Series*>& open);

/// Side by side, the current one left and in focus, as they are read: frames, or slices as acquired that
/// scroll together, neither view with a window alone.
Workspace comparedWithPrior(Workspace workspace, const SeriesPicture& current, const SeriesPicture& prior);

/// The date of the study in a view, where views on screen show studies of several days; else empty. With
/// names hidden "Current" of the latest, "Prior" of those before.
QString dateToTellApart(const Workspace& workspace, ViewId view);

}  // namespace volumen
