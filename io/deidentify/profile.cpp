#include "io/deidentify/profile.h"

#include <algorithm>
#include <string>

#include "io/deidentify/profile_tables.h"
#include "io/dicom/scan.h"

namespace volumen {

namespace {

// The columns of the table.
enum Column {
  tagColumn,
  vrColumn,
  keyword,
  basic,
  privates,
  uids,
  device,
  institution,
  patient,
  fullDates,
  shiftedDates,
  descriptors,
  columns
};

// Some classes need these attributes, although the table removes them.
constexpr std::uint32_t needed[] = {0x00700082, 0x00700083};  // presentation states (PS3.3 C.11.10)

// The dates of birth and death in another calendar reveal the dates that the table removes.
constexpr std::uint32_t otherCalendar[] = {0x00100033, 0x00100034, 0x00100035};

// These UIDs name no object but classes, transfer syntaxes, coding schemes, context groups, mapping
// resources and versions of programs. The table lists none of them.
constexpr std::uint32_t nameNoObject[] = {
    0x00080016, 0x0008001a, 0x0008001b, 0x00080062, 0x0008010c, 0x00080117, 0x00080118, 0x00081150,
    0x0008115a, 0x00083002, 0x00089123, 0x00340003, 0x04000010, 0x04000510, 0x30100052, 0x30100053};

std::vector<std::string_view> splitAt(char separator, std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

// Returns the action to take where the table allows several, such as "X/Z/D". A classic image loses the
// attribute if X is among them.
ProfileAction oneOf(std::string_view actions, bool isClassic) {
  const auto has = [&](char action) { return actions.find(action) != std::string_view::npos; };
  if (has('U')) return ProfileAction::newUid;
  if (has('X') && (isClassic || actions.size() == 1)) return ProfileAction::remove;
  if (has('D')) return ProfileAction::dummy;
  return has('Z') ? ProfileAction::empty : ProfileAction::remove;
}

}  // namespace

ConfidentialityProfile::Row ConfidentialityProfile::rowFrom(std::string_view line, const Retained& retained) {
  std::vector<std::string_view> cells = splitAt('\t', line);
  cells.resize(columns);
  Row row{0, 0xffffffff, 0, oneOf(cells[basic], true), oneOf(cells[basic], false)};
  int shift = 28;
  for (const char c : cells[tagColumn]) {
    if (c == ',') continue;
    const std::uint32_t digit = c >= '0' && c <= '9' ? std::uint32_t(c - '0') : std::uint32_t(c - 'A' + 10);
    if (c == 'x')
      row.mask &= ~(0xfu << shift);
    else
      row.tag |= digit << shift;
    shift -= 4;
  }
  if (cells[vrColumn].size() == 2) row.vr = dicom::vrOf(cells[vrColumn][0], cells[vrColumn][1]);
  if (std::ranges::find(needed, row.tag) != std::end(needed)) row.classic = row.other = ProfileAction::dummy;
  const bool isSequence = row.vr == dicom::vrOf('S', 'Q');
  // No class allows an empty list of references.
  if (isSequence && cells[basic] == "X/Z" && cells[uids] == "K") row.other = ProfileAction::remove;
  const std::pair<bool, Column> options[] = {{retained.uids, uids},
                                             {retained.device, device},
                                             {retained.institution, institution},
                                             {retained.patient, patient},
                                             {retained.dates, fullDates}};
  for (const auto& [isRetained, column] : options)
    if (isRetained && cells[column] == "K") row.classic = row.other = ProfileAction::keep;
  if (retained.shiftDays != 0 && cells[shiftedDates] == "C") row.classic = row.other = ProfileAction::shift;
  if (retained.descriptors && cells[descriptors] == "C" && !isSequence && row.vr != 0)
    row.classic = row.other = ProfileAction::clean;
  return row;
}

ConfidentialityProfile::ConfidentialityProfile(const Retained& retained) : retained_(retained) {
  for (const std::string& table : profileTables())
    for (const std::string_view line : splitAt('\n', table)) {
      const bool isRow = line.size() > 9 && line[4] == ',';
      if (isRow) rows_.push_back(rowFrom(line, retained));
    }
  for (const std::uint32_t tag : otherCalendar)
    rows_.push_back({tag, 0xffffffff, 0, ProfileAction::remove, ProfileAction::remove});
  // Clang 14 cannot compile the std::ranges version, which returns a subrange.
  const auto open =
      std::stable_partition(rows_.begin(), rows_.end(), [](const Row& r) { return r.mask == 0xffffffff; });
  exact_ = std::size_t(open - rows_.begin());
  std::ranges::sort(rows_.begin(), rows_.begin() + std::ptrdiff_t(exact_), {}, &Row::tag);
}

const ConfidentialityProfile::Row* ConfidentialityProfile::rowOf(std::uint32_t tag) const {
  const auto open = rows_.begin() + std::ptrdiff_t(exact_);
  const auto exact = std::ranges::lower_bound(rows_.begin(), open, tag, {}, &Row::tag);
  if (exact != open && exact->tag == tag) return &*exact;
  const auto found =
      std::ranges::find_if(open, rows_.end(), [&](const Row& r) { return (tag & r.mask) == r.tag; });
  return found == rows_.end() ? nullptr : &*found;
}

ProfileAction ConfidentialityProfile::actionOf(std::uint32_t tag, bool isClassic, std::uint16_t vr) const {
  const Row* const row = rowOf(tag);
  if (!row) return unlistedAction(tag, vr);
  return isClassic ? row->classic : row->other;
}

ProfileAction ConfidentialityProfile::unlistedAction(std::uint32_t tag, std::uint16_t vr) const {
  const bool isUid = vr == dicom::vrOf('U', 'I');
  const bool isTime =
      vr == dicom::vrOf('D', 'A') || vr == dicom::vrOf('D', 'T') || vr == dicom::vrOf('T', 'M');
  if (isUid && !retained_.uids && std::ranges::find(nameNoObject, tag) == std::end(nameNoObject))
    return ProfileAction::newUid;
  if (!isTime || retained_.dates) return ProfileAction::keep;
  // The class that needs this element is not known. An element without a value does the least harm.
  return retained_.shiftDays != 0 ? ProfileAction::shift : ProfileAction::empty;
}

std::uint16_t ConfidentialityProfile::vrOf(std::uint32_t tag) const {
  const Row* const row = rowOf(tag);
  return row ? row->vr : std::uint16_t(0);
}

}  // namespace volumen
