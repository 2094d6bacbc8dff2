#include "ui/controller/derived_objects.h"

#include <algorithm>

#include "io/segmentation.h"
#include "ui/controller/frame_service.h"
#include "ui/data/picture_index.h"

namespace volumen {

namespace {

Result<std::shared_ptr<const LoadedRegions>> loadRegions(const std::string& path, DerivedKind kind) {
  LoadedRegions loaded;
  if (kind == DerivedKind::segmentation) {
    auto segmentation = loadSegmentation(path);
    if (!segmentation) return segmentation.error();
    loaded.segmentation = std::make_shared<const Segmentation>(std::move(*segmentation));
  } else {
    auto contours = loadContours(path);
    if (!contours) return contours.error();
    loaded.contours = std::make_shared<const StructureSet>(std::move(*contours));
  }
  return std::make_shared<const LoadedRegions>(std::move(loaded));
}

std::size_t bytesOf(const LoadedRegions& regions) {
  std::size_t bytes = regions.segmentation ? regions.segmentation->bits.size() : 0;
  if (regions.contours)
    for (const RegionOfInterest& region : regions.contours->regions)
      for (const Contour& contour : region.contours) bytes += contour.points.size() * sizeof(glm::dvec3);
  return bytes;
}

}  // namespace

DerivedObjects::DerivedObjects(const Session& session, Jobs& jobs)
    : regions_(regionsRule(session), session, &jobs), reports_(&jobs) {
  connect(&regions_, &Regions::changed, this, &DerivedObjects::changed);
  connect(&regions_, &Regions::failed, this, &DerivedObjects::failed);
}

DerivedObjects::Regions::Rule DerivedObjects::regionsRule(const Session& session) const {
  return {.wanted =
              [this, &session] {
                std::vector<DerivedKey> wanted;
                for (const auto& [key, look] : session.workspace().regions)
                  if (find(key)) wanted.push_back(key);
                return wanted;
              },
          .work = [this](const DerivedKey& key, std::size_t) -> Regions::Work {
            return [path = key.path, kind = find(key)->kind](const Job&) { return loadRegions(path, kind); };
          },
          .name = [](const DerivedKey&) { return JobName(tr("Reading regions")); },
          .bytes = bytesOf,
          .isKept = [this](const DerivedKey& key) { return find(key) != nullptr; },
          .isTriedAgain = [](const Regions::Entry& entry, const Workspace& before,
                             const Workspace&) { return !before.regions.contains(entry.key); },
          .tryAgainMs = FrameService::tryAgainMs,
          .lacksMemory = "There is not enough memory for the regions."};
}

DerivedObjectPtr DerivedObjects::find(const DerivedKey& key) const {
  const auto found = std::ranges::find(all_, key, [](const DerivedObjectPtr& one) { return keyOf(*one); });
  return found == all_.end() ? nullptr : *found;
}

void DerivedObjects::setOpen(std::vector<DerivedObjectPtr> all) {
  all_ = std::move(all);
  regions_.tryAgain([](const DerivedKey&) { return true; });
  regions_.update();
  Q_EMIT changed();
}

std::vector<DerivedObjectPtr> DerivedObjects::naming(DerivedKind kind, const Series& series,
                                                     int index) const {
  std::vector<DerivedObjectPtr> found;
  for (const DerivedObjectPtr& object : all_)
    if (object->kind == kind && namesPicture(object->pictures, series, index)) found.push_back(object);
  return found;
}

std::shared_ptr<const LoadedRegions> DerivedObjects::regions(const DerivedKey& key) const {
  const auto* entry = regions_.find(key);
  return entry ? entry->value : nullptr;
}

void DerivedObjects::readReport(const DerivedObjectPtr& object) {
  reports_.run(
      tr("Reading the report"), [object](const Job&) { return loadReport(object->path); },
      [this, object](const Result<Report>& report) {
        if (report)
          Q_EMIT reportRead(object, *report);
        else
          Q_EMIT failed(QString::fromStdString(report.message()));
      });
}

}  // namespace volumen
