#include "io/files/nrrd_write.h"

#include <cassert>

#include "io/files/header_text.h"

namespace volumen {

namespace {

// Escapes a value for NRRD.
std::string escaped(const std::string& text) {
  std::string safe;
  for (char c : text) {
    if (c == '\\')
      safe += "\\\\";
    else if (c == '\n')
      safe += "\\n";
    else
      safe += c;
  }
  return safe;
}

const char* nrrdTypeName(SampleType type) {
  static constexpr const char* names[] = {"int8",   "uint8", "int16",  "uint16", "int32",
                                          "uint32", "int64", "uint64", "float",  "double"};
  return names[int(type)];
}

std::string vectorText(glm::dvec3 v) {
  return '(' + exactText(v.x) + ',' + exactText(v.y) + ',' + exactText(v.z) + ')';
}

}  // namespace

std::string nrrdHeader(const VoxelGeometry& g, SampleType type, const NrrdKeyValues& keyValues,
                       std::size_t volumes) {
  const glm::dmat3& L = g.patientFromVoxelStep;
  const bool isList = volumes > 1;
  std::string text = "NRRD0005\ntype: ";
  text += nrrdTypeName(type);
  text += isList ? "\ndimension: 4\n" : "\ndimension: 3\n";
  if (g.calibrated) text += "space: left-posterior-superior\n";
  text += "sizes: " + (isList ? std::to_string(volumes) + ' ' : std::string()) + std::to_string(g.size.x) +
          ' ' + std::to_string(g.size.y) + ' ' + std::to_string(g.size.z) + '\n';
  if (g.calibrated)
    text += std::string("space directions: ") + (isList ? "none " : "") + vectorText(L[0]) + ' ' +
            vectorText(L[1]) + ' ' + vectorText(L[2]) + '\n';
  text += std::string("kinds: ") + (isList ? "list " : "") +
          "domain domain domain\nendian: little\nencoding: gzip\n";
  if (g.calibrated) text += "space origin: " + vectorText(g.origin) + '\n';
  for (const auto& [key, value] : keyValues) {
    assert(key.find(":=") == std::string::npos && key.find('\n') == std::string::npos);
    text += key + ":=" + escaped(value) + '\n';
  }
  return text + '\n';
}

}  // namespace volumen
