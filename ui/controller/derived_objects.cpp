#include "ui/controller/derived_objects.h"

#include <algorithm>

#include "io/segmentation.h"
#include "io/study/series.h"
#include "ui/data/picture_index.h"

namespace volumen {

namespace {

Result<LoadedRegions> loadRegions(const std::string& path, DerivedKind kind) {
  if (kind == DerivedKind::segmentation) {
    auto segmentation = loadSegmentation(path);
    if (!segmentation) return segmentation.error();
    return LoadedRegions{nullptr, std::make_shared<const Segmentation>(std::move(*segmentation))};
  }
  auto contours = loadContours(path);
  if (!contours) return contours.error();
  return LoadedRegions{std::make_shared<const StructureSet>(std::move(*contours)), nullptr};
}

}  // namespace

DerivedObjects::DerivedObjects(Jobs& jobs, QObject* parent) : QObject(parent), lane_(&jobs) {
  lane_.keepToTheEnd();  // views would request it again
}

void DerivedObjects::setOpen(std::vector<DerivedObjectPtr> all) {
  all_ = std::move(all);
  failed_.clear();
  Q_EMIT changed();
}

std::vector<DerivedObjectPtr> DerivedObjects::naming(DerivedKind kind, const Series& series,
                                                     int index) const {
  std::vector<DerivedObjectPtr> found;
  for (const DerivedObjectPtr& object : all_)
    if (object->kind == kind && namesPicture(object->pictures, series, index)) found.push_back(object);
  return found;
}

std::shared_ptr<const LoadedRegions> DerivedObjects::regions(const DerivedKey& key, DerivedKind kind) {
  if (const auto held = regions_.find(key); held != regions_.end()) return held->second;
  const auto isIt = [&](const DerivedObjectPtr& object) { return keyOf(*object) == key; };
  if (std::ranges::none_of(all_, isIt) || failed_.contains(key)) return nullptr;
  if (!asked_.insert(key).second) return nullptr;
  lane_.run(
      tr("Reading regions"), [key, kind](const Job&) { return loadRegions(key.path, kind); },
      [this, key](Result<LoadedRegions> loaded) {
        asked_.erase(key);
        if (!loaded) {
          failed_.insert(key);
          return void(Q_EMIT failed(QString::fromStdString(loaded.message())));
        }
        regions_[key] = std::make_shared<const LoadedRegions>(std::move(*loaded));
        Q_EMIT changed();
      });
  return nullptr;
}

void DerivedObjects::readReport(const DerivedObjectPtr& object) {
  lane_.run(
      tr("Reading the report"), [object](const Job&) { return loadReport(object->path); },
      [this, object](const Result<Report>& report) {
        if (report)
          Q_EMIT reportRead(object, *report);
        else
          Q_EMIT failed(QString::fromStdString(report.message()));
      });
}

}  // namespace volumen
