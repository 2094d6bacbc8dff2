#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/export/secondary_capture.h"
#include "io/study/study.h"
#include "results/segments/segment_map.h"
#include "results/series/loaded_series.h"
#include "ui/document/job_lane.h"
#include "ui/exports/picture_maker.h"
#include "viewer/slice/plane.h"

namespace volumen {

class OpenStudies;
class Session;

/// Files that leave the window, and notes for the user on how they were made.
struct LeavingFiles {
  std::vector<std::string> files;
  QStringList notes{};
};

/// Files that can leave the window.
struct FileOffer {
  QString text;  ///< which these are: "Its measurements as a structured report"
  QString name;  ///< of a new file or folder, without ending
  /// Returns the files, or makes them in `folder`. Runs on the thread of a job.
  std::function<Result<LeavingFiles>(const QString& folder, const Job& job)> make{};
  /// Makes `frames` pictures for a Secondary Capture of `series` instead, with or without names.
  std::function<PictureMakerPtr(bool namesHidden)> pictures{};
  Series series{};
  CaptureTags tags{};
  int frames = 1;
  bool hasFace = false;  ///< volumes of it may show a head (FacelessSeries)
};

/// Returns what can leave of a series shown in the window and of its study: their files, the segments
/// `maps`, measurements and key images as DICOM objects.
std::vector<FileOffer> offersOf(const Series& shown, const std::vector<SegmentMap>& maps,
                                const Session& session, const OpenStudies& open);

/// Returns all that is open of the study of a series.
Study openStudyOf(const OpenStudies& open, const Series& series);

/// Returns an offer of how the acquired pictures of a series are shown: in `window`, by default in their own,
/// with its measurements.
FileOffer offerOfPresentation(const Series& shown, const std::optional<Window>& window,
                              const Session& session, const OpenStudies& open);

/// Returns an offer of slices through a whole series like `plane`, in its slab and interpolation, as a
/// derived series of this number.
FileOffer offerOfSlices(const LoadedSeriesPtr& shown, const SlicePlane& plane, int seriesNumber);

}  // namespace volumen
