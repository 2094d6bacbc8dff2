#include "ui/controller/references.h"

#include <algorithm>

#include "io/segmentation.h"
#include "ui/data/picture_index.h"

namespace volumen {

namespace {

Result<LoadedRegions> loadRegions(const std::string& path, ReferenceKind kind) {
  if (kind == ReferenceKind::segmentation) {
    auto segmentation = loadSegmentation(path);
    if (!segmentation) return segmentation.error();
    return LoadedRegions{nullptr, std::make_shared<const Segmentation>(std::move(*segmentation))};
  }
  auto contours = loadContours(path);
  if (!contours) return contours.error();
  return LoadedRegions{std::make_shared<const StructureSet>(std::move(*contours)), nullptr};
}

}  // namespace

References::References(QObject* parent) : QObject(parent) { pool_.setMaxThreadCount(1); }

References::~References() {
  pool_.clear();
  pool_.waitForDone();
}

void References::setOpen(std::vector<ReferencePtr> all) {
  all_ = std::move(all);
  Q_EMIT changed();
}

std::vector<ReferencePtr> References::naming(ReferenceKind kind, const Series& series, int index) const {
  std::vector<ReferencePtr> found;
  for (const ReferencePtr& object : all_)
    if (object->kind == kind && namesPicture(object->pictures, series, index)) found.push_back(object);
  return found;
}

void References::fail(const std::string& sentence) {
  QMetaObject::invokeMethod(
      this, [this, text = QString::fromStdString(sentence)] { Q_EMIT failed(text); }, Qt::QueuedConnection);
}

std::shared_ptr<const LoadedRegions> References::regions(const ReferenceKey& key, ReferenceKind kind) {
  if (const auto held = regions_.find(key); held != regions_.end()) return held->second;
  const auto isIt = [&](const ReferencePtr& object) { return keyOf(*object) == key; };
  if (std::ranges::none_of(all_, isIt) || !asked_.insert(key).second) return nullptr;
  pool_.start([this, key, kind] {
    Result<LoadedRegions> loaded = loadRegions(key.path, kind);
    if (!loaded) return fail(loaded.message());
    QMetaObject::invokeMethod(
        this,
        [this, key, regions = std::make_shared<const LoadedRegions>(std::move(*loaded))] {
          regions_[key] = regions;
          Q_EMIT changed();
        },
        Qt::QueuedConnection);
  });
  return nullptr;
}

void References::readReport(const ReferencePtr& object) {
  pool_.start([this, object] {
    const Result<Report> report = loadReport(object->path);
    if (!report) return fail(report.message());
    QMetaObject::invokeMethod(
        this, [this, object, report = *report] { Q_EMIT reportRead(object, report); }, Qt::QueuedConnection);
  });
}

}  // namespace volumen
