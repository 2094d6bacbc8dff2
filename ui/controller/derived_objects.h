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

/// What was read of a structure set or of a segmentation; the other one is null.
struct LoadedRegions {
  std::shared_ptr<const StructureSet> contours;
  std::shared_ptr<const Segmentation> segmentation;
};

/// The objects that refer to pictures: which there are in what is open, and what was read of them, each a
/// job. Asking never waits.
class DerivedObjects : public QObject {
  Q_OBJECT
 public:
  explicit DerivedObjects(Jobs& jobs, QObject* parent = nullptr);

  /// Those of all studies that are open.
  void setOpen(std::vector<DerivedObjectPtr> all);
  const std::vector<DerivedObjectPtr>& all() const { return all_; }
  /// Those of a kind that name picture `index` (from 0) of a series.
  std::vector<DerivedObjectPtr> naming(DerivedKind kind, const Series& series, int index) const;

  /// Null: it is not open, or not read yet and changed() will tell, or it cannot be read and failed() told.
  /// That holds until tryAgain() or setOpen().
  std::shared_ptr<const LoadedRegions> regions(const DerivedKey& key, DerivedKind kind);
  /// Reads the regions of this object again where that failed.
  void tryAgain(const DerivedKey& key) { failed_.erase(key); }
  /// Ends in reportRead() or failed().
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
