#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/series/series_facts.h"
#include "ui/workspace/priors.h"

namespace volumen {

/// Conditions on a series, or on one picture of a series of projections. Empty fields accept anything. Texts
/// are alternatives, "CR|DX", and ignore case.
struct SeriesRule {
  std::string modality, laterality, viewPosition;     ///< alternatives
  std::string bodyPart, description, notDescription;  ///< words, by their beginning (hasWord())
  std::optional<ViewKind> plane;                      ///< plane of the acquired slices
  std::optional<Weighting> weighting;
  std::optional<Kernel> kernel;
  std::optional<bool> contrast;
  bool operator==(const SeriesRule&) const = default;
};

/// The order of several matching series.
enum class SeriesOrder { number, time, description, slices };

/// A series under the name that cells use.
struct ProtocolSeries {
  std::string name;
  SeriesRule rule;
  SeriesOrder order = SeriesOrder::number;
  int prior = 0;     ///< study: 0 the current one, 1 the latest earlier one with this modality, ...
  std::string like;  ///< replaces the rule: name of the entry whose most similar series is taken; `prior`
                     ///< counts earlier studies that have one
  bool operator==(const ProtocolSeries&) const = default;
};

/// The picture that a cell shows of its series.
enum class CellPicture { asAcquired, axial, coronal, sagittal, scene, frames };

/// Limits of a cell's window: largest centre and width, negative ones as well, and smallest width.
inline constexpr double mostOfWindow = 1e9, leastWidthOfWindow = 1e-9;

/// The side of a view where a mammogram's chest wall is to lie.
enum class ChestWall { anywhere, left, right };

/// One view of the grid.
struct ProtocolCell {
  std::string series;  ///< names, "lung|soft": the first that is found; empty: no series
  int which = 1;       ///< number among several matching series, from 1
  CellPicture picture = CellPicture::asAcquired;  ///< `scene` needs a known 3D look of the series
  /// In displayed units. Applies to the series in all views, but to this view alone if another cell gives the
  /// series another window.
  std::optional<Window> window;
  std::string over;  ///< name of the overlaid series; empty: none
  double slabMm = 0;
  SlabMode slabMode = SlabMode::max;
  bool inverted = false;
  ChestWall chestWall = ChestWall::anywhere;
  bool operator==(const ProtocolCell&) const = default;
};

/// The studies a protocol is for.
struct ProtocolCondition {
  SeriesRule rule;              ///< matched by at least one series
  int least = 1, most = 10000;  ///< number of matching series
  bool prior = false;           ///< needs an open earlier study of that modality
  bool operator==(const ProtocolCondition&) const = default;
};

/// A hanging protocol: which series are shown, where and how.
struct HangingProtocol {
  std::string name;
  ProtocolCondition when;
  std::vector<ProtocolSeries> series;
  Layout layout = Layout::two;      ///< must be a grid
  std::vector<ProtocolCell> cells;  ///< row by row, at most one per cell of the grid
  int leastFilled = 1;              ///< cells that must find their series
  Links links;
  bool sameScale = false;  ///< same mm per pixel in all frames
  bool automatic = false;  ///< hangs when the study is opened
  bool operator==(const HangingProtocol&) const = default;
};

/// Reads a protocol from JSON (resources/docs/protocols.md). The Error names the wrong or unknown field.
Result<HangingProtocol> protocolFromJson(const std::string& text);
/// Returns JSON that protocolFromJson() reads. Default values are left out.
std::string protocolToJson(const HangingProtocol& protocol);

bool matches(const SeriesRule& rule, const SeriesPicture& picture);

/// Returns the pictures that match the rule of an entry in its study, in the entry's order.
std::vector<SeriesPicture> picturesFor(const ProtocolSeries& entry, const PatientStudies& studies);

/// Returns one picture for each cell, without a series if none was found.
std::vector<SeriesPicture> picturesOfCells(const HangingProtocol& protocol, const PatientStudies& studies);

/// Returns the indices of protocols that fit the open studies, best first: by number of conditions, then by
/// number of filled cells. Equal ones keep their order.
std::vector<std::size_t> fitting(const std::vector<HangingProtocol>& protocols,
                                 const PatientStudies& studies);

/// Returns the workspace after hanging. Cells without a series are empty and name the one they want.
Workspace hung(Workspace workspace, const HangingProtocol& protocol, const PatientStudies& studies);

/// Returns the protocol that hangs studies like the one in focus as on screen, without other patients'
/// series. `open` are all open pictures. `last` is the protocol hung last, or null. Where its pictures still
/// stand it gives chest walls and scale.
HangingProtocol protocolOf(const Workspace& workspace, const std::string& name,
                           const std::vector<const Series*>& open, const HangingProtocol* last = nullptr);

}  // namespace volumen
