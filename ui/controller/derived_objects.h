#pragma once

#include <memory>
#include <vector>

#include "io/contours.h"
#include "io/report.h"
#include "ui/data/derived_key.h"
#include "ui/document/derivation.h"
#include "ui/workspace/session.h"
#include "viewer/segment/segmentation.h"

namespace volumen {

/// The content of a structure set or a segmentation; the other pointer is null.
struct LoadedRegions {
  std::shared_ptr<const StructureSet> contours;
  std::shared_ptr<const Segmentation> segmentation;
};

/// The objects that refer to pictures, from all open studies. The content of those shown over pictures
/// follows from the workspace; it stays while the object is open. No call waits.
class DerivedObjects : public QObject {
  Q_OBJECT
 public:
  DerivedObjects(const Session& session, Jobs& jobs);

  /// Sets the objects of all open studies.
  void setOpen(std::vector<DerivedObjectPtr> all);
  const std::vector<DerivedObjectPtr>& all() const { return all_; }
  /// Returns the objects of a kind that refer to picture `index` (from 0) of a series.
  std::vector<DerivedObjectPtr> naming(DerivedKind kind, const Series& series, int index) const;

  /// Returns the regions, or null if the object is not shown, not read yet (changed() follows) or unreadable
  /// (failed() has reported it). An unreadable file is tried again, the first time after a second.
  std::shared_ptr<const LoadedRegions> regions(const DerivedKey& key) const;
  /// Reads a report; ends in reportRead() or failed().
  void readReport(const DerivedObjectPtr& report);

 Q_SIGNALS:
  /// Other studies are open, or regions were read.
  void changed();
  void reportRead(const volumen::DerivedObjectPtr& object, const volumen::Report& report);
  void failed(const QString& sentence);

 private:
  using Regions = Derivation<DerivedKey, LoadedRegions>;
  Regions::Rule regionsRule(const Session& session) const;
  DerivedObjectPtr find(const DerivedKey& key) const;

  std::vector<DerivedObjectPtr> all_;
  Regions regions_;
  JobLane reports_;
};

}  // namespace volumen
