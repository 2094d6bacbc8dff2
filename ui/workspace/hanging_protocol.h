#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/workspace/priors.h"
#include "ui/workspace/series_facts.h"

namespace volumen {

/// What a series must be, or of a series of projections one picture; what is not said may be anything. Texts
/// are alternatives, "CR|DX"; upper or lower case is the same.
struct SeriesRule {
  std::string modality, laterality, viewPosition;     ///< one of these
  std::string bodyPart, description, notDescription;  ///< words, by their beginning (hasWord())
  std::optional<ViewKind> plane;                      ///< of the slices as acquired
  std::optional<Weighting> weighting;
  std::optional<Kernel> kernel;
  std::optional<bool> contrast;
  bool operator==(const SeriesRule&) const = default;
};

/// Which of several series comes first.
enum class SeriesOrder { number, time, description, slices };

/// A series by a name that cells use.
struct ProtocolSeries {
  std::string name;
  SeriesRule rule;
  SeriesOrder order = SeriesOrder::number;
  int prior = 0;  ///< of which study: 0 the current one, 1 the latest before that holds such a modality, ...
  std::string like;  ///< instead of a rule: what is most like this one of the protocol, of the earlier
                     ///< studies that hold something like it
  bool operator==(const ProtocolSeries&) const = default;
};

/// What a cell shows of its series.
enum class CellPicture { asAcquired, axial, coronal, sagittal, scene, frames };

/// What the centre and width of a cell's window may be, negative ones as well.
inline constexpr double mostOfWindow = 1e9, leastWidthOfWindow = 1e-9;

/// Where the chest wall of a mammogram is to lie.
enum class ChestWall { anywhere, left, right };

/// One view of the grid.
struct ProtocolCell {
  std::string series;  ///< names, "lung|soft": the first one that there is; empty: nothing
  int which = 1;       ///< of several series that fit: the first, the second, ...
  CellPicture picture = CellPicture::asAcquired;  ///< `scene` where the 3D look of the series is known
  /// In the numbers on screen; of the series wherever it is shown, but of this view alone where another cell
  /// gives that series another window.
  std::optional<Window> window;
  std::string over;  ///< the name of a series over it; empty: none
  double slabMm = 0;
  SlabMode slabMode = SlabMode::max;
  bool inverted = false;
  ChestWall chestWall = ChestWall::anywhere;
  bool operator==(const ProtocolCell&) const = default;
};

/// Which studies a protocol is for.
struct ProtocolCondition {
  SeriesRule rule;              ///< of at least one series
  int least = 1, most = 10000;  ///< how many of them there are
  bool prior = false;           ///< an earlier study of that modality is open, too
  bool operator==(const ProtocolCondition&) const = default;
};

/// How a study is hung: which series stand where, and how.
struct HangingProtocol {
  std::string name;
  ProtocolCondition when;
  std::vector<ProtocolSeries> series;
  Layout layout = Layout::two;      ///< a grid
  std::vector<ProtocolCell> cells;  ///< row by row; at most as many as the grid has
  int leastFilled = 1;              ///< cells that find their series, or it does not fit
  Links links;
  bool sameScale = false;  ///< of frames: as many mm a pixel in all of them
  bool automatic = false;  ///< hung as the study is opened
  bool operator==(const HangingProtocol&) const = default;
};

/// A protocol from JSON (resources/docs/protocols.md). An Error names the field that is wrong, or unknown.
Result<HangingProtocol> protocolFromJson(const std::string& text);
/// What protocolFromJson() reads; what is as by default is left out.
std::string protocolToJson(const HangingProtocol& protocol);

bool matches(const SeriesRule& rule, const SeriesPicture& picture);

/// What the rule of an entry finds in its study, in its order.
std::vector<SeriesPicture> picturesFor(const ProtocolSeries& entry, const PatientStudies& studies);

/// What each cell shows; no series: none was found. As many as there are cells.
std::vector<SeriesPicture> picturesOfCells(const HangingProtocol& protocol, const PatientStudies& studies);

/// The numbers of those of some protocols that fit what is open, the best first: that whose condition says
/// most, else that of which most cells are filled; those alike in their order.
std::vector<std::size_t> fitting(const std::vector<HangingProtocol>& protocols,
                                 const PatientStudies& studies);

/// The workspace as a protocol has it. Cells without a series are empty and say what they want.
Workspace hung(Workspace workspace, const HangingProtocol& protocol, const PatientStudies& studies);

/// The protocol that hangs studies like the one in focus as the views on screen show it; what they show of
/// other patients is left out. `open`: all pictures that are open. `last`: the protocol that was hung last,
/// null: none; where its pictures stand it says where chest walls lie, and the scale.
HangingProtocol protocolOf(const Workspace& workspace, const std::string& name,
                           const std::vector<const Series*>& open, const HangingProtocol* last = nullptr);

}  // namespace volumen
