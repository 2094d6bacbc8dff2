#include "io/export/label_table.h"

#include <cstdio>

#include "io/files/data_file.h"
#include "io/files/header_text.h"
#include "io/files/label_values.h"
#include "io/worker/batches.h"
#include "io/worker/object_fields.h"

namespace volumen {

namespace worker {
inline void fields(Wire& w, LabelRow& r) { w(r.value, r.segment, r.segment.visible, r.segment.opacity); }
}  // namespace worker

namespace {

std::string nameInTable(std::string name) {
  for (char& c : name) {
    if (c == '"') c = '\'';
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return name;
}

std::string rowText(const Segment& s) {
  const glm::u8vec3 colour = s.colour.value_or(glm::u8vec3(255));
  char numbers[96];
  std::snprintf(numbers, sizeof numbers, "%5d %5d %4d %4d %8s %2d %2d    ", s.number, colour.x, colour.y,
                colour.z, exactText(s.opacity).c_str(), s.visible, s.visible);
  return numbers + ('"' + nameInTable(s.label)) + "\"\n";
}

// Parses a row: number, red, green, blue, opacity, shown, mesh shown, "name". Returns nothing for other
// lines.
std::optional<LabelRow> rowIn(std::string_view line) {
  const std::size_t begin = line.find('"'), end = line.rfind('"');
  if (begin == std::string_view::npos || end == begin) return {};
  const auto numbers = toNumbers(line.substr(0, begin));
  if (!numbers || numbers->size() < 5) return {};
  const std::vector<double>& n = *numbers;
  const auto isWhole = [](double x, double most) {
    return x >= 0 && x <= most && x == double(std::uint32_t(x));
  };
  if (!isWhole(n[0], mostLabelValue) || !isWhole(n[1], 255) || !isWhole(n[2], 255) || !isWhole(n[3], 255) ||
      !(n[4] >= 0 && n[4] <= 1))
    return {};
  LabelRow row;
  row.value = std::uint32_t(n[0]);
  row.segment.label = line.substr(begin + 1, end - begin - 1);
  row.segment.colour = glm::u8vec3(glm::dvec3(n[1], n[2], n[3]));
  row.segment.opacity = n[4];
  row.segment.visible = n.size() < 6 || n[5] != 0;
  return row;
}

Result<std::vector<LabelRow>> readTable(const std::string& path) {
  const auto text = readHead(path, mostHeaderBytes);
  if (!text) return text.error();
  if (text->size() == mostHeaderBytes)
    return Error{path + " is a table of more than 1 MiB, which is not read."};
  std::vector<LabelRow> rows;
  std::string_view rest = *text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = trimmed(takeLine(rest));
    if (line.empty() || line.front() == '#') continue;
    auto row = rowIn(line);
    if (!row)
      return Error{path + ": its line " + std::to_string(number) +
                   " is no label: number, red, green, blue, opacity, two switches and a name in quotation "
                   "marks are meant."};
    if (row->value > 0) rows.push_back(std::move(*row));
  }
  return rows;
}

}  // namespace

std::string labelTableOf(const std::string& image) {
  for (const char* ending : {".nii.gz", ".nii", ".mha", ".mhd", ".nrrd"})
    if (const std::string name = lowerCase(image); name.ends_with(ending))
      return image.substr(0, image.size() - std::string_view(ending).size()) + ".label";
  return image + ".label";
}

std::vector<std::string> namesChangedInTable(std::span<const Segment> segments) {
  std::vector<std::string> changed;
  for (const Segment& segment : segments)
    if (std::string name = nameInTable(segment.label); name != segment.label)
      changed.push_back(std::move(name));
  return changed;
}

Result<OutputFile> writeLabelTable(std::span<const Segment> segments, const std::string& path) {
  std::string text =
      "################################################\n"
      "# ITK-SnAP Label Description File\n"
      "# File format:\n"
      "# IDX   -R-  -G-  -B-  -A--  VIS MSH  LABEL\n"
      "# IDX: number of the label; R, G, B: colour, 0 to 255; A: opacity, 0 to 1; VIS, MSH: 1 where it is\n"
      "# shown, in slices and in 3D; LABEL: its name. Written by volumen; open the image of the same name "
      "by\n"
      "# \"itksnap -s IMAGE -l TABLE\".\n"
      "################################################\n"
      "    0     0    0    0        0  0  0    \"Clear Label\"\n";
  for (const Segment& segment : segments) text += rowText(segment);
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  if (Status s = out->write(text); !s) return s.error();
  return out;
}

Result<std::vector<LabelRow>> readLabelTable(const std::string& path) {
  const CancelToken never;
  worker::Request request = worker::headersOf({path}, never);
  worker::Failure failure{};
  auto rows = worker::isolated<readTable>(request, failure, path);
  if (failure != worker::Failure::none) return Error{path + ": " + worker::reasonOf(failure) + "."};
  return rows;
}

}  // namespace volumen
