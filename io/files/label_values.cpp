#include "io/files/label_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "viewer/volume/buffer.h"

namespace volumen {

namespace {

std::string shortText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) < 0.01 ? "%.1g" : "%.6g", value);
  return text;
}

}  // namespace

Result<std::vector<LabelOf>> labelsFor(std::span<const std::uint32_t> values) {
  constexpr std::size_t most = 255;
  if (values.size() > most)
    return Error{"it has " + std::to_string(values.size()) + " segments in one layer; at most 255 are read."};
  std::vector<LabelOf> labels;
  std::array<bool, most + 1> taken{};
  for (const std::uint32_t value : values)
    if (value <= most) taken[value] = true;
  std::size_t next = 1;
  for (const std::uint32_t value : values) {
    if (value > most)
      while (taken[next]) ++next;
    labels.push_back({value, std::uint8_t(value > most ? next++ : value)});
  }
  return labels;
}

// Files hold labels as float32 or with a float32 slope: 1.0000458 means 1.
Result<LabelValues> LabelValues::read(const ImageHeader& header, std::uint64_t volume,
                                      const std::string& path, std::vector<std::string>& notes,
                                      const Progress& progress, const CancelToken& cancel) {
  constexpr double mostOff = 1e-3;
  std::vector<std::string> warnings;
  auto samples = readSamples(header.data, volume, header.slope, header.intercept, progress, cancel, warnings);
  if (!samples) return samples.error();
  LabelValues made;
  made.geometry_ = header.geometry;
  double farthest = 0;
  const std::optional<double> wrong = std::visit(
      [&](const auto& stored) -> std::optional<double> {
        made.values_.reserve(stored.size());
        for (const auto raw : stored) {
          const double value = samples->slope * double(raw) + samples->intercept, label = std::round(value);
          if (!(label >= 0 && label <= mostLabelValue && std::abs(value - label) <= mostOff)) return value;
          farthest = std::max(farthest, std::abs(value - label));
          made.values_.push_back(std::uint32_t(label));
        }
        return {};
      },
      samples->values);
  if (wrong)
    return Error{path + " holds values that are no labels, such as " + shortText(*wrong) +
                 ": whole numbers from 0 to " + std::to_string(mostLabelValue) + " are meant."};
  if (farthest > 0)
    notes.push_back(path + ": labels are off whole numbers by up to " + shortText(farthest) +
                    ", and were rounded.");
  return made;
}

std::vector<std::uint32_t> LabelValues::present() const {
  std::vector<bool> there(std::size_t(*std::ranges::max_element(values_)) + 1);
  std::uint32_t last = 0;
  for (const std::uint32_t value : values_)
    if (value != last) there[last = value] = true;
  std::vector<std::uint32_t> all;
  for (std::uint32_t value = 1; value < there.size(); ++value)
    if (there[value]) all.push_back(value);
  return all;
}

DenseLabels LabelValues::labels(std::span<const LabelOf> labels) const {
  std::uint32_t most = 0;
  for (const LabelOf& l : labels) most = std::max(most, l.value);
  std::vector<std::uint8_t> labelOf(std::size_t(most) + 1);
  for (const LabelOf& l : labels) labelOf[l.value] = l.label;
  DenseLabels made{geometry_, zeros<std::uint8_t>(values_.size())};
  for (std::size_t n = 0; n < values_.size(); ++n)
    if (values_[n] <= most) made.labels[n] = labelOf[values_[n]];
  return made;
}

}  // namespace volumen
