#include "io/export/surface_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <new>
#include <set>

#include "io/files/header_text.h"
#include "io/files/output_file.h"
#include "viewer/volume/free_name.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

static_assert(std::endian::native == std::endian::little, "binary surfaces are written as they are held");

// Slicer reads the axes from this text; other programs assume them (vtkMRMLModelStorageNode.cxx).
const std::string surfaceSpace = std::string("volumen ") + VOLUMEN_VERSION + " SPACE=LPS mm";

// Other programs look for words such as "SPACE=" and "COLOR=" in these texts.
std::string withoutEquals(std::string text) {
  std::ranges::replace(text, '=', ':');
  return text;
}

// Returns a comment line for each field.
std::string commentsOf(const IdentityFields& whose, const std::string& begin) {
  std::string lines;
  for (const auto& [keyword, value] : whose) lines += begin + keyword + ": " + withoutEquals(value) + "\n";
  return lines;
}

// Writes `count` items; all cores format parts, which are written in order.
Status writeParts(OutputFile& file, std::size_t count, const CancelToken& cancel,
                  const std::function<void(std::size_t first, std::size_t end, std::string& bytes)>& make) {
  constexpr std::size_t part = 1 << 15, together = 16;
  std::array<std::string, together> made;
  for (std::size_t start = 0; start < count; start += part * together) {
    if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
    const std::size_t parts = std::min(together, (count - start + part - 1) / part);
    parallelFor(std::int64_t(parts), 0, [&](std::int64_t begin, std::int64_t end) {
      for (auto n = std::size_t(begin); n < std::size_t(end); ++n) {
        made[n].clear();
        const std::size_t first = start + n * part;
        make(first, std::min(count, first + part), made[n]);
      }
    });
    for (std::size_t n = 0; n < parts; ++n)
      if (Status s = file.write(made[n]); !s) return s;
  }
  return {};
}

template <class T>
void append(std::string& bytes, const T& value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

using SurfaceParts = std::span<const SurfacePart>;

// The contents of a file.
struct SurfaceContents {
  SurfaceParts parts;
  const IdentityFields& whose;
};

std::size_t pointsOf(SurfaceParts parts) {
  std::size_t count = 0;
  for (const SurfacePart& part : parts) count += part.surface->points.size();
  return count;
}

std::size_t trianglesOf(SurfaceParts parts) {
  std::size_t count = 0;
  for (const SurfacePart& part : parts) count += part.surface->triangles.size();
  return count;
}

Status writeStlTriangles(const Surface& surface, OutputFile& file, const CancelToken& cancel) {
  return writeParts(
      file, surface.triangles.size(), cancel, [&](std::size_t first, std::size_t end, std::string& bytes) {
        for (std::size_t t = first; t < end; ++t) {
          const auto& corners = surface.triangles[t];
          const glm::vec3 a = surface.points[corners[0]], b = surface.points[corners[1]],
                          c = surface.points[corners[2]];
          const glm::dvec3 across = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
          const double length = glm::length(across);
          append(bytes, std::array{length > 0 ? glm::vec3(across / length) : glm::vec3(0), a, b, c});
          append(bytes, std::uint16_t(0));
        }
      });
}

// Binary STL: an 80-byte header that does not begin with "solid", the triangle count, 50 bytes a triangle.
Status writeStl(const SurfaceContents& contents, OutputFile& file, const CancelToken& cancel) {
  constexpr std::size_t headerBytes = 80;
  const SurfaceParts parts = contents.parts;
  std::string header = surfaceSpace;
  for (const auto& [keyword, value] : contents.whose)
    if (const std::string next = ' ' + withoutEquals(value); header.size() + next.size() <= headerBytes)
      header += next;
  header.resize(headerBytes, ' ');
  append(header, std::uint32_t(trianglesOf(parts)));
  if (Status s = file.write(header); !s) return s;
  for (const SurfacePart& part : parts)
    if (Status s = writeStlTriangles(*part.surface, file, cancel); !s) return s;
  return {};
}

// `before` is the number of points of the preceding surfaces.
Status writePlyFaces(const Surface& surface, std::uint32_t before, OutputFile& file,
                     const CancelToken& cancel) {
  return writeParts(file, surface.triangles.size(), cancel,
                    [&](std::size_t first, std::size_t end, std::string& bytes) {
                      for (std::size_t t = first; t < end; ++t) {
                        bytes += char(3);
                        for (const std::uint32_t corner : surface.triangles[t])
                          append(bytes, before + corner);
                      }
                    });
}

Status writePly(const SurfaceContents& contents, OutputFile& file, const CancelToken& cancel) {
  const SurfaceParts parts = contents.parts;
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment " + surfaceSpace + "\n" +
      commentsOf(contents.whose, "comment ") + "element vertex " + std::to_string(pointsOf(parts)) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(trianglesOf(parts)) + "\nproperty list uchar int vertex_indices\nend_header\n";
  if (Status s = file.write(header); !s) return s;
  for (const SurfacePart& part : parts) {
    const auto& points = part.surface->points;
    if (Status s = file.write(points.data(), points.size() * sizeof(glm::vec3)); !s) return s;
  }
  std::uint32_t before = 0;
  for (const SurfacePart& part : parts) {
    if (Status s = writePlyFaces(*part.surface, before, file, cancel); !s) return s;
    before += std::uint32_t(part.surface->points.size());
  }
  return {};
}

// Appends the shortest digits that parse to the same number.
template <class T>
void appendNumber(std::string& text, T value) {
  char digits[32];
  text += ' ';
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

Status writeObjPoints(const Surface& surface, OutputFile& file, const CancelToken& cancel) {
  return writeParts(file, surface.points.size(), cancel,
                    [&](std::size_t first, std::size_t end, std::string& text) {
                      for (std::size_t n = first; n < end; ++n) {
                        text += 'v';
                        for (int a = 0; a < 3; ++a) appendNumber(text, surface.points[n][a]);
                        text += '\n';
                      }
                    });
}

Status writeObjFaces(const Surface& surface, std::uint32_t before, OutputFile& file,
                     const CancelToken& cancel) {
  return writeParts(file, surface.triangles.size(), cancel,
                    [&](std::size_t first, std::size_t end, std::string& text) {
                      for (std::size_t t = first; t < end; ++t) {
                        text += 'f';
                        for (const std::uint32_t corner : surface.triangles[t])
                          appendNumber(text, before + corner + 1);
                        text += '\n';
                      }
                    });
}

// A blank would begin the name of a second group.
std::string groupNameOf(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ' || c == 127) c = '_';
  return name;
}

// Adds the new group's name to `taken`.
std::string groupLine(const std::string& name, std::set<std::string>& taken) {
  const std::string free =
      freeName(name, [&](const std::string& one) { return !taken.insert(groupNameOf(one)).second; });
  return "g " + groupNameOf(free) + "\n";
}

Status writeObj(const SurfaceContents& contents, OutputFile& file, const CancelToken& cancel) {
  const SurfaceParts parts = contents.parts;
  if (Status s = file.write("# " + surfaceSpace + "\n" + commentsOf(contents.whose, "# ")); !s) return s;
  for (const SurfacePart& part : parts)
    if (Status s = writeObjPoints(*part.surface, file, cancel); !s) return s;
  std::uint32_t before = 0;
  std::set<std::string> groups;
  for (const SurfacePart& part : parts) {
    if (parts.size() > 1)
      if (Status s = file.write(groupLine(part.name, groups)); !s) return s;
    if (Status s = writeObjFaces(*part.surface, before, file, cancel); !s) return s;
    before += std::uint32_t(part.surface->points.size());
  }
  return {};
}

struct SurfaceWriter {
  const char* ending;  // lower case, with the dot
  Status (*write)(const SurfaceContents& contents, OutputFile& file, const CancelToken& cancel);
};
constexpr std::array<SurfaceWriter, 3> surfaceWriters{
    {{".stl", writeStl}, {".ply", writePly}, {".obj", writeObj}}};

const SurfaceWriter* surfaceWriterOf(const std::string& path) {
  const std::string name = lowerCase(path);
  const auto found =
      std::ranges::find_if(surfaceWriters, [&](const SurfaceWriter& w) { return name.ends_with(w.ending); });
  return found == surfaceWriters.end() ? nullptr : &*found;
}

}  // namespace

std::string surfaceEndings() {
  std::string text = surfaceWriters[0].ending;
  for (std::size_t n = 1; n < surfaceWriters.size(); ++n)
    text += (n + 1 < surfaceWriters.size() ? ", " : " or ") + std::string(surfaceWriters[n].ending);
  return text;
}

Status writeSurface(const Surface& surface, const std::string& path, const CancelToken& cancel) {
  const SurfacePart all{{}, &surface};
  return writeSurfaces({&all, 1}, path, cancel);
}

Status writeSurfaces(std::span<const SurfacePart> parts, const std::string& path, const CancelToken& cancel) {
  Result<OutputFile> file = surfacesAside(parts, path, cancel);
  return file ? file->commit() : file.error();
}

Result<OutputFile> surfacesAside(std::span<const SurfacePart> parts, const std::string& path,
                                 const CancelToken& cancel, const IdentityFields& whose) try {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();  // PLY indices are int32
  const SurfaceWriter* writer = surfaceWriterOf(path);
  if (!writer) return Error{"Cannot write " + path + ": surfaces are written as " + surfaceEndings() + "."};
  if (trianglesOf(parts) == 0) return Error{"Cannot write " + path + ": the segment is empty."};
  if (trianglesOf(parts) > most || pointsOf(parts) > most)
    return Error{"Cannot write " + path + ": these are too many triangles for one file."};
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  if (Status s = writer->write({parts, whose}, *file, cancel); !s) return s.error();
  return file;
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path + ": there is not enough memory."};
}

}  // namespace volumen
