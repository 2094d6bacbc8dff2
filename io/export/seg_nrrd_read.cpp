#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <set>

#include "io/export/seg_nrrd.h"
#include "io/export/seg_nrrd_tags.h"
#include "io/files/header_text.h"
#include "io/files/image_file.h"
#include "io/files/label_values.h"
#include "viewer/segment/names_and_colours.h"
#include "viewer/volume/listed_first.h"

namespace volumen {

namespace {

using Fields = std::map<std::string, std::string>;

// A segment as described in the header.
struct Entry {
  Segment segment;
  std::uint64_t layer = 0;
  std::uint32_t value = 1;
};

std::optional<glm::u8vec3> colourIn(const std::string& text) {
  const auto parts = toNumbers(text);
  if (!parts || parts->size() != 3) return {};
  glm::u8vec3 colour;
  for (int c = 0; c < 3; ++c) {
    const double part = (*parts)[std::size_t(c)];
    if (!(part >= 0 && part <= 1)) return {};
    colour[c] = std::uint8_t(std::lround(part * 255));
  }
  return colour;
}

// Returns the whole number in a field, or `absent` if the field is missing.
Result<std::uint32_t> numberIn(const Fields& fields, const std::string& key, std::uint64_t least,
                               std::uint64_t most, std::uint64_t absent) {
  const auto found = fields.find(key);
  if (found == fields.end()) return std::uint32_t(absent);
  const auto number = toInteger(trimmed(found->second));
  if (!number || *number < std::int64_t(least) || *number > std::int64_t(most))
    return Error{"its " + key + " is '" + fieldText(found->second) + "'; " + std::to_string(least) + " to " +
                 std::to_string(most) + " is meant."};
  return std::uint32_t(*number);
}

// Appends colour fields that cannot be read to `noColours`.
Result<std::optional<Entry>> entryOf(const Fields& fields, std::size_t n, std::uint64_t layers,
                                     std::vector<std::string>& noColours) {
  const std::string name = "Segment" + std::to_string(n) + "_";
  const auto text = [&](const char* key) {
    const auto found = fields.find(name + key);
    return found == fields.end() ? std::string() : found->second;
  };
  if (!fields.contains(name + "ID") && !fields.contains(name + "Name") &&
      !fields.contains(name + "LabelValue"))
    return std::optional<Entry>();
  Entry entry;
  entry.segment.label = fields.contains(name + "Name") ? text("Name") : text("ID");
  const std::string colour = text("Color");
  entry.segment.colour = colourIn(colour);
  if (!colour.empty() && !entry.segment.colour)
    noColours.push_back(name + "Color '" + fieldText(colour) + "'");
  readTags(text("Tags"), entry.segment);
  const auto layer = numberIn(fields, name + "Layer", 0, layers - 1, n);  // older files: one layer a segment
  if (!layer) return layer.error();
  if (*layer >= layers)
    return Error{"it has " + std::to_string(layers) + " layers, and its segment " + std::to_string(n + 1) +
                 " is in none of them."};
  const auto value = numberIn(fields, name + "LabelValue", 1, mostLabelValue, 1);
  if (!value) return value.error();
  entry.layer = *layer;
  entry.value = *value;
  return std::optional<Entry>(std::move(entry));
}

Result<std::vector<Entry>> entriesOf(const ImageHeader& header, std::vector<std::string>& noColours) {
  const Fields fields(header.keyValues.begin(), header.keyValues.end());
  const std::uint64_t layers = header.data.volumes();
  std::vector<Entry> all;
  while (true) {
    auto entry = entryOf(fields, all.size(), layers, noColours);
    if (!entry) return entry.error();
    if (!*entry) return all;
    all.push_back(std::move(**entry));
  }
}

// Returns entries for a layer whose labels have no names.
std::vector<Entry> namedByNumber(const LabelValues& values, std::uint64_t layer) {
  std::vector<Entry> all;
  for (const std::uint32_t value : values.present())
    all.push_back({{.label = "Label " + std::to_string(value)}, layer, value});
  return all;
}

// Collects in `leftOut` the labels that belong to no segment.
Result<Segmented> layerOf(const LabelValues& values, const std::vector<Entry>& entries,
                          std::set<std::uint32_t>& leftOut) {
  std::vector<std::uint32_t> numbers;
  for (const Entry& entry : entries) {
    if (std::ranges::find(numbers, entry.value) != numbers.end())
      return Error{"two of its segments are the label " + std::to_string(entry.value) + " of one layer."};
    numbers.push_back(entry.value);
  }
  const auto labels = labelsFor(numbers);
  if (!labels) return labels.error();
  for (const std::uint32_t value : values.present())
    if (std::ranges::find(numbers, value) == numbers.end()) leftOut.insert(value);
  Segmented made{{}, LabelMap(values.labels(*labels))};
  for (std::size_t n = 0; n < entries.size(); ++n) {
    made.segments.push_back(entries[n].segment);
    made.segments.back().number = (*labels)[n].label;
  }
  return made;
}

std::vector<std::string> notesOfReading(const std::string& path, const std::vector<std::string>& noColours,
                                        const std::set<std::uint32_t>& leftOut) {
  std::vector<std::string> notes, numbers;
  if (!noColours.empty())
    notes.push_back(path + ": other colours were taken for " + listedFirst(noColours) +
                    "; three numbers from 0 to 1 are meant.");
  for (const std::uint32_t value : leftOut) numbers.push_back(std::to_string(value));
  if (numbers.size() == 1)
    notes.push_back(path + ": voxels of the label " + numbers.front() +
                    " are of no segment, and were left out.");
  else if (!numbers.empty())
    notes.push_back(path + ": voxels of " + std::to_string(numbers.size()) +
                    " labels are of no segment, and were left out: " + listedFirst(numbers) + ".");
  return notes;
}

Result<SegmentsFile> readLayers(const ImageHeader& header, const std::string& path, const Progress& progress,
                                const CancelToken& cancel) {
  std::vector<std::string> noColours;
  std::set<std::uint32_t> leftOut;
  auto entries = entriesOf(header, noColours);
  if (!entries) return Error{path + ": " + entries.message()};
  SegmentsFile file;
  for (std::uint64_t layer = 0; layer < header.data.volumes(); ++layer) {
    const auto values = LabelValues::read(header, layer, path, file.notes, progress, cancel);
    if (!values) return values.error();
    std::vector<Entry> own;
    if (entries->empty()) own = namedByNumber(*values, layer);
    std::ranges::copy_if(*entries, std::back_inserter(own), [&](const Entry& e) { return e.layer == layer; });
    auto map = layerOf(*values, own, leftOut);
    if (!map) return Error{path + ": " + map.message()};
    file.maps.push_back(std::move(*map));
  }
  std::ranges::move(notesOfReading(path, noColours, leftOut), std::back_inserter(file.notes));
  return file;
}

}  // namespace

Result<SegmentsFile> readSegNrrd(const std::string& path, const Progress& progress,
                                 const CancelToken& cancel) try {
  constexpr std::uint64_t mostLayers = 255;
  const auto header = readImageHeader(path, cancel);
  if (!header) return header.error();
  if (header->format != "NRRD") return Error{path + " is no NRRD file."};
  if (header->data.volumes() > mostLayers)
    return Error{path + " has " + std::to_string(header->data.volumes()) + " layers; at most " +
                 std::to_string(mostLayers) + " are read."};
  return readLayers(*header, path, progress, cancel);
} catch (const std::bad_alloc&) {
  return Error{path + ": there is not enough memory for its segments."};
}

}  // namespace volumen
