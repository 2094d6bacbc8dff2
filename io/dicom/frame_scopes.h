#pragma once

#include <optional>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// Where the attributes of one frame stand: all in the data set itself, or, in enhanced pictures, each in a
/// functional group of the frame or of all frames (PS3.3 C.7.6.16), and in the data set where there is no
/// such group (multi-frame secondary captures have their rescale and pixel spacing there, PS3.3 C.8.6.3).
class FrameScopes {
 public:
  explicit FrameScopes(DataSet::Scope root) : root_(root), isEnhanced_(false) {}
  FrameScopes(const DataSet& data, DataSet::Scope ofFrame, DataSet::Scope ofAll)
      : data_(&data), root_(ofFrame), ofAll_(ofAll), isEnhanced_(true) {}
  /// Those of frame `n` (from 0).
  FrameScopes(const DataSet& data, int n) : FrameScopes(data.root()) {
    const auto ofAll = data.items(sharedGroups, root_), ofFrames = data.items(perFrameGroups, root_);
    if (!isEnhanced(data)) return;
    const bool there = std::size_t(n) < ofFrames.size();
    *this = FrameScopes(data, there ? ofFrames[std::size_t(n)] : DataSet::Scope{},
                        ofAll.empty() ? DataSet::Scope{} : ofAll[0]);
  }

  /// Whether this functional group is there.
  bool hasGroup(std::uint32_t group) const { return isEnhanced_ && itemOf(group).has_value(); }

  static bool isEnhanced(const DataSet& data) {
    return data.find(sharedGroups, data.root()) || data.find(perFrameGroups, data.root());
  }

  /// The scope that holds the attributes of this functional group.
  DataSet::Scope of(std::uint32_t group) const {
    return isEnhanced_ ? itemOf(group).value_or(data_->root()) : root_;
  }
  /// The same of what the data set itself cannot say of each frame; an empty scope where there is no such
  /// group.
  DataSet::Scope ofGroupAlone(std::uint32_t group) const {
    return isEnhanced_ ? itemOf(group).value_or(DataSet::Scope{}) : root_;
  }

  /// All items of a sequence that a frame has: its own, else those of all frames, else those of the data set.
  std::vector<DataSet::Scope> itemsOf(std::uint32_t sequence, const DataSet& data) const {
    for (DataSet::Scope scope : {root_, ofAll_})
      if (auto items = data.items(sequence, scope); !items.empty()) return items;
    return data.items(sequence, data.root());
  }

  static constexpr std::uint32_t sharedGroups = 0x52009229, perFrameGroups = 0x52009230;

 private:
  std::optional<DataSet::Scope> itemOf(std::uint32_t group) const {
    for (DataSet::Scope scope : {root_, ofAll_})
      if (const auto items = data_->items(group, scope); !items.empty()) return items[0];
    return {};
  }

  const DataSet* data_ = nullptr;
  DataSet::Scope root_, ofAll_;
  bool isEnhanced_;
};

/// Functional groups that slices and frames as acquired both read.
inline constexpr std::uint32_t pixelMeasures = 0x00289110, pixelValueTransformation = 0x00289145,
                               frameVoiLut = 0x00289132;

}  // namespace volumen::dicom
