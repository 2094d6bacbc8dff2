#include "viewer/scene/automatic.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "viewer/scene/presets.h"

namespace volumen {

namespace {

constexpr int fineBins = 1 << 16;

// Returns the number of values in [low, high), by whole bins.
std::int64_t countBetween(const Histogram& h, double low, double high) {
  std::int64_t sum = 0;
  for (std::size_t n = 0; n < h.counts.size(); ++n) {
    const double centre = h.low + (double(n) + 0.5) * h.binWidth();
    if (centre >= low && centre < high) sum += h.counts[n];
  }
  return sum;
}

// Returns the fraction of the values above `least` that lie in [low, high); 0 if there are none.
double share(const Histogram& h, double low, double high, double least) {
  const std::int64_t all = countBetween(h, least, 1e30);
  return all == 0 ? 0 : double(countBetween(h, low, high)) / double(all);
}

}  // namespace

ValueRange usualRange(const Volume& volume) {
  const Histogram h = histogram(volume, fineBins);
  const ValueRange usual{valueOfRank(h, 0.01), valueOfRank(h, 0.995)};
  // In label maps, or small objects on a large background, nearly all values are equal.
  return usual.low < usual.high ? usual : ValueRange{h.low, h.high};
}

bool looksLikeHounsfield(const Histogram& h) {
  return h.low >= -4096 && h.high <= 40000 && share(h, -1100, -900, -1100) > 0.02 &&
         countBetween(h, 0, 1e30) > 0;
}

double waterOf(const Volume& volume) {
  if (volume.attributes().modality != "CT") return 0;
  const bool hasNegative = std::visit(
      [&](const auto& stored) {
        return std::ranges::any_of(stored, [&](auto v) { return volume.realValue(double(v)) < 0; });
      },
      volume.stored());
  if (hasNegative) return 0;
  // Fat and muscle, 1024 higher, are most of the matter denser than foam. In Hounsfield units that would
  // be bone.
  return share(histogram(volume, fineBins), 850, 1200, 500) > 0.5 ? 1024 : 0;
}

bool inHounsfield(const Volume& volume, const Histogram& h) {
  const std::string& modality = volume.attributes().modality;
  return (modality == "CT" && waterOf(volume) == 0) || (modality.empty() && looksLikeHounsfield(h));
}

bool hasContrast(const Histogram& h) {
  constexpr double binHu = 20, firstHu = 130, lastHu = 450;
  double lowest = double(countBetween(h, firstHu, firstHu + binHu));
  for (double hu = firstHu + binHu; hu < lastHu; hu += binHu) {
    const double count = double(countBetween(h, hu, hu + binHu));
    // The factor 1.5 exceeds the hump of a table top (a tenth); the second term exceeds chance.
    if (count > 1.5 * lowest + 5 * std::sqrt(count)) return true;
    lowest = std::min(lowest, count);
  }
  return false;
}

bool isChest(const Histogram& h) { return share(h, -900, -600, -900) > 0.1; }

bool isBony(const Histogram& h) { return share(h, 300, 1e30, -200) > 0.09; }

std::string automaticPreset(const Volume& volume) {
  const std::string& modality = volume.attributes().modality;
  if (modality == "US") return "US-Fetal";
  // A surface of a head would be its face; the brightest values lie inside.
  if (modality == "MR") return "MR-MIP";
  if (modality == "PT" || modality == "NM") return "PET-MIP";
  Histogram h = histogram(volume, fineBins);
  const double water = waterOf(volume);
  if (water == 0 && !inHounsfield(volume, h)) return "MR-Default";
  h.low -= water, h.high -= water;
  if (isBony(h)) return "CT-Bone";
  if (isChest(h)) return hasContrast(h) ? "CT-Chest-Contrast-Enhanced" : "CT-Bones";
  return hasContrast(h) ? "CT-AAA" : "CT-Muscle";
}

}  // namespace volumen
