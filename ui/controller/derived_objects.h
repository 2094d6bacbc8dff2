#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "io/contours.h"
#include "io/report.h"
#include "ui/data/derived_key.h"
#include "ui/document/job_lane.h"
#include "viewer/segment/segmentation.h"

namespace volumen {

struct Series;

/// The content of a structure set or a segmentation; the other pointer is null.
struct LoadedRegions {
  std::shared_ptr<const StructureSet> contours;
  std::shared_ptr<const Segmentation> segmentation;
};

/// The objects that refer to pictures, from all open studies, and their content. Each is read by a job. No
/// call waits.
class DerivedObjects : public QObject {
  Q_OBJECT
 public:
  explicit DerivedObjects(Jobs& jobs, QObject* parent = nullptr);

  /// Sets the objects of all open studies.
  void setOpen(std::vector<DerivedObjectPtr> all);
  const std::vector<DerivedObjectPtr>& all() const { return all_; }
  /// Returns the objects of a kind that refer to picture `index` (from 0) of a series.
  std::vector<DerivedObjectPtr> naming(DerivedKind kind, const Series& series, int index) const;

  /// Returns the regions, or null if the object is not open, not read yet (changed() follows) or unreadable
  /// (failed() has reported it). A failure holds until tryAgain() or setOpen().
  std::shared_ptr<const LoadedRegions> regions(const DerivedKey& key, DerivedKind kind);
  /// Allows another attempt to read this object after a failure.
  void tryAgain(const DerivedKey& key) { failed_.erase(key); }
  /// Reads a report; ends in reportRead() or failed().
  void readReport(const DerivedObjectPtr& report);

 Q_SIGNALS:
  /// Other studies are open, or regions were read.
  void changed();
  void reportRead(const volumen::DerivedObjectPtr& object, const volumen::Report& report);
  void failed(const QString& sentence);

 private:
  std::vector<DerivedObjectPtr> all_;
  std::map<DerivedKey, std::shared_ptr<const LoadedRegions>> regions_;
  std::set<DerivedKey> asked_, failed_;
  JobLane lane_;
};

}  // namespace volumen
