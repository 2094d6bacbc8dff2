#include "tests/unit/app/series_case.h"

#include <QDir>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "tests/unit/app/export_case.h"

namespace volumen::tests {

namespace {

bool isNearly(const std::vector<double>& numbers, std::initializer_list<double> wanted) {
  return std::ranges::equal(numbers, wanted, [](double a, double b) { return std::abs(a - b) <= 1e-6; });
}

// Describes how a file lies elsewhere than its plane; empty if it does not.
QString placeFault(StoredFile& file, const TwinPlane& plane) {
  const glm::dvec2 half = (glm::dvec2(plane.size) - 1.0) * 0.5 * plane.mmPerPixel;
  const glm::dvec3 corner = plane.centre - half.x * plane.right - half.y * plane.down, r = plane.right,
                   d = plane.down;
  if (!isNearly(file.numbers(DCM_ImagePositionPatient), {corner.x, corner.y, corner.z}))
    return QStringLiteral("lies at ") + QString::fromStdString(file.said(DCM_ImagePositionPatient));
  if (!isNearly(file.numbers(DCM_ImageOrientationPatient), {r.x, r.y, r.z, d.x, d.y, d.z}))
    return QStringLiteral("is turned to ") + QString::fromStdString(file.said(DCM_ImageOrientationPatient));
  if (!isNearly(file.numbers(DCM_PixelSpacing), {plane.mmPerPixel, plane.mmPerPixel}))
    return QStringLiteral("has pixels of ") + QString::fromStdString(file.said(DCM_PixelSpacing));
  if (file.number(DCM_Columns, 0) != plane.size.x || file.number(DCM_Rows, 0) != plane.size.y)
    return QStringLiteral("has %1 columns").arg(file.number(DCM_Columns, 0));
  return {};
}

// Describes the first pixel with another value than `volumen slice` has; empty if there is none.
QString valueFault(StoredFile& file, const SliceFile& slice, std::optional<double>& outside) {
  const std::vector<double> values = file.values();
  if (!slice.failure.isEmpty()) return slice.failure;
  if (values.size() != slice.values.size()) return QStringLiteral("has %1 values").arg(values.size());
  const double half = 0.51 * file.number(DCM_RescaleSlope, 1);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double wanted = double(slice.values[n]);
    if (std::isnan(wanted) && !outside) outside = values[n];
    const bool isEqual = std::isnan(wanted) ? std::abs(values[n] - *outside) <= half
                                            : std::abs(values[n] - wanted) <= half + 1e-6 * std::abs(wanted);
    if (!isEqual) return QStringLiteral("has %1 at pixel %2, not %3").arg(values[n]).arg(n).arg(wanted);
  }
  return {};
}

}  // namespace

TwinPlane TwinStack::plane(int n) const {
  TwinPlane plane = first;
  plane.centre += n * distance * glm::cross(first.right, first.down);
  return plane;
}

TwinStack stackAcross(const VoxelGeometry& geometry, const TwinPlane& first, double distance) {
  TwinStack stack{first, 1, distance};
  const glm::dvec3 normal = glm::cross(first.right, first.down);
  double half = 0;
  for (const glm::dvec3& corner : geometry.boxCorners())
    half = std::max(half, std::abs(glm::dot(corner - geometry.centre(), normal)));
  stack.count = std::max(1, int(std::ceil(2 * half / distance - 1e-6)));
  stack.first.centre = geometry.centre() - 0.5 * (stack.count - 1) * distance * normal;
  return stack;
}

StoredFile::StoredFile(const QString& path) {
  if (file.loadFile(OFFilename(path.toUtf8().constData())).bad()) qWarning("%s", qPrintable(path));
}

std::string StoredFile::said(const DcmTagKey& tag) {
  OFString value;
  file.getDataset()->findAndGetOFStringArray(tag, value);
  return std::string(value.c_str(), value.size());
}

std::vector<double> StoredFile::numbers(const DcmTagKey& tag) {
  std::vector<double> all;
  for (const QString& number : QString::fromStdString(said(tag)).split(QLatin1Char('\\')))
    if (!number.isEmpty()) all.push_back(number.toDouble());
  return all;
}

double StoredFile::number(const DcmTagKey& tag, double otherwise) {
  const std::vector<double> all = numbers(tag);
  return all.empty() ? otherwise : all[0];
}

std::vector<double> StoredFile::values() {
  const Uint16* words = nullptr;
  unsigned long count = 0;
  file.getDataset()->findAndGetUint16Array(DCM_PixelData, words, &count);
  const bool isSigned = number(DCM_PixelRepresentation, 0) == 1;
  const double slope = number(DCM_RescaleSlope, 1), intercept = number(DCM_RescaleIntercept, 0);
  std::vector<double> all;
  for (unsigned long n = 0; n < count; ++n)
    all.push_back(slope * (isSigned ? double(Sint16(words[n])) : double(words[n])) + intercept);
  return all;
}

std::vector<std::string> StoredFile::sources() {
  std::vector<std::string> uids;
  DcmItem* item = nullptr;
  while (file.getDataset()->findAndGetSequenceItem(DCM_SourceImageSequence, item, long(uids.size())).good()) {
    OFString uid;
    item->findAndGetOFString(DCM_ReferencedSOPInstanceUID, uid);
    uids.emplace_back(uid.c_str());
  }
  return uids;
}

QStringList storedFilesIn(const QString& folder) {
  QStringList files;
  for (const QString& name : QDir(folder).entryList(QDir::Files, QDir::Name))
    files << folder + QLatin1Char('/') + name;
  return files;
}

QStringList newErrorsInMiddle(const QString& folder, const QString& source) {
  const QStringList files = storedFilesIn(folder);
  QStringList errors = newErrors(files[files.size() / 2], storedFilesIn(source).constFirst().toStdString());
  erase_if(errors,
           [](const QString& error) { return error.contains(QLatin1String("DeidentificationMethod")); });
  return errors;
}

QString exactText(double number) { return QString::number(number, 'g', 17); }

QString stackFaults(const QString& folder, const QString& source, const QStringList& ofSeries,
                    const TwinStack& stack, const std::set<int>& compared) {
  const QStringList files = storedFilesIn(folder);
  if (files.size() != stack.count)
    return QStringLiteral("%1 slices, not %2").arg(files.size()).arg(stack.count);
  std::optional<double> outside;
  for (int n = 0; n < stack.count; ++n) {
    StoredFile file(files[n]);
    QString fault = placeFault(file, stack.plane(n));
    if (fault.isEmpty() && compared.contains(n))
      fault = valueFault(file, runSlice(source, ofSeries + planeOptions(stack.plane(n))), outside);
    if (!fault.isEmpty()) return QStringLiteral("slice %1 %2").arg(n).arg(fault);
  }
  return {};
}

}  // namespace volumen::tests
