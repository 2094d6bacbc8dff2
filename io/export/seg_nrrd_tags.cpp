#include "io/export/seg_nrrd_tags.h"

#include <string_view>
#include <vector>

namespace volumen {

namespace {

constexpr std::string_view entryKey = "TerminologyEntry";

// Replaces the separators of codes and fields in a text.
std::string withoutMarks(std::string text) {
  for (char& c : text)
    if (c == '^' || c == '~' || c == '|') c = ' ';
  return text;
}

std::string codeText(const Code& code) {
  return withoutMarks(code.scheme) + '^' + withoutMarks(code.value) + '^' + withoutMarks(code.meaning);
}

std::vector<std::string_view> parts(std::string_view text, char between) {
  std::vector<std::string_view> all;
  for (std::size_t end = 0; end != std::string_view::npos; text.remove_prefix(end + 1)) {
    end = text.find(between);
    all.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
  }
  return all;
}

Code codeIn(std::string_view text) {
  const auto fields = parts(text, '^');
  if (fields.size() < 3) return {};
  return {std::string(fields[1]), std::string(fields[0]), std::string(fields[2])};
}

}  // namespace

std::string tagsOf(const Segment& segment) {
  std::string tags;
  if (!segment.type.value.empty())
    tags = std::string(entryKey) + ":Segmentation category and type - 3D Slicer General Anatomy list~" +
           codeText(segment.category) + '~' + codeText(segment.type) + '~' + codeText(segment.modifier) +
           "~Anatomic codes - DICOM master list~" + codeText(segment.region) + '~' +
           codeText(segment.regionModifier) + '|';
  return tags + "Segmentation.Status:inprogress|";
}

void readTags(const std::string& tags, Segment& segment) {
  for (const std::string_view tag : parts(tags, '|')) {
    const std::size_t colon = tag.find(':');
    if (colon == std::string_view::npos || tag.substr(0, colon) != entryKey) continue;
    const auto entry =
        parts(tag.substr(colon + 1), '~');  // context, category, type, modifier, context, region, modifier
    if (entry.size() > 1) segment.category = codeIn(entry[1]);
    if (entry.size() > 2) segment.type = codeIn(entry[2]);
    if (entry.size() > 3) segment.modifier = codeIn(entry[3]);
    if (entry.size() > 5) segment.region = codeIn(entry[5]);
    if (entry.size() > 6) segment.regionModifier = codeIn(entry[6]);
  }
}

}  // namespace volumen
