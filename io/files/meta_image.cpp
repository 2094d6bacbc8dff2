#include "io/files/meta_image.h"

#include <algorithm>
#include <map>

#include "io/files/header_text.h"

namespace volumen {

namespace {

struct MetaHeader {
  std::map<std::string, std::string> fields;
  std::string_view rest;         // text after the line ElementDataFile
  std::uint64_t dataOffset = 0;  // position of `rest` in the file

  // Returns the first field present, or an empty string.
  std::string field(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (const auto found = fields.find(name); found != fields.end()) return found->second;
    return {};
  }
  bool isTrue(std::initializer_list<const char*> names) const {
    const std::string text = field(names);
    return !text.empty() && (text[0] == 'T' || text[0] == 't' || text[0] == '1');
  }
};

Result<MetaHeader> parse(const std::string& head, const std::string& path) {
  MetaHeader header;
  header.rest = head;
  while (!header.rest.empty()) {
    const std::string_view line = takeLine(header.rest);
    const std::size_t equals = line.find_first_of("=:");
    if (trimmed(line).empty()) continue;
    if (equals == std::string_view::npos)
      return Error{path + " has a header line that is not 'Name = value': '" + fieldText(line) + "'."};
    const std::string name(trimmed(line.substr(0, equals)));
    if (!header.fields.emplace(name, trimmed(line.substr(equals + 1))).second)
      return Error{path + " gives the field '" + fieldText(name) + "' twice."};
    if (name == "ElementDataFile") {
      header.dataOffset = head.size() - header.rest.size();
      return header;
    }
  }
  return Error{
      path + " has no field ElementDataFile" +
      (head.size() == mostHeaderBytes ? " within its first MiB." : "; it is cut off or no MetaImage.")};
}

std::optional<SampleType> metaImageType(const std::string& name) {
  using enum SampleType;
  static const std::map<std::string, SampleType> types{
      {"MET_CHAR", int8},       {"MET_UCHAR", uint8},       {"MET_SHORT", int16},   {"MET_USHORT", uint16},
      {"MET_INT", int32},       {"MET_UINT", uint32},       {"MET_LONG", int32},    {"MET_ULONG", uint32},
      {"MET_LONG_LONG", int64}, {"MET_ULONG_LONG", uint64}, {"MET_FLOAT", float32}, {"MET_DOUBLE", float64}};
  // "_ARRAY" marks vectors of several channels.
  constexpr std::string_view array = "_ARRAY";
  const bool isArray = name.ends_with(array);
  const auto found = types.find(isArray ? name.substr(0, name.size() - array.size()) : name);
  if (found == types.end()) return {};
  return found->second;
}

// Returns the numbers of a field, at least `count`; empty if the field is absent.
Result<std::optional<std::vector<double>>> numbers(const MetaHeader& header,
                                                   std::initializer_list<const char*> names,
                                                   std::size_t count, const std::string& path) {
  const std::string text = header.field(names);
  if (text.empty()) return std::optional<std::vector<double>>();
  auto all = toNumbers(text);
  if (!all || all->size() < count)
    return Error{path + " has the " + *names.begin() + " '" + fieldText(text) + "', which is not " +
                 std::to_string(count) + " numbers."};
  return all;
}

// Returns the first grid axis whose row of the matrix is zero.
std::optional<std::size_t> axisOfZeros(const std::optional<std::vector<double>>& matrix, std::size_t used,
                                       std::size_t axes) {
  for (std::size_t a = 0; matrix && a < used; ++a) {
    const auto row = matrix->begin() + std::ptrdiff_t(a * axes);
    if (std::all_of(row, row + std::ptrdiff_t(axes), [](double x) { return x == 0; })) return a;
  }
  return {};
}

Status setMetaGeometry(const MetaHeader& header, const std::vector<std::uint64_t>& sizes, std::size_t axes,
                       ImageHeader& image, const std::string& path) {
  auto spacing = numbers(header, {"ElementSpacing", "ElementSize"}, axes, path);
  if (!spacing) return spacing.error();
  auto matrix = numbers(header, {"TransformMatrix", "Orientation", "Rotation"}, axes * axes, path);
  if (!matrix) return matrix.error();
  auto offset = numbers(header, {"Offset", "Position", "Origin"}, axes, path);
  if (!offset) return offset.error();
  if (!*spacing) return setNominalGeometry(image, sizes, path);
  if (const auto axis = axisOfZeros(*matrix, sizes.size(), axes)) {
    matrix->reset();
    image.warnings.push_back("Axis " + std::to_string(*axis + 1) +
                             " of its TransformMatrix has the direction 0: its directions are not used.");
  }
  // ITK writes '?' for 2D images, whose directions are unrelated to a patient.
  const bool saysUnknown = header.field({"AnatomicalOrientation"}).find('?') != std::string::npos;
  if (!*matrix)
    image.warnings.push_back(
        {"The header gives no directions: its axes are taken as left, posterior, superior.",
         WarningKind::noDirections});
  else if (saysUnknown)
    image.warnings.push_back(
        {"Its AnatomicalOrientation is not known: its space is taken as left, posterior, superior.",
         WarningKind::noDirections});
  const std::string unit = header.field({"DistanceUnits"});
  const double mm = unit == "um" ? 1e-3 : unit == "cm" ? 10 : 1;
  if (mm != 1)
    image.warnings.push_back("The header gives lengths in '" + unit + "'; they were converted to mm.");
  std::vector<glm::dvec3> steps;
  glm::dvec3 origin(0);
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    if (!((**spacing)[a] > 0))
      return Error{path + " has the ElementSpacing " + exactText((**spacing)[a]) + "; it must be above 0."};
    glm::dvec3 along(0);
    along[int(a)] = 1;
    for (std::size_t b = 0; *matrix && b < sizes.size(); ++b) along[int(b)] = (**matrix)[a * axes + b];
    steps.push_back(along * (**spacing)[a] * mm);
    if (*offset) origin[int(a)] = (**offset)[a] * mm;
  }
  return setGeometry(image, sizes, steps, origin, path);
}

Status parseSamples(const MetaHeader& header, SampleData& data, const std::string& path) {
  const auto type = metaImageType(header.field({"ElementType"}));
  if (!type)
    return Error{path + " has samples of type '" + fieldText(header.field({"ElementType"})) +
                 "', which volumen does not read."};
  data.type = *type;
  data.bigEndian = header.isTrue({"ElementByteOrderMSB", "BinaryDataByteOrderMSB"});
  const std::string binary = header.field({"BinaryData"});
  data.text = !binary.empty() && !header.isTrue({"BinaryData"});
  if (header.isTrue({"CompressedData"})) data.encoding = Encoding::deflate;
  const std::string skip = header.field({"HeaderSize"});
  const auto headerSize = skip.empty() ? 0 : toInteger(skip);
  const bool fromEnd = headerSize == -1 && !data.text && data.encoding == Encoding::raw;
  if (!headerSize || (*headerSize < 0 && !fromEnd) || *headerSize > (std::int64_t(1) << 40))
    return Error{path + " has the HeaderSize '" + fieldText(skip) +
                 "'; a number from 0 on is meant, or -1 for uncompressed data at the end."};
  if (fromEnd)
    data.byteSkip = -1;
  else
    data.offset = std::uint64_t(*headerSize);
  return {};
}

// Returns the samples at each voxel. Vectors become one volume a component; bytes in threes or fours are
// colours.
Result<std::uint64_t> channelsOf(const MetaHeader& header, SampleType type, const std::string& path) {
  const std::string text = header.field({"ElementNumberOfChannels"});
  const auto channels = text.empty() ? 1 : toInteger(text);
  if (!channels || *channels < 1)
    return Error{path + " has " + fieldText(text) + " channels; 1 or more is meant."};
  if (type == SampleType::uint8 && (*channels == 3 || *channels == 4))
    return Error{path + " is a colour image: it cannot be shown in 3D."};
  return std::uint64_t(*channels);
}

Status findFiles(MetaHeader& header, SampleData& data, const std::string& path) {
  const std::string text = header.field({"ElementDataFile"});
  const auto parts = words(text);
  if (parts.empty()) return Error{path + " names no data file (ElementDataFile is empty)."};
  if (text == "LOCAL" || text == "Local" || text == "local") {
    data.files = {path};
    data.offset += header.dataOffset;
    return {};
  }
  std::vector<std::string> names{text};
  if (parts[0] == "LIST") {
    names.clear();
    while (!header.rest.empty())
      if (const auto name = trimmed(takeLine(header.rest)); !name.empty()) names.emplace_back(name);
  } else if (parts.size() == 4 && text.find('%') != std::string::npos) {
    auto all = expandPattern(parts, path);
    if (!all) return all.error();
    names = *all;
  }
  return setDataFiles(data, names, path);
}

Status parseRescale(const MetaHeader& header, ImageHeader& image, const std::string& path) {
  auto slope = numbers(header, {"ElementToIntensityFunctionSlope"}, 1, path);
  if (!slope) return slope.error();
  auto intercept = numbers(header, {"ElementToIntensityFunctionOffset"}, 1, path);
  if (!intercept) return intercept.error();
  if (*slope) image.slope = (**slope)[0];
  if (*intercept) image.intercept = (**intercept)[0];
  return {};
}

}  // namespace

Result<ImageHeader> readMetaImageHeader(const std::string& path) {
  auto head = readHead(path, mostHeaderBytes);
  if (!head) return head.error();
  auto header = parse(*head, path);
  if (!header) return header.error();
  const std::string object = header->field({"ObjectType"});
  if (!object.empty() && object != "Image")
    return Error{path + " is a MetaIO object of type '" + fieldText(object) + "', not an image."};

  constexpr std::int64_t mostAxes = 10;
  const auto axes = toInteger(header->field({"NDims"}));
  if (!axes || *axes < 1 || *axes > mostAxes)
    return Error{path + " has the NDims '" + fieldText(header->field({"NDims"})) + "'; 1 to 10 is meant."};
  const auto sizes = toSizes(header->field({"DimSize"}));
  if (!sizes || std::int64_t(sizes->size()) != *axes)
    return Error{path + " has the DimSize '" + fieldText(header->field({"DimSize"})) + "', which is not " +
                 std::to_string(*axes) + " whole numbers from 1 on."};

  ImageHeader image;
  image.format = "MetaImage";
  image.description = fieldText(header->field({"Comment"}));
  const std::string modality = header->field({"Modality"});
  image.modality = modality == "MET_MOD_CT" ? "CT" : modality == "MET_MOD_MR" ? "MR" : "";
  if (Status s = parseSamples(*header, image.data, path); !s) return s.error();
  const auto end = sizes->begin() + std::min<std::int64_t>(3, *axes);
  const std::vector<std::uint64_t> grid(sizes->begin(), end);
  const auto channels = channelsOf(*header, image.data.type, path);
  if (!channels) return channels.error();
  if (Status s = setCounts(image.data, {*channels}, grid, {end, sizes->end()}, path); !s) return s.error();
  std::vector<OuterAxis> outer{{OuterAxis::Kind::component, *channels}};
  for (auto size = end; size != sizes->end(); ++size)
    outer.push_back({size == end ? OuterAxis::Kind::time : OuterAxis::Kind::other, *size});
  image.names = volumeNames(outer);
  if (Status s = setMetaGeometry(*header, grid, std::size_t(*axes), image, path); !s) return s.error();
  if (Status s = parseRescale(*header, image, path); !s) return s.error();
  if (Status s = findFiles(*header, image.data, path); !s) return s.error();
  if (Status s = checkFiles(image.data); !s) return s.error();
  return image;
}

}  // namespace volumen
