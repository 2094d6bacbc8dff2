#include "io/files/sample_cache.h"

#include <zlib.h>

#include <QDir>
#include <QStandardPaths>
#include <algorithm>
#include <array>
#include <cstring>

#include "io/files/output_file.h"
#include "io/regular_file.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/volume/buffer.h"

namespace volumen {

namespace {

// The header of a cache file; its values follow in memory layout.
struct Head {
  std::array<char, 16> format{'v', 'o', 'l', 'u', 'm', 'e', 'n', ' ', 's', 'a', 'm', 'p', 'l', 'e', ' ', '1'};
  std::uint64_t checksum = 0;
};

std::uint64_t checksumOf(const std::vector<std::int16_t>& values) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(values.data()), values.size() * sizeof(values[0]));
}

// Returns the values in a file; empty if it is missing, damaged or of another format.
std::vector<std::int16_t> keptValues(const std::string& path) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file || file->size() <= sizeof(Head)) return {};
  const auto head = file->read(0, sizeof(Head)), body = file->read(sizeof(Head), file->size() - sizeof(Head));
  if (!head || !body || body->size() % sizeof(std::int16_t) != 0) return {};
  auto values = zeros<std::int16_t>(body->size() / sizeof(std::int16_t));
  std::memcpy(values.data(), body->data(), body->size());
  const Head expected{.checksum = checksumOf(values)};
  return std::memcmp(head->data(), &expected, sizeof(Head)) == 0 ? values : std::vector<std::int16_t>{};
}

Status keep(const std::vector<std::int16_t>& values, const std::string& path) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  const Head head{.checksum = checksumOf(values)};
  if (Status s = file->write(&head, sizeof(Head)); !s) return s;
  if (Status s = file->write(values.data(), values.size() * sizeof(values[0])); !s) return s;
  return file->commit();
}

}  // namespace

std::string userCacheFolder() {
  const QString all = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation);
  return QFile::encodeName(all + QStringLiteral("/volumen")).toStdString();
}

Result<VolumePtr> cachedPhantom(const std::string& text, const std::string& folder) {
  std::string name = text;
  std::replace(name.begin(), name.end(), ':', '-');
  const std::string path = folder + "/" + name + ".values";
  if (std::vector<std::int16_t> values = keptValues(path); !values.empty())
    if (auto kept = phantomFrom(text, std::move(values))) return kept;
  Result<VolumePtr> made = makePhantom(text);
  if (!made) return made;
  // A cache that cannot be written costs only time, so the user is not told.
  if (QDir().mkpath(QFile::decodeName(folder.c_str())))
    (void)keep(std::get<std::vector<std::int16_t>>((*made)->stored()), path).ok();
  return made;
}

}  // namespace volumen
