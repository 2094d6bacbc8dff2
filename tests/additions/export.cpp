// An addition that writes the format of format.cpp.
#include "io/files/output_file.h"
#include "io/files/volume_writers.h"

namespace volumen {

Status writeCube(const Volume& volume, const std::string& path, const Progress&, const CancelToken&) {
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  const auto& bytes = std::get<std::vector<std::uint8_t>>(volume.stored());
  if (Status s = out->write("cube " + std::to_string(volume.size().x) + '\n'); !s) return s;
  if (Status s = out->write(bytes.data(), bytes.size()); !s) return s;
  return out->commit();
}

}  // namespace volumen
