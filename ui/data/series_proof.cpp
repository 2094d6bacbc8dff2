#include "ui/data/series_proof.h"

#include <QCryptographicHash>
#include <filesystem>
#include <set>

#include "io/study/series.h"

namespace volumen {

namespace {

std::string hashOf(const std::vector<std::string>& uids) {
  if (uids.empty()) return {};
  QCryptographicHash hash(QCryptographicHash::Sha256);
  for (const std::string& uid : uids) {
    hash.addData(QByteArrayView(uid.data(), qsizetype(uid.size())));
    hash.addData("\n");
  }
  return hash.result().toHex().toStdString();
}

std::string sizeText(glm::ivec3 size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z);
}

}  // namespace

SeriesProof proofOf(const Series& series) {
  return {series.acquired, series.valueType, int(series.files.size()), hashOf(series.sopInstanceUids)};
}

std::vector<SavedFolder> foldersOf(const Series& series) {
  namespace fs = std::filesystem;
  constexpr std::size_t most = 1000;
  std::set<std::string> names;
  for (const std::string& file : series.files)
    if (file != series.path)
      names.insert(fs::path(file).parent_path().lexically_relative(series.path).string());
  if (names.size() > most || names == std::set<std::string>{"."}) return {};
  std::vector<SavedFolder> folders;
  for (const std::string& name : names) folders.push_back({name});
  return folders;
}

std::string changeText(const SeriesProof& before, const SeriesProof& now) {
  const glm::ivec3 was = before.geometry.size, is = now.geometry.size;
  if (was.x == is.x && was.y == is.y && was.z != is.z)
    return "it has " + std::to_string(is.z) + " slices instead of " + std::to_string(was.z);
  if (was != is) return "it has " + sizeText(is) + " voxels instead of " + sizeText(was);
  if (before.geometry.spacing() != now.geometry.spacing()) return "its voxels have another size";
  if (before.geometry != now.geometry) return "it lies elsewhere in the patient";
  if (before.valueType != now.valueType)
    return "its values are " + now.valueType + " instead of " + before.valueType;
  return before == now ? "" : "it is made of other files";
}

}  // namespace volumen
