#pragma once

#include <functional>
#include <string>

#include "ui/controller/segment_jobs.h"
#include "ui/features/feature.h"

namespace volumen {

/// Segments of the series that the panel is about are written to files: asks where, how
/// surfaces are written, and before it replaces files that the file dialog did not ask about.
class SegmentsToFiles : public Feature {
 public:
  SegmentsToFiles(Workbench& bench, SegmentJobs& segmenter);

  /// There is a segment.
  void ask();

 private:
  void save(const std::vector<SegmentMap>& maps, const Series& series, const QString& path);
  void chooseSurfaces(const std::vector<SegmentMap>& maps, const Series& series, const QString& path);
  /// Calls `write` with the files that are written; where others than `path` are replaced only once that is
  /// meant.
  void writeTo(const QString& path, const Result<std::vector<std::string>>& files,
               const std::function<void(const std::vector<std::string>& files)>& write);
  void askBeforeReplacing(const QStringList& files, const std::function<void()>& replace);

  SegmentJobs& segmenter_;
};

}  // namespace volumen
