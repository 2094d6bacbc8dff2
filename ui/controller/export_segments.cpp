#include "ui/controller/export_segments.h"

#include <QStringList>
#include <algorithm>
#include <vector>

#include "io/export/seg_nrrd.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// A row a kind of file.
struct ExportFormat {
  const char* ending;
  const char* noun;
  Status (*write)(const std::string& path, const SegmentMap& map, const CancelToken& cancel);
};

const std::vector<ExportFormat>& exportFormats() {
  static const std::vector<ExportFormat> table{
      {".seg.nrrd", "Segmentations",
       [](const std::string& path, const SegmentMap& map, const CancelToken& cancel) {
         return writeSegNrrd(*map.labels, map.segments, path, cancel);
       }},
  };
  return table;
}

}  // namespace

Status exportSegments(const std::string& path, const SegmentMap& map, const CancelToken& cancel) {
  const QString lower = QString::fromStdString(path).toLower();
  const auto format = std::ranges::find_if(
      exportFormats(), [&](const ExportFormat& f) { return lower.endsWith(QLatin1String(f.ending)); });
  if (format != exportFormats().end()) return format->write(path, map, cancel);
  std::string endings;
  for (const ExportFormat& f : exportFormats()) endings.append(endings.empty() ? "" : ", ").append(f.ending);
  return Error{"Cannot write " + path + ": the name must end in " + endings + "."};
}

QString exportFilters() {
  QStringList filters;
  for (const ExportFormat& f : exportFormats())
    filters << QStringLiteral("%1 (*%2)").arg(tr(f.noun), QLatin1String(f.ending));
  return filters.join(QStringLiteral(";;"));
}

QString usualExportEnding() { return QLatin1String(exportFormats().front().ending + 1); }

}  // namespace volumen
