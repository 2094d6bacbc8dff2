#pragma once

#include <functional>
#include <string>

#include "ui/features/feature.h"

namespace volumen {

/// Exports segments of the series that the panel shows. Asks for the file, the options of surfaces, and
/// before replacing files that the file dialog did not ask about.
class SegmentsToFiles : public Feature {
 public:
  explicit SegmentsToFiles(Workbench& bench);

  /// Requires at least one segment.
  void ask();

 private:
  void save(const std::vector<SegmentMap>& maps, const Series& series, const QString& path);
  void chooseSurfaces(const std::vector<SegmentMap>& maps, const Series& series, const QString& path);
  /// Calls `write` with the files to be written. If it replaces files other than `path`, asks first.
  void writeTo(const QString& path, const Result<std::vector<std::string>>& files,
               const std::function<void(const std::vector<std::string>& files)>& write);
  void askBeforeReplacing(const QStringList& files, const std::function<void()>& replace);
};

}  // namespace volumen
