#include "tests/unit/io/dicom_folder.h"

#include <QString>
#include <algorithm>

#include "io/open.h"

namespace volumen::tests {

std::string DicomFolder::path(const std::string& name) const {
  return dir_.filePath(QString::fromStdString(name)).toStdString();
}

void DicomFolder::add(const std::string& name, const DicomPicture& picture, const char* syntax) const {
  writeDicom(path(name), picture, syntax);
}

void DicomFolder::addStack(const std::vector<double>& z) const {
  for (std::size_t n = 0; n < z.size(); ++n)
    add(numbered("s", int(100 + (n * 11) % z.size())), sliceAt(z[n], int(100 * z[n])));
}

Study DicomFolder::open() const {
  Result<Study> study = openStudy(path());
  return study.ok() ? *study : Study{};
}

DicomPicture sliceAt(double z, int value) {
  DicomPicture p;
  p.position = {10, 20, z};
  p.instance = 1000 - value;
  p.pixels = {std::uint16_t(value)};
  return p;
}

std::string numbered(const char* prefix, int n) {
  return QString::fromLatin1("%1%2").arg(QLatin1String(prefix)).arg(n).toStdString();
}

bool warns(const std::vector<Warning>& warnings, const std::string& word) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const Warning& w) {
    return w.sentence.find(word) != std::string::npos && w.sentence.ends_with(".");
  });
}

std::vector<float> firstOfEachSlice(const Volume& volume) {
  std::vector<float> values;
  for (int k = 0; k < volume.size().z; ++k) values.push_back(volume.value(0, 0, k));
  return values;
}

}  // namespace volumen::tests
