#include "results/pictures/picture_greys.h"

#include <algorithm>
#include <map>

#include "io/frames.h"

namespace volumen {

namespace {

struct PictureGrey {
  int index = 0;
  ValueMapping mapping;
  std::vector<NamedGrey> greys;
};

std::vector<NamedGrey> through(const std::optional<Window>& window, std::vector<NamedGrey> greys) {
  if (!window) return greys;
  return {{{}, throughWindow(greys.front().mapping, *window)}};
}

// Returns a mapping of stored values that shows the same greys. The ramp of LINEAR is centred half a value
// lower and is one value narrower than its window (PS3.3 C.11.2.1.2.1).
GreyMapping ofStored(GreyMapping grey, const ValueMapping& values) {
  const double one = grey.function == WindowFunction::linear ? 1 : 0;
  grey.window.centre = (grey.window.centre - one / 2 - values.intercept) / values.slope + one / 2;
  grey.window.width = (grey.window.width - one) / values.slope + one;
  return grey;
}

// Converts the greys of pictures with different rescales to stored values. Returns an Error if a lookup
// table or a slope of 0 or less prevents it.
Status useStoredValues(std::vector<PictureGrey>& pictures) {
  for (PictureGrey& picture : pictures) {
    for (NamedGrey& grey : picture.greys) {
      if (!picture.mapping.table.empty() || picture.mapping.slope <= 0 || !grey.mapping.table.grey.empty())
        return Error{
            "The pictures have different rescales and lookup tables, and a presentation state has one "
            "rescale: choose pictures that are alike with --images."};
      grey.mapping = ofStored(grey.mapping, picture.mapping);
    }
    picture.mapping = {};
  }
  return {};
}

bool haveSameGreys(const PictureGrey& a, const PictureGrey& b) {
  return std::ranges::equal(a.greys, b.greys, [](const NamedGrey& x, const NamedGrey& y) {
    return x.name == y.name && x.mapping == y.mapping;
  });
}

// Returns one part for each group of pictures with the same greys.
std::vector<Presentation::Greys> partsOf(const Series& series, std::span<const PictureGrey> pictures) {
  std::vector<std::pair<const PictureGrey*, std::vector<int>>> groups;
  for (const PictureGrey& picture : pictures) {
    const auto same = [&](const auto& group) { return haveSameGreys(*group.first, picture); };
    auto group = std::ranges::find_if(groups, same);
    if (group == groups.end()) group = groups.insert(group, {&picture, {}});
    group->second.push_back(picture.index);
  }
  std::vector<Presentation::Greys> parts;
  for (const auto& [picture, indices] : groups) {
    const bool isAll = groups.size() == 1;
    parts.push_back({isAll ? std::vector<ReferencedPicture>() : picturesAt(series, indices), picture->greys});
  }
  return parts;
}

bool areAlike(const Frame& a, const Frame& b) {
  return a.size == b.size && a.pixel == b.pixel &&
         a.greys.front().mapping.inverted == b.greys.front().mapping.inverted;
}

/// Collects the greys of pictures that are added one by one.
class GreysCollector {
 public:
  GreysCollector(const SeriesPictures& chosen, const std::optional<Window>& window)
      : chosen_(chosen), window_(window) {}

  Status add(int index, Frame frame) {
    const Series& series = chosen_.series;
    const std::string& file = series.files[std::size_t(index)];
    if (series.sopInstanceUids[std::size_t(index)].empty())
      return Error{file + " has no SOPInstanceUID, by which a presentation state names its pictures."};
    if (frame.greys.empty())
      return Error{file +
                   " holds a picture in colour, but a grayscale presentation state is for grey pictures."};
    for (const std::string& warning : frame.warnings)
      if (std::ranges::find(greys_.notes, warning) == greys_.notes.end()) greys_.notes.push_back(warning);
    pictures_.push_back({index, frame.mapping, through(window_, frame.greys)});
    if (pictures_.size() == 1)
      greys_.first = std::move(frame);
    else if (!areAlike(greys_.first, frame))
      return Error{file +
                   " differs from the first picture in size, pixel spacing or inversion, and a presentation "
                   "state needs pictures that are alike: choose them with --images."};
    return {};
  }

  Result<PictureGreys> finish() {
    Presentation& p = greys_.presentation;
    const auto isOfFirst = [&](const PictureGrey& one) { return one.mapping == pictures_.front().mapping; };
    if (!std::ranges::all_of(pictures_, isOfFirst)) {
      if (Status s = useStoredValues(pictures_); !s) return s.error();
      greys_.notes.emplace_back(
          "The pictures have different rescales: each has a window of its own in stored values.");
    }
    p.pictures = picturesAt(chosen_.series, chosen_.indices);
    p.values = pictures_.front().mapping;
    p.greys = partsOf(chosen_.series, pictures_);
    p.inverted = pictures_.front().greys.front().mapping.inverted;
    return std::move(greys_);
  }

 private:
  const SeriesPictures& chosen_;
  const std::optional<Window>& window_;
  std::vector<PictureGrey> pictures_;
  PictureGreys greys_;
};

}  // namespace

GreyMapping throughWindow(GreyMapping grey, const Window& window) {
  grey.window = window, grey.table = {};
  if (grey.function == WindowFunction::linear && window.width < 1)
    grey.function = WindowFunction::linearExact;
  return grey;
}

std::vector<ReferencedPicture> picturesAt(const Series& series, const std::vector<int>& indices) {
  std::vector<ReferencedPicture> all;
  std::map<std::string, std::size_t> known;
  for (const int index : indices) {
    const auto n = std::size_t(index);
    const auto [at, isNew] = known.try_emplace(series.sopInstanceUids[n], all.size());
    if (isNew) all.push_back({series.sopInstanceUids[n], {}, {}, {}});
    all[at->second].frames.push_back(series.frames[n]);
  }
  for (ReferencedPicture& picture : all) std::ranges::sort(picture.frames);
  return all;
}

Result<PictureGreys> greysOfPictures(const SeriesPictures& chosen, const std::optional<Window>& window,
                                     const CancelToken& cancel) {
  auto frames = loadFrameGreys(chosen.series, chosen.indices, cancel);
  if (cancel.cancelled()) return Error{"Interrupted; nothing was written."};
  if (!frames) return frames.error();
  GreysCollector collector(chosen, window);
  for (std::size_t n = 0; n < frames->size(); ++n)
    if (Status s = collector.add(chosen.indices[n], std::move((*frames)[n])); !s) return s.error();
  return collector.finish();
}

}  // namespace volumen
