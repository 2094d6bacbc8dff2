#include "io/study/arrange.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_set>

#include "io/study/natural_order.h"
#include "io/study/study.h"

namespace volumen {
namespace {

long numberOf(const std::string& text) {
  long n = 0;
  std::from_chars(text.data(), text.data() + text.size(), n);
  return n;
}

struct Natural {
  const std::string& text;
  bool operator<(const Natural& other) const { return naturalOrder(text, other.text) < 0; }
  bool operator==(const Natural& other) const { return text == other.text; }
};

/// Appends "#1", "#2", ... to ids that several volumes of a series (or files of one name) share.
template <class Found>
void numberParts(std::vector<Found>& all) {
  std::map<std::string, int> count, next;
  for (const Found& found : all) ++count[found.id];
  for (Found& found : all)
    if (const std::string id = found.id; count[id] > 1)
      found.id.append("#").append(std::to_string(++next[id]));
}

/// Returns the key of `info`'s order: patient, study, series number.
auto orderKey(const SeriesIdentity& s) {
  return std::make_tuple(std::tie(s.patientName, s.patientId, s.studyDate, s.studyUid),
                         numberOf(s.seriesNumber));
}

/// Sorts by orderKey() and series. Within a series it keeps the reader's order: position, then the values
/// that separate its volumes.
void sortVolumes(std::vector<Series>& volumes) {
  const auto key = [](const Series& s) {
    return std::make_tuple(orderKey(s), Natural{s.seriesUid.empty() ? s.path : s.seriesUid});
  };
  std::stable_sort(volumes.begin(), volumes.end(),
                   [&](const Series& a, const Series& b) { return key(a) < key(b); });
}

/// Sorts by orderKey(), series and path.
template <class Found>
void sortFiles(std::vector<Found>& files) {
  const auto key = [](const Found& f) {
    return std::make_tuple(orderKey(f), Natural{f.seriesUid}, std::tie(f.path));
  };
  std::stable_sort(files.begin(), files.end(),
                   [&](const Found& a, const Found& b) { return key(a) < key(b); });
}

/// Sets DerivedObject::notHere of every derived object.
void countNotHere(Study& study) {
  std::unordered_set<std::string_view> here;
  if (study.derived.empty()) return;
  for (const Series& s : study.volumes) here.insert(s.sopInstanceUids.begin(), s.sopInstanceUids.end());
  for (const Image& image : study.images) here.insert(image.sopInstanceUid);
  for (const DerivedObject& object : study.derived) here.insert(object.sopInstanceUid);
  for (DerivedObject& object : study.derived)
    object.notHere = std::size_t(std::ranges::count_if(
        object.pictures, [&](const ReferencedPicture& p) { return !here.contains(p.sopInstanceUid); }));
}

}  // namespace

void sortImages(std::vector<Image>& images) { sortFiles(images); }

void arrange(Study& study) {
  sortVolumes(study.volumes);
  numberParts(study.volumes);
  sortImages(study.images);
  numberParts(study.images);
  sortFiles(study.derived);
  numberParts(study.derived);
  countNotHere(study);
}

}  // namespace volumen
