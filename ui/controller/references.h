#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "io/contours.h"
#include "io/report.h"
#include "ui/data/reference_key.h"
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
class References : public QObject {
  Q_OBJECT
 public:
  explicit References(Jobs& jobs, QObject* parent = nullptr);

  /// Those of all studies that are open.
  void setOpen(std::vector<ReferencePtr> all);
  const std::vector<ReferencePtr>& all() const { return all_; }
  /// Those of a kind that name picture `index` (from 0) of a series.
  std::vector<ReferencePtr> naming(ReferenceKind kind, const Series& series, int index) const;

  /// Null: it is not open, or not read yet and changed() will tell, or it cannot be read and failed() told
  /// once.
  std::shared_ptr<const LoadedRegions> regions(const ReferenceKey& key, ReferenceKind kind);
  /// Ends in reportRead() or failed().
  void readReport(const ReferencePtr& report);

 Q_SIGNALS:
  /// Other studies are open, or regions were read.
  void changed();
  void reportRead(const volumen::ReferencePtr& object, const volumen::Report& report);
  void failed(const QString& sentence);

 private:
  std::vector<ReferencePtr> all_;
  std::map<ReferenceKey, std::shared_ptr<const LoadedRegions>> regions_;
  std::set<ReferenceKey> asked_;
  JobLane lane_;
};

}  // namespace volumen
