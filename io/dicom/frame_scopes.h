#pragma once

#include <optional>
#include <vector>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// Locates the attributes of one frame. They are all in the data set itself or, in enhanced pictures, in
/// functional groups of the frame or of all frames (PS3.3 C.7.6.16). Without such a group the data set
/// applies: multi-frame secondary captures have rescale and pixel spacing there (PS3.3 C.8.6.3).
class FrameScopes {
 public:
  explicit FrameScopes(DataSet::Scope root) : root_(root), isEnhanced_(false) {}
  FrameScopes(const DataSet& data, DataSet::Scope ofFrame, DataSet::Scope ofAll)
      : data_(&data), root_(ofFrame), ofAll_(ofAll), isEnhanced_(true) {}
  /// Locates the attributes of frame `n` (from 0).
  FrameScopes(const DataSet& data, int n) : FrameScopes(data.root()) {
    const auto ofAll = data.items(sharedGroups, root_), ofFrames = data.items(perFrameGroups, root_);
    if (!isEnhanced(data)) return;
    const bool there = std::size_t(n) < ofFrames.size();
    *this = FrameScopes(data, there ? ofFrames[std::size_t(n)] : DataSet::Scope{},
                        ofAll.empty() ? DataSet::Scope{} : ofAll[0]);
  }

  /// Returns whether this functional group is present.
  bool hasGroup(std::uint32_t group) const { return isEnhanced_ && itemOf(group).has_value(); }

  static bool isEnhanced(const DataSet& data) {
    return data.find(sharedGroups, data.root()) || data.find(perFrameGroups, data.root());
  }

  /// Returns the scope that holds the attributes of a functional group.
  DataSet::Scope of(std::uint32_t group) const {
    return isEnhanced_ ? itemOf(group).value_or(data_->root()) : root_;
  }
  /// Does the same for attributes that must not come from the data set. Returns an empty scope without such a
  /// group.
  DataSet::Scope ofGroupAlone(std::uint32_t group) const {
    return isEnhanced_ ? itemOf(group).value_or(DataSet::Scope{}) : root_;
  }

  /// Returns the items of a sequence: those of the frame, else of all frames, else of the data set.
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

/// Functional groups that both slices and frames as acquired read.
inline constexpr std::uint32_t pixelMeasures = 0x00289110, pixelValueTransformation = 0x00289145,
                               frameVoiLut = 0x00289132;

}  // namespace volumen::dicom
