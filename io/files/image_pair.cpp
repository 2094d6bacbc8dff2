#include "io/files/image_pair.h"

#include <filesystem>

#include "io/files/data_file.h"

namespace volumen {

namespace fs = std::filesystem;

namespace {

fs::path withoutGz(fs::path name) {
  if (name.extension() == ".gz") name.replace_extension();
  return name;
}

}  // namespace

Result<PairedSamples> samplesOfPair(const std::string& headerPath) {
  fs::path name = withoutGz(fs::path(headerPath).filename());
  name.replace_extension(name.extension() == ".HDR" ? ".IMG" : ".img");
  const auto plain = resolveBeside(headerPath, name.string());
  if (plain) return PairedSamples{*plain, false};
  const auto packed = resolveBeside(headerPath, name.string() + ".gz");
  if (packed) return PairedSamples{*packed, true};
  return plain.error();
}

std::optional<std::string> headerOfPair(const std::string& samplesPath) {
  fs::path header = withoutGz(samplesPath);
  if (header.extension() != ".img" && header.extension() != ".IMG") return {};
  header.replace_extension(header.extension() == ".IMG" ? ".HDR" : ".hdr");
  std::error_code unknown;
  for (const std::string& path : {header.string(), header.string() + ".gz"})
    if (fs::is_regular_file(path, unknown)) return path;
  return {};
}

}  // namespace volumen
