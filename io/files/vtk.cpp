// VTK, legacy: a text header, structured points, one array of scalars or vectors, big endian or text.
#include <map>

#include "io/files/binary_header.h"
#include "io/files/data_file.h"
#include "io/files/header_text.h"
#include "io/files/other_formats.h"

namespace volumen {

namespace {

struct VtkHeader {
  std::string title;
  bool text = false;
  std::map<std::string, std::string> fields;  // DIMENSIONS, SPACING, ORIGIN, POINT_DATA
  std::string type;                           // sample type
  std::uint64_t components = 1;
  std::uint64_t dataOffset = 0;
};

std::optional<SampleType> vtkType(const std::string& name) {
  using enum SampleType;
  static const std::map<std::string, SampleType> types{{"char", int8},
                                                       {"signed_char", int8},
                                                       {"unsigned_char", uint8},
                                                       {"short", int16},
                                                       {"unsigned_short", uint16},
                                                       {"int", int32},
                                                       {"unsigned_int", uint32},
                                                       {"vtkidtype", int32},
                                                       {"long", int64},
                                                       {"unsigned_long", uint64},
                                                       {"vtktypeint64", int64},
                                                       {"float", float32},
                                                       {"double", float64}};
  const auto found = types.find(lowerCase(name));
  if (found == types.end()) return {};
  return found->second;
}

// Returns the words of a line, the first in capitals: keywords may have either case.
std::vector<std::string> wordsOf(std::string_view line) {
  std::vector<std::string> all = words(line);
  if (!all.empty()) all[0] = upperCase(all[0]);
  return all;
}

// Parses the line with the sample format: "SCALARS name type [components]", "VECTORS name type".
Status parseArray(const std::vector<std::string>& line, std::string_view& rest, VtkHeader& header,
                  const std::string& path) {
  if (line.size() < 3) return Error{path + " has an array without a name or a type."};
  header.type = line[2];
  header.components = line[0] == "SCALARS" ? 1 : 3;
  if (line[0] == "SCALARS" && line.size() > 3) {
    const auto count = toInteger(line[3]);
    if (!count || *count < 1 || *count > 4)
      return Error{path + " has scalars of " + fieldText(line[3]) + " components; 1 to 4 is meant."};
    header.components = std::uint64_t(*count);
  }
  std::string_view ahead = rest;
  const auto next = wordsOf(takeLine(ahead));
  if (!next.empty() && next[0] == "LOOKUP_TABLE") rest = ahead;
  return {};
}

Result<VtkHeader> parseVtk(const std::string& head, const std::string& path) {
  VtkHeader header;
  std::string_view rest = head;
  takeLine(rest);
  header.title = fieldText(takeLine(rest));
  std::string coding;
  while (coding.empty() && !rest.empty()) coding = upperCase(trimmed(takeLine(rest)));
  if (coding != "ASCII" && coding != "BINARY")
    return Error{path + " is '" + fieldText(coding) + "' where ASCII or BINARY is meant."};
  header.text = coding == "ASCII";
  while (!rest.empty()) {
    const auto line = wordsOf(takeLine(rest));
    if (line.empty()) continue;
    if (line[0] == "DATASET" && (line.size() < 2 || upperCase(line[1]) != "STRUCTURED_POINTS"))
      return Error{path + " is a VTK file of " + (line.size() < 2 ? "nothing" : fieldText(line[1])) +
                   "; volumen reads STRUCTURED_POINTS."};
    if (line[0] == "SCALARS" || line[0] == "VECTORS" || line[0] == "NORMALS") {
      if (Status s = parseArray(line, rest, header, path); !s) return s.error();
      header.dataOffset = head.size() - rest.size();
      return header;
    }
    if (line[0] == "COLOR_SCALARS") return Error{path + " is a colour image: it cannot be shown in 3D."};
    const std::string name = line[0] == "ASPECT_RATIO" ? "SPACING" : line[0];
    for (const char* known : {"DATASET", "DIMENSIONS", "SPACING", "ORIGIN", "POINT_DATA"})
      if (name == known) {
        std::string values;
        for (std::size_t n = 1; n < line.size(); ++n) values += line[n] + ' ';
        if (!header.fields.emplace(name, values).second)
          return Error{path + " gives the field '" + name + "' twice."};
      }
    if (!header.fields.contains(name))
      return Error{path + " has the field '" + fieldText(line[0]) + "', which volumen does not read."};
  }
  return Error{
      path + " has no scalars or vectors" +
      (head.size() == mostHeaderBytes ? " within its first MiB." : "; it is cut off or holds none.")};
}

Result<std::vector<double>> three(const VtkHeader& header, const char* name, const std::string& path) {
  const auto found = header.fields.find(name);
  if (found == header.fields.end()) return std::vector<double>();
  const auto numbers = toNumbers(found->second);
  if (!numbers || numbers->size() != 3)
    return Error{path + " has the " + name + " '" + fieldText(found->second) + "', which is not 3 numbers."};
  return *numbers;
}

// Structured points lie along the axes.
Status setVtkGeometry(const VtkHeader& header, const std::vector<std::uint64_t>& sizes, ImageHeader& image,
                      const std::string& path) {
  const auto spacings = three(header, "SPACING", path), origin = three(header, "ORIGIN", path);
  if (!spacings) return spacings.error();
  if (!origin) return origin.error();
  if (spacings->empty()) return setNominalGeometry(image, sizes, path);
  const glm::dvec3 at =
      origin->empty() ? glm::dvec3(0) : glm::dvec3((*origin)[0], (*origin)[1], (*origin)[2]);
  return setUnorientedGrid(image, sizes, *spacings, at, path);
}

}  // namespace

bool isVtk(const FileClaim& file) { return file.head.starts_with("# vtk DataFile"); }

Result<ImageHeader> readVtkHeader(const std::string& path) {
  const auto head = readHead(path, mostHeaderBytes);
  if (!head) return head.error();
  const auto header = parseVtk(*head, path);
  if (!header) return header.error();
  const auto sizesThere = header->fields.find("DIMENSIONS");
  const auto sizes = toSizes(sizesThere == header->fields.end() ? "" : sizesThere->second);
  if (!sizes || sizes->size() != 3) return Error{path + " has no DIMENSIONS of 3 whole numbers from 1 on."};
  const auto type = vtkType(header->type);
  if (!type)
    return Error{path + " has samples of type '" + fieldText(header->type) +
                 "', which volumen does not read."};
  if (header->components > 1 && *type == SampleType::uint8)
    return Error{path + " is a colour image: it cannot be shown in 3D."};
  ImageHeader image;
  image.format = "VTK";
  image.description = header->title;
  image.data.type = *type;
  image.data.bigEndian = true;
  image.data.text = header->text;
  if (Status s = setCounts(image.data, {header->components}, *sizes, {}, path); !s) return s.error();
  const auto points = header->fields.find("POINT_DATA");
  if (points == header->fields.end() || toInteger(trimmed(points->second)) != std::int64_t(image.data.voxels))
    return Error{path + " says POINT_DATA " +
                 (points == header->fields.end() ? "nowhere" : fieldText(points->second)) +
                 ", but its DIMENSIONS make " + std::to_string(image.data.voxels) + " points."};
  image.names = volumeNames({{OuterAxis::Kind::component, header->components}});
  if (Status s = setVtkGeometry(*header, *sizes, image, path); !s) return s.error();
  setDataAt(image.data, path, header->dataOffset, false);
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
